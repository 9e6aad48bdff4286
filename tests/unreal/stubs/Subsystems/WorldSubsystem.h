#pragma once
#include "CoreMinimal.h"
#include "Components/ActorComponent.h"
#include "Engine/World.h"
class UTickableWorldSubsystem : public UObject
{
public:
	UTickableWorldSubsystem() = default;
	UTickableWorldSubsystem(FVTableHelper& Helper) : UObject(Helper) {}
	virtual void Deinitialize() {}
	virtual void Tick(float) {}
	virtual TStatId GetStatId() const = 0;

protected:
	virtual bool DoesSupportWorldType(const EWorldType::Type) const { return true; }
};
