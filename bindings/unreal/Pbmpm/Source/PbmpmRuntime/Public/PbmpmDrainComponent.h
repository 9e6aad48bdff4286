// Takes matter out.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmPartComponent.h"

#include "PbmpmDrainComponent.generated.h"

/** Takes out what is in its shape at the end of a substep. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmDrainComponent : public UPbmpmPartComponent
{
	GENERATED_BODY()

public:
	virtual void Begin(FPbmpmWorld& World) override;
	virtual void End(FPbmpmWorld& World) override;
	virtual int32 Order() const override { return 2; }

	/** Particles that it has taken. Waits for a step in the background. */
	UFUNCTION(BlueprintCallable, Category = "Pbmpm")
	int64 GetDrained() const;

private:
	pbmpm_drain_id Drain{};
};
