# A world of matter. Parts are nodes below it, or below bodies anywhere in the scene. It stands at the origin of the scene and draws matter as balls.
extends Spatial

const Native = preload("res://addons/pbmpm/native.gdns")

export(float) var cell_size = 0.05 # [m]
export(int) var particle_capacity = 50000
export(Vector3) var gravity = Vector3(0, -9.81, 0) # [m/s^2]
export(float) var rate = 60.0 # steps per second
export(int) var most_steps = 2 # per physics frame
export(int) var substeps = 1
export(int) var iterations = 5
export(String, "convergent", "dual", "primal", "paper", "explicit") var solver = "convergent"
export(bool) var background = true # the step runs while Godot draws
export(int) var thread_count = 0 # 0: one per core
export(bool) var closed = true # a box with walls, from domain_min to domain_max
export(Vector3) var domain_min = Vector3() # [m]; without walls: what leaves this box is taken out
export(Vector3) var domain_max = Vector3(1, 1, 1) # [m]
export(float) var domain_friction = 0.0
export(float) var ball_size = 0.7 # of the balls that are drawn [cells]

var native
var _parts = []
var _materials = {}
var _balls


func _enter_tree():
	add_to_group("pbmpm_world")


func _ready():
	var made = Native.new()
	if not made:
		push_error("pbmpm: the library is missing: addons/pbmpm/bin should hold it")
		return
	var fields = {
		"cell_size": cell_size, "particle_capacity": particle_capacity, "gravity": gravity, "dt": 1.0 / rate, "most_steps": most_steps, "substeps": substeps,
		"iterations": iterations, "solver": solver, "background": background, "thread_count": thread_count, "domain_enabled": closed,
		"domain_min": domain_min, "domain_max": domain_max, "domain_friction": domain_friction,
	}
	if not made.create(fields):
		return # Godot has told why
	native = made
	if not closed:
		native.set_kill_bounds(domain_min, domain_max)
	_make_balls()
	var parts = []
	for part in get_tree().get_nodes_in_group("pbmpm_part"):
		if part.world() == self:
			parts.append(part)
	parts.sort_custom(self, "_is_before")
	for part in parts:
		add(part)


func _is_before(a, b):
	return a.order < b.order


func add(part):
	if not part in _parts:
		_parts.append(part)
		part.begin(self)


func forget(part):
	if part in _parts:
		_parts.erase(part)
		part.end(self)


# The library's identifier of a material.gd, which the world gets to know with its first use.
func material_id(material):
	if not material:
		push_error("pbmpm: a part has no material")
		return 0
	if not _materials.has(material):
		_materials[material] = native.add_material(material.fields())
	return _materials[material]


func figures():
	return native.figures() if native else {}


func advice():
	return native.advice() if native else ""


func _physics_process(delta):
	if not native:
		return
	for part in _parts:
		part.before_frame(self, delta)
	native.frame(delta)
	for part in _parts:
		part.after_frame(self)


func _process(_delta):
	if not native:
		return
	_balls.multimesh.set_as_bulk_array(native.draw(ball_size * cell_size))
	_balls.multimesh.visible_instance_count = native.drawn()


func _make_balls():
	var surface = SpatialMaterial.new()
	surface.vertex_color_use_as_albedo = true
	surface.vertex_color_is_srgb = true
	surface.roughness = 0.4
	var ball = SphereMesh.new()
	ball.radius = 0.5
	ball.height = 1.0
	ball.radial_segments = 8
	ball.rings = 4
	ball.material = surface
	_balls = MultiMeshInstance.new()
	_balls.multimesh = MultiMesh.new()
	_balls.multimesh.transform_format = MultiMesh.TRANSFORM_3D
	_balls.multimesh.color_format = MultiMesh.COLOR_FLOAT
	_balls.multimesh.mesh = ball
	_balls.multimesh.instance_count = particle_capacity
	_balls.multimesh.visible_instance_count = 0
	_balls.set_custom_aabb(AABB(domain_min, domain_max - domain_min))
	add_child(_balls)
