// The library's side of a world: what the subsystem owns and parts use.
#pragma once

#include "CoreMinimal.h"
#include "UObject/StrongObjectPtr.h"

#include "PbmpmConversion.h"
#include "PbmpmModule.h"

class UPbmpmMaterial;
class UPbmpmWorldComponent;

class FPbmpmWorld
{
public:
	/** Null where it fails; the log says why. */
	static TUniquePtr<FPbmpmWorld> Create(const UPbmpmWorldComponent& Settings);

	pbmpm::engine::simulation Simulation;
	/** The world when no step runs. */
	pbmpm::expected<pbmpm::world_ref> Editing() { return Simulation.editing(); }
	/** The library's identifier of a material, which the world gets to know with its first use. */
	pbmpm::expected<pbmpm_material_id> Material(UPbmpmMaterial* Asset);
	/** The asset behind a particle's number of a material; null for none. */
	const UPbmpmMaterial* MaterialOf(uint32 Index) const;
	/** Copies particles for renderers, once per frame. */
	void UpdatePoints();
	pbmpm::span<const pbmpm::engine::point> Points() const { return Copied; }

	/** Tells the log of a failure; true if there was none. */
	template <class T> static bool Succeeded(const pbmpm::expected<T>& Result, const TCHAR* What)
	{
		if (Result)
		{
			return true;
		}
		UE_LOG(LogPbmpm, Error, TEXT("%s: %s"), What, UTF8_TO_TCHAR(Result.error().message));
		return false;
	}

private:
	FPbmpmWorld(pbmpm::engine::simulation&& Made, uint32 Capacity) : Simulation(std::move(Made)), Buffer(PbmpmConversion::Coordinates, Capacity) {}

	pbmpm::engine::points Buffer;
	pbmpm::span<const pbmpm::engine::point> Copied;
	TMap<UPbmpmMaterial*, pbmpm_material_id> Materials;
	TMap<uint32, TStrongObjectPtr<UPbmpmMaterial>> Assets;
};
