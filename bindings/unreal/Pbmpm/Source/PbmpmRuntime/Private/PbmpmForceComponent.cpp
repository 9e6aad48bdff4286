#include "PbmpmForceComponent.h"

#include "PbmpmWorld.h"

using namespace PbmpmConversion;

static pbmpm_force_kind KindOf(EPbmpmForce Kind)
{
	switch (Kind)
	{
	case EPbmpmForce::Radial:
		return PBMPM_FORCE_RADIAL;
	case EPbmpmForce::Vortex:
		return PBMPM_FORCE_VORTEX;
	case EPbmpmForce::Drag:
		return PBMPM_FORCE_DRAG;
	case EPbmpmForce::Grab:
		return PBMPM_FORCE_GRAB;
	default:
		return PBMPM_FORCE_UNIFORM;
	}
}

static pbmpm_falloff FalloffOf(EPbmpmFalloff Falloff)
{
	switch (Falloff)
	{
	case EPbmpmFalloff::Linear:
		return PBMPM_FALLOFF_LINEAR;
	case EPbmpmFalloff::Smooth:
		return PBMPM_FALLOFF_SMOOTH;
	case EPbmpmFalloff::InverseSquare:
		return PBMPM_FALLOFF_INVERSE_SQUARE;
	default:
		return PBMPM_FALLOFF_NONE;
	}
}

pbmpm::force_def UPbmpmForceComponent::Define() const
{
	const FQuat Rotation = GetComponentTransform().GetRotation();
	pbmpm::force_def Def;
	Def.kind = KindOf(Kind);
	Def.enabled = bActs;
	Def.everywhere = bEverywhere;
	Def.falloff = FalloffOf(Falloff);
	Def.range = Coordinates.length(Range);
	// A drag's strength is per second, without a length.
	Def.strength = Kind == EPbmpmForce::Drag ? Strength : Coordinates.length(Strength);
	// A uniform force acts along its direction; the others turn about it, and turning is mirrored.
	if (Kind == EPbmpmForce::Uniform)
	{
		Set(Def.direction, Coordinates.direction(Plain(Rotation.GetForwardVector())));
	}
	else
	{
		Set(Def.direction, Coordinates.turning(Plain(Rotation.GetUpVector())));
	}
	Set(Def.velocity, Coordinates.vector(Plain(Velocity)));
	Def.spin = FMath::DegreesToRadians(Spin);
	return Def;
}

void UPbmpmForceComponent::Begin(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("A force");
	const auto Form = MakeShape(World);
	const auto Editing = World.Editing();
	if (!FPbmpmWorld::Succeeded(Form, What) || !FPbmpmWorld::Succeeded(Editing, What))
	{
		return;
	}
	Told = *Form;
	ToldDef = Define();
	const auto Made = Editing->force_create(ToldDef, Told);
	if (FPbmpmWorld::Succeeded(Made, What))
	{
		Force = *Made;
	}
}

void UPbmpmForceComponent::BeforeFrame(FPbmpmWorld& World)
{
	if (pbmpm::is_null(Force))
	{
		return;
	}
	pbmpm::shape Now = Told;
	pbmpm::vector3 Position;
	pbmpm::quaternion Rotation;
	Pose(Position, Rotation);
	Set(Now.position, Position);
	Set(Now.rotation, Rotation);
	const pbmpm::force_def Def = Define();
	// Structures without padding, so that equal bytes are equal values.
	if (FMemory::Memcmp(&Now, &Told, sizeof(Now)) == 0 && FMemory::Memcmp(&Def, &ToldDef, sizeof(Def)) == 0)
	{
		return;
	}
	Told = Now;
	ToldDef = Def;
	if (const auto Editing = World.Editing())
	{
		FPbmpmWorld::Succeeded(Editing->force_set(Force, &Def, &Now), TEXT("A force"));
	}
}

void UPbmpmForceComponent::End(FPbmpmWorld& World)
{
	const auto Editing = World.Editing();
	if (Editing && !pbmpm::is_null(Force))
	{
		FPbmpmWorld::Succeeded(Editing->force_destroy(Force), TEXT("A force"));
	}
	Force = {};
}
