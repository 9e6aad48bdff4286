// Matter at the beginning.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmPartComponent.h"

#include "PbmpmFillComponent.generated.h"

class UPbmpmMaterial;

/** Fills its shape with matter when it begins. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmFillComponent : public UPbmpmPartComponent
{
	GENERATED_BODY()

public:
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmMaterial> Material;

	/** [cm/s]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FVector Velocity = FVector::ZeroVector;

	/** Of a cell. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0.25", ClampMax = "16"))
	float ParticlesPerAxis = 2.0f;

	virtual void Begin(FPbmpmWorld& World) override;
	virtual int32 Order() const override { return 1; }
};
