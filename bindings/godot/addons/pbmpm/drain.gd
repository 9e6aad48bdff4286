# Takes matter out.
extends "res://addons/pbmpm/part.gd"


func _init():
	order = 2


func begin(world):
	id = world.native.add_drain(shape_fields(world))
