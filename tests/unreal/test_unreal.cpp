/* The Unreal plugin in a stand-in for the engine: a module that loads, a world with each kind of part, frames, and what comes to an end. */
#include "PbmpmBallsComponent.h"
#include "PbmpmColliderComponent.h"
#include "PbmpmDrainComponent.h"
#include "PbmpmDrink.h"
#include "PbmpmEmitterComponent.h"
#include "PbmpmFillComponent.h"
#include "PbmpmForceComponent.h"
#include "PbmpmMaterial.h"
#include "PbmpmModule.h"
#include "PbmpmNiagaraComponent.h"
#include "PbmpmRaft.h"
#include "PbmpmSandbox.h"
#include "PbmpmSubsystem.h"
#include "PbmpmWorldComponent.h"

#include "Components/StaticMeshComponent.h"
#include "Engine/StaticMesh.h"
#include "HAL/PlatformProcess.h"
#include "LandscapeProxy.h"
#include "NiagaraComponent.h"
#include "StaticMeshResources.h"

static int Checks, Failures;

static void Check(bool bHolds, const char* What, int Line)
{
	Checks++;
	if (bHolds)
	{
		return;
	}
	Failures++;
	std::printf("test_unreal.cpp:%d: does not hold: %s (last of the log: ", Line, What);
	for (const TCHAR* Letter = *FStubLog::Get().Last; *Letter; Letter++)
	{
		std::putchar(int(*Letter));
	}
	std::printf(")\n");
}
#define CHECK(Condition) Check(static_cast<bool>(Condition), #Condition, __LINE__)

/* A level: components that play until it ends. */
struct FLevel
{
	UWorld World;
	UPbmpmSubsystem Subsystem;
	std::vector<UActorComponent*> Playing;

	FLevel() { World.StubSubsystem = &Subsystem; }
	void Play(UActorComponent& Component)
	{
		Component.StubLevel = &World;
		Component.BeginPlay();
		Playing.push_back(&Component);
	}
	void Stop(UActorComponent& Component)
	{
		Component.EndPlay(EEndPlayReason::Destroyed);
		Playing.erase(std::find(Playing.begin(), Playing.end(), &Component));
	}
	void Tick(float Seconds)
	{
		Subsystem.Tick(Seconds);
		for (UActorComponent* Component : Playing)
		{
			Component->TickComponent(Seconds, LEVELTICK_All, nullptr);
		}
	}
	void End()
	{
		while (!Playing.empty())
		{
			Stop(*Playing.back());
		}
	}
};

static void Place(USceneComponent& Component, const FVector& Location, const FQuat& Rotation = FQuat::Identity)
{
	Component.StubTransform = FTransform(Rotation, Location, FVector(1.0));
}

static FVector MeanOf(pbmpm::span<const pbmpm::engine::point> Points)
{
	FVector Sum;
	for (const pbmpm::engine::point& Point : Points)
	{
		Sum = Sum + FVector(Point.position[0], Point.position[1], Point.position[2]);
	}
	return Sum * (1.0 / double(Points.size()));
}

/* A tank of 2 m x 1 m x 1 m. */
static void MakeTank(UPbmpmWorldComponent& Tank)
{
	Tank.bClosed = true;
	Tank.DomainMin = FVector(0, 0, 0);
	Tank.DomainMax = FVector(200, 100, 100);
}

static void AModuleSaysWhyItCannotLoad()
{
	FPbmpmModule Module;
	FPlatformProcess::StubFinds = false;
	Module.StartupModule();
	CHECK(!FPbmpmModule::IsLoaded() && FStubLog::Get().Last.Contains(TEXT("libpbmpm.so.1")));
	FLevel Level;
	UPbmpmWorldComponent Tank;
	Level.Play(Tank);
	Level.Tick(0.02f); // nothing, and no fault
	CHECK(Level.Subsystem.GetMatter() == nullptr && FStubLog::Get().Errors == 2);
	Level.End();
	FPlatformProcess::StubFinds = true;
}

static void MatterFallsAndIsDrawn()
{
	FLevel Level;
	UPbmpmWorldComponent Tank;
	MakeTank(Tank);
	UPbmpmLiquid Water;
	UPbmpmFillComponent Fill;
	UPbmpmBallsComponent Balls;
	UPbmpmNiagaraComponent Niagara;
	UNiagaraComponent System;
	Fill.Material = &Water;
	Fill.HalfExtents = FVector(40, 20, 10);
	Place(Fill, FVector(60, 50, 60));
	Niagara.Niagara = &System;
	Level.Play(Fill); // before its world
	Level.Play(Tank);
	Level.Play(Balls);
	Level.Play(Niagara);
	Level.Tick(1.0f / 60);
	const auto Before = Level.Subsystem.GetPoints();
	CHECK(Before.size() == 16 * 8 * 4 && Tank.GetParticleCount() == 512);
	const FVector Start = MeanOf(Before);
	CHECK(std::abs(Start.X - 60) < 1 && std::abs(Start.Y - 50) < 1 && std::abs(Start.Z - 60) < 2);
	for (int Frame = 0; Frame < 20; Frame++)
	{
		Level.Tick(1.0f / 60);
	}
	// A third of a second: from rest that is 54 cm, and a step less is drawn, since the last runs in the background.
	const FVector Fallen = MeanOf(Level.Subsystem.GetPoints());
	CHECK(std::abs(Fallen.X - Start.X) < 0.5 && std::abs(Fallen.Y - Start.Y) < 0.5);
	CHECK(Start.Z - Fallen.Z > 40 && Fallen.Z > 4);
	CHECK(Balls.GetInstanceCount() == 512 && std::abs(Balls.StubInstances[7].GetScale3D().X - Balls.BallScale) < 1e-6);
	CHECK(System.StubCount == 1024 && System.StubNames[0] == FName(TEXT("Positions")));
	CHECK(Level.Subsystem.GetMaterial(Level.Subsystem.GetPoints()[0]) == &Water);
	CHECK(Tank.GetStepMilliseconds() > 0 && Tank.GetLostSeconds() == 0);
	Level.Tick(1.0f);
	CHECK(Tank.GetLostSeconds() > 0.9f);
	static_cast<void>(Tank.GetAdvice());
	CHECK(FStubLog::Get().Errors == 0);
	Level.End();
	CHECK(Level.Subsystem.GetPoints().size() == 0);
}

/* The mean motion of a block of matter in one second without gravity, in which a force acts along Unreal's x. */
static FVector MotionUnder(EPbmpmForce Kind, const FVector& Location, const FQuat& Rotation)
{
	FLevel Level;
	UPbmpmWorldComponent Space;
	Space.Gravity = FVector::ZeroVector;
	UPbmpmLiquid Water;
	UPbmpmFillComponent Fill;
	UPbmpmForceComponent Force;
	Fill.Material = &Water;
	Fill.HalfExtents = FVector(20, 20, 20);
	Force.Kind = Kind;
	Force.bEverywhere = true;
	Place(Force, Location, Rotation);
	Level.Play(Space);
	Level.Play(Fill);
	Level.Play(Force);
	Level.Tick(0.0f);
	for (int Frame = 0; Frame < 31; Frame++)
	{
		Level.Tick(1.0f / 60);
	}
	const FVector Mean = MeanOf(Level.Subsystem.GetPoints());
	Level.End();
	CHECK(FStubLog::Get().Errors == 0);
	return Mean;
}

static void ForcesActAlongUnrealsAxes()
{
	const FQuat Yaw(0, 0, std::sqrt(0.5), std::sqrt(0.5)); // x to y
	const FVector Forward = MotionUnder(EPbmpmForce::Uniform, FVector(), FQuat::Identity), Right = MotionUnder(EPbmpmForce::Uniform, FVector(), Yaw);
	CHECK(Forward.X > 5 && std::abs(Forward.Y) < 1 && std::abs(Forward.Z) < 1);
	CHECK(Right.Y > 5 && std::abs(Right.X) < 1 && std::abs(Right.Z) < 1);
	// At (200, 0, 0) from its axis z, w x r is along y, as Unreal turns.
	const FVector Turned = MotionUnder(EPbmpmForce::Vortex, FVector(-200, 0, 0), FQuat::Identity);
	CHECK(Turned.Y > 5 && std::abs(Turned.Z) < 1);
}

static void EmittersAndDrainsKeepAccount()
{
	FLevel Level;
	UPbmpmWorldComponent Space;
	UPbmpmLiquid Water;
	UPbmpmEmitterComponent Jet;
	UPbmpmDrainComponent Drain;
	Jet.Material = &Water;
	Jet.Radius = 20;
	Jet.Rate = 100; // litres/s
	Jet.Speed = 100;
	const FQuat Down(0, std::sqrt(0.5), 0, std::sqrt(0.5)); // x to -z
	CHECK(Down.GetForwardVector().Z < -0.99);
	Place(Jet, FVector(0, 0, 100), Down);
	Drain.HalfExtents = FVector(100, 100, 50);
	Place(Drain, FVector(0, 0, -250));
	Level.Play(Space);
	Level.Play(Jet);
	Level.Play(Drain);
	for (int Frame = 0; Frame < 121; Frame++)
	{
		Level.Tick(1.0f / 60);
	}
	// 200 litres in 2 s, of 0.125 litres each; a fall of 3 m at first 1 m/s takes 0.69 s. So 1.3 s of them are gone.
	const double Drained = double(Drain.GetDrained());
	CHECK(std::abs(Drained / 1045 - 1) < 0.1);
	const FVector Mean = MeanOf(Level.Subsystem.GetPoints());
	CHECK(std::abs(Mean.X) < 3 && std::abs(Mean.Y) < 3 && Mean.Z < 50);
	Jet.bEmits = false;
	const int32 Count = int32(Level.Subsystem.GetPoints().size());
	for (int Frame = 0; Frame < 30; Frame++)
	{
		Level.Tick(1.0f / 60);
	}
	CHECK(int32(Level.Subsystem.GetPoints().size()) < Count);
	Level.Stop(Jet);
	Level.Tick(1.0f / 60);
	CHECK(FStubLog::Get().Errors == 0);
	Level.End();
}

static void BodiesFloat()
{
	FLevel Level;
	UPbmpmWorldComponent Tank;
	MakeTank(Tank);
	Tank.DomainMax = FVector(160, 160, 100);
	UPbmpmLiquid Water;
	UPbmpmFillComponent Fill;
	UPrimitiveComponent Raft;
	UPbmpmColliderComponent Collider;
	Fill.Material = &Water;
	Fill.HalfExtents = FVector(80, 80, 25);
	Place(Fill, FVector(80, 80, 25));
	Raft.StubSimulates = true;
	Raft.StubMass = 36; // half of the water's density
	Raft.StubInertia = 12000;
	Place(Raft, FVector(80, 80, 65));
	Collider.StubParent = &Raft;
	Collider.HalfExtents = FVector(30, 30, 10);
	Collider.FrictionCoefficient = 0;
	Level.Play(Tank);
	Level.Play(Fill);
	Level.Play(Collider);
	for (int Frame = 0; Frame < 150; Frame++)
	{
		Level.Tick(1.0f / 60);
		Raft.StubSimulate(1.0f / 60);
	}
	const double Height = Raft.StubTransform.GetLocation().Z;
	std::printf("a raft: its centre is %.1f cm high; Archimedes says 51.4 cm\n", Height);
	CHECK(std::abs(Height - 51.4) < 4); // 0.4 cells, see pbmpm_collider_submerged()
	Level.Stop(Collider);
	Level.Tick(1.0f / 60);
	CHECK(FStubLog::Get().Errors == 0);
	Level.End();
}

static void MeshesAndLandscapesHoldMatter()
{
	FLevel Level;
	UPbmpmWorldComponent Space;
	UPbmpmLiquid Water;
	UPbmpmFillComponent Fill;
	UPbmpmColliderComponent Ground, Block;
	ALandscapeProxy Land;
	Fill.Material = &Water;
	Fill.HalfExtents = FVector(30, 30, 10);
	Place(Fill, FVector(-100, 0, 60));
	Ground.Shape = EPbmpmShape::Landscape;
	Ground.Landscape = &Land;
	Ground.HalfExtents = FVector(480, 480, 50);
	Ground.HeightSpacing = 20;
	// A box of 40 cm, as a mesh: an anvil that the water falls on.
	FStaticMeshRenderData Data;
	FStaticMeshLODResources Box;
	for (uint32 Corner = 0; Corner < 8; Corner++)
	{
		Box.VertexBuffers.PositionVertexBuffer.Stub.push_back({Corner & 1 ? 20.0f : -20.0f, Corner & 2 ? 20.0f : -20.0f, Corner & 4 ? 20.0f : -20.0f});
	}
	Box.IndexBuffer.Stub = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
	Data.LODResources.Add(Box);
	UStaticMesh Mesh;
	Mesh.bAllowCPUAccess = true;
	Mesh.StubData = &Data;
	Block.Shape = EPbmpmShape::Mesh;
	Block.Mesh = &Mesh;
	Place(Block, FVector(-100, 0, 15));
	Level.Play(Space);
	Level.Play(Fill);
	Level.Play(Ground);
	Level.Play(Block);
	for (int Frame = 0; Frame < 60; Frame++)
	{
		Level.Tick(1.0f / 60);
	}
	CHECK(FStubLog::Get().Errors == 0);
	int32 Below = 0, Inside = 0;
	for (const pbmpm::engine::point& Point : Level.Subsystem.GetPoints())
	{
		Below += Point.position[2] < 0.1f * Point.position[0] - 10;
		Inside += std::abs(Point.position[0] + 100) < 15 && std::abs(Point.position[1]) < 15 && std::abs(Point.position[2] - 15) < 15;
	}
	CHECK(Level.Subsystem.GetPoints().size() == 576 && Below == 0 && Inside == 0);
	Mesh.bAllowCPUAccess = false;
	UPbmpmColliderComponent Hidden;
	Hidden.Shape = EPbmpmShape::Mesh;
	Hidden.Mesh = &Mesh;
	Level.Play(Hidden);
	Level.Tick(1.0f / 60);
	CHECK(FStubLog::Get().Errors == 1 && FStubLog::Get().Last.Contains(TEXT("CPU access")));
	Level.End();
}

static void WorldsEndAndBeginAgain()
{
	FLevel Level;
	UPbmpmWorldComponent Tank, Second;
	MakeTank(Tank);
	UPbmpmSand Sand;
	UPbmpmFillComponent Fill;
	UPbmpmColliderComponent Wall;
	Fill.Material = &Sand;
	Fill.HalfExtents = FVector(20, 20, 20);
	Place(Fill, FVector(60, 50, 60));
	Wall.bMoves = true;
	Wall.HalfExtents = FVector(10, 40, 20);
	Place(Wall, FVector(150, 50, 30));
	Level.Play(Tank);
	Level.Play(Fill);
	Level.Play(Wall);
	for (int Round = 0; Round < 3; Round++)
	{
		Level.Tick(1.0f / 60);
		Level.Tick(1.0f / 60);
		CHECK(Level.Subsystem.GetPoints().size() == 512);
		Level.Stop(Tank);
		Level.Tick(1.0f / 60);
		CHECK(Level.Subsystem.GetMatter() == nullptr);
		Level.Play(Tank);
	}
	Level.Play(Second);
	CHECK(FStubLog::Get().Warnings == 1 && FStubLog::Get().Errors == 0);
	Fill.Material = nullptr;
	Level.Tick(1.0f / 60);
	CHECK(FStubLog::Get().Errors == 1 && FStubLog::Get().Last.Contains(TEXT("no material")));
	Level.End();
}

/* A sample in a level. What simulates falls and is pushed, and hits nothing. */
template <class SampleType> struct FSampleLevel : FLevel
{
	SampleType Sample;

	explicit FSampleLevel(const FVector& Place = FVector())
	{
		Sample.RootComponent->SetRelativeLocation(Place);
		for (const auto& [Name, Object] : Sample.StubObjects)
		{
			if (UActorComponent* Component = dynamic_cast<UActorComponent*>(Object.get()))
			{
				Play(*Component);
			}
		}
	}
	void Run(int Frames)
	{
		for (int Frame = 0; Frame < Frames; Frame++)
		{
			Sample.Tick(1.0f / 60);
			Tick(1.0f / 60);
			for (const auto& [Name, Object] : Sample.StubObjects)
			{
				UPrimitiveComponent* Body = dynamic_cast<UPrimitiveComponent*>(Object.get());
				if (Body && Body->IsSimulatingPhysics())
				{
					Body->StubSimulate(1.0f / 60);
				}
			}
		}
	}
	SIZE_T Count() const { return Subsystem.GetPoints().size(); }
};

static void SamplesPlay()
{
	{
		FSampleLevel<APbmpmDrink> Level(FVector(1000, -2000, 300)); // and not at the level's origin
		Level.Run(1);
		const SIZE_T Before = Level.Count();
		Level.Run(30);
		CHECK(Before > 9000 && Level.Count() > Before + 2000);
		const FVector Mean = MeanOf(Level.Subsystem.GetPoints());
		CHECK(Mean.Z > 304 && Mean.Z < 340 && std::abs(Mean.X - 1000) < 10 && std::abs(Mean.Y + 2000) < 10);
		Level.End();
	}
	{
		FSampleLevel<APbmpmRaft> Level;
		Level.Run(45);
		const FVector Place = Level.Sample.Raft->GetComponentTransform().GetLocation();
		CHECK(Level.Count() > 10000 && Place.Z > 10 && Place.Z < 70 && Place.X > 152);
		Level.End();
	}
	{
		FSampleLevel<APbmpmSandbox> Level;
		Level.Run(1);
		const SIZE_T All = Level.Count();
		int32 High = 0;
		for (int Frame = 0; Frame < 60; Frame++)
		{
			Level.Sample.MoveHand(FVector(180, 40, 20 + Frame), 1.0f / 60, true);
			Level.Run(1);
		}
		for (const pbmpm::engine::point& Point : Level.Subsystem.GetPoints())
		{
			High += Level.Subsystem.GetMaterial(Point) == Level.Sample.Clay && Point.position[2] > 40;
		}
		CHECK(Level.Count() == All && High > 100);
		Level.End();
	}
	CHECK(FStubLog::Get().Errors == 0);
}

int main()
{
	AModuleSaysWhyItCannotLoad();
	FPbmpmModule Module;
	Module.StartupModule();
	CHECK(FPbmpmModule::IsLoaded());
	for (void (*Test)() : {MatterFallsAndIsDrawn, ForcesActAlongUnrealsAxes, EmittersAndDrainsKeepAccount, BodiesFloat, MeshesAndLandscapesHoldMatter, WorldsEndAndBeginAgain, SamplesPlay})
	{
		FStubLog::Get() = FStubLog();
		Test();
	}
	Module.ShutdownModule();
	std::printf("%d checks, %d failures\n", Checks, Failures);
	return Failures == 0 ? 0 : 1;
}
