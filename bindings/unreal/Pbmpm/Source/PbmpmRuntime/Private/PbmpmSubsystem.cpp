#include "PbmpmSubsystem.h"

#include "Engine/World.h"

#include "PbmpmMaterial.h"
#include "PbmpmModule.h"
#include "PbmpmPartComponent.h"
#include "PbmpmStats.h"
#include "PbmpmWorld.h"

DEFINE_STAT(STAT_PbmpmFrame);
DEFINE_STAT(STAT_PbmpmCopy);
DEFINE_STAT(STAT_PbmpmDraw);
DEFINE_STAT(STAT_PbmpmParticles);
DEFINE_STAT(STAT_PbmpmStep);
DEFINE_STAT(STAT_PbmpmError);
DEFINE_STAT(STAT_PbmpmLost);

/* Here, where the matter's type is complete. */
UPbmpmSubsystem::UPbmpmSubsystem() = default;
UPbmpmSubsystem::UPbmpmSubsystem(FVTableHelper& Helper) : Super(Helper) {}
UPbmpmSubsystem::~UPbmpmSubsystem() = default;

bool UPbmpmSubsystem::DoesSupportWorldType(const EWorldType::Type WorldType) const
{
	return WorldType == EWorldType::Game || WorldType == EWorldType::PIE;
}

UPbmpmSubsystem* UPbmpmSubsystem::Of(const UActorComponent& Component)
{
	const UWorld* World = Component.GetWorld();
	return World ? World->GetSubsystem<UPbmpmSubsystem>() : nullptr;
}

void UPbmpmSubsystem::BeginWorld(const UPbmpmWorldComponent& Settings)
{
	if (Matter)
	{
		UE_LOG(LogPbmpm, Warning, TEXT("The level has several world components; the first counts."));
		return;
	}
	if (!FPbmpmModule::IsLoaded())
	{
		UE_LOG(LogPbmpm, Error, TEXT("There is no matter, since the library was not loaded; the log says above why."));
		return;
	}
	Matter = FPbmpmWorld::Create(Settings);
	Owner = Matter ? &Settings : nullptr;
}

void UPbmpmSubsystem::EndWorld(const UPbmpmWorldComponent& Settings)
{
	if (Owner == &Settings)
	{
		Close();
	}
}

void UPbmpmSubsystem::Deinitialize()
{
	Close();
	Super::Deinitialize();
}

/* Parts stay: they begin again with the next world. */
void UPbmpmSubsystem::Close()
{
	for (int32 Index = 0; Index < BegunCount; Index++)
	{
		Parts[Index]->End(*Matter);
	}
	BegunCount = 0;
	Owner = nullptr;
	Matter.Reset();
}

void UPbmpmSubsystem::Add(UPbmpmPartComponent& Part)
{
	Parts.Add(&Part);
}

void UPbmpmSubsystem::Remove(UPbmpmPartComponent& Part)
{
	const int32 Index = Parts.Find(&Part);
	if (Index == INDEX_NONE)
	{
		return;
	}
	if (Index < BegunCount)
	{
		Part.End(*Matter);
		BegunCount--;
	}
	Parts.RemoveAt(Index);
}

/* Those that came since the last frame: colliders before the matter that they leave no room for. */
void UPbmpmSubsystem::BeginParts()
{
	if (BegunCount == Parts.Num())
	{
		return;
	}
	TArray<UPbmpmPartComponent*> Fresh;
	for (int32 Index = BegunCount; Index < Parts.Num(); Index++)
	{
		Fresh.Add(Parts[Index]);
	}
	Fresh.StableSort([](const UPbmpmPartComponent& A, const UPbmpmPartComponent& B) { return A.Order() < B.Order(); });
	for (UPbmpmPartComponent* Part : Fresh)
	{
		Parts[BegunCount++] = Part;
		Part->Begin(*Matter);
	}
}

void UPbmpmSubsystem::Tick(float DeltaTime)
{
	Super::Tick(DeltaTime);
	if (!Matter)
	{
		return;
	}
	SCOPE_CYCLE_COUNTER(STAT_PbmpmFrame);
	BeginParts();
	for (UPbmpmPartComponent* Part : Parts)
	{
		Part->BeforeFrame(*Matter);
	}
	FPbmpmWorld::Succeeded(Matter->Simulation.frame(DeltaTime), TEXT("A step failed"));
	for (UPbmpmPartComponent* Part : Parts)
	{
		Part->AfterFrame(*Matter);
	}
	Matter->UpdatePoints();
	Report();
}

void UPbmpmSubsystem::Report() const
{
	if (const auto Stats = Matter->Simulation.reading().get_step_stats())
	{
		SET_DWORD_STAT(STAT_PbmpmParticles, Stats->particle_count);
		SET_FLOAT_STAT(STAT_PbmpmStep, Stats->ms_total);
		SET_FLOAT_STAT(STAT_PbmpmError, Stats->predicted_error);
	}
	SET_FLOAT_STAT(STAT_PbmpmLost, float(Matter->Simulation.clock().lost()));
}

TStatId UPbmpmSubsystem::GetStatId() const
{
	RETURN_QUICK_DECLARE_CYCLE_STAT(UPbmpmSubsystem, STATGROUP_Tickables);
}

pbmpm::span<const pbmpm::engine::point> UPbmpmSubsystem::GetPoints() const
{
	return Matter ? Matter->Points() : pbmpm::span<const pbmpm::engine::point>();
}

const UPbmpmMaterial* UPbmpmSubsystem::GetMaterial(const pbmpm::engine::point& Point) const
{
	return Matter ? Matter->MaterialOf(Point.material) : nullptr;
}
