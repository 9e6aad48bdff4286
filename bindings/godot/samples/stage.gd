# What the samples share: light, a camera, bodies made of boxes, and a player for tests. With PBMPM_PLAY set to a folder the sample runs for `seconds`,
# writes pictures there at the times in `shots`, prints a table of times, and ends.
extends Spatial

const Collider = preload("res://addons/pbmpm/collider.gd")

export(float) var seconds = 6.0
export(PoolRealArray) var shots = PoolRealArray([1.0, 3.0, 5.0])

var time = 0.0
var _frames = 0
var _folder = OS.get_environment("PBMPM_PLAY")
var _steps = []


func _enter_tree():
	var sun = DirectionalLight.new()
	sun.rotation_degrees = Vector3(-50, -35, 0)
	sun.shadow_enabled = true
	add_child(sun)
	var environment = Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(0.86, 0.9, 0.94)
	environment.ambient_light_color = Color(1, 1, 1)
	environment.ambient_light_energy = 0.45
	var sky = WorldEnvironment.new()
	sky.environment = environment
	add_child(sky)
	build()


# To be overridden: makes what is not in the scene's file. Before the world begins.
func build():
	pass


# To be overridden: what happens in a physics frame.
func play(_delta):
	pass


# To be overridden: what is wrong at the end, or an empty text.
func verdict():
	return ""


func _physics_process(delta):
	time += delta
	play(delta)


func _process(_delta):
	if _folder == "":
		return
	_frames += 1
	var figures = $World.figures()
	_steps.append(figures["step_ms"])
	# Frames that nobody looks at are not drawn: without a graphics card that takes much longer than a step.
	VisualServer.render_loop_enabled = false
	for shot in shots:
		if abs(time - shot) < 0.5 / 60:
			VisualServer.render_loop_enabled = true
			_shoot("%s/%s_%.1f.png" % [_folder, name.to_lower(), shot])
	if time >= seconds:
		_report(figures)
		var wrong = verdict()
		print("%s: %s" % [name, "as expected" if wrong == "" else "FAILED: " + wrong])
		get_tree().quit()


func _shoot(path):
	yield(VisualServer, "frame_post_draw")
	var picture = get_viewport().get_texture().get_data()
	picture.flip_y()
	picture.save_png(path)


func _report(figures):
	_steps.sort()
	print("%s: %d frames, %d steps, %d particles, %.3f s given up; step [ms]: median %.2f, 95 %% %.2f, most %.2f" % [
		name, _frames, figures["steps"], figures["particles"], figures["lost_seconds"], _steps[_steps.size() / 2], _steps[int(_steps.size() * 0.95)], _steps[-1]])
	print("%s: hash %d" % [name, $World.native.hash()])
	for line in $World.advice().split("\n", false):
		print("%s: %s" % [name, line])


func look(from, at, angle = 40.0):
	var camera = Camera.new()
	camera.fov = angle
	add_child(camera)
	camera.look_at_from_position(from, at, Vector3.UP)


func paint(colour):
	var surface = SpatialMaterial.new()
	surface.albedo_color = colour
	surface.flags_transparent = colour.a < 1
	if colour.a < 1:
		surface.params_cull_mode = SpatialMaterial.CULL_BACK
	return surface


# A box for eyes, physics and matter, that stands still.
func wall(place, half, colour, seen = true):
	return _box(StaticBody.new(), place, half, colour, seen)


# One that Godot's physics moves and matter pushes.
func floating_box(place, half, colour, density):
	var body = RigidBody.new()
	body.mass = density * 8 * half.x * half.y * half.z
	body.can_sleep = false
	return _box(body, place, half, colour, true)


func _box(body, place, half, colour, seen):
	var form = BoxShape.new()
	form.extents = half
	var hull = CollisionShape.new()
	hull.shape = form
	body.add_child(hull)
	if seen:
		var mesh = CubeMesh.new()
		mesh.size = 2 * half
		mesh.material = paint(colour)
		var look = MeshInstance.new()
		look.mesh = mesh
		body.add_child(look)
	var collider = Collider.new()
	collider.half_extents = half
	body.add_child(collider)
	body.translation = place
	add_child(body)
	return body
