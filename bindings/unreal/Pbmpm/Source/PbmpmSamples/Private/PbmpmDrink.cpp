#include "PbmpmDrink.h"

#include "Components/StaticMeshComponent.h"

#include "PbmpmBallsComponent.h"
#include "PbmpmEmitterComponent.h"
#include "PbmpmMaterial.h"
#include "PbmpmWorldComponent.h"

APbmpmDrink::APbmpmDrink()
{
	World->CellSize = 2.5f;
	World->ParticleCapacity = 40000;
	World->DomainMin = FVector(-60, -60, -30);
	World->DomainMax = FVector(60, 60, 200);
	Balls->BallScale = 0.02f;
	Tea = CreateDefaultSubobject<UPbmpmLiquid>(TEXT("Tea"));
	Tea->Colour = FLinearColor(0.7f, 0.25f, 0.03f);
	AddFill(TEXT("Rest"), Tea, FVector(0, 0, 6), FVector(20, 20, 6));
	// The glass: 40 cm wide inside, that is 16 cells.
	AddWall(TEXT("Floor"), FVector(0, 0, -2.5), FVector(25, 25, 2.5));
	AddWall(TEXT("Left"), FVector(-22.5, 0, 22.5), FVector(2.5, 25, 22.5));
	AddWall(TEXT("Right"), FVector(22.5, 0, 22.5), FVector(2.5, 25, 22.5));
	AddWall(TEXT("Back"), FVector(0, -22.5, 22.5), FVector(20, 2.5, 22.5));
	AddWall(TEXT("Front"), FVector(0, 22.5, 22.5), FVector(20, 2.5, 22.5));
	AddFloatingBox(TEXT("Ice1"), FVector(6, -8, 14), FVector(5, 5, 5), 600.0f);
	AddFloatingBox(TEXT("Ice2"), FVector(9, 9, 14), FVector(5, 5, 5), 600.0f);
	Jet = CreateDefaultSubobject<UPbmpmEmitterComponent>(TEXT("Jet"));
	Attach(Jet, FVector(-11, 0, 60), FQuat(FVector(0, 1, 0), PI / 2)); // forward is down
	Jet->Material = Tea;
	Jet->Radius = 4.5f;
	Jet->Rate = 9.5f;
	Jet->Speed = 150.0f;
}

void APbmpmDrink::Tick(float DeltaSeconds)
{
	Super::Tick(DeltaSeconds);
	Time += DeltaSeconds;
	Jet->bEmits = Time < 2.2f;
}
