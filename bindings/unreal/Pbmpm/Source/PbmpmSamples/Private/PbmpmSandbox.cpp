#include "PbmpmSandbox.h"

#include "Components/StaticMeshComponent.h"

#include "PbmpmBallsComponent.h"
#include "PbmpmForceComponent.h"
#include "PbmpmMaterial.h"
#include "PbmpmWorldComponent.h"

APbmpmSandbox::APbmpmSandbox()
{
	World->CellSize = 5.0f;
	World->bClosed = true;
	World->DomainMin = FVector(0, 0, 0);
	World->DomainMax = FVector(200, 80, 120);
	Balls->BallScale = 0.04f;
	Water = CreateDefaultSubobject<UPbmpmLiquid>(TEXT("Water"));
	Jelly = CreateDefaultSubobject<UPbmpmElastic>(TEXT("Jelly"));
	Jelly->Density = 900.0f;
	Jelly->YoungModulus = 5e4f;
	Jelly->Colour = FLinearColor(0.1f, 0.6f, 0.1f);
	Sand = CreateDefaultSubobject<UPbmpmSand>(TEXT("Sand"));
	Sand->Density = 1600.0f;
	Sand->Colour = FLinearColor(0.8f, 0.5f, 0.1f);
	Clay = CreateDefaultSubobject<UPbmpmVisco>(TEXT("Clay"));
	Clay->Density = 1300.0f;
	Clay->Colour = FLinearColor(0.4f, 0.1f, 0.06f);
	AddWall(TEXT("Basin"), FVector(45, 40, 20), FVector(5, 40, 20));
	AddFill(TEXT("Pool"), Water, FVector(20, 40, 10), FVector(20, 40, 10));
	AddFill(TEXT("Block"), Jelly, FVector(78, 40, 15), FVector(15, 15, 15));
	AddFill(TEXT("Heap"), Sand, FVector(130, 40, 12), FVector(12, 20, 12));
	AddFill(TEXT("Lump"), Clay, FVector(180, 40, 15), FVector(12, 12, 12));
	Hand = CreateDefaultSubobject<UPbmpmForceComponent>(TEXT("Hand"));
	Attach(Hand, FVector(78, 40, 60));
	Hand->Kind = EPbmpmForce::Grab;
	Hand->bActs = false;
	Hand->Shape = EPbmpmShape::Sphere;
	Hand->Radius = 12.0f;
	Hand->Falloff = EPbmpmFalloff::Smooth;
	Hand->Range = 12.0f;
}

void APbmpmSandbox::MoveHand(const FVector& Place, float Seconds, bool bGrabs)
{
	const FVector Before = Hand->GetComponentTransform().GetLocation();
	const bool bHeld = Hand->bActs; // the way to where it begins to hold is none that matter goes
	Hand->SetRelativeLocation(Place);
	Hand->bActs = bGrabs;
	Hand->Velocity = bHeld && Seconds > 0.0f ? (Hand->GetComponentTransform().GetLocation() - Before) * (1.0 / Seconds) : FVector(0, 0, 0);
}
