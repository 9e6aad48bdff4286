// Four materials and a hand.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmSample.h"

#include "PbmpmSandbox.generated.h"

class UPbmpmElastic;
class UPbmpmForceComponent;
class UPbmpmLiquid;
class UPbmpmSand;
class UPbmpmVisco;

/** Water, jelly, sand and clay, and a hand that grabs what is near it. A Blueprint moves it by MoveHand(). */
UCLASS()
class PBMPMSAMPLES_API APbmpmSandbox : public APbmpmSample
{
	GENERATED_BODY()

public:
	APbmpmSandbox();

	/** Where the hand shall be after a frame of `Seconds`, in the actor's frame [cm], and whether it holds on. */
	UFUNCTION(BlueprintCallable, Category = "Pbmpm")
	void MoveHand(const FVector& Place, float Seconds, bool bGrabs);

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmForceComponent> Hand;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmLiquid> Water;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmElastic> Jelly;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmSand> Sand;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmVisco> Clay;
};
