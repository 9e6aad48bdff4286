"""What engines ask of a world: lists of what there is, changing obstacles and walls, user values, the origin, lines to draw."""

from __future__ import annotations

import numpy as np
import pytest

import pbmpm


def tank(**named) -> pbmpm.World:
    """A box of 1 m, half full of water."""
    world = pbmpm.World(2, 0.05, gravity=(0, -9.81), domain=((0, 0), (1, 1)), capacity=4000, **named)
    world.fill(pbmpm.Box((0.5, 0.25), (0.5, 0.25)), world.add_material(pbmpm.Liquid()))
    return world


def run(world: pbmpm.World, steps: int) -> None:
    for _ in range(steps):
        world.step(1 / 60)


def test_lists_hold_what_is_there() -> None:
    world = tank()
    water = world.materials[0]
    ball = pbmpm.Sphere((0.5, 0.5), 0.1)
    first, second = world.add_collider(ball), world.add_collider(ball, key=7)
    emitter = world.add_emitter(ball, water, 0.0)
    drain = world.add_drain(ball, enabled=False)
    force = world.add_force(pbmpm.ForceKind.UNIFORM, 1.0, shape=ball)
    assert [item.identity for item in world.colliders] == [first.identity, second.identity]
    assert world.materials[0].index == water.index
    assert [item.key for item in world.colliders] == [0, 7]
    assert len(world.materials) == len(world.emitters) == len(world.drains) == len(world.forces) == 1
    first.destroy()
    assert [item.key for item in world.colliders] == [7]
    assert not first.valid
    assert all(item.valid for item in (water, second, emitter, drain, force))
    world.close()
    assert not second.valid


def test_a_collider_changes_in_place() -> None:
    world = tank()
    gate = world.add_collider(pbmpm.Box((0.5, 0.5), (0.05, 0.6)))
    world.remove_in(pbmpm.Box((0.76, 0.3), (0.26, 0.4)))
    run(world, 30)
    assert np.asarray(world.positions)[:, 0].max() < 0.52
    gate.change(shape=pbmpm.Box((0.5, 5.0), (0.05, 0.6)), friction=pbmpm.Friction.SLIP, measures_impulse=True)
    run(world, 30)
    assert np.asarray(world.positions)[:, 0].max() > 0.9
    assert gate.friction is pbmpm.Friction.SLIP
    assert tuple(gate.shape.position) == (0.5, 5.0)
    assert gate.impulse.linear == (0.0, 0.0)
    with pytest.raises(pbmpm.InvalidArgumentError):
        gate.change(friction_coefficient=-1.0)


def test_what_was_given_at_creation_can_be_assigned_later() -> None:
    world = tank()
    ball = pbmpm.Sphere((0.5, 0.5), 0.1)
    oil = world.add_material(pbmpm.Liquid(density=800, groups=2))
    force = world.add_force("uniform", 1.0)
    emitter = world.add_emitter(ball, world.materials[0], 1.0)
    drain = world.add_drain(ball)
    gate = world.add_collider(ball)
    for thing, name, value in [
        (force, "kind", pbmpm.ForceKind.DRAG),
        (force, "strength", 2.5),
        (force, "everywhere", False),
        (force, "falloff", pbmpm.Falloff.SMOOTH),
        (force, "range", 0.5),
        (force, "direction", (1.0, 0.0)),
        (force, "velocity", (0.5, -0.5)),
        (force, "spin", 0.25),
        (force, "enabled", False),
        (emitter, "rate", 2.0),
        (emitter, "region", pbmpm.Region.DISC),
        (emitter, "speed", 3.0),
        (emitter, "direction", (0.0, 1.0)),
        (emitter, "spread", 0.5),
        (emitter, "particles_per_axis", 3.0),
        (emitter, "fill_limit", 1.25),
        (emitter, "budget", 7),
        (emitter, "seed", 9),
        (emitter, "user_value", 11),
        (gate, "friction", pbmpm.Friction.SLIP),
        (gate, "friction_coefficient", 0.5),
        (gate, "kinematic", True),
        (gate, "measures_impulse", True),
        (gate, "measures_impulse", False),
        (gate, "sensor", True),
        (gate, "reports_touches", True),
        (gate, "meets", 2),
    ]:
        assert getattr(thing, name) != value
        setattr(thing, name, value)
        assert getattr(thing, name) == value, name
    force.kind, gate.friction = "vortex", "stick"
    assert (force.kind, gate.friction) == (pbmpm.ForceKind.VORTEX, pbmpm.Friction.STICK)
    gate.shape = pbmpm.Box((0.5, 0.5), (0.1, 0.1))
    assert isinstance(gate.shape, pbmpm.Box) and gate.friction is pbmpm.Friction.STICK
    emitter.material = drain.material = oil
    assert emitter.material.index == drain.material.index == oil.index
    drain.material = None
    assert drain.material is None
    gate.meets = oil
    assert gate.meets == 2
    for thing, name in ((force, "strength"), (force, "enabled"), (emitter, "rate"), (gate, "kinematic")):
        with pytest.raises(TypeError, match=name):
            setattr(thing, name, None)
    with pytest.raises(pbmpm.InvalidArgumentError, match="strength"):
        force.kind, force.strength = "drag", -1.0


@pytest.mark.parametrize("name", ["material", "collider", "emitter", "drain", "force"])
def test_a_message_tells_what_became_of_a_thing(name: str) -> None:
    from pbmpm._library import ffi

    world, ball = tank(), pbmpm.Sphere((0.5, 0.5), 0.1)
    made = {
        "material": lambda: world.add_material(pbmpm.Liquid()),
        "collider": lambda: world.add_collider(ball),
        "emitter": lambda: world.add_emitter(ball, world.materials[0], 1.0),
        "drain": lambda: world.add_drain(ball),
        "force": lambda: world.add_force("uniform"),
    }[name]
    first = made()
    first.destroy()
    made()  # in the same place
    with pytest.raises(pbmpm.InvalidIdError, match=f"this {name} was destroyed$"):
        first.key
    for generation, what in ((0, "is null"), (0xFFFFFFFF, "never existed: its identifier is made up")):
        first._id = ffi.new(f"pbmpm_{name}_id *", (first._id.index, generation))[0]
        with pytest.raises(pbmpm.InvalidIdError, match=f"this {name} {what}$"):
            first.key


def test_a_fill_with_a_material_that_is_gone_says_so() -> None:
    world, other = tank(), tank()
    ball, oil = pbmpm.Sphere((0.5, 0.5), 0.1), world.add_material(pbmpm.Liquid())
    with pytest.raises(pbmpm.InvalidIdError, match="fill.material is of another world, or was destroyed long ago"):
        other.fill(ball, oil)
    oil.destroy()
    with pytest.raises(pbmpm.InvalidIdError, match="fill.material was destroyed$"):
        world.fill(ball, oil)
    with pytest.raises(pbmpm.InvalidIdError, match="emitter.material was destroyed$"):
        world.add_emitter(ball, oil, 1.0)
    with pytest.raises(pbmpm.InvalidIdError, match="drain.material was destroyed$"):
        world.add_drain(ball, material=oil)
    with pytest.raises(pbmpm.InvalidIdError, match="particles.material was destroyed$"):
        world.add_particles(oil, [(0.5, 0.9)])


def test_particles_that_are_gone_are_told_from_those_that_never_were() -> None:
    world = tank()
    ids = np.asarray(world.ids)[:3].copy()
    world.remove(ids[:1])
    with pytest.raises(pbmpm.InvalidIdError, match="particle 0 of the list is gone, or of another world"):
        world.find(ids)
    ids[0] = (0, 0xFFFFFFFF)
    with pytest.raises(pbmpm.InvalidIdError, match="particle 0 of the list never existed"):
        world.find(ids)


def test_walls_open_and_have_friction() -> None:
    world = tank()
    assert world.wall(0, upper=True) == pbmpm.Wall(False, pbmpm.Friction.COULOMB, 0.0)
    world.set_wall(0, upper=True, open=True)
    world.set_wall(1, friction=pbmpm.Friction.STICK, friction_coefficient=0.5)
    assert world.wall(0, upper=True).open
    assert world.wall(1) == pbmpm.Wall(False, pbmpm.Friction.STICK, 0.5)
    run(world, 30)
    assert np.asarray(world.positions)[:, 0].max() > 1.2
    with pytest.raises(pbmpm.InvalidArgumentError, match="no such wall"):
        world.set_wall(2, open=True)


def test_the_origin_moves_under_the_matter() -> None:
    world = tank()
    before = np.array(world.positions)
    moved = world.shift_origin((100.0, -0.05))
    assert moved == pytest.approx((100.0, 0.0))  # cells of 0.05 m are not exact
    assert world.origin == moved
    assert np.abs(np.asarray(world.positions) - (before - (100.0, 0.0))).max() < 1e-5
    assert world.domain == ((-100.0, 0.0), (-99.0, 1.0))


def test_user_values_go_with_the_particles() -> None:
    world = tank()
    with pytest.raises(pbmpm.UnsupportedError):
        _ = world.user_values
    ids = world.add_particles(world.materials[0], [(0.3, 0.8), (0.7, 0.8)], user_values=[3, 0xFFFFFFFF])
    count = world.fill(pbmpm.Box((0.5, 0.8), (0.05, 0.05)), world.materials[0], user_value=11)
    run(world, 30)
    values = np.asarray(world.user_values)
    assert values.dtype == np.uint32
    assert list(values[world.find(ids)]) == [3, 0xFFFFFFFF]
    assert np.count_nonzero(values == 11) == count
    world.set(pbmpm.Field.USER_VALUE, [8], ids[:1])
    assert np.asarray(world.user_values)[world.find(ids)[0]] == 8
    world.user_values = np.arange(len(world))
    assert list(np.asarray(world.user_values)) == list(range(len(world)))
    for wrong in ([1.5, 2.0], [-1, 2], [1]):
        with pytest.raises(pbmpm.InvalidArgumentError, match="user_value"):
            world.set(pbmpm.Field.USER_VALUE, wrong, ids)


def test_emitters_give_user_values() -> None:
    world = pbmpm.World(2, 0.05, capacity=1000)
    water = world.add_material(pbmpm.Liquid())
    emitter = world.add_emitter(pbmpm.Box((0, 0), (0.2, 0.2)), water, 0.5, user_value=21)
    run(world, 10)
    assert len(world) > 0
    assert set(np.asarray(world.user_values)) == {21}
    emitter.change(user_value=22)
    run(world, 10)
    assert set(np.asarray(world.user_values)) == {21, 22}


def test_a_sensor_tells_who_comes_and_goes() -> None:
    world = pbmpm.World(2, 0.1, capacity=1000)
    jelly = world.add_material(pbmpm.Elastic())
    world.fill(pbmpm.Box((0, 0), (0.2, 0.2)), jelly, velocity=(1, 0))
    gate = world.add_collider(pbmpm.Box((1, 0), (0.1, 1)), sensor=True, reports_touches=True)
    states = []
    for _ in range(90):
        world.step(1 / 60)
        for touch in world.touches():
            assert touch.collider.identity == gate.identity
            assert touch.material is not None and touch.material.index == jelly.index
            assert touch.impulse == (0.0, 0.0)
            states.append(touch.state)
    assert states[0] is pbmpm.TouchState.BEGAN
    assert states[-1] is pbmpm.TouchState.ENDED
    assert set(states[1:-1]) == {pbmpm.TouchState.STAYS}
    with pytest.raises(pbmpm.InvalidArgumentError, match="sensor"):
        gate.change(measures_impulse=True)


def test_lines_show_what_is_there() -> None:
    world = tank()
    world.add_collider(pbmpm.Sphere((0.5, 0.7), 0.1))
    run(world, 1)
    ends, parts = world.debug_lines()
    assert ends.shape == (len(parts), 2, 2)
    ball = ends[parts == pbmpm.DebugPart.COLLIDERS.value]
    assert np.abs(np.linalg.norm(ball - (0.5, 0.7), axis=2) - 0.1).max() < 1e-6
    walls, _ = world.debug_lines(pbmpm.DebugPart.DOMAIN)
    assert len(walls) == 4
    assert len(world.debug_lines("domain", "colliders")[0]) == 4 + len(ball)
    assert len(world.debug_lines(pbmpm.DebugPart.BLOCKS)[0]) >= 4
    empty, none = pbmpm.World(3, 0.1).debug_lines()
    assert empty.shape == (0, 2, 3) and none.shape == (0,)


def test_an_obstacle_meets_the_groups_that_it_is_told() -> None:
    world = pbmpm.World(2, 0.1, capacity=1000, gravity=(0, -9.81))
    water = world.add_material(pbmpm.Liquid(groups=2))
    world.fill(pbmpm.Box((0, 0.5), (0.3, 0.3)), water)
    grate = world.add_collider(pbmpm.Box((0, -0.5), (2, 0.2)), meets=1)
    assert (grate.meets, water.parameters.groups) == (1, 2)
    run(world, 60)
    assert np.asarray(world.positions)[:, 1].max() < -0.7
    grate.change(meets=0)
    assert grate.meets == 0
    for wrong in (-1, 2**32, 1.5):
        with pytest.raises((pbmpm.InvalidArgumentError, TypeError, OverflowError)):
            grate.change(meets=wrong)
        with pytest.raises((pbmpm.InvalidArgumentError, TypeError, OverflowError)):
            world.add_material(pbmpm.Liquid(groups=wrong))
    with pytest.raises(pbmpm.InvalidArgumentError, match="groups"):
        world.add_material(pbmpm.Liquid(groups=0))


def test_an_obstacle_meets_materials() -> None:
    world = pbmpm.World(2, 0.1, capacity=1000)
    water, oil, sand = (world.add_material(pbmpm.Liquid(groups=groups)) for groups in (1, 2, 6))
    shape = pbmpm.Box((0, 0), (1, 1))
    assert world.add_collider(shape, meets=water).meets == 1
    wall = world.add_collider(shape, meets=[water, oil, sand])
    assert wall.meets == 7
    wall.change(meets=(oil, sand))
    assert wall.meets == 6
    for meets in (oil, [water, sand]):  # oil has a group of sand
        with pytest.raises(pbmpm.InvalidArgumentError, match="same groups"):
            world.add_collider(shape, meets=meets)
    with pytest.raises(pbmpm.InvalidArgumentError, match="at least one"):
        wall.change(meets=[])
    assert wall.meets == 6
