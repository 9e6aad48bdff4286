// A force on matter besides gravity.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmPartComponent.h"

#include "PbmpmForceComponent.generated.h"

UENUM(BlueprintType)
enum class EPbmpmForce : uint8
{
	/** Along the component's x axis. */
	Uniform,
	/** Away from the component. */
	Radial,
	/** About the component's z axis. */
	Vortex,
	/** Towards `Velocity` and `Spin`, as wind does. */
	Drag,
	/** Matter takes on `Velocity` and `Spin`. */
	Grab
};

UENUM(BlueprintType)
enum class EPbmpmFalloff : uint8
{
	None,
	Linear,
	Smooth,
	InverseSquare
};

/** A force. It may move and change. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmForceComponent : public UPbmpmPartComponent
{
	GENERATED_BODY()

public:
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	EPbmpmForce Kind = EPbmpmForce::Uniform;

	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	bool bActs = true;

	/** Everywhere, and not in its shape alone. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bEverywhere = false;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	EPbmpmFalloff Falloff = EPbmpmFalloff::None;

	/** Of the falloff, around the shape [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0"))
	float Range = 0.0f;

	/** [cm/s^2]; of a drag [1/s]; not used by a grab. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	float Strength = 100.0f;

	/** Of drag and grab [cm/s]. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	FVector Velocity = FVector::ZeroVector;

	/** Of drag and grab, about the component's z axis [degrees/s]. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Pbmpm")
	float Spin = 0.0f;

	virtual void Begin(FPbmpmWorld& World) override;
	virtual void BeforeFrame(FPbmpmWorld& World) override;
	virtual void End(FPbmpmWorld& World) override;
	virtual int32 Order() const override { return 2; }

private:
	pbmpm::force_def Define() const;

	pbmpm_force_id Force{};
	/** As the library was told last. */
	pbmpm::shape Told;
	pbmpm::force_def ToldDef;
};
