#include "PbmpmColliderComponent.h"

#include "Components/PrimitiveComponent.h"

#include "PbmpmWorld.h"

using namespace PbmpmConversion;

static pbmpm_friction FrictionOf(EPbmpmFriction Friction)
{
	switch (Friction)
	{
	case EPbmpmFriction::Stick:
		return PBMPM_FRICTION_STICK;
	case EPbmpmFriction::Slip:
		return PBMPM_FRICTION_SLIP;
	default:
		return PBMPM_FRICTION_COULOMB;
	}
}

UPrimitiveComponent* UPbmpmColliderComponent::FindBody() const
{
	UPrimitiveComponent* Parent = Cast<UPrimitiveComponent>(GetAttachParent());
	return Parent && Parent->IsSimulatingPhysics() ? Parent : nullptr;
}

void UPbmpmColliderComponent::Begin(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("A collider");
	const auto Form = MakeShape(World);
	const auto Editing = World.Editing();
	if (!FPbmpmWorld::Succeeded(Form, What) || !FPbmpmWorld::Succeeded(Editing, What))
	{
		return;
	}
	UPrimitiveComponent* Parent = FindBody();
	pbmpm::collider_def Def;
	Def.friction = FrictionOf(Friction);
	Def.friction_coefficient = FrictionCoefficient;
	Def.kinematic = bMoves || Parent;
	Def.measures_impulse = Parent != nullptr;
	Def.sensor = bSensor;
	const auto Made = Editing->collider_create(Def, *Form);
	if (!FPbmpmWorld::Succeeded(Made, What))
	{
		return;
	}
	Collider = *Made;
	if (!Parent)
	{
		return;
	}
	// From the collider to the centre of mass, along the collider's own axes. The shape's turn undoes itself in the world's coordinates.
	pbmpm::vector3 Position;
	pbmpm::quaternion Rotation;
	Pose(Position, Rotation);
	const pbmpm::quaternion Back{-Rotation[0], -Rotation[1], -Rotation[2], Rotation[3]};
	const FVector Away = Parent->GetCenterOfMass() - GetComponentTransform().GetLocation();
	const pbmpm::vector3 Centre = pbmpm::engine::turned(Back, Coordinates.vector(Plain(Away)));
	const auto Coupled = World.Simulation.add_body(pbmpm::engine::body(Collider, Parent->GetMass(), Centre));
	if (FPbmpmWorld::Succeeded(Coupled, What))
	{
		Coupling = int32(*Coupled);
		Body = Parent;
	}
}

void UPbmpmColliderComponent::BeforeFrame(FPbmpmWorld& World)
{
	pbmpm::vector3 Position;
	pbmpm::quaternion Rotation;
	Pose(Position, Rotation);
	if (UPrimitiveComponent* Parent = Body.Get())
	{
		const pbmpm::vector3 Velocity = Coordinates.vector(Plain(Parent->GetPhysicsLinearVelocity()));
		const pbmpm::vector3 Turning = Coordinates.turning(Plain(Parent->GetPhysicsAngularVelocityInRadians()));
		World.Simulation.body_at(SIZE_T(Coupling)).set_motion({Position, Rotation, Velocity, Turning});
	}
	else if (bMoves && !pbmpm::is_null(Collider) && Coupling == INDEX_NONE)
	{
		World.Simulation.follow(Collider, Position, Rotation);
	}
}

void UPbmpmColliderComponent::AfterFrame(FPbmpmWorld& World)
{
	UPrimitiveComponent* Parent = Body.Get();
	if (!Parent)
	{
		return;
	}
	const pbmpm::engine::push Push = World.Simulation.body_at(SIZE_T(Coupling)).take_push();
	Parent->AddImpulse(ToUnreal(Coordinates.host_impulse(Push.linear)));
	Parent->AddAngularImpulseInRadians(ToUnreal(Coordinates.host_angular_impulse(Push.angular)));
}

void UPbmpmColliderComponent::End(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("A collider");
	if (Coupling != INDEX_NONE)
	{
		FPbmpmWorld::Succeeded(World.Simulation.remove_body(SIZE_T(Coupling)), What);
	}
	else if (!pbmpm::is_null(Collider))
	{
		World.Simulation.leave(Collider);
		const auto Editing = World.Editing();
		FPbmpmWorld::Succeeded(Editing ? Editing->collider_destroy(Collider) : Editing.error(), What);
	}
	Collider = {};
	Coupling = INDEX_NONE;
	Body = nullptr;
}
