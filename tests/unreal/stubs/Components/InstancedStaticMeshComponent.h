#pragma once
#include "Components/StaticMeshComponent.h"
class UInstancedStaticMeshComponent : public UStaticMeshComponent
{
public:
	int32 NumCustomDataFloats = 0;
	int32 GetInstanceCount() const { return StubInstances.Num(); }
	virtual TArray<int32> AddInstances(const TArray<FTransform>& Fresh, bool, bool = false, bool = true)
	{
		for (const FTransform& One : Fresh)
		{
			StubInstances.Add(One);
		}
		return {};
	}
	virtual bool SetCustomData(int32 Index, TArrayView<const float> Data, bool = false) { return Index < StubInstances.Num() && Data.Num() == NumCustomDataFloats; }
	virtual bool BatchUpdateInstancesTransforms(int32 First, const TArray<FTransform>& Fresh, bool = false, bool = false, bool = false)
	{
		for (int32 Index = 0; Index < Fresh.Num(); Index++)
		{
			StubInstances[First + Index] = Fresh[Index];
		}
		return true;
	}
	TArray<FTransform> StubInstances;
};
