// Materials as assets. Parameters, units and ranges are those of pbmpm/material.h.
#pragma once

#include "CoreMinimal.h"
#include "Engine/DataAsset.h"

#include "PbmpmConversion.h"

#include "PbmpmMaterial.generated.h"

/** What matter is made of. Create one of its kinds as a data asset. */
UCLASS(Abstract, BlueprintType)
class PBMPMRUNTIME_API UPbmpmMaterial : public UDataAsset
{
	GENERATED_BODY()

public:
	/** Rest density [kg/m^3]. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0.001", ClampMax = "1000000"))
	float Density = 1000.0f;

	/** What renderers show. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm")
	FLinearColor Colour = FLinearColor(0.2f, 0.5f, 0.9f);

	/** The library's definition. */
	pbmpm::material_def Definition() const;

protected:
	virtual void Describe(pbmpm::material_def& Def) const;
};

/** Keeps its volume. */
UCLASS(BlueprintType)
class PBMPMRUNTIME_API UPbmpmLiquid : public UPbmpmMaterial
{
	GENERATED_BODY()

public:
	/** [m^2/s]; water has 1e-6. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0"))
	float KinematicViscosity = 0.0f;

protected:
	virtual void Describe(pbmpm::material_def& Def) const override;
};

/** Keeps its shape. */
UCLASS(BlueprintType)
class PBMPMRUNTIME_API UPbmpmElastic : public UPbmpmMaterial
{
	GENERATED_BODY()

public:
	/** [Pa]. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0.001"))
	float YoungModulus = 1e5f;

	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "0.495"))
	float PoissonRatio = 0.3f;

protected:
	virtual void Describe(pbmpm::material_def& Def) const override;
};

/** Shears as far as friction lets it. */
UCLASS(BlueprintType)
class PBMPMRUNTIME_API UPbmpmSand : public UPbmpmElastic
{
	GENERATED_BODY()

public:
	/** [degrees]. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "80"))
	float FrictionAngle = 30.0f;

	/** ln of the volume ratio up to which it bears tension; 0: dry. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "0.5"))
	float Cohesion = 0.0f;

protected:
	virtual void Describe(pbmpm::material_def& Def) const override;
};

/** Flows where it is strained too far: clay, dough, mud. */
UCLASS(BlueprintType)
class PBMPMRUNTIME_API UPbmpmVisco : public UPbmpmElastic
{
	GENERATED_BODY()

public:
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0", ClampMax = "10"))
	float YieldStrain = 0.05f;

	/** [1/s]. */
	UPROPERTY(EditAnywhere, BlueprintReadOnly, Category = "Pbmpm", meta = (ClampMin = "0"))
	float FlowRate = 100.0f;

protected:
	virtual void Describe(pbmpm::material_def& Def) const override;
};
