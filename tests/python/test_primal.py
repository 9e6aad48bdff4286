"""The primal solver: energy, frequencies, the price of truncation, BDF2, and the explicit solver beside it.

Energies are computed here in double precision from the particles' state.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import pbmpm
from pbmpm import Elastic, ElasticModel, Field, Integrator, Liquid, Solver

CELL = 1.0 / 32.0
DENSITY = 1000.0
YOUNG, POISSON = 1e6, 0.3
SHEAR = YOUNG / (2.0 * (1.0 + POISSON))
LAME = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
STRAIN_RANGE = (0.1, 20.0)  # the default bounds of the singular values of F

MODELS = {"FCR": ElasticModel.FIXED_COROTATED, "NH": ElasticModel.NEO_HOOKEAN}


def singular_values(deformations: np.ndarray) -> np.ndarray:
    """With the sign of the determinant in the last one."""
    left, values, right = np.linalg.svd(deformations)
    values[:, -1] *= np.where(np.linalg.det(left @ right) < 0.0, -1.0, 1.0)
    return values


def stored_energy(deformations: np.ndarray, model: str) -> np.ndarray:
    """Per rest volume [J/m^d], with F brought into its range as the library does before its first use."""
    values = np.clip(singular_values(deformations.astype(float)), *STRAIN_RANGE)
    ratio = np.prod(values, axis=1)
    if model == "FCR":
        return SHEAR * np.sum((values - 1.0) ** 2, axis=1) + 0.5 * LAME * (ratio - 1.0) ** 2
    below = (ratio - 0.1) / 0.1
    log = np.where(ratio >= 0.1, np.log(np.maximum(ratio, 0.1)), math.log(0.1) + below - 0.5 * below**2)
    return 0.5 * SHEAR * np.sum(values**2 - 1.0, axis=1) - SHEAR * log + 0.5 * LAME * log**2


def total_energy(world: pbmpm.World, model: str) -> float:
    """Kinetic, with the motion within each particle's neighbourhood, and stored [J]."""
    masses = np.asarray(world.masses, dtype=float)
    speed2 = np.sum(np.asarray(world.velocities, dtype=float) ** 2, axis=1)
    affine = np.asarray(world.affine_velocities, dtype=float).reshape(len(masses), -1)
    moving = 0.5 * np.sum(masses * (speed2 + 0.25 * CELL**2 * np.sum(affine**2, axis=1)))
    dimension = world.dimension
    deformations = np.asarray(world.deformations).reshape(-1, dimension, dimension)
    return float(moving + np.sum(masses / DENSITY * stored_energy(deformations, model)))


def block_of(dimension: int, cells: int) -> np.ndarray:
    axis = (np.arange(2 * cells) + 0.5) * 0.5 * CELL
    return np.stack(np.meshgrid(*[axis] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)


def random_strain(places: np.ndarray, deformations: np.ndarray) -> None:
    deformations[:] = np.random.default_rng(1).normal(size=deformations.shape)
    deformations[::10] = 1e-6 * np.eye(places.shape[1])
    deformations[5::10] = 0.0


def inverted(places: np.ndarray, deformations: np.ndarray) -> None:
    deformations[:, 0, 0] = -1.0


def squashed(places: np.ndarray, deformations: np.ndarray) -> None:
    places[:, 1] *= 0.1
    deformations[:, 1, 1] = 0.1


def flattened(places: np.ndarray, deformations: np.ndarray) -> None:
    places[:, 1] *= 1e-3
    deformations[:, 1, 1] = 1e-3


def stretched(places: np.ndarray, deformations: np.ndarray) -> None:
    places[:, 1] *= 3.0
    deformations[:, 1, 1] = 3.0


Abuse = Callable[[np.ndarray, np.ndarray], None]
ABUSES: tuple[Abuse, ...] = (random_strain, inverted, squashed, flattened, stretched)


def elastic_world(
    dimension: int, model: str, solver: Solver = Solver.PRIMAL, **settings: object
) -> tuple[pbmpm.World, pbmpm.Material]:
    world = pbmpm.World(dimension, CELL, capacity=4096, solver=solver, threads=1, **settings)  # type: ignore[arg-type]
    elastic = Elastic(density=DENSITY, young_modulus=YOUNG, poisson_ratio=POISSON, elastic_model=MODELS[model])
    return world, world.add_material(elastic)


def abused_world(abuse: Abuse, dimension: int, model: str, **settings: object) -> pbmpm.World:
    places = block_of(dimension, 6 if dimension == 2 else 3)
    deformations = np.tile(np.eye(dimension), (len(places), 1, 1))
    abuse(places, deformations)
    world, material = elastic_world(dimension, model, **settings)
    ids = world.add_particles(material, places, volumes=(0.5 * CELL) ** dimension)
    world.set(Field.DEFORMATION, deformations, ids)
    return world


@pytest.mark.parametrize("dimension", (2, 3))
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("abuse", ABUSES, ids=lambda abuse: abuse.__name__)
def test_abused_bodies_never_gain_energy(abuse: Abuse, model: str, dimension: int) -> None:
    """Elastic and kinetic energy never grow, at any rate and number of iterations, but for a millionth of rounding."""
    for rate in (15, 60, 480):
        for iterations in (1, 5, 20):
            with abused_world(abuse, dimension, model, iterations=iterations) as world:
                first = last = total_energy(world, model)
                count = len(world)
                for step in range(8):
                    world.step(1.0 / rate)
                    energy = total_energy(world, model)
                    assert energy <= last + 1e-6 * first, (rate, iterations, step)
                    last = energy
                assert len(world) == count


@pytest.mark.parametrize("model", MODELS)
def test_bdf2_never_has_more_energy_than_at_first(model: str) -> None:
    """BDF2 conserves a mean over two steps, so the energy of one may rise a little, but not beyond the start."""
    for abuse in ABUSES:
        for rate in (15, 480):
            for iterations in (1, 20):
                with abused_world(abuse, 2, model, iterations=iterations, integrator=Integrator.BDF2) as world:
                    first = total_energy(world, model)
                    for step in range(12):
                        world.step(1.0 / rate)
                        now = (abuse.__name__, rate, iterations, step)
                        assert total_energy(world, model) <= first * (1.0 + 1e-6), now


def rigid_loss(rate: int, spin: float, seconds: float) -> float:
    """Share of its angular momentum that a rigid body loses by BDF2, from exact places and velocities in the complex plane.

    Forces between its points have no torque where a step ends, so x' turns x to where the predictor x + u* is seen.
    """
    dt = 1.0 / rate
    past, v = 1j * spin, 1j * spin
    x = (1.0 + 1j * spin * dt) / abs(1.0 + 1j * spin * dt)  # the first step is one of backward Euler, which keeps it
    way = x - 1.0
    v = x * complex((x.conjugate() * way).real / dt, spin)
    for _ in range(1, round(seconds * rate)):
        leads = (x + way / 3.0 + 2.0 * dt / 9.0 * (4.0 * v - past)) / x
        u = x * (leads / abs(leads) - 1.0)
        past, v = v, (3.0 * u - way) / (2.0 * dt)
        x, way = x + u, u
    return 1.0 - (x.conjugate() * v).imag / spin


@pytest.mark.parametrize(("dimension", "iterations"), [(2, 5), (2, 20), (3, 5)])
def test_a_stiff_body_with_bdf2_turns_as_if_it_were_rigid(dimension: int, iterations: int) -> None:
    """However many iterations there are. After a step of backward Euler by t its points move outwards by t/2 of their speed. No energy is gained, so up to
    1 - sqrt(1 - t^2/4) of the rotation is missing."""
    rate, spin, seconds = 120, 2.0 * math.pi, 2.0
    radius = 3.0 * CELL
    world = pbmpm.World(dimension, CELL, capacity=20_000, iterations=iterations, solver=Solver.PRIMAL, threads=1)
    stiff = Elastic(young_modulus=1e4 * DENSITY * (spin * radius) ** 2)
    world.fill(pbmpm.Sphere([0.0] * dimension, radius), world.add_material(stiff), seed=1)
    turn = np.zeros((dimension, dimension))
    turn[1, 0], turn[0, 1] = spin, -spin
    world.velocities = np.asarray(world.positions) @ turn.T
    world.affine_velocities = np.tile(turn, (len(world), 1, 1))
    world.integrator = Integrator.BDF2
    start = world.stats.angular_momentum[2]
    for _ in range(round(seconds * rate)):
        world.step(1.0 / rate)
    lost, law = 1.0 - world.stats.angular_momentum[2] / start, rigid_loss(rate, spin, seconds)
    assert abs(lost - law) < 0.125 * (spin / rate) ** 2


def test_a_body_that_pays_keeps_its_momentum() -> None:
    """Random F of stiff matter: bodies gain by what is unfinished and pay with their velocities. Sums of single precision alone may differ. Nothing is slowed to
    max_displacement, which would take momentum."""
    rate = 120
    world = pbmpm.World(2, CELL, capacity=2_000, iterations=10, solver=Solver.PRIMAL, threads=1, max_displacement=64.0)
    stiff = Elastic(young_modulus=1e4 * DENSITY * (120.0 * CELL) ** 2, elastic_model=ElasticModel.NEO_HOOKEAN)
    world.fill(pbmpm.Box([0.3 * CELL] * 2, [4.0 * CELL] * 2), world.add_material(stiff), seed=1)
    world.set(Field.DEFORMATION, np.random.default_rng(1).normal(size=(len(world), 2, 2)).astype(np.float32))
    world.velocities = np.tile([100.0 * CELL, 0.0], (len(world), 1))
    start, worst, failures = np.array(world.stats.momentum), 0.0, 0
    for _ in range(40):
        world.step(1.0 / rate)
        failures += world.stats.energy_checks_failed
        speeds = np.abs(np.asarray(world.velocities, dtype=float))
        size = float(np.asarray(world.masses, dtype=float) @ speeds.sum(axis=1))
        worst = max(worst, float(np.abs(np.array(world.stats.momentum) - start).max()) / size)
    assert failures > 0 and world.stats.clamped_total == 0
    assert worst < 1e-6  # eight roundings of 2^-23


def test_a_squashed_body_grows_back() -> None:
    """Being unable to gain energy does not mean being frozen."""
    for iterations in (1, 2, 20):
        with abused_world(squashed, 2, "FCR", iterations=iterations) as world:
            for _ in range(120):
                world.step(1.0 / 60.0)
            heights = np.asarray(world.positions)[:, 1]
            assert np.ptp(heights) > 0.5 * 6 * CELL, iterations


def test_free_fall_is_exact() -> None:
    """No iteration touches a motion without strain."""
    for integrator in Integrator:
        world, material = elastic_world(2, "FCR", gravity=(0.0, -9.81), iterations=2, integrator=integrator)
        with world:
            places = block_of(2, 4)
            speed = np.tile([1.0, 2.0], (len(places), 1))
            world.add_particles(material, places, velocities=speed, volumes=0.25 * CELL**2)
            for _ in range(30):
                world.step(1.0 / 60.0)
            velocity = np.asarray(world.velocities, dtype=float).mean(axis=0)
            # Both integrators give v = v0 + g t. Rounding: 30 steps of single precision.
            assert velocity == pytest.approx([1.0, 2.0 - 9.81 * 0.5], rel=2e-5)
            assert world.stats.energy_checks_failed == 0


def bouncing_world(integrator: Integrator, iterations: int) -> pbmpm.World:
    world, material = elastic_world(
        2, "FCR", gravity=(0.0, -9.81), iterations=iterations, integrator=integrator, domain=((-1.0, 0.0), (1.0, 2.0))
    )
    places = block_of(2, 8) + [-4 * CELL, 0.05]
    world.add_particles(material, places, velocities=np.tile([0.0, -2.0], (len(places), 1)), volumes=0.25 * CELL**2)
    return world


@pytest.mark.parametrize("integrator", tuple(Integrator))
def test_an_impact_does_not_bounce_higher_than_it_fell_from(integrator: Integrator) -> None:
    for iterations in (1, 5, 20):
        for rate in (30, 60, 240):
            with bouncing_world(integrator, iterations) as world:
                heights = np.asarray(world.positions)[:, 1].astype(float)
                least = heights.mean() - heights.min()
                drop = 2.0**2 / (2.0 * 9.81) + heights.min()
                highest = 0.0
                for _ in range(rate):
                    world.step(1.0 / rate)
                    highest = max(highest, float(np.asarray(world.positions)[:, 1].mean()) - least)
                assert highest <= drop + 0.5 * CELL, (iterations, rate)


def test_friction_holds_and_lets_slide() -> None:
    """A block on a slope, which is gravity that is turned: held below the coefficient, sliding above."""
    for slope, holds in ((0.2, True), (0.8, False)):
        pull = 9.81 * np.array([math.sin(math.atan(slope)), -math.cos(math.atan(slope))])
        walls = ((-1.0, 0.0), (3.0, 1.0))
        world, material = elastic_world(2, "FCR", gravity=pull, iterations=20, domain=walls, domain_friction=0.5)
        with world:
            places = block_of(2, 6) + [0.0, 0.0]
            world.add_particles(material, places, volumes=0.25 * CELL**2)
            for _ in range(240):
                world.step(1.0 / 480.0)
            way = float(np.asarray(world.positions)[:, 0].mean() - places[:, 0].mean())
            free = 0.5 * (pull[0] + 0.5 * pull[1]) * 0.5**2  # Coulomb's law over half a second
            assert (abs(way) < 0.5 * CELL) if holds else way == pytest.approx(free, abs=CELL), slope


def test_results_do_not_depend_on_threads() -> None:
    hashes = set()
    for threads in (1, 2, 5):
        gravity = (0.0, -9.81, 0.0)
        world = pbmpm.World(
            3, CELL, capacity=20000, solver=Solver.PRIMAL, threads=threads, iterations=4, gravity=gravity
        )
        with world:
            material = world.add_material(Elastic(young_modulus=YOUNG))
            world.add_particles(material, block_of(3, 10), volumes=(0.5 * CELL) ** 3)
            for _ in range(3):
                world.step(1.0 / 60.0)
            hashes.add(world.hash())
    assert len(hashes) == 1


def test_a_liquid_takes_part() -> None:
    """Elastic matter in a pool, both in the primal solver: nothing is lost, and the liquid does not fire the check."""
    for bulk in (0.0, 1e5):
        walls = ((0.0, 0.0), (1.0, 1.0))
        world = pbmpm.World(
            2, CELL, capacity=8192, solver=Solver.PRIMAL, threads=1, iterations=10, gravity=(0.0, -9.81), domain=walls
        )
        with world:
            water = world.add_material(Liquid(density=DENSITY, bulk_modulus=bulk))
            jelly = world.add_material(Elastic(density=800.0, young_modulus=1e5))
            pool = block_of(2, 16)
            world.add_particles(water, pool, volumes=0.25 * CELL**2)
            world.add_particles(jelly, block_of(2, 4) + [0.2, 0.55], volumes=0.25 * CELL**2)
            failed = 0
            for _ in range(60):
                world.step(1.0 / 120.0)
                failed += world.stats.energy_checks_failed
            assert world.stats.max_speed < 10.0 and len(world) == len(pool) + 64
            assert failed <= 6


def test_no_step_leaps_where_liquid_lets_go_of_a_wall() -> None:
    """Nodes that a wall holds have no stiffness where the liquid at it is loose; let go, they have their mass.

    A step of a pool at rest corrects at most what gravity moves, g dt^2 = 0.014 cells of 0.2 m; leaps were 10 cells and more.
    """
    walls = ((0.0, 0.0, 0.0), (0.8, 1.6, 0.8))
    gravity = (0.0, -9.81, 0.0)
    world = pbmpm.World(3, 0.2, capacity=4096, solver=Solver.PRIMAL, threads=1, iterations=5, gravity=gravity, domain=walls)
    with world:
        water = world.add_material(Liquid(bulk_modulus=576e3))
        world.fill(pbmpm.Box((0.4, 0.4, 0.4), (0.4, 0.4, 0.4)), water, seed=1)
        for step in range(20):
            world.step(1.0 / 60.0)
            assert world.stats.residual < 0.014, step


@pytest.mark.parametrize("rate, stays", ((2400, True), (60, False)))
def test_explicit_is_stable_while_sound_is_slow(rate: int, stays: bool) -> None:
    """Below one cell per step a stretched block swings; far above it explodes, but stays finite."""
    world, material = elastic_world(2, "FCR", solver=Solver.EXPLICIT)
    with world:
        places = block_of(2, 6)
        ids = world.add_particles(material, places, volumes=0.25 * CELL**2)
        deformations = np.tile(np.diag([1.01, 1.0]), (len(places), 1, 1))
        world.set(Field.DEFORMATION, deformations, ids)
        first = total_energy(world, "FCR")
        for _ in range(100):
            world.step(1.0 / rate)
        assert np.isfinite(np.asarray(world.positions)).all() and np.isfinite(np.asarray(world.velocities)).all()
        assert (total_energy(world, "FCR") <= 1.5 * first) == stays
