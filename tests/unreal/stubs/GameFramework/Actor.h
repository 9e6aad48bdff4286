#pragma once
#include "Components/SceneComponent.h"
struct FActorTickFunction
{
	bool bCanEverTick = false;
};
class AActor : public UObject
{
public:
	template <class Type> Type* FindComponentByClass() const { return nullptr; }
	template <class Type> Type* CreateDefaultSubobject(FName Name)
	{
		for (const auto& [Known, Object] : StubObjects)
		{
			if (Known == Name)
			{
				std::abort(); // two of one name, which Unreal refuses, too
			}
		}
		Type* Made = new Type;
		if constexpr (std::is_base_of_v<UActorComponent, Type>)
		{
			Made->StubOwner = this;
		}
		StubObjects.emplace_back(Name, std::unique_ptr<UObject>(Made));
		return Made;
	}
	virtual void Tick(float) {}
	FVector GetActorLocation() const { return RootComponent ? RootComponent->GetComponentTransform().GetLocation() : FVector::ZeroVector; }
	USceneComponent* RootComponent = nullptr;
	FActorTickFunction PrimaryActorTick;
	std::vector<std::pair<FName, std::unique_ptr<UObject>>> StubObjects;
};
