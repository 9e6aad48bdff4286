# A source of matter. It may move.
extends "res://addons/pbmpm/part.gd"

export(Resource) var material
export(bool) var emitting = true setget set_emitting
export(String, "volume", "disc") var region = "disc"
export(float) var rate = 0.01 # rest volume per second [m^3/s]
export(float) var speed = 1.0 # [m/s]
export(Vector3) var direction = Vector3(0, -1, 0) # along the node's axes
export(float) var spread = 0.0 # [rad]
export(float) var fill_limit = 1.0


func _init():
	order = 2


func begin(world):
	var fields = shape_fields(world)
	fields["material"] = world.material_id(material)
	fields["enabled"] = emitting
	fields["region"] = region
	fields["rate"] = rate
	fields["speed"] = speed
	fields["direction"] = direction
	fields["spread"] = spread
	fields["fill_limit"] = fill_limit
	id = world.native.add_emitter(fields)


func before_frame(world, _delta):
	world.native.follow_emitter(id, global_transform.origin, turn())


func set_emitting(value):
	emitting = value
	if id:
		world().native.set_emitter(id, {"enabled": value})
