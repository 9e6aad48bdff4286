"""Forces against their formulas, on clouds of particles that do not touch each other."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import pbmpm
from pbmpm import Falloff, ForceKind, Solver

DX = 0.05
SOLVERS = [Solver.PAPER, Solver.DUAL, Solver.PRIMAL, Solver.EXPLICIT]


def cloud(dimension: int, count: int, spread: float = 1.0, **settings: object) -> tuple[pbmpm.World, np.ndarray]:
    """A world with single particles at least five cells apart, so that no node is shared; and their identifiers. Soft elastic ones: no pressure
    moves them, and sound travels less than a cell per step, as the explicit solver needs."""
    world = pbmpm.World(dimension, DX, capacity=256, **settings)
    matter = world.add_material(pbmpm.Elastic(relaxation=1.0, young_modulus=0.01))
    rng = np.random.default_rng(7)
    places: list[np.ndarray] = []
    while len(places) < count:
        place = rng.uniform(-spread, spread, dimension)
        if np.linalg.norm(place) > 0.4 and all(np.abs(place - other).max() > 5 * DX for other in places):
            places.append(place)
    return world, world.add_particles(matter, places, rng.uniform(-1, 1, (count, dimension)))


def state(world: pbmpm.World, ids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    rows = world.find(ids)
    return world.positions.copy()[rows].astype(float), world.velocities.copy()[rows].astype(float)


def solve(acceleration: Callable[[np.ndarray], np.ndarray], x: np.ndarray, v: np.ndarray, time: float) -> np.ndarray:
    """Positions after x'' = acceleration(x), by the classical Runge-Kutta method in steps so small that they do not show."""
    count = 400
    h = time / count

    def rate(y: np.ndarray) -> np.ndarray:
        return np.stack([y[1], acceleration(y[0])])

    y = np.stack([x, v])
    for _ in range(count):
        a = rate(y)
        b = rate(y + h / 2 * a)
        c = rate(y + h / 2 * b)
        d = rate(y + h * c)
        y = y + h / 6 * (a + 2 * b + 2 * c + d)
    result: np.ndarray = y[0]
    return result


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("dimension", [2, 3])
def test_uniform_force_is_gravity_bit_for_bit(dimension: int, solver: Solver) -> None:
    """The same float is added to the same node, whether it is called gravity or a force."""
    pull = [0.5, -9.75, 0.25][:dimension]
    hashes = []
    for forced in (False, True):
        world, _ = cloud(dimension, 20, solver=solver, gravity=None if forced else pull)
        for axis in range(dimension if forced else 0):
            world.add_force(ForceKind.UNIFORM, pull[axis], direction=np.eye(dimension)[axis])
        for _ in range(50):
            world.step(1 / 128)
        hashes.append(world.hash())
        world.close()
    assert hashes[0] == hashes[1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_uniform_force_accelerates_exactly(solver: Solver) -> None:
    """v = v0 + a t to the rounding of floats: each step errs by half a unit in the last place of about 2 m/s."""
    with cloud(3, 20, solver=solver)[0] as world:
        ids = world.ids.copy()
        _, v0 = state(world, ids)
        world.add_force(ForceKind.UNIFORM, 2.0, direction=(0, 0, 3))
        steps = 64
        for _ in range(steps):
            world.step(1 / 64)
        _, v1 = state(world, ids)
        assert np.abs(v1 - v0 - [0, 0, 2.0]).max() < 3 * steps * 2**-23


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("kind", [ForceKind.RADIAL, ForceKind.VORTEX])
@pytest.mark.parametrize("dimension", [2, 3])
def test_radial_and_vortex_follow_their_equation(dimension: int, kind: ForceKind, solver: Solver) -> None:
    """Against x'' = a(x). The mean of a direction field over a particle's nodes is off by dx^2 / (8 r^2) < 2e-3 of it for r > 0.4, and the
    semi-implicit Euler steps by dt T |a| / 2 and by what v changes: 1e-3 m in all after half a second at 1 m/s^2."""
    world, ids = cloud(dimension, 20, solver=solver)
    x0, v0 = state(world, ids)
    v0 = v0 * 0.2
    world.set(pbmpm.Field.VELOCITY, v0, ids)
    x0, v0 = state(world, ids)
    world.add_force(kind, 1.0, direction=[0, 0, 1][:dimension] if dimension == 3 else None)

    def acceleration(x: np.ndarray) -> np.ndarray:
        way = x.copy()
        if kind is ForceKind.VORTEX:
            way[:, 0], way[:, 1] = -x[:, 1], x[:, 0]
            way[:, 2:] = 0
        length = np.linalg.norm(way, axis=1, keepdims=True)
        return way / np.maximum(length, DX)

    for _ in range(500):
        world.step(1e-3)
    x1, _ = state(world, ids)
    moved = np.linalg.norm(x1 - (x0 + 0.5 * v0), axis=1)
    assert moved.min() > 0.08  # 1/2 a t^2 = 0.125: the force was felt
    assert np.abs(x1 - solve(acceleration, x0, v0, 0.5)).max() < 1e-3
    world.close()


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("steps", [1, 10, 100])
def test_drag_is_exponential_at_any_step(steps: int, solver: Solver) -> None:
    """v = w + (v0 - w) exp(-k t), however t is cut: no error but rounding, of every step."""
    world, ids = cloud(3, 20, solver=solver)
    _, v0 = state(world, ids)
    wind = np.array([0.5, -0.25, 0.125])
    world.add_force(ForceKind.DRAG, 3.0, velocity=wind)
    for _ in range(steps):
        world.step(0.5 / steps)
    _, v1 = state(world, ids)
    assert np.abs(v1 - (wind + (v0 - wind) * np.exp(-1.5))).max() < (steps + 4) * 2**-22
    world.close()


@pytest.mark.parametrize("coefficient", [1e-3, 1.0, 1e3, 1e9])
@pytest.mark.parametrize("dt", [1e-4, 1 / 60, 0.25])
def test_drag_is_stable_and_ends_at_its_terminal_velocity(coefficient: float, dt: float) -> None:
    """After one step v lies between v0 and w + g / k; and one that falls at w + g / k goes on doing so."""
    world, ids = cloud(2, 12, gravity=(0, -2.0))
    terminal = np.array([0.25, -2.0 / coefficient if coefficient >= 1 else -2.0])
    wind = terminal - [0, -2.0 / coefficient]
    world.set(pbmpm.Field.VELOCITY, np.tile(terminal, (12, 1)), ids)
    world.add_force(ForceKind.DRAG, coefficient, velocity=wind)
    for _ in range(20):
        world.step(dt)
    _, v = state(world, ids)
    assert np.abs(v - terminal).max() < 1e-5 * (1 + np.abs(wind).max())
    world.close()


@pytest.mark.parametrize("solver", SOLVERS)
def test_grab_gives_its_velocity_and_spin(solver: Solver) -> None:
    """w = velocity + spin times (axis cross r), at once and against gravity. It is linear in x, so the transfers do not change it."""
    world, ids = cloud(3, 20, solver=solver, gravity=(0, -9.81, 0))
    world.add_force(
        ForceKind.GRAB, shape=pbmpm.Sphere((0.1, 0, 0), 3.0), velocity=(0.5, 0.25, 0), spin=2.0, direction=(0, 0, 1)
    )
    x0, _ = state(world, ids)
    world.step(1 / 240)
    _, v = state(world, ids)
    r = x0 - [0.1, 0, 0]
    wanted = np.array([0.5, 0.25, 0]) + 2.0 * np.stack([-r[:, 1], r[:, 0], 0 * r[:, 0]], axis=1)
    assert np.abs(v - wanted).max() < 2e-5
    world.close()


@pytest.mark.parametrize(
    ("falloff", "share"),
    [
        (Falloff.NONE, lambda d: float(d <= 0.6 + DX / 2)),
        (Falloff.LINEAR, lambda d: max(0.0, 1 - d / 0.6)),
        (Falloff.SMOOTH, lambda d: max(0.0, 1 - (d / 0.6) ** 2) ** 2),
        (Falloff.INVERSE_SQUARE, lambda d: (1 + d / 0.6) ** -2),
    ],
)
def test_falloff(falloff: Falloff, share: Callable[[float], float]) -> None:
    """Particles on nodes above a half space, which feel the mean over three layers of nodes with the weights 1/8, 3/4, 1/8. Nodes stand at the
    edge of NONE, so its range is half a cell longer."""
    with pbmpm.World(2, DX, capacity=64, solver=Solver.PAPER) as world:
        matter = world.add_material(pbmpm.Elastic())
        distances = [-0.5, 0.25, 0.5, 1.0]
        ids = world.add_particles(matter, [(0.0, d) for d in distances])
        ground = pbmpm.Plane((0, 0), (0, 1))
        reach = 0.6 + DX / 2 if falloff is Falloff.NONE else 0.6
        world.add_force(ForceKind.UNIFORM, 1.0, shape=ground, falloff=falloff, range=reach, direction=(1, 0))
        world.step(0.01)
        _, v = state(world, ids)
        layers = [(d + shift * DX, weight) for d in distances for shift, weight in ((-1, 1 / 8), (0, 3 / 4), (1, 1 / 8))]
        felt = np.reshape([weight * (1.0 if d <= 1e-9 else share(d)) for d, weight in layers], (-1, 3)).sum(axis=1)
        assert np.abs(v[:, 0] / 0.01 - felt).max() < 1e-5


def test_only_blocks_in_range_are_touched() -> None:
    """Matter that a force does not reach moves bit for bit as without it, and the nodes that felt it are those in its ball."""
    near, far = (0.0, 0.0), (4.0, 0.0)
    hashes = []
    for forced in (False, True):
        with pbmpm.World(2, DX, capacity=1000) as world:
            matter = world.add_material(pbmpm.Liquid())
            world.fill(pbmpm.Box(far, (0.3, 0.3)), matter, velocity=(0, 1))
            if forced:
                force = world.add_force(ForceKind.RADIAL, 5.0, shape=pbmpm.Sphere(near, 1.0), falloff=Falloff.SMOOTH, range=2.0)
            for _ in range(20):
                world.step(1 / 100)
            hashes.append(world.hash())
            if forced:
                assert force.nodes == 0
                assert force.impulse == (0.0, 0.0)
    assert hashes[0] == hashes[1]


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("flip", [0.0, 0.9])
def test_impulses_are_the_change_of_momentum(solver: Solver, flip: float) -> None:
    """Sum of the impulses and of gravity's m g dt against the momentum of a free cloud of liquid: pressures are internal. Sums of floats: 1e-5 of
    what is moved. With 40 iterations the primal solver converges; before, what it leaves of the gradient is a change of momentum."""
    gravity = np.array([0.5, -9.81, 0.25])
    with pbmpm.World(3, DX, capacity=20000, gravity=gravity, solver=solver, flip=flip, substeps=3, iterations=40) as world:
        matter = world.add_material(pbmpm.Liquid(bulk_modulus=1e4, volume_feedback=0.0))
        world.fill(pbmpm.Sphere((0, 0, 0), 0.3), matter, velocity=(1, 2, 3))
        ball = pbmpm.Sphere((0.1, 0.2, 0), 0.2)
        forces = [
            world.add_force(ForceKind.UNIFORM, 3.0, direction=(1, 1, 0)),
            world.add_force(ForceKind.RADIAL, -8.0, shape=ball, falloff=Falloff.LINEAR, range=0.3),
            world.add_force(ForceKind.VORTEX, 5.0, shape=ball, falloff=Falloff.INVERSE_SQUARE, range=0.3),
            world.add_force(ForceKind.DRAG, 4.0, velocity=(0, 1, 0), shape=ball, falloff=Falloff.SMOOTH, range=0.3),
            world.add_force(ForceKind.DRAG, 40.0, spin=3.0, shape=ball),
        ]
        off = world.add_force(ForceKind.UNIFORM, 100.0, enabled=False)
        mass, dt = world.stats.mass, 1 / 120
        for _ in range(5):
            before = np.array(world.stats.momentum)
            world.step(dt)
            gained = np.array(world.stats.momentum) - before - mass * gravity * dt
            told = sum(np.array(force.impulse) for force in forces)
            moved = sum(np.abs(force.impulse).sum() for force in forces) + np.abs(before).sum()
            assert np.abs(gained - told).max() < 1e-5 * moved
        assert all(force.nodes > 0 for force in forces[:1])
        assert off.impulse == (0.0, 0.0, 0.0)


def test_same_result_for_any_number_of_threads() -> None:
    results = []
    for threads in (1, 3):
        with pbmpm.World(2, DX, capacity=20000, threads=threads) as world:
            matter = world.add_material(pbmpm.Liquid())
            world.fill(pbmpm.Box((0, 0), (1.2, 1.2)), matter)
            force = world.add_force(ForceKind.VORTEX, 3.0, shape=pbmpm.Sphere((0, 0), 0.4), falloff=Falloff.SMOOTH, range=0.8)
            brake = world.add_force(ForceKind.DRAG, 1.0)
            for _ in range(30):
                world.step(1 / 120)
            results.append((world.hash(), force.impulse, brake.impulse))
    assert results[0] == results[1]


def test_change_and_destroy() -> None:
    world, ids = cloud(2, 12)
    force = world.add_force(ForceKind.UNIFORM, 2.0, direction=(1, 0))
    force.change(kind=ForceKind.DRAG, strength=1e9)
    world.step(0.01)
    assert np.abs(world.velocities.copy()).max() < 1e-6
    assert (force.kind, force.strength, force.enabled) == (ForceKind.DRAG, 1e9, True)
    force.enabled = False
    assert not force.enabled
    force.destroy()
    with pytest.raises(pbmpm.InvalidIdError):
        force.impulse  # noqa: B018
    with pytest.raises(TypeError, match="no 'colour'"):
        world.add_force(ForceKind.DRAG).change(colour=1)
    world.close()


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"kind": ForceKind.DRAG, "strength": -1.0}, "strength"),
        ({"kind": ForceKind.UNIFORM, "strength": float("nan")}, "strength"),
        ({"kind": ForceKind.UNIFORM, "direction": (0, 0)}, "direction"),
        ({"kind": ForceKind.RADIAL, "falloff": Falloff.INVERSE_SQUARE}, "range"),
        ({"kind": ForceKind.RADIAL, "range": -1.0}, "range"),
        ({"kind": ForceKind.GRAB, "velocity": (float("inf"), 0)}, "velocity"),
        ({"kind": ForceKind.GRAB, "spin": 1e7}, "spin"),
        ({"kind": ForceKind.GRAB, "shape": pbmpm.Sphere((0, 0), -1)}, "radius"),
    ],
)
def test_bad_values_are_refused(values: dict[str, object], message: str) -> None:
    with pbmpm.World(2, DX) as world, pytest.raises(pbmpm.InvalidArgumentError, match=message):
        world.add_force(**values)  # type: ignore[arg-type]
