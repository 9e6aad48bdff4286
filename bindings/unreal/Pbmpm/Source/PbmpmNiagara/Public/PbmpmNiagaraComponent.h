// Hands particles to a Niagara system.
#pragma once

#include "CoreMinimal.h"
#include "Components/ActorComponent.h"

#include "PbmpmNiagaraComponent.generated.h"

class UNiagaraComponent;

/** Writes positions and velocities of all particles into user parameters of a Niagara system each frame. These are array data interfaces of Niagara's: an Array Position
 *  and an Array Vector. Their names stand here. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMNIAGARA_API UPbmpmNiagaraComponent : public UActorComponent
{
	GENERATED_BODY()

public:
	UPbmpmNiagaraComponent();

	/** Null: the first Niagara component of the actor. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	TObjectPtr<UNiagaraComponent> Niagara;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FName Positions = TEXT("Positions");

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FName Velocities = TEXT("Velocities");

	virtual void BeginPlay() override;
	virtual void TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction) override;

private:
	/** Kept from frame to frame. */
	TArray<FVector> PositionArray;
	TArray<FVector> VelocityArray;
};
