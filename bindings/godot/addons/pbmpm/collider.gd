# An obstacle. It follows its node where `moves` is set. Below a RigidBody it is coupled: matter pushes the body, and the body pushes matter.
extends "res://addons/pbmpm/part.gd"

export(bool) var moves = false
export(String, "coulomb", "stick", "slip") var friction = "coulomb"
export(float) var friction_coefficient = 0.2
export(bool) var sensor = false

var _body # the RigidBody that it is part of, or null
var _number # of the coupling


func begin(world):
	_body = get_parent() as RigidBody
	var fields = shape_fields(world)
	if shape == "plane":
		fields["normal"] = Vector3.UP
	fields["kinematic"] = moves or _body != null
	fields["measures_impulse"] = _body != null
	fields["friction"] = friction
	fields["friction_coefficient"] = friction_coefficient
	fields["sensor"] = sensor
	id = world.native.add_collider(fields)
	if id and _body:
		# The centre of mass of a RigidBody is its origin.
		_number = world.native.couple(id, _body.mass, turn().inverse() * (_body.global_transform.origin - global_transform.origin))


func before_frame(world, _delta):
	if not id:
		return
	if _body:
		var rests = _body.mode == RigidBody.MODE_STATIC
		var velocity = Vector3() if rests else _body.linear_velocity
		world.native.set_motion(_number, global_transform.origin, turn(), velocity, Vector3() if rests else _body.angular_velocity)
	elif moves:
		world.native.follow_collider(id, global_transform.origin, turn())


func after_frame(world):
	if not id or not _body:
		return
	var push = world.native.take_push(_number)
	_body.apply_central_impulse(push["linear"])
	_body.apply_torque_impulse(push["angular"])


func end(world):
	if id and _body:
		world.native.uncouple(_number)
	elif id:
		world.native.remove_collider(id)
	id = null
