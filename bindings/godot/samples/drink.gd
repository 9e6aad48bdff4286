# Pour a drink: a jet fills a glass, then two cubes of ice fall in.
extends "res://samples/stage.gd"

const GLASS = Color(0.7, 0.85, 0.95, 0.25)
const ICE = Color(0.92, 0.97, 1.0, 0.75)

var _ice = []
var _let_go = false


func build():
	# The glass: 40 cm wide inside, that is 16 cells. Its front is not drawn.
	wall(Vector3(0, -0.025, 0), Vector3(0.25, 0.025, 0.25), GLASS)
	wall(Vector3(-0.225, 0.225, 0), Vector3(0.025, 0.225, 0.25), GLASS)
	wall(Vector3(0.225, 0.225, 0), Vector3(0.025, 0.225, 0.25), GLASS)
	wall(Vector3(0, 0.225, -0.225), Vector3(0.2, 0.225, 0.025), GLASS)
	wall(Vector3(0, 0.225, 0.225), Vector3(0.2, 0.225, 0.025), GLASS, false)
	# Lighter than real ice, which sinks on a grid this coarse: see docs/limits.md.
	for i in 2:
		var cube = floating_box(Vector3(-0.02 + 0.14 * i, 0.65 + 0.15 * i, -0.08 + 0.16 * i), Vector3(0.05, 0.05, 0.05), ICE, 600.0)
		cube.rotation_degrees = Vector3(20 * i, 30, 15)
		cube.mode = RigidBody.MODE_STATIC
		_ice.append(cube)
	look(Vector3(0.45, 0.95, 1.4), Vector3(0, 0.32, 0))


func play(_delta):
	$World/Jet.emitting = time < 2.6
	if time > 3.0 and not _let_go:
		_let_go = true
		for cube in _ice:
			cube.mode = RigidBody.MODE_RIGID


# 0.0385 m^3 stand 24 cm high in the glass.
func verdict():
	for cube in _ice:
		var height = cube.translation.y
		if height < 0.15 or height > 0.3:
			return "a cube is %.3f m high, and not at the surface" % height
	return ""
