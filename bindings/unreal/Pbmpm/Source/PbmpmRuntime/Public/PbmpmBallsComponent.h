// Draws matter as instances of a mesh.
#pragma once

#include "CoreMinimal.h"
#include "Components/InstancedStaticMeshComponent.h"

#include "PbmpmBallsComponent.generated.h"

/** Draws each particle as an instance of its static mesh: a ball, say. Custom data 0 to 2 of an instance is its material's colour. */
UCLASS(ClassGroup = (Pbmpm), meta = (BlueprintSpawnableComponent))
class PBMPMRUNTIME_API UPbmpmBallsComponent : public UInstancedStaticMeshComponent
{
	GENERATED_BODY()

public:
	UPbmpmBallsComponent();

	/** Of the mesh [1]: the engine's sphere is 100 cm wide. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0"))
	float BallScale = 0.05f;

	virtual void TickComponent(float DeltaTime, ELevelTick TickType, FActorComponentTickFunction* ThisTickFunction) override;

private:
	/** Kept from frame to frame, so that a frame allocates nothing. */
	TArray<FTransform> Transforms;
};
