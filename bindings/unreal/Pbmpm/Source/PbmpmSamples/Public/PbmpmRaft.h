// A raft on a river.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmSample.h"

#include "PbmpmRaft.generated.h"

class UPbmpmDrainComponent;
class UPbmpmEmitterComponent;
class UPbmpmLiquid;

/** A raft on a channel of 7 m with a spring at one end and a drain below the other. */
UCLASS()
class PBMPMSAMPLES_API APbmpmRaft : public APbmpmSample
{
	GENERATED_BODY()

public:
	APbmpmRaft();

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmLiquid> Water;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmEmitterComponent> Spring;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmDrainComponent> Drain;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UStaticMeshComponent> Raft;
};
