// Settings of a world of matter.
#pragma once

#include "CoreMinimal.h"
#include "Components/ActorComponent.h"

#include "PbmpmWorldComponent.generated.h"

UENUM(BlueprintType)
enum class EPbmpmSolver : uint8
{
	Convergent,
	Dual,
	Primal,
	Paper
};

/** A world of matter: add it to one actor of the level. Lengths are centimetres; docs/choosing.md says which settings to begin with. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmWorldComponent : public UActorComponent
{
	GENERATED_BODY()

public:
	/** Spacing of the grid [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0.01"))
	float CellSize = 10.0f;

	/** Particles that there is room for; memory is taken when play begins. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1"))
	int32 ParticleCapacity = 65536;

	/** [cm/s^2]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FVector Gravity = FVector(0.0, 0.0, -981.0);

	/** Steps per second. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1"))
	float Rate = 60.0f;

	/** Steps per frame; what a slow frame owes beyond them is given up, and counted. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1", ClampMax = "60"))
	int32 MostSteps = 2;

	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1", ClampMax = "256"))
	int32 Substeps = 1;

	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1", ClampMax = "1000"))
	int32 Iterations = 5;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	EPbmpmSolver Solver = EPbmpmSolver::Convergent;

	/** The last step of a frame runs while the game goes on. What is drawn is then a step older. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bBackground = true;

	/** Walls around the domain. Without them what leaves it is taken out. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bClosed = false;

	/** Corners of the domain, from where the actor stands when play begins [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FVector DomainMin = FVector(-500.0, -500.0, -500.0);

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FVector DomainMax = FVector(500.0, 500.0, 500.0);

	virtual void BeginPlay() override;
	virtual void EndPlay(const EEndPlayReason::Type EndPlayReason) override;

	/** Milliseconds of the last step, on the thread that made it. */
	UFUNCTION(BlueprintPure, Category = "Pbmpm")
	float GetStepMilliseconds() const;

	UFUNCTION(BlueprintPure, Category = "Pbmpm")
	int32 GetParticleCount() const;

	/** Simulated seconds that slow frames gave up. */
	UFUNCTION(BlueprintPure, Category = "Pbmpm")
	float GetLostSeconds() const;

	/** What will go wrong with the present scene and settings: one line for each advice of the library. Waits for a step in the background, and costs up to half of one. */
	UFUNCTION(BlueprintCallable, Category = "Pbmpm")
	FString GetAdvice() const;
};
