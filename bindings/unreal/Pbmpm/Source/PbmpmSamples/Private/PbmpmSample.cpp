#include "PbmpmSample.h"

#include "Components/StaticMeshComponent.h"
#include "Engine/StaticMesh.h"
#include "Modules/ModuleManager.h"
#include "UObject/ConstructorHelpers.h"

#include "PbmpmBallsComponent.h"
#include "PbmpmColliderComponent.h"
#include "PbmpmFillComponent.h"
#include "PbmpmWorldComponent.h"

IMPLEMENT_MODULE(FDefaultModuleImpl, PbmpmSamples)

/** Of the engine's cube [cm]. */
constexpr double HalfOfCube = 50.0;

APbmpmSample::APbmpmSample()
{
	PrimaryActorTick.bCanEverTick = true;
	static ConstructorHelpers::FObjectFinder<UStaticMesh> FoundCube(TEXT("/Engine/BasicShapes/Cube.Cube"));
	static ConstructorHelpers::FObjectFinder<UStaticMesh> FoundBall(TEXT("/Engine/BasicShapes/Sphere.Sphere"));
	Cube = FoundCube.Object;
	RootComponent = CreateDefaultSubobject<USceneComponent>(TEXT("Root"));
	World = CreateDefaultSubobject<UPbmpmWorldComponent>(TEXT("World"));
	Balls = CreateDefaultSubobject<UPbmpmBallsComponent>(TEXT("Balls"));
	Balls->SetupAttachment(RootComponent);
	Balls->SetStaticMesh(FoundBall.Object);
}

UStaticMeshComponent* APbmpmSample::AddBox(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, const FQuat& Turn)
{
	UStaticMeshComponent* Box = CreateDefaultSubobject<UStaticMeshComponent>(Name);
	Box->SetupAttachment(RootComponent);
	Box->SetStaticMesh(Cube);
	Box->SetRelativeLocation(Place);
	Box->SetRelativeRotation(Turn);
	Box->SetRelativeScale3D(HalfExtents * (1.0 / HalfOfCube));
	UPbmpmColliderComponent* Collider = CreateDefaultSubobject<UPbmpmColliderComponent>(*FString::Printf(TEXT("%sCollider"), Name));
	Collider->SetupAttachment(Box);
	Collider->HalfExtents = FVector(HalfOfCube); // the box's scale does the rest
	return Box;
}

UStaticMeshComponent* APbmpmSample::AddWall(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, const FQuat& Turn)
{
	return AddBox(Name, Place, HalfExtents, Turn);
}

UStaticMeshComponent* APbmpmSample::AddFloatingBox(const TCHAR* Name, const FVector& Place, const FVector& HalfExtents, float Density)
{
	constexpr double CubicMetres = 1e-6;
	UStaticMeshComponent* Box = AddBox(Name, Place, HalfExtents, FQuat::Identity);
	Box->SetSimulatePhysics(true);
	Box->SetMassOverrideInKg(NAME_None, float(Density * 8.0 * HalfExtents.X * HalfExtents.Y * HalfExtents.Z * CubicMetres), true);
	return Box;
}

void APbmpmSample::Attach(UPbmpmPartComponent* Part, const FVector& Place, const FQuat& Turn)
{
	Part->SetupAttachment(RootComponent);
	Part->SetRelativeLocation(Place);
	Part->SetRelativeRotation(Turn);
}

void APbmpmSample::AddFill(const TCHAR* Name, UPbmpmMaterial* Material, const FVector& Place, const FVector& HalfExtents)
{
	UPbmpmFillComponent* Fill = CreateDefaultSubobject<UPbmpmFillComponent>(Name);
	Attach(Fill, Place);
	Fill->Material = Material;
	Fill->HalfExtents = HalfExtents;
}
