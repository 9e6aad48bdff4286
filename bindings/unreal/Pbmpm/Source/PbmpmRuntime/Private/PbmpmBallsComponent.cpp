#include "PbmpmBallsComponent.h"

#include "PbmpmMaterial.h"
#include "PbmpmStats.h"
#include "PbmpmSubsystem.h"

UPbmpmBallsComponent::UPbmpmBallsComponent()
{
	PrimaryComponentTick.bCanEverTick = true;
	NumCustomDataFloats = 3;
	SetCollisionEnabled(ECollisionEnabled::NoCollision);
}

void UPbmpmBallsComponent::TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction)
{
	Super::TickComponent(DeltaTime, TickType, ThisTickFunction);
	const UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this);
	if (!Subsystem)
	{
		return;
	}
	SCOPE_CYCLE_COUNTER(STAT_PbmpmDraw);
	const auto Points = Subsystem->GetPoints();
	const int32 Count = int32(Points.size());
	// Instances are never removed: those beyond the particles shrink to nothing.
	Transforms.SetNum(FMath::Max(Count, GetInstanceCount()));
	for (int32 Index = 0; Index < Transforms.Num(); Index++)
	{
		if (Index < Count)
		{
			const pbmpm::engine::point& Point = Points[SIZE_T(Index)];
			Transforms[Index] = FTransform(FQuat::Identity, FVector(Point.position[0], Point.position[1], Point.position[2]), FVector(BallScale));
		}
		else
		{
			Transforms[Index].SetScale3D(FVector::ZeroVector);
		}
	}
	if (GetInstanceCount() < Transforms.Num())
	{
		TArray<FTransform> Fresh;
		Fresh.SetNum(Transforms.Num() - GetInstanceCount());
		AddInstances(Fresh, /*bShouldReturnIndices*/ false, /*bWorldSpace*/ true);
	}
	for (int32 Index = 0; Index < Count; Index++)
	{
		const UPbmpmMaterial* Material = Subsystem->GetMaterial(Points[SIZE_T(Index)]);
		const FLinearColor Colour = Material ? Material->Colour : FLinearColor::White;
		const float Data[] = {Colour.R, Colour.G, Colour.B};
		SetCustomData(Index, MakeArrayView(Data, 3), /*bMarkRenderStateDirty*/ false);
	}
	BatchUpdateInstancesTransforms(0, Transforms, /*bWorldSpace*/ true, /*bMarkRenderStateDirty*/ true, /*bTeleport*/ true);
}
