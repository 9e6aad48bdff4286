#include "PbmpmDrainComponent.h"

#include "PbmpmSubsystem.h"
#include "PbmpmWorld.h"

void UPbmpmDrainComponent::Begin(FPbmpmWorld& World)
{
	const TCHAR* What = TEXT("A drain");
	const auto Form = MakeShape(World);
	const auto Editing = World.Editing();
	if (!FPbmpmWorld::Succeeded(Form, What) || !FPbmpmWorld::Succeeded(Editing, What))
	{
		return;
	}
	const auto Made = Editing->drain_create(pbmpm::drain_def(), *Form);
	if (FPbmpmWorld::Succeeded(Made, What))
	{
		Drain = *Made;
	}
}

void UPbmpmDrainComponent::End(FPbmpmWorld& World)
{
	const auto Editing = World.Editing();
	if (Editing && !pbmpm::is_null(Drain))
	{
		FPbmpmWorld::Succeeded(Editing->drain_destroy(Drain), TEXT("A drain"));
	}
	Drain = {};
}

int64 UPbmpmDrainComponent::GetDrained() const
{
	const UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this);
	FPbmpmWorld* Matter = Subsystem ? Subsystem->GetMatter() : nullptr;
	if (!Matter || pbmpm::is_null(Drain))
	{
		return 0;
	}
	const auto Editing = Matter->Editing();
	const auto Status = Editing ? Editing->drain_status_get(Drain) : Editing.error();
	return Status ? int64(Status->drained) : 0;
}
