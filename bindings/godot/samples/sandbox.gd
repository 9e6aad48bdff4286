# A sandbox: water, jelly, sand and clay, and a hand that grabs what is near it. The mouse moves the hand while its button is held; the wheel lifts it.
extends "res://samples/stage.gd"

const HAND = Color(0.9, 0.2, 0.2, 0.35)

var _height = 0.25
var _lifted = [0, 0, 0, 0] # particles high above each place, at most


func build():
	wall(Vector3(1, -0.05, 0.4), Vector3(1.1, 0.05, 0.5), Color(0.75, 0.72, 0.68))
	wall(Vector3(0.45, 0.2, 0.4), Vector3(0.05, 0.2, 0.4), Color(0.75, 0.72, 0.68)) # of the basin
	look(Vector3(1.0, 1.5, 2.4), Vector3(1.0, 0.2, 0.4), 45)
	var ball = SphereMesh.new()
	ball.material = paint(HAND)
	var seen = MeshInstance.new()
	seen.mesh = ball
	seen.scale = Vector3(0.12, 0.12, 0.12) # the radius of the force
	$World/Hand.add_child(seen)


func play(delta):
	var hand = $World/Hand
	var place = _played() if _folder != "" else _pointed()
	hand.enabled = _folder != "" or Input.is_mouse_button_pressed(BUTTON_LEFT)
	hand.velocity = (place - hand.translation) / delta
	hand.translation = place
	if _folder != "":
		_count_lifted()


# For tests: it dips into each material in turn, and lifts what it gets.
func _played():
	var share = fmod(time, 2.0) / 2.0
	return _place(_heap()) + Vector3(0, 0.25 * cos(TAU * share), 0)


func _place(heap):
	return Vector3([0.2, 0.78, 1.3, 1.8][heap], 0.35, 0.4)


func _heap():
	return int(min(time / 2.0, 3))


func _count_lifted():
	var above = {"shape": "box", "position": _place(_heap()) + Vector3(0, 0.25, 0), "half_extents": Vector3(0.2, 0.2, 0.3)}
	_lifted[_heap()] = max(_lifted[_heap()], $World.native.count_in(above))


# Each heap is lower than 40 cm until the hand lifts it.
func verdict():
	return "" if _lifted.min() > 50 else "particles that were lifted, of each material: %s" % [_lifted]


# Where the mouse points to, at the hand's height.
func _pointed():
	var camera = get_viewport().get_camera()
	var mouse = get_viewport().get_mouse_position()
	var place = Plane(Vector3.UP, _height).intersects_ray(camera.project_ray_origin(mouse), camera.project_ray_normal(mouse))
	return place if place else $World/Hand.translation


func _unhandled_input(event):
	if event is InputEventMouseButton and event.pressed:
		if event.button_index == BUTTON_WHEEL_UP:
			_height += 0.05
		elif event.button_index == BUTTON_WHEEL_DOWN:
			_height -= 0.05
