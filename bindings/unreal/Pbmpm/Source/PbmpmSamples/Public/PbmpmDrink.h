// Pour a drink.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmSample.h"

#include "PbmpmDrink.generated.h"

class UPbmpmEmitterComponent;
class UPbmpmLiquid;

/** A jet fills a glass with two cubes in it. They are lighter than ice, which sinks on a grid so coarse. */
UCLASS()
class PBMPMSAMPLES_API APbmpmDrink : public APbmpmSample
{
	GENERATED_BODY()

public:
	APbmpmDrink();
	virtual void Tick(float DeltaSeconds) override;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmLiquid> Tea;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmEmitterComponent> Jet;

private:
	float Time = 0.0f;
};
