#include "PbmpmWorld.h"

#include "GameFramework/Actor.h"

#include "PbmpmMaterial.h"
#include "PbmpmStats.h"
#include "PbmpmTasks.h"
#include "PbmpmWorldComponent.h"

using namespace PbmpmConversion;

static pbmpm_solver SolverOf(EPbmpmSolver Solver)
{
	switch (Solver)
	{
	case EPbmpmSolver::Dual:
		return PBMPM_SOLVER_DUAL;
	case EPbmpmSolver::Primal:
		return PBMPM_SOLVER_PRIMAL;
	case EPbmpmSolver::Paper:
		return PBMPM_SOLVER_PAPER;
	default:
		return PBMPM_SOLVER_CONVERGENT;
	}
}

/* The corners of a box again: swapping axes keeps them in order, mirroring would not. */
static void SetBox(float (&Low)[3], float (&High)[3], const FVector& Min, const FVector& Max)
{
	const pbmpm::vector3 A = Coordinates.vector(Plain(Min)), B = Coordinates.vector(Plain(Max));
	for (SIZE_T Axis = 0; Axis < 3; Axis++)
	{
		Low[Axis] = FMath::Min(A[Axis], B[Axis]);
		High[Axis] = FMath::Max(A[Axis], B[Axis]);
	}
}

TUniquePtr<FPbmpmWorld> FPbmpmWorld::Create(const UPbmpmWorldComponent& Settings)
{
	const AActor* Owner = Settings.GetOwner();
	const FVector Place = Owner ? Owner->GetActorLocation() : FVector::ZeroVector;
	const FVector Min = Place + Settings.DomainMin, Max = Place + Settings.DomainMax;
	pbmpm::engine::options Wanted;
	const pbmpm::task_hooks Hooks = PbmpmTaskHooks();
	Wanted.world.cell_size = Coordinates.length(Settings.CellSize);
	Wanted.world.particle_capacity = uint32(FMath::Max(Settings.ParticleCapacity, 0));
	Wanted.world.domain_enabled = Settings.bClosed;
	SetBox(Wanted.world.domain_min, Wanted.world.domain_max, Min, Max);
	Wanted.world.tasks = &Hooks;
	Set(Wanted.settings.gravity, Coordinates.vector(Plain(Settings.Gravity)));
	Wanted.settings.substeps = Settings.Substeps;
	Wanted.settings.iterations = Settings.Iterations;
	Wanted.settings.solver = SolverOf(Settings.Solver);
	Wanted.dt = 1.0 / Settings.Rate;
	Wanted.most_steps = Settings.MostSteps;
	Wanted.background = Settings.bBackground;
	auto Made = pbmpm::engine::simulation::create(Wanted);
	if (!Succeeded(Made, TEXT("A world of matter can not begin")))
	{
		return nullptr;
	}
	if (!Settings.bClosed)
	{
		pbmpm::kill_bounds Bounds;
		Bounds.enabled = 1;
		SetBox(Bounds.low, Bounds.high, Min, Max);
		Succeeded(Made->reading().set_kill_bounds(Bounds), TEXT("The domain"));
	}
	return TUniquePtr<FPbmpmWorld>(new FPbmpmWorld(std::move(*Made), Wanted.world.particle_capacity));
}

pbmpm::expected<pbmpm_material_id> FPbmpmWorld::Material(UPbmpmMaterial* Asset)
{
	if (!Asset)
	{
		return pbmpm::failure{PBMPM_ERROR_INVALID_ARGUMENT, "a part has no material"};
	}
	if (const pbmpm_material_id* Known = Materials.Find(Asset))
	{
		return *Known;
	}
	const auto World = Editing();
	if (!World)
	{
		return World.error();
	}
	const auto Made = World->material_create(Asset->Definition());
	if (Made)
	{
		Materials.Add(Asset, *Made);
		Assets.Add(Made->index, TStrongObjectPtr<UPbmpmMaterial>(Asset));
	}
	return Made;
}

const UPbmpmMaterial* FPbmpmWorld::MaterialOf(uint32 Index) const
{
	const TStrongObjectPtr<UPbmpmMaterial>* Asset = Assets.Find(Index);
	return Asset ? Asset->Get() : nullptr;
}

void FPbmpmWorld::UpdatePoints()
{
	SCOPE_CYCLE_COUNTER(STAT_PbmpmCopy);
	const auto Fresh = Buffer.copy(Simulation.reading(), Simulation.clock().alpha());
	Copied = Succeeded(Fresh, TEXT("Copying particles")) ? *Fresh : pbmpm::span<const pbmpm::engine::point>();
}
