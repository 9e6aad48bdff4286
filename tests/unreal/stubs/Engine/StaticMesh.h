#pragma once
#include "CoreMinimal.h"
class FStaticMeshRenderData;
class UStaticMesh : public UObject
{
public:
	uint8 bAllowCPUAccess : 1;
	FStaticMeshRenderData* GetRenderData() const { return StubData; }
	FStaticMeshRenderData* StubData = nullptr;
};
