# A raft on a river: a bed of heights, a spring upstream, a drain below the fall at its end, and a raft that Godot's physics moves.
extends "res://samples/stage.gd"

const BANK = Color(0.55, 0.47, 0.36)
const WOOD = Color(0.62, 0.4, 0.2)
const SPACING = 0.2 # of the heights [m]
const COLUMNS = 41 # along the river: 8 m
const ROWS = 15 # across it: 2.8 m

var _raft


# The bed at a place along and across the river, from its beginning and its middle [m]: a bank is behind the spring, it winds, falls by 4 cm per metre, and
# ends in a fall.
func bed(along, across):
	var bank = clamp((abs(across - 0.25 * sin(0.9 * along)) - 0.6) / 0.3, 0, 1)
	var fall = 1.0 if along > 6.9 else 0.0
	if along < 0.7:
		bank = 1
	return 0.9 * bank * bank * (3 - 2 * bank) - 0.04 * along - fall


func build():
	var heights = PoolRealArray()
	for row in ROWS:
		for column in COLUMNS:
			heights.append(bed(column * SPACING, (row - (ROWS - 1) / 2) * SPACING))
	var bank = StaticBody.new()
	var land = MeshInstance.new()
	land.mesh = _surface(heights)
	land.material_override = paint(BANK)
	bank.add_child(land)
	var hull = CollisionShape.new()
	hull.shape = land.mesh.create_trimesh_shape()
	bank.add_child(hull)
	var collider = Collider.new()
	collider.shape = "heights"
	collider.heights = heights
	collider.columns = COLUMNS
	collider.spacing = SPACING
	collider.thickness = 0.5
	collider.friction_coefficient = 0.0
	bank.add_child(collider)
	bank.translation = Vector3(0, 0, -(ROWS - 1) / 2 * SPACING)
	add_child(bank)
	_raft = floating_box(Vector3(2.2, 0.5, 0.2), Vector3(0.4, 0.1, 0.25), WOOD, 400.0)
	look(Vector3(3.2, 5.4, 3.8), Vector3(4.0, -0.2, 0), 50)


# It floats past the bends and over the fall.
func verdict():
	return "" if _raft.translation.x > 6.9 else "the raft is %.1f m along the river, and not over the fall" % _raft.translation.x


func _surface(heights):
	var tool = SurfaceTool.new()
	tool.begin(Mesh.PRIMITIVE_TRIANGLES)
	for row in ROWS - 1:
		for column in COLUMNS - 1:
			for corner in [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]:
				var c = column + corner[0]
				var r = row + corner[1]
				tool.add_vertex(Vector3(c * SPACING, heights[r * COLUMNS + c], r * SPACING))
	tool.generate_normals()
	return tool.commit()
