#pragma once
#include "Components/ActorComponent.h"
class USceneComponent : public UActorComponent
{
public:
	const FTransform& GetComponentTransform() const { return StubParent ? StubParent->GetComponentTransform() : StubTransform; }
	USceneComponent* GetAttachParent() const { return StubParent; }
	FTransform StubTransform;
	USceneComponent* StubParent = nullptr; // attached without an offset
};
