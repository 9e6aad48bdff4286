// Unreal's values as those of the layer for engines. Coordinates are converted there, in pbmpm_engine/coordinates.hpp, and nowhere else.
#pragma once

#include "CoreMinimal.h"

THIRD_PARTY_INCLUDES_START
#include <pbmpm_engine/points.hpp>
#include <pbmpm_engine/simulation.hpp>
THIRD_PARTY_INCLUDES_END

namespace PbmpmConversion
{
	inline constexpr const pbmpm::engine::coordinates& Coordinates = pbmpm::engine::unreal;

	/** The same numbers, in Unreal's coordinates. */
	inline pbmpm::vector3 Plain(const FVector& Vector)
	{
		return {float(Vector.X), float(Vector.Y), float(Vector.Z)};
	}
	inline pbmpm::quaternion Plain(const FQuat& Rotation)
	{
		return {float(Rotation.X), float(Rotation.Y), float(Rotation.Z), float(Rotation.W)};
	}
	inline FVector ToUnreal(const pbmpm::vector3& Plain)
	{
		return FVector(Plain[0], Plain[1], Plain[2]);
	}
	template <SIZE_T Count> void Set(float (&To)[Count], const std::array<float, Count>& From)
	{
		for (SIZE_T Index = 0; Index < Count; Index++)
		{
			To[Index] = From[Index];
		}
	}
} // namespace PbmpmConversion
