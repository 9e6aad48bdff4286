#include "PbmpmFillComponent.h"

#include "PbmpmWorld.h"

using namespace PbmpmConversion;

void UPbmpmFillComponent::Begin(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("A fill");
	const auto Form = MakeShape(World);
	const auto Matter = World.Material(Material);
	const auto Editing = World.Editing();
	if (!FPbmpmWorld::Succeeded(Form, What) || !FPbmpmWorld::Succeeded(Matter, What) || !FPbmpmWorld::Succeeded(Editing, What))
	{
		return;
	}
	pbmpm::fill_def Def;
	Def.material = *Matter;
	Def.particles_per_axis = ParticlesPerAxis;
	Set(Def.velocity, Coordinates.vector(Plain(Velocity)));
	FPbmpmWorld::Succeeded(Editing->particles_fill(Def, *Form), What);
}
