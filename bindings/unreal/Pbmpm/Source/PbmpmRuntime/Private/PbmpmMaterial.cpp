#include "PbmpmMaterial.h"

pbmpm::material_def UPbmpmMaterial::Definition() const
{
	pbmpm::material_def Def;
	Describe(Def);
	return Def;
}

void UPbmpmMaterial::Describe(pbmpm::material_def& Def) const
{
	Def.density = Density;
}

void UPbmpmLiquid::Describe(pbmpm::material_def& Def) const
{
	Super::Describe(Def);
	Def.kind = PBMPM_LIQUID;
	Def.kinematic_viscosity = KinematicViscosity;
}

void UPbmpmElastic::Describe(pbmpm::material_def& Def) const
{
	Super::Describe(Def);
	Def.kind = PBMPM_ELASTIC;
	Def.young_modulus = YoungModulus;
	Def.poisson_ratio = PoissonRatio;
}

void UPbmpmSand::Describe(pbmpm::material_def& Def) const
{
	Super::Describe(Def);
	Def.kind = PBMPM_SAND;
	Def.friction_angle = FMath::DegreesToRadians(FrictionAngle);
	Def.cohesion = Cohesion;
}

void UPbmpmVisco::Describe(pbmpm::material_def& Def) const
{
	Super::Describe(Def);
	Def.kind = PBMPM_VISCO;
	Def.yield_strain = YieldStrain;
	Def.flow_rate = FlowRate;
}
