// An obstacle.
#pragma once

#include "CoreMinimal.h"

#include "PbmpmPartComponent.h"

#include "PbmpmColliderComponent.generated.h"

class UPrimitiveComponent;

UENUM(BlueprintType)
enum class EPbmpmFriction : uint8
{
	Coulomb,
	Stick,
	Slip
};

/** An obstacle. Attached to a component that simulates physics it is coupled: matter pushes the body, and the body pushes matter. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmColliderComponent : public UPbmpmPartComponent
{
	GENERATED_BODY()

public:
	/** It follows the component. Without it, it stands where it began, which costs less. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bMoves = false;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	EPbmpmFriction Friction = EPbmpmFriction::Coulomb;

	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "100"))
	float FrictionCoefficient = 0.2f;

	/** Acts on nothing: a trigger. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	bool bSensor = false;

	virtual void Begin(FPbmpmWorld& World) override;
	virtual void BeforeFrame(FPbmpmWorld& World) override;
	virtual void AfterFrame(FPbmpmWorld& World) override;
	virtual void End(FPbmpmWorld& World) override;

private:
	UPrimitiveComponent* FindBody() const;

	pbmpm_collider_id Collider{};
	/** Number of the coupling, or INDEX_NONE. */
	int32 Coupling = INDEX_NONE;
	TWeakObjectPtr<UPrimitiveComponent> Body;
};
