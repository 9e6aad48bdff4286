"""What looks right and would do nothing, or the wrong thing, is refused with a message that helps."""

from __future__ import annotations

import copy
import enum
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pbmpm

CLASSES = [item for item in vars(pbmpm).values() if isinstance(item, type)]
ENUMERATIONS = [item for item in CLASSES if issubclass(item, enum.Enum)]
OBJECTS = [item for item in CLASSES if not issubclass(item, (enum.Enum, Exception))]


# Attributes that do not exist


@pytest.mark.parametrize("kind", OBJECTS, ids=lambda kind: kind.__name__)
def test_no_class_takes_an_attribute_that_it_does_not_have(kind: type) -> None:
    with pytest.raises(AttributeError, match="nonsense"):
        setattr(kind.__new__(kind), "nonsense", 1)


def test_a_misspelt_attribute_is_refused_with_the_nearest_one(pool: pbmpm.World, water: pbmpm.Material) -> None:
    ball = pbmpm.Sphere([1.0] * pool.dimension, 0.1)
    with pytest.raises(AttributeError, match="World has no attribute 'gravtiy'; did you mean 'gravity'"):
        pool.gravtiy = (0, 0, 0)
    with pytest.raises(AttributeError, match="Material has no attribute 'paramaters'; did you mean 'parameters'"):
        water.paramaters = pbmpm.Liquid()
    with pytest.raises(AttributeError, match="Emitter has no attribute 'enable'; did you mean 'enabled'"):
        pool.add_emitter(ball, water, 1.0).enable = False
    with pytest.raises(TypeError, match="this force has no 'strenght' to set; did you mean 'strength'"):
        pool.add_force(pbmpm.ForceKind.UNIFORM).change(strenght=2)
    with pytest.raises(AttributeError, match="World has no attribute 'zzz'$"):
        pool.zzz = 1


def test_what_has_no_setter_stays(world: pbmpm.World) -> None:
    for name in ("cell_size", "step", "stats"):
        with pytest.raises(AttributeError, match=name):
            setattr(world, name, 1)


class Level(pbmpm.World):
    score = 0


def test_a_subclass_declares_what_it_keeps() -> None:
    with Level(2, 0.1, capacity=1) as level:
        level.score = 3
        with pytest.raises(AttributeError, match="Level has no attribute 'scroe'; did you mean 'score'"):
            level.scroe = 4
        assert level.score == 3 and Level.score == 0


# Copies

COPIES: list[Callable[[Any], Any]] = [copy.copy, copy.deepcopy, lambda it: pickle.loads(pickle.dumps(it))]
each_copy = pytest.mark.parametrize("make_copy", COPIES, ids=["copy", "deepcopy", "pickle"])


@each_copy
def test_what_a_world_owns_cannot_be_copied(
    pool: pbmpm.World, water: pbmpm.Material, make_copy: Callable[[Any], Any], capfd: pytest.CaptureFixture[str]
) -> None:
    ball = pbmpm.Sphere([1.0] * pool.dimension, 0.1)
    before = pool.hash()
    for owned, instead in [
        (pool, r"snapshot\(\)"),
        (pool._handle, r"snapshot\(\)"),
        (pool.positions, r"copy\(\)"),
        (water, r"add_material\(\)"),
        (pool.add_collider(ball), r"snapshot\(\)"),
        (pool.add_emitter(ball, water, 1.0), r"snapshot\(\)"),
        (pool.add_drain(ball), r"snapshot\(\)"),
        (pool.add_force("uniform"), r"snapshot\(\)"),
        (pool.load_solid(hull(pool.dimension)), r"load_solid\(\)"),
    ]:
        with pytest.raises(TypeError, match=f"{type(owned).__name__} objects cannot be copied or pickled: .*{instead}"):
            make_copy(owned)
    assert pool.hash() == before
    assert capfd.readouterr() == ("", "")


def hull(dimension: int) -> pbmpm.BakedSolid:
    return pbmpm.bake_hull(np.vstack([np.zeros(dimension), np.eye(dimension)]), resolution=4)


@each_copy
def test_a_copy_of_a_baked_solid_is_one(world: pbmpm.World, make_copy: Callable[[Any], Any]) -> None:
    solid = hull(world.dimension)
    other = make_copy(solid)
    assert (other.data, other.info) == (solid.data, solid.info)
    world.load_solid(other)


def test_the_pickle_of_a_baked_solid_is_looked_at() -> None:
    with pytest.raises(pbmpm.DamagedError):
        pickle.loads(pickle.dumps(hull(2)).replace(hull(2).data[-64:], bytes(64)))


def test_a_baked_shape_with_its_arguments_swapped_says_so() -> None:
    with pbmpm.World(2, 0.1) as world:
        solid = world.load_solid(hull(2))
        with pytest.raises(TypeError, match=r"Baked\(position, solid\): .*load_solid\(\)"):
            world.add_collider(pbmpm.Baked(solid, (0.0, 0.0)))  # type: ignore[arg-type]
        with pytest.raises(TypeError, match="BakedSolid"):
            world.add_collider(pbmpm.Baked((0.0, 0.0), hull(2)))  # type: ignore[arg-type]


# Names of enumerations


@pytest.mark.parametrize("kind", ENUMERATIONS, ids=lambda kind: kind.__name__)
def test_every_enumeration_knows_its_names(kind: type[enum.Enum]) -> None:
    for member in kind:
        assert kind(member.name.lower()) is kind(member.name.title()) is kind(member.value) is member
    with pytest.raises(pbmpm.InvalidArgumentError) as caught:
        kind("nonsense")
    assert str(caught.value).startswith(f"'nonsense' is no {kind.__name__}; there are ")
    assert all(member.name.lower() in str(caught.value) for member in kind)


def test_names_do_where_members_do(pool: pbmpm.World, water: pbmpm.Material) -> None:
    ball = pbmpm.Sphere([0.3] * pool.dimension, 0.1)
    pool.solver, pool.pressure, pool.integrator = "primal", "Cells", "BDF2"
    assert (pool.solver, pool.pressure) == (pbmpm.Solver.PRIMAL, pbmpm.Pressure.CELLS)
    assert pool.integrator is pbmpm.Integrator.BDF2
    assert pool.add_collider(ball, friction="slip").friction is pbmpm.Friction.SLIP
    force = pool.add_force("radial", falloff="smooth", range=1)
    force.change(kind="vortex")
    assert force.kind is pbmpm.ForceKind.VORTEX
    pool.add_emitter(ball, water, 1.0, region="disc").change(region="volume")
    assert pool.view("velocity").field is pbmpm.Field.VELOCITY
    pool.set("velocity", np.ones((len(pool), pool.dimension)))
    pool.publish(["position", "mass"])
    jelly = pbmpm.Elastic(strain_policy="delete", elastic_model="neo_hookean")
    assert jelly == pbmpm.Elastic(
        strain_policy=pbmpm.StrainPolicy.DELETE, elastic_model=pbmpm.ElasticModel.NEO_HOOKEAN
    )
    assert pool.add_material(jelly).parameters == jelly


def test_a_world_is_made_with_names() -> None:
    with pbmpm.World(2, 0.1, capacity=1, solver="dual", pressure="cells", integrator="bdf2") as world:
        assert world.solver is pbmpm.Solver.DUAL
        assert world.pressure is pbmpm.Pressure.CELLS
        assert world.integrator is pbmpm.Integrator.BDF2


def test_a_member_of_another_enumeration_is_refused(world: pbmpm.World) -> None:
    solver = world.solver
    for wrong in (pbmpm.Pressure.CELLS, "duel", None, 4711):
        with pytest.raises(pbmpm.InvalidArgumentError, match="is no Solver; there are paper, dual, primal"):
            world.solver = wrong
    with pytest.raises(pbmpm.InvalidArgumentError, match="is no StrainPolicy; there are clamp, delete"):
        pbmpm.Sand(strain_policy=pbmpm.Solver.DUAL)
    with pytest.raises(TypeError, match="substeps"):
        world.substeps = pbmpm.Solver.PRIMAL
    assert world.solver is solver


# Numbers


@pytest.mark.parametrize("wrong, error", [(-1, ValueError), (1 << 64, ValueError), ("a", TypeError), (1.5, TypeError)])
def test_a_wrong_key_is_told_what_a_key_is(
    world: pbmpm.World, water: pbmpm.Material, wrong: Any, error: type[Exception]
) -> None:
    ball = pbmpm.Sphere([0.3] * world.dimension, 0.1)
    message = rf"key: a whole number in \[0, {2**64 - 1}\] is needed, not {wrong!r}"
    for add in (
        lambda: world.add_material(pbmpm.Liquid(), key=wrong),
        lambda: world.add_collider(ball, key=wrong),
        lambda: world.add_emitter(ball, water, 1.0, key=wrong),
        lambda: world.add_drain(ball, key=wrong),
        lambda: world.add_force("uniform", key=wrong),
    ):
        with pytest.raises(error, match=message):
            add()


def test_a_wrong_number_is_told_its_range(world: pbmpm.World) -> None:
    with pytest.raises(pbmpm.InvalidArgumentError, match=rf"substeps: a whole number in \[{-(2**31)}, {2**31 - 1}\]"):
        world.substeps = 1 << 40
    with pytest.raises(TypeError, match="flip: a number is needed, not 'much'"):
        world.flip = "much"


def test_none_is_no_value_of_a_setting(world: pbmpm.World) -> None:
    for name in ("gravity", "substeps", "flip"):
        with pytest.raises((TypeError, ValueError), match=name):
            setattr(world, name, None)


def test_what_is_no_part_of_a_world_may_be_copied(pool: pbmpm.World, water: pbmpm.Material) -> None:
    pool.step(1 / 60)
    for value in (pool.stats, pool.flow, water.parameters, water.effective(1 / 60), pbmpm.Sphere([1.0, 1.0], 0.1)):
        assert pickle.loads(pickle.dumps(value)) == value
