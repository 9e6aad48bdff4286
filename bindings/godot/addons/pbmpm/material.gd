# A material. The parameters are those of pbmpm/material.h; each kind takes its own and ignores the others.
extends Resource

export(String, "liquid", "elastic", "sand", "visco") var kind = "liquid"
export(float) var density = 1000.0 # [kg/m^3]
export(Color, RGB) var colour = Color(0.25, 0.55, 0.9)
export(float) var kinematic_viscosity = 0.0 # liquid [m^2/s]
export(float) var young_modulus = 1e5 # all but liquids [Pa]
export(float, 0, 0.495) var poisson_ratio = 0.3 # all but liquids
export(float) var friction_angle = 0.5236 # sand [rad]
export(float) var cohesion = 0.0 # sand
export(float) var yield_strain = 0.05 # visco
export(float) var flow_rate = 100.0 # visco [1/s]


func fields():
	return {
		"kind": kind, "density": density, "kinematic_viscosity": kinematic_viscosity, "young_modulus": young_modulus, "poisson_ratio": poisson_ratio,
		"friction_angle": friction_angle, "cohesion": cohesion, "yield_strain": yield_strain, "flow_rate": flow_rate,
		"colour": Vector3(colour.r, colour.g, colour.b),
	}
