#include "PbmpmEmitterComponent.h"

#include "PbmpmWorld.h"

using namespace PbmpmConversion;

/* What may change while it plays. */
void UPbmpmEmitterComponent::Describe(pbmpm_emitter_def& Def) const
{
	constexpr float CubicMetresPerLitre = 1e-3f;
	Def.enabled = bEmits;
	Def.rate = Rate * CubicMetresPerLitre;
	Def.speed = Coordinates.length(Speed);
}

void UPbmpmEmitterComponent::Begin(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("An emitter");
	const auto Form = MakeShape(World);
	const auto Matter = World.Material(Material);
	const auto Editing = World.Editing();
	if (!FPbmpmWorld::Succeeded(Form, What) || !FPbmpmWorld::Succeeded(Matter, What) || !FPbmpmWorld::Succeeded(Editing, What))
	{
		return;
	}
	pbmpm::emitter_def Def;
	Describe(Def);
	Def.material = *Matter;
	Def.region = bDisc ? PBMPM_EMIT_DISC : PBMPM_EMIT_VOLUME;
	Def.spread = FMath::DegreesToRadians(Spread);
	Def.fill_limit = FillLimit;
	Set(Def.direction, Coordinates.direction(Plain(FVector::ForwardVector)));
	pbmpm::shape Place = *Form;
	if (bDisc)
	{
		// The disc lies across the direction, which turns with the shape: so the shape needs the component's rotation, whatever its kind.
		pbmpm::vector3 Position;
		pbmpm::quaternion Rotation;
		Pose(Position, Rotation);
		Set(Place.rotation, Rotation);
		Place.radius = Coordinates.length(Radius * float(GetComponentTransform().GetScale3D().X));
	}
	const auto Made = Editing->emitter_create(Def, Place);
	if (FPbmpmWorld::Succeeded(Made, What))
	{
		Emitter = *Made;
	}
	bToldEmits = bEmits;
	ToldRate = Rate;
	ToldSpeed = Speed;
}

void UPbmpmEmitterComponent::BeforeFrame(FPbmpmWorld& World)
{
	if (pbmpm::is_null(Emitter))
	{
		return;
	}
	pbmpm::vector3 Position;
	pbmpm::quaternion Rotation;
	Pose(Position, Rotation);
	World.Simulation.follow(Emitter, Position, Rotation);
	if (bToldEmits == bEmits && ToldRate == Rate && ToldSpeed == Speed)
	{
		return;
	}
	bToldEmits = bEmits;
	ToldRate = Rate;
	ToldSpeed = Speed;
	const auto Editing = World.Editing();
	auto Now = Editing ? Editing->emitter_get(Emitter) : Editing.error();
	if (FPbmpmWorld::Succeeded(Now, TEXT("An emitter")))
	{
		Describe(Now->def);
		FPbmpmWorld::Succeeded(Editing->emitter_set(Emitter, &Now->def), TEXT("An emitter"));
	}
}

void UPbmpmEmitterComponent::End(FPbmpmWorld& World)
{
	World.Simulation.leave(Emitter);
	const auto Editing = World.Editing();
	if (Editing && !pbmpm::is_null(Emitter))
	{
		FPbmpmWorld::Succeeded(Editing->emitter_destroy(Emitter), TEXT("An emitter"));
	}
	Emitter = {};
}
