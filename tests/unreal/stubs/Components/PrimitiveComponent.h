#pragma once
#include "Components/SceneComponent.h"
namespace ECollisionEnabled
{
enum Type { NoCollision };
}
// A body in Unreal's units: centimetres, kilograms.
class UPrimitiveComponent : public USceneComponent
{
public:
	virtual bool IsSimulatingPhysics(FName = FName()) const { return StubSimulates; }
	virtual float GetMass() const { return StubMass; }
	FVector GetCenterOfMass(FName = FName()) const { return GetComponentTransform().GetLocation(); }
	FVector GetPhysicsLinearVelocity(FName = FName()) { return StubVelocity; }
	FVector GetPhysicsAngularVelocityInRadians(FName = FName()) const { return StubTurning; }
	virtual void AddImpulse(FVector Impulse, FName = FName(), bool = false) { StubVelocity = StubVelocity + Impulse * (1.0 / StubMass); }
	virtual void AddAngularImpulseInRadians(FVector Impulse, FName = FName(), bool = false) { StubTurning = StubTurning + Impulse * (1.0 / StubInertia); }
	virtual void SetCollisionEnabled(ECollisionEnabled::Type) {}
	void StubSimulate(float Seconds)
	{
		StubTransform = FTransform(StubTransform.GetRotation(), StubTransform.GetLocation() + StubVelocity * Seconds, StubTransform.GetScale3D());
		StubVelocity = StubVelocity + FVector(0, 0, -981) * Seconds;
	}
	virtual void SetSimulatePhysics(bool bSimulate) { StubSimulates = bSimulate; }
	void SetMassOverrideInKg(FName, float Mass, bool = true) { StubMass = Mass; }
	bool StubSimulates = false;
	float StubMass = 1, StubInertia = 1e6f;
	FVector StubVelocity, StubTurning;
};
