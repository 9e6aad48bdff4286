#include "PbmpmRaft.h"

#include "Components/StaticMeshComponent.h"

#include "PbmpmBallsComponent.h"
#include "PbmpmDrainComponent.h"
#include "PbmpmEmitterComponent.h"
#include "PbmpmMaterial.h"
#include "PbmpmWorldComponent.h"

APbmpmRaft::APbmpmRaft()
{
	World->CellSize = 10.0f;
	World->ParticleCapacity = 60000;
	World->DomainMin = FVector(-100, -200, -250);
	World->DomainMax = FVector(900, 200, 300);
	Balls->BallScale = 0.08f;
	Water = CreateDefaultSubobject<UPbmpmLiquid>(TEXT("Water"));
	// The bed falls by 4 cm per metre.
	const FQuat Slope(FVector(0, 1, 0), 0.04);
	AddWall(TEXT("Bed"), FVector(350, 0, -30), FVector(350, 110, 30), Slope);
	AddWall(TEXT("LeftBank"), FVector(350, -90, 20), FVector(350, 20, 50), Slope);
	AddWall(TEXT("RightBank"), FVector(350, 90, 20), FVector(350, 20, 50), Slope);
	AddWall(TEXT("BackBank"), FVector(-20, 0, 30), FVector(20, 110, 60));
	AddFill(TEXT("River"), Water, FVector(350, 0, 20), FVector(340, 70, 20));
	Raft = AddFloatingBox(TEXT("Raft"), FVector(150, 0, 60), FVector(40, 25, 10), 400.0f);
	Spring = CreateDefaultSubobject<UPbmpmEmitterComponent>(TEXT("Spring"));
	Attach(Spring, FVector(30, 0, 35));
	Spring->Material = Water;
	Spring->bDisc = false;
	Spring->HalfExtents = FVector(15, 50, 15);
	Spring->Rate = 350.0f;
	Spring->Speed = 100.0f;
	Drain = CreateDefaultSubobject<UPbmpmDrainComponent>(TEXT("Drain"));
	Attach(Drain, FVector(780, 0, -150));
	Drain->HalfExtents = FVector(100, 180, 60);
}
