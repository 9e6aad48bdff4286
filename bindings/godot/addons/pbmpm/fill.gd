# Matter at the beginning.
extends "res://addons/pbmpm/part.gd"

export(Resource) var material
export(Vector3) var velocity = Vector3() # [m/s]
export(float) var particles_per_axis = 2.0 # of a cell


func _init():
	order = 1 # behind colliders: what they cover stays free


func begin(world):
	var fields = shape_fields(world)
	fields["material"] = world.material_id(material)
	fields["velocity"] = velocity
	fields["particles_per_axis"] = particles_per_axis
	world.native.fill(fields)
