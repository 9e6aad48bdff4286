# A force on matter. It may move; then change `velocity` and `strength` as you like, they are taken anew in each frame.
extends "res://addons/pbmpm/part.gd"

export(String, "uniform", "radial", "vortex", "drag", "grab") var kind = "grab"
export(bool) var enabled = true
export(bool) var everywhere = false
export(String, "none", "linear", "smooth", "inverse_square") var falloff = "smooth"
export(float) var falloff_range = 0.2 # [m]
export(float) var strength = 1.0 # [m/s^2]; of a drag [1/s]
export(Vector3) var direction = Vector3(0, 1, 0)
export(Vector3) var velocity = Vector3() # of drag and grab [m/s]
export(float) var spin = 0.0 # of drag and grab [rad/s]


func _init():
	order = 2


func _fields(world):
	var fields = shape_fields(world)
	fields["kind"] = kind
	fields["enabled"] = enabled
	fields["everywhere"] = everywhere
	fields["falloff"] = falloff
	fields["range"] = falloff_range
	fields["strength"] = strength
	fields["direction"] = direction
	fields["velocity"] = velocity
	fields["spin"] = spin
	return fields


func begin(world):
	id = world.native.add_force(_fields(world))


func before_frame(world, _delta):
	world.native.set_force(id, _fields(world))
