#pragma once
#include "GameFramework/Actor.h"
class ALandscapeProxy : public AActor
{
public:
	// A slope: a tenth along x.
	TOptional<float> GetHeightAtLocation(FVector Location) const { return float(0.1 * Location.X); }
};
