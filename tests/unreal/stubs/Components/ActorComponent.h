#pragma once
#include "CoreMinimal.h"
class AActor;
class UWorld;
namespace EEndPlayReason
{
enum Type { Destroyed, Quit };
}
enum ELevelTick { LEVELTICK_All };
struct FActorComponentTickFunction
{
	bool bCanEverTick = false;
};
class UActorComponent : public UObject
{
public:
	virtual void BeginPlay() {}
	virtual void EndPlay(const EEndPlayReason::Type) {}
	virtual void TickComponent(float, ELevelTick, FActorComponentTickFunction*) {}
	UWorld* GetWorld() const { return StubLevel; }
	AActor* GetOwner() const { return StubOwner; }
	FActorComponentTickFunction PrimaryComponentTick;
	UWorld* StubLevel = nullptr;
	AActor* StubOwner = nullptr;
};
