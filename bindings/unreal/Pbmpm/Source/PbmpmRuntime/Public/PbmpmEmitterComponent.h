// A source of matter.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmPartComponent.h"

#include "PbmpmEmitterComponent.generated.h"

class UPbmpmMaterial;

/** Emits matter from its shape, or from the disc of its radius. It may move. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmEmitterComponent : public UPbmpmPartComponent
{
	GENERATED_BODY()

public:
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmMaterial> Material;

	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	bool bEmits = true;

	/** From the disc of `Radius` across the component's direction, instead of from the shape. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bDisc = true;

	/** Rest volume per second [litres/s]. A disc runs full with its area times the speed. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm", meta = (ClampMin = "0"))
	float Rate = 10.0f;

	/** Along the component's x axis [cm/s]. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm", meta = (ClampMin = "0"))
	float Speed = 100.0f;

	/** Half angle of the cone [degrees]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "180"))
	float Spread = 0.0f;

	/** Nothing is emitted where the grid is so full; a source inside a pool needs more than 1. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0.1", ClampMax = "100"))
	float FillLimit = 1.0f;

	virtual void Begin(FPbmpmWorld& World) override;
	virtual void BeforeFrame(FPbmpmWorld& World) override;
	virtual void End(FPbmpmWorld& World) override;
	virtual int32 Order() const override { return 2; }

private:
	void Describe(pbmpm_emitter_def& Def) const;

	pbmpm_emitter_id Emitter{};
	/** What the library was told. */
	bool bToldEmits = false;
	float ToldRate = 0.0f;
	float ToldSpeed = 0.0f;
};
