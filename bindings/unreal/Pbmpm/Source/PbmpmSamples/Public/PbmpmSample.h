// What the samples share.
#pragma once

#include "CoreMinimal.h"
#include "GameFramework/Actor.h"

#include "PbmpmSample.generated.h"

class UPbmpmBallsComponent;
class UPbmpmColliderComponent;
class UPbmpmEmitterComponent;
class UPbmpmFillComponent;
class UPbmpmMaterial;
class UPbmpmPartComponent;
class UPbmpmWorldComponent;
class UStaticMesh;
class UStaticMeshComponent;

/** An actor with a world of matter and balls that show it. Use one of its kinds. Helpers are for constructors. */
UCLASS(Abstract)
class PBMPMSAMPLES_API APbmpmSample : public AActor
{
	GENERATED_BODY()

public:
	APbmpmSample();

protected:
	/** A box for eyes, physics and matter that stands still. */
	UStaticMeshComponent* AddWall(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, const FQuat& Turn = FQuat::Identity);
	/** One that physics moves and matter pushes; the density is in kg/m^3. */
	UStaticMeshComponent* AddFloatingBox(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, float Density);
	void AddFill(const TCHAR* Name, UPbmpmMaterial* Material, const FVector& Place, const FVector& HalfExtents);
	/** Puts a part where it belongs. */
	void Attach(UPbmpmPartComponent* Part, const FVector& Place, const FQuat& Turn = FQuat::Identity);

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmWorldComponent> World;

	UPROPERTY(VisibleAnywhere, Category = "Pbmpm")
	TObjectPtr<UPbmpmBallsComponent> Balls;

private:
	UStaticMeshComponent* AddBox(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, const FQuat& Turn);

	UPROPERTY()
	TObjectPtr<UStaticMesh> Cube;
};
