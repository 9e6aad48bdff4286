#include "PbmpmWorldComponent.h"

#include "PbmpmSubsystem.h"
#include "PbmpmWorld.h"

static FPbmpmWorld* MatterOf(const UActorComponent& Component)
{
	const UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(Component);
	return Subsystem ? Subsystem->GetMatter() : nullptr;
}

void UPbmpmWorldComponent::BeginPlay()
{
	Super::BeginPlay();
	if (UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this))
	{
		Subsystem->BeginWorld(*this);
	}
}

void UPbmpmWorldComponent::EndPlay(const EEndPlayReason::Type EndPlayReason)
{
	if (UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this))
	{
		Subsystem->EndWorld(*this);
	}
	Super::EndPlay(EndPlayReason);
}

float UPbmpmWorldComponent::GetStepMilliseconds() const
{
	FPbmpmWorld* Matter = MatterOf(*this);
	const auto Stats = Matter ? Matter->Simulation.reading().get_step_stats() : pbmpm_stats{};
	return Stats ? Stats->ms_total : 0.0f;
}

int32 UPbmpmWorldComponent::GetParticleCount() const
{
	FPbmpmWorld* Matter = MatterOf(*this);
	return Matter ? int32(Matter->Points().size()) : 0;
}

float UPbmpmWorldComponent::GetLostSeconds() const
{
	FPbmpmWorld* Matter = MatterOf(*this);
	return Matter ? float(Matter->Simulation.clock().lost()) : 0.0f;
}

FString UPbmpmWorldComponent::GetAdvice() const
{
	FString Lines;
	FPbmpmWorld* Matter = MatterOf(*this);
	if (!Matter)
	{
		return Lines;
	}
	const auto World = Matter->Editing();
	std::array<pbmpm_advice, 32> List{};
	const auto Count = World ? World->advice(float(Matter->Simulation.clock().dt()), List) : World.error();
	if (!FPbmpmWorld::Succeeded(Count, TEXT("Advice")))
	{
		return Lines;
	}
	for (uint32 Index = 0; Index < FMath::Min(*Count, uint32(List.size())); Index++)
	{
		Lines += FString::Printf(TEXT("%s: %s\n"), UTF8_TO_TCHAR(pbmpm::advice_name(List[Index].code)), UTF8_TO_TCHAR(List[Index].text));
	}
	return Lines;
}
