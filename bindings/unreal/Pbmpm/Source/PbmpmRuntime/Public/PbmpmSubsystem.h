// Steps the world of matter with the game's.
#pragma once

#include "CoreMinimal.h"
#include "Subsystems/WorldSubsystem.h"

#include "PbmpmConversion.h"

#include "PbmpmSubsystem.generated.h"

class FPbmpmWorld;
class UPbmpmMaterial;
class UPbmpmPartComponent;
class UPbmpmWorldComponent;

/** One world of matter for each world of the game. It begins with the first world component, and ends with it. Game thread. */
UCLASS()
class PBMPMRUNTIME_API UPbmpmSubsystem : public UTickableWorldSubsystem
{
	GENERATED_BODY()

public:
	UPbmpmSubsystem();
	UPbmpmSubsystem(FVTableHelper& Helper);
	virtual ~UPbmpmSubsystem() override;
	virtual void Deinitialize() override;
	virtual void Tick(float DeltaTime) override;
	virtual TStatId GetStatId() const override;

	void BeginWorld(const UPbmpmWorldComponent& Settings);
	void EndWorld(const UPbmpmWorldComponent& Settings);
	void Add(UPbmpmPartComponent& Part);
	void Remove(UPbmpmPartComponent& Part);

	/** The matter's world; null before it has begun, and where the library is missing. */
	FPbmpmWorld* GetMatter() const { return Matter.Get(); }
	/** Particles as of this frame, in Unreal's coordinates; valid until the next tick. */
	pbmpm::span<const pbmpm::engine::point> GetPoints() const;
	/** The asset that a particle is made of. */
	const UPbmpmMaterial* GetMaterial(const pbmpm::engine::point& Point) const;

	static UPbmpmSubsystem* Of(const UActorComponent& Component);

protected:
	virtual bool DoesSupportWorldType(const EWorldType::Type WorldType) const override;

private:
	void BeginParts();
	void Close();
	void Report() const;

	TUniquePtr<FPbmpmWorld> Matter;
	const UPbmpmWorldComponent* Owner = nullptr;
	/** All parts that play; `BegunCount` of them, the first, have begun. */
	TArray<UPbmpmPartComponent*> Parts;
	int32 BegunCount = 0;
};
