# What fills, emitters, drains, forces and colliders share: they stand somewhere in the scene, have a shape, and belong to the world that is the nearest above
# them, or else to the first of the scene. The world calls begin() once, before_frame() and after_frame() in each physics frame.
extends Spatial

export(String, "box", "sphere", "capsule", "plane", "mesh", "heights") var shape = "box"
export(Vector3) var half_extents = Vector3(0.5, 0.5, 0.5) # box [m]
export(float) var radius = 0.5 # sphere, capsule [m]
export(float) var half_length = 0.5 # capsule, along the node's z axis as Godot's own [m]
export(Mesh) var mesh # mesh: closed
export(int, 4, 1024) var resolution = 64 # mesh: cells along its longest side
export(PoolRealArray) var heights # heights [m], row by row along the node's x axis
export(int) var columns = 2 # heights: in a row
export(float) var spacing = 1.0 # heights [m]
export(float) var thickness = 1.0 # heights: below the lowest [m]

var id # of the library
var order = 0 # parts with a lower number begin first


func _enter_tree():
	add_to_group("pbmpm_part")


func _ready():
	var world = world()
	if world and world.native:
		world.add(self)


func _exit_tree():
	var world = world()
	if world:
		world.forget(self)


func world():
	var node = get_parent()
	while node and not node.is_in_group("pbmpm_world"):
		node = node.get_parent()
	if node:
		return node
	var worlds = get_tree().get_nodes_in_group("pbmpm_world")
	return worlds[0] if worlds else null


# How the shape lies. The library's capsules lie along the first axis.
func turn():
	var rotation = global_transform.basis.get_rotation_quat()
	return rotation * Quat(Vector3.UP, -PI / 2) if shape == "capsule" else rotation


# The shape as native.gdns takes it. A node's scale is part of the shape.
func shape_fields(world):
	var scale = global_transform.basis.get_scale()
	var fields = {"shape": shape, "position": global_transform.origin, "rotation": turn()}
	match shape:
		"box":
			fields["half_extents"] = half_extents * scale
		"sphere":
			fields["radius"] = radius * scale.x
		"capsule":
			fields["radius"] = radius * scale.x
			fields["half_length"] = half_length * scale.z
		"mesh":
			fields["shape"] = "baked"
			fields["baked"] = world.native.bake_mesh(_scaled_faces(scale), resolution)
		"heights":
			fields["shape"] = "baked"
			fields["baked"] = world.native.bake_heights(heights, columns, spacing, thickness)
	return fields


func _scaled_faces(scale):
	var faces = mesh.get_faces()
	for i in faces.size():
		faces[i] *= scale
	return faces


func begin(_world):
	pass


func before_frame(_world, _delta):
	pass


func after_frame(_world):
	pass


func end(_world):
	pass
