// What fills, emitters, drains, forces and colliders share: a shape at a place.
#pragma once

#include "CoreMinimal.h"
#include "Components/SceneComponent.h"

#include "PbmpmConversion.h"

#include "PbmpmPartComponent.generated.h"

class ALandscapeProxy;
class FPbmpmWorld;
class UStaticMesh;

UENUM(BlueprintType)
enum class EPbmpmShape : uint8
{
	Box,
	Sphere,
	Capsule,
	/** All that is below the component's XY plane. */
	Plane,
	/** A closed static mesh with CPU access. It is baked when play begins. */
	Mesh,
	/** The ground of a landscape inside of the box. */
	Landscape
};

/** A part of the matter's world. It begins with the world, or when it comes to one that runs. */
UCLASS(Abstract, ClassGroup = (Pbmpm))
class PBMPMRUNTIME_API UPbmpmPartComponent : public USceneComponent
{
	GENERATED_BODY()

public:
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	EPbmpmShape Shape = EPbmpmShape::Box;

	/** Box, and landscape: half of its edges before the component's scale [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	FVector HalfExtents = FVector(50.0, 50.0, 50.0);

	/** Sphere and capsule, before the component's scale [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0"))
	float Radius = 50.0f;

	/** Capsule: half of the way between the centres of its round ends, along the component's z axis [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "0"))
	float HalfLength = 50.0f;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	TObjectPtr<UStaticMesh> Mesh;

	/** Mesh: cells of the baked solid along its longest side. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "4", ClampMax = "1024"))
	int32 Resolution = 64;

	UPROPERTY(EditAnywhere, Category = "Pbmpm")
	TObjectPtr<ALandscapeProxy> Landscape;

	/** Landscape: between heights [cm]. */
	UPROPERTY(EditAnywhere, Category = "Pbmpm", meta = (ClampMin = "1"))
	float HeightSpacing = 100.0f;

	virtual void BeginPlay() override;
	virtual void EndPlay(const EEndPlayReason::Type EndPlayReason) override;

	/** Called by the subsystem: once when the world is there, then around each frame's steps, and once at the end. */
	virtual void Begin(FPbmpmWorld& World) {}
	virtual void BeforeFrame(FPbmpmWorld& World) {}
	virtual void AfterFrame(FPbmpmWorld& World) {}
	virtual void End(FPbmpmWorld& World) {}
	/** Parts with a lower number begin first. */
	virtual int32 Order() const { return 0; }

protected:
	/** The shape where the component is. Errors: those of baking. */
	pbmpm::expected<pbmpm::shape> MakeShape(FPbmpmWorld& World) const;
	/** Where it is, as moving colliders and emitters are told. */
	void Pose(pbmpm::vector3& Position, pbmpm::quaternion& Rotation) const;

private:
	pbmpm::expected<pbmpm_baked_id> BakeMesh(FPbmpmWorld& World) const;
	pbmpm::expected<pbmpm::shape> BakeLandscape(FPbmpmWorld& World) const;
};
