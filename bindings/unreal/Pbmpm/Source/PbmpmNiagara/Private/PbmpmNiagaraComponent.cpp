#include "PbmpmNiagaraComponent.h"

#include "GameFramework/Actor.h"
#include "Modules/ModuleManager.h"
#include "NiagaraComponent.h"
#include "NiagaraDataInterfaceArrayFunctionLibrary.h"

#include "PbmpmSubsystem.h"

IMPLEMENT_MODULE(FDefaultModuleImpl, PbmpmNiagara)

UPbmpmNiagaraComponent::UPbmpmNiagaraComponent()
{
	PrimaryComponentTick.bCanEverTick = true;
}

void UPbmpmNiagaraComponent::BeginPlay()
{
	Super::BeginPlay();
	if (!Niagara && GetOwner())
	{
		Niagara = GetOwner()->FindComponentByClass<UNiagaraComponent>();
	}
}

void UPbmpmNiagaraComponent::TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction)
{
	Super::TickComponent(DeltaTime, TickType, ThisTickFunction);
	const UPbmpmSubsystem* Subsystem = UPbmpmSubsystem::Of(*this);
	if (!Subsystem || !Niagara)
	{
		return;
	}
	const auto Points = Subsystem->GetPoints();
	PositionArray.SetNum(int32(Points.size()));
	VelocityArray.SetNum(int32(Points.size()));
	for (int32 Index = 0; Index < PositionArray.Num(); Index++)
	{
		const pbmpm::engine::point& Point = Points[SIZE_T(Index)];
		PositionArray[Index] = FVector(Point.position[0], Point.position[1], Point.position[2]);
		VelocityArray[Index] = FVector(Point.velocity[0], Point.velocity[1], Point.velocity[2]);
	}
	UNiagaraDataInterfaceArrayFunctionLibrary::SetNiagaraArrayPosition(Niagara, Positions, PositionArray);
	UNiagaraDataInterfaceArrayFunctionLibrary::SetNiagaraArrayVector(Niagara, Velocities, VelocityArray);
}
