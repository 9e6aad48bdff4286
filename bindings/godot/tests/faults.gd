# What the native class refuses, and how it says so. Prints a line for each call that did not do as it should, and how many calls there were.
extends SceneTree

const Native = preload("res://addons/pbmpm/native.gdns")

var _calls = 0


func _init():
	var native = Native.new()
	_refuses("fill before create", native.fill({}))
	_refuses("an unknown field", native.create({"cell_sise": 0.1}))
	_refuses("a text for a number", native.create({"cell_size": "0.1"}))
	_refuses("an unknown word", native.create({"solver": "best"}))
	_refuses("a value out of range", native.create({"cell_size": -1.0}))
	_refuses("a step without length", native.create({"dt": 0.0}))
	_takes("a world", native.create({"cell_size": 0.1, "particle_capacity": 100, "domain_enabled": true}))
	_refuses("an unknown material", native.fill({"material": 7, "shape": "box"}))
	var water = native.add_material({"kind": "liquid"})
	_takes("a material", water)
	_refuses("more than there is room for", native.fill({"material": water, "shape": "box"}))
	_takes("a fill", native.fill({"material": water, "shape": "sphere", "position": Vector3(0.5, 0.5, 0.5), "radius": 0.1}))
	_refuses("a mesh that is open", native.bake_mesh(PoolVector3Array([Vector3(), Vector3(1, 0, 0), Vector3(0, 1, 0)]), 16))
	_refuses("rows that are not full", native.bake_heights(PoolRealArray([0, 0, 0, 0, 0]), 2, 1.0, 1.0))
	_refuses("a body that there is not", native.take_push(3))
	_refuses("a force that there is not", native.set_force(3, {"enabled": false}))
	_takes("a frame", native.frame(1.0 / 60))
	_takes("figures", native.figures())
	# Once more: the world before is gone.
	_takes("another world", native.create({"cell_size": 0.1, "particle_capacity": 100}))
	_refuses("a material of the world before", native.fill({"material": water, "shape": "box", "half_extents": Vector3(0.1, 0.1, 0.1)}))
	print("Faults: as expected, %d calls" % _calls)
	quit()


func _refuses(what, answer):
	_calls += 1
	if answer != null:
		print("Faults: FAILED: %s is not refused" % what)


func _takes(what, answer):
	_calls += 1
	if answer == null:
		print("Faults: FAILED: %s is refused" % what)
