#pragma once
#include "Components/ActorComponent.h"
class USceneComponent : public UActorComponent
{
public:
	// Brought up to date by each call, as Unreal's is by each move.
	const FTransform& GetComponentTransform() const
	{
		if (!StubParent)
		{
			return StubTransform;
		}
		const FTransform& Parent = StubParent->GetComponentTransform();
		StubWorld = FTransform(Parent.GetRotation() * StubTransform.GetRotation(),
			Parent.GetLocation() + Parent.GetRotation().RotateVector(StubTransform.GetLocation() * Parent.GetScale3D()),
			Parent.GetScale3D() * StubTransform.GetScale3D());
		return StubWorld;
	}
	USceneComponent* GetAttachParent() const { return StubParent; }
	void SetupAttachment(USceneComponent* Parent, FName = FName()) { StubParent = Parent; }
	void SetRelativeLocation(FVector Place) { StubTransform = FTransform(StubTransform.GetRotation(), Place, StubTransform.GetScale3D()); }
	void SetRelativeRotation(const FQuat& Turn) { StubTransform = FTransform(Turn, StubTransform.GetLocation(), StubTransform.GetScale3D()); }
	void SetRelativeScale3D(FVector Scale) { StubTransform.SetScale3D(Scale); }
	FTransform StubTransform; // relative to the parent
	USceneComponent* StubParent = nullptr;

private:
	mutable FTransform StubWorld;
};
