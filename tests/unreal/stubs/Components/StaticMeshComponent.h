#pragma once
#include "Components/PrimitiveComponent.h"
class UStaticMesh;
class UStaticMeshComponent : public UPrimitiveComponent
{
public:
	virtual bool SetStaticMesh(UStaticMesh*) { return true; }
};
