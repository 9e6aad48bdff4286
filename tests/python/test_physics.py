"""The library against exact solutions, conservation laws and the solver's own laws.

Limits come from three places and are named beside each: round-off of single precision, the invariance checks that the
project set itself before there was code, and the spread of small models that the laws were derived with.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest

import pbmpm
from pbmpm.lab.accuracy import laws

Array = npt.NDArray[np.float64]

CELL = 0.1  # [m]
RATE = 60.0  # steps per second
GRAVITY = 9.81
MATERIALS = {"liquid": pbmpm.Liquid(volume_feedback=0), "elastic": pbmpm.Elastic()}

each_material = pytest.mark.parametrize("parameters", MATERIALS.values(), ids=MATERIALS.keys())


def by_id(world: pbmpm.World, values: npt.ArrayLike) -> Array:
    """Rows of a view in the order in which particles were made."""
    rows = np.argsort(world.ids.array()[:, 0], kind="stable")
    return np.asarray(values, dtype=float)[rows]


def positions_of(world: pbmpm.World) -> Array:
    return by_id(world, world.positions.array())


def set_linear_motion(world: pbmpm.World, gradient: Array, velocity: Array | float = 0.0) -> None:
    """Gives every particle the velocity `velocity` + `gradient` x."""
    positions = world.positions.copy().astype(float)
    world.velocities = velocity + positions @ gradient.T
    world.affine_velocities = np.tile(gradient, (len(positions), 1, 1))


def turn(dimension: int, angle: float) -> Array:
    """A rotation in the plane of the first two axes."""
    matrix = np.eye(dimension)
    matrix[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    return matrix


# Motion without forces


@each_material
def test_free_fall_has_the_error_of_its_time_step(dimension: int, parameters: pbmpm.materials.Parameters) -> None:
    """Gravity enters before positions move, so after t a body is g t dt / 2 too deep, exactly."""
    seconds, iterations, errors = 1.0, 5, []
    for rate in (30, 60, 120):
        gravity = [0.0, -GRAVITY, 0.0][:dimension]
        with pbmpm.World(dimension, CELL, capacity=10_000, gravity=gravity, iterations=iterations, threads=1, solver=pbmpm.Solver.PAPER) as world:
            world.fill(pbmpm.Sphere([0.0] * dimension, 3 * CELL), world.add_material(parameters), jitter=0)
            start = positions_of(world)
            for _ in range(round(seconds * rate)):
                world.step(1 / rate)
            fallen = (positions_of(world) - start)[:, 1].mean()
        errors.append(fallen + 0.5 * GRAVITY * seconds**2)
        # Round-off: one unit in the last place for each of the N + 1 rounds of transfer of each step.
        rounding = seconds * rate * (iterations + 1) * 2.0**-24 * abs(fallen)
        assert errors[-1] == pytest.approx(-0.5 * GRAVITY * seconds / rate, abs=rounding)
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.02)
    assert errors[1] / errors[2] == pytest.approx(2.0, abs=0.02)


def spinning_body(world: pbmpm.World, parameters: pbmpm.materials.Parameters, velocity: tuple[float, ...]) -> None:
    """A ball of 20 cells (3D: 10) that turns by 2 rad/s while it moves."""
    radius = (10 if world.dimension == 2 else 5) * CELL
    world.fill(pbmpm.Sphere([0.03] * world.dimension, radius), world.add_material(parameters))
    gradient = np.zeros((world.dimension, world.dimension))
    gradient[0, 1], gradient[1, 0] = -2.0, 2.0
    set_linear_motion(world, gradient, np.array(velocity[: world.dimension]))
    world.step(1 / RATE)


# A turning liquid without a wall is soon only spray, so it gets fewer steps.
each_body = pytest.mark.parametrize(
    ("parameters", "steps"), [(MATERIALS["elastic"], 1000), (MATERIALS["liquid"], 100)], ids=["elastic", "liquid"]
)


@each_body
@pytest.mark.parametrize(("iterations", "limit"), [(1, 1e-6), (5, 3e-6)])
def test_linear_momentum_of_a_free_body(
    dimension: int, parameters: pbmpm.materials.Parameters, steps: int, iterations: int, limit: float
) -> None:
    """Kept to 1e-6 with one iteration (check I2), mass exactly. The drift is round-off, mostly of node masses, and acts anew
    in each of the N + 1 rounds of transfer: 3 times as much is allowed for 3 times as many."""
    with pbmpm.World(dimension, CELL, capacity=20_000, iterations=iterations, threads=1, solver=pbmpm.Solver.PAPER) as world:
        spinning_body(world, parameters, (1.0, 0.5, 0.25))
        start = world.stats
        for _ in range(steps):
            world.step(1 / RATE)
        end = world.stats
    assert np.abs(np.subtract(end.momentum, start.momentum)).max() / np.linalg.norm(start.momentum) < limit
    assert end.mass == start.mass


@each_body
def test_angular_momentum_of_a_free_body(dimension: int, parameters: pbmpm.materials.Parameters, steps: int) -> None:
    """Kept to 1e-5 (check I3); the body stays at the origin, so that its path adds nothing."""
    with pbmpm.World(dimension, CELL, capacity=20_000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        spinning_body(world, parameters, (0.0, 0.0, 0.0))
        start = world.stats.angular_momentum[2]
        for _ in range(steps):
            world.step(1 / RATE)
        assert world.stats.angular_momentum[2] == pytest.approx(start, rel=1e-5)


def test_rigid_rotation_is_kept(dimension: int) -> None:
    """A finite turn of a turned elastic body asks for no correction (check I7: 1e-6)."""
    step, before = turn(dimension, 0.1), turn(dimension, 0.7)
    with pbmpm.World(dimension, CELL, capacity=10_000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Box([0.03] * dimension, [4 * CELL] * dimension), world.add_material(pbmpm.Elastic()))
        world.set(pbmpm.Field.DEFORMATION, np.tile(before, (len(world), 1, 1)))
        set_linear_motion(world, (step - np.eye(dimension)) * RATE)
        start = positions_of(world)
        world.step(1 / RATE)
        assert np.abs(positions_of(world) - start @ step.T).max() / CELL < 1e-6
        assert np.abs(world.deformations.array() - step @ before).max() < 1e-6


def test_uniform_stretch_is_kept(dimension: int) -> None:
    """A constant gradient without change of volume goes through the grid unchanged (check I8: 1e-5)."""
    gradient = np.zeros((dimension, dimension))
    gradient[0, 0], gradient[1, 1], gradient[0, 1], gradient[-1, 0] = 0.05, -0.05, 0.03, 0.02
    with pbmpm.World(dimension, CELL, capacity=10_000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Box([0.03] * dimension, [4 * CELL] * dimension), world.add_material(MATERIALS["liquid"]))
        set_linear_motion(world, gradient * RATE)
        start = positions_of(world)
        world.step(1 / RATE)
        assert np.abs(positions_of(world) - start @ (np.eye(dimension) + gradient).T).max() / CELL < 1e-5
        assert np.abs(world.affine_velocities.array() / RATE - gradient).max() < 1e-5


@pytest.mark.parametrize("growth", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("solver", [pbmpm.Solver.DUAL, pbmpm.Solver.PRIMAL])
def test_liquid_that_flies_apart_goes_straight_on(dimension: int, solver: pbmpm.Solver, growth: float) -> None:
    """A sheet one cell wide with the velocity growth x per substep: nothing presses on it, so each particle keeps its velocity. Its rim was up to 2.5
    times as fast after eight substeps. Grid and particles round some hundred times (1e-4)."""
    gradient = np.zeros((dimension, dimension))
    gradient[0, 0] = growth * RATE
    with pbmpm.World(dimension, CELL, capacity=10_000, threads=1, solver=solver, iterations=2) as world:
        sheet = pbmpm.Box([0.0] * dimension, [0.5 * CELL, *[2 * CELL] * (dimension - 1)])
        world.fill(sheet, world.add_material(pbmpm.Liquid(bulk_modulus=1e5)))
        set_linear_motion(world, gradient)
        start = by_id(world, world.velocities.array())
        for _ in range(8):
            world.step(1 / RATE)
        assert np.abs(by_id(world, world.velocities.array()) - start).max() < 1e-4 * np.abs(start).max()


@pytest.mark.parametrize("solver", [pbmpm.Solver.DUAL, pbmpm.Solver.PRIMAL])
def test_liquid_that_flies_apart_in_all_directions_gains_nothing(dimension: int, solver: pbmpm.Solver) -> None:
    """Its growth fades no later than that of what flies freely."""
    with pbmpm.World(dimension, CELL, capacity=10_000, threads=1, solver=solver, iterations=2) as world:
        world.fill(pbmpm.Sphere([0.0] * dimension, CELL), world.add_material(pbmpm.Liquid(bulk_modulus=1e5)))
        set_linear_motion(world, np.eye(dimension) * 0.2 * RATE)
        energy = float((world.velocities.array().astype(float) ** 2).sum())
        for _ in range(8):
            world.step(1 / RATE)
            assert float((world.velocities.array().astype(float) ** 2).sum()) <= energy * (1 + 1e-4)


@each_material
def test_mirror_symmetry(parameters: pbmpm.materials.Parameters) -> None:
    """A symmetric collapse stays symmetric for 1 s to 1e-5 of the tank's width (check I6)."""
    width, rate = 6.4, 240
    with pbmpm.World(
        2, CELL, capacity=5000, gravity=(0, -GRAVITY), domain=((0, 0), (width, 3.2)), iterations=10, threads=1,
        solver=pbmpm.Solver.PAPER,
    ) as world:
        world.fill(pbmpm.Box((0.5 * width, 0.8), (0.8, 0.8)), world.add_material(parameters), jitter=0)
        start = positions_of(world)
        mirrored = start * (-1, 1) + (width, 0)
        order, image = (np.lexsort(np.round(places / (0.1 * CELL)).T) for places in (start, mirrored))
        for _ in range(rate):
            world.step(1 / rate)
        end = positions_of(world)
    difference = end[image] * (-1, 1) + (width, 0) - end[order]
    assert np.abs(difference).max() / width < 1e-5


# Stiffness


def column_modulus(dimension: int, iterations: int, relaxation: float) -> float:
    """K / rho [m^2/s^2] of a settled column, from the slope of the pressure law over its middle half."""
    cells, width, gravity, rate = 16, 4 * CELL, 1.0, 120
    size = [width, 1.5 * cells * CELL, width][:dimension]
    half = [0.5 * width, 0.5 * cells * CELL, 0.5 * width][:dimension]
    with pbmpm.World(
        dimension,
        CELL,
        capacity=5000,
        gravity=[0, -gravity, 0][:dimension],
        domain=([0] * dimension, size),
        iterations=iterations,
        threads=1,
        solver=pbmpm.Solver.PAPER,
    ) as world:
        liquid = pbmpm.Liquid(volume_feedback=0, relaxation=relaxation)
        world.fill(pbmpm.Box(half, half), world.add_material(liquid), jitter=0)
        for _ in range(20 * rate):
            world.step(1 / rate)
        heights = world.positions.array()[:, 1]
        order = np.argsort(-heights)
        load = (
            gravity * np.cumsum(world.masses.array()[order].astype(float)) / liquid.density / width ** (dimension - 1)
        )
        ratios = world.volume_ratios.array()[order].astype(float)
    middle = slice(len(ratios) // 4, 3 * len(ratios) // 4)
    # The impulse of a particle carries its rest volume, so the pressure is K (1/J - 1) / J.
    strain = (1 / ratios - 1) / ratios
    return 1 / float(np.polyfit(load[middle], strain[middle], 1)[0])


@pytest.mark.parametrize(("iterations", "relaxation"), [(2, 1.5), (8, 1.5), (8, 1.0)])
def test_hydrostatic_compression_obeys_the_bulk_modulus(dimension: int, iterations: int, relaxation: float) -> None:
    """K = rho w N dx^2 / (4 d dt^2); the models of the law scatter by 7 %."""
    law = laws.bulk_modulus_over_density(dimension, CELL, 1 / 120, iterations, relaxation)
    assert column_modulus(dimension, iterations, relaxation) == pytest.approx(law, rel=0.07)


def test_stiffness_grows_with_the_iterations() -> None:
    """K is linear in N: slope 1 +- 0.1 (check I11)."""
    counts = [2, 4, 8, 16]
    moduli = [column_modulus(2, count, 1.5) for count in counts]
    slope = np.polyfit(np.log(counts), np.log(moduli), 1)[0]
    assert slope == pytest.approx(1.0, abs=0.1)


def bar_frequency(
    dimension: int, iterations: int, rate: float, relaxation: float, length: float, speed: float
) -> float:
    """Frequency [Hz] of the first longitudinal mode of a free bar, from the zeros of its velocity."""
    thickness, periods, wave_number = 4 * CELL, 3, math.pi / length
    with pbmpm.World(dimension, CELL, capacity=20_000, iterations=iterations, threads=1, solver=pbmpm.Solver.PAPER) as world:
        half = [0.5 * length] + [0.5 * thickness] * (dimension - 1)
        bar = pbmpm.Box([0.5 * length] + [0.0] * (dimension - 1), half)
        world.fill(bar, world.add_material(pbmpm.Elastic(relaxation=relaxation)), jitter=0)
        shape = np.cos(wave_number * world.positions.array()[:, 0].astype(float))
        velocities = np.zeros((len(shape), dimension))
        velocities[:, 0] = 1e-3 * speed * shape
        shape = by_id(world, shape)
        world.velocities = velocities
        amplitudes = []
        for _ in range(round(periods * 2 * length / speed * rate)):
            world.step(1 / rate)
            amplitudes.append(float(by_id(world, world.velocities.array())[:, 0] @ shape))
    signal = np.array(amplitudes)
    crossings = np.nonzero(signal[:-1] * signal[1:] < 0)[0]
    zeros = (crossings + signal[crossings] / (signal[crossings] - signal[crossings + 1])) / rate
    return (len(zeros) - 1) / (2 * (zeros[-1] - zeros[0]))


@pytest.mark.parametrize(
    ("iterations", "rate", "relaxation"), [(1, 240, 1.5), (4, 240, 1.5), (1, 240, 1.0), (2, 60, 1.5)]
)
def test_axial_bar_obeys_the_elastic_modulus(iterations: int, rate: float, relaxation: float) -> None:
    """E = rho w N dx^2 / (4 dt^2); the models of the law agree within 3 %, and E goes with the frequency squared."""
    length = 64 * CELL
    speed = 0.5 * CELL * rate * math.sqrt(relaxation * iterations)
    frequency = bar_frequency(2, iterations, rate, relaxation, length, speed)
    assert (frequency / (0.5 * speed / length)) ** 2 == pytest.approx(1.0, abs=0.03)


def test_axial_bar_in_3d() -> None:
    length, rate, relaxation = 32 * CELL, 240.0, 1.5
    speed = 0.5 * CELL * rate * math.sqrt(relaxation)
    frequency = bar_frequency(3, 1, rate, relaxation, length, speed)
    assert (frequency / (0.5 * speed / length)) ** 2 == pytest.approx(1.0, abs=0.03)


# Dissipation


def shear_wave_viscosity(dimension: int, iterations: int, viscosity: float, wave_cells: int, expected: float) -> float:
    """Kinematic viscosity [m^2/s] by the decay of a shear wave in the middle of a free block, far from its faces."""
    waves, wave = (5 if dimension == 2 else 3), wave_cells * CELL
    wave_number = 2 * math.pi / wave
    with pbmpm.World(dimension, CELL, capacity=80_000, iterations=iterations, threads=1, solver=pbmpm.Solver.PAPER) as world:
        half = [1.5 * wave, 0.5 * waves * wave, 3 * CELL][:dimension]
        liquid = pbmpm.Liquid(viscosity=viscosity, volume_feedback=0)
        world.fill(pbmpm.Box([0.0] * dimension, half), world.add_material(liquid), jitter=0)
        places = world.positions.copy().astype(float)
        amplitude = 1e-3 * CELL * RATE
        velocities = np.zeros_like(places)
        gradients = np.zeros((len(places), dimension, dimension))
        velocities[:, 0] = amplitude * np.cos(wave_number * places[:, 1])
        gradients[:, 0, 1] = -amplitude * wave_number * np.sin(wave_number * places[:, 1])
        world.velocities, world.affine_velocities = velocities, gradients
        places, shape = by_id(world, places), by_id(world, velocities[:, 0])
        middle = (np.abs(places[:, 0]) < 0.5 * wave) & (np.abs(places[:, 1]) < 0.5 * wave)
        logs = []
        for _ in range(round(0.7 / (expected * wave_number**2) * RATE)):
            world.step(1 / RATE)
            speeds = by_id(world, world.velocities.array())[:, 0]
            logs.append(math.log(speeds[middle] @ shape[middle]))
    settled = len(logs) // 5
    times = np.arange(len(logs)) / RATE
    return -float(np.polyfit(times[settled:], logs[settled:], 1)[0]) / wave_number**2


@pytest.mark.parametrize(
    ("iterations", "viscosity", "wave_cells"), [(1, 0.0, 12), (5, 0.0, 12), (5, 0.1, 12), (5, 0.1, 24), (5, 0.3, 16)]
)
def test_shear_wave_decays_by_the_laws(dimension: int, iterations: int, viscosity: float, wave_cells: int) -> None:
    """nu = N nu_m dx^2 / (8 dt) of the material, and 0.024 k^2 dx^4 / dt for each of the N + 1 rounds of transfer. The
    models of the laws spread by 4 %."""
    if dimension == 3 and wave_cells != 12:
        pytest.skip("the same law with several 100 000 particles")
    wave_number = 2 * math.pi / (wave_cells * CELL)
    material = iterations * viscosity * CELL**2 * RATE / 8
    transfer = 0.024 * (iterations + 1) * wave_number**2 * CELL**4 * RATE
    expected = material + transfer
    measured = shear_wave_viscosity(dimension, iterations, viscosity, wave_cells, expected)
    assert measured == pytest.approx(expected, rel=0.05)


# A liquid with an exact solution


def drop_axes(cells: int, rate: int, seconds: float, feedback: float) -> tuple[float, float]:
    """Half axes, over the radius, of a drop that starts as a disc with the velocity (-x, y) / s."""
    radius = cells * CELL
    with pbmpm.World(2, CELL, capacity=20_000, iterations=10, threads=1, solver=pbmpm.Solver.PAPER) as world:
        liquid = pbmpm.Liquid(volume_feedback=feedback)
        world.fill(pbmpm.Sphere((0.0, 0.0), radius), world.add_material(liquid), jitter=0)
        start = np.cov(world.positions.array().astype(float).T)
        set_linear_motion(world, np.diag([-1.0, 1.0]))
        for _ in range(round(seconds * rate)):
            world.step(1 / rate)
        end = np.cov(world.positions.array().astype(float).T)
    return math.sqrt(end[0, 0] / start[0, 0]), math.sqrt(end[1, 1] / start[1, 1])


def test_the_layer_at_the_floor_is_no_denser_than_the_rest() -> None:
    """The grid holds less at a wall, whose other side is empty. After a dam break feedback that does not know of walls leaves
    the floor's layer at 1.22 times its volume instead of 1.11; the law's own compression there is 1.09."""
    width, height, rate = 32, 24, 120
    with pbmpm.World(2, CELL, capacity=5000, domain=((0, 0), (width * CELL, 64 * CELL)), iterations=5, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.gravity = (0, -9.81)
        half = (0.25 * width * CELL, 0.5 * height * CELL)
        world.fill(pbmpm.Box(half, half), world.add_material(pbmpm.Liquid()), jitter=0)
        layers = []
        for step in range(6 * rate):
            world.step(1 / rate)
            if step >= 4 * rate and step % 12 == 0:
                layers.append(float((world.positions.array()[:, 1] < CELL).sum()) / (4 * width))
    assert float(np.mean(layers)) < 1.15


def exact_drop_axis(seconds: float) -> float:
    """The shrinking half axis a: dA/dt = A^2 (a^4 - 1) / (a^4 + 1), da/dt = -a A, a(0) = A(0) = 1; the other is 1/a."""
    a, rate, steps = 1.0, 1.0, 20_000
    for _ in range(steps):
        step = seconds / steps
        a, rate = a - step * a * rate, rate + step * rate**2 * (a**4 - 1) / (a**4 + 1)
    return a


def test_elliptical_drop_keeps_its_area() -> None:
    """Below 1 % per second at 10 iterations and 240 Hz (check I13), with the library's default feedback."""
    a, b = drop_axes(16, 240, 1.0, pbmpm.Liquid().volume_feedback)
    assert a * b == pytest.approx(1.0, abs=0.01)


def test_elliptical_drop_converges() -> None:
    """With half the cell and half the step the error of the half axes falls to half or less: first order (check I12; the
    order's own tolerance of 0.2 is that of check I10)."""
    exact = exact_drop_axis(1.0)
    errors = []
    for cells, rate in ((8, 120), (16, 240)):
        a, b = drop_axes(cells, rate, 1.0, 0.0)
        errors.append(max(abs(a / exact - 1), abs(b * exact - 1)))
    assert math.log2(errors[0] / errors[1]) > 0.8


# Energy


def peak_energy(
    dimension: int, parameters: pbmpm.materials.Parameters, cells: int, rate: float, iterations: int
) -> float:
    """Highest kinetic plus potential energy over the start's while a column collapses for 2 s."""
    side, gravity = cells * 0.05, [0.0, -GRAVITY, 0.0][:dimension]
    domain = ([0.0] * dimension, [4 * side, 2 * side, 0.4][:dimension])
    with pbmpm.World(
        dimension, 0.05, capacity=20_000, gravity=gravity, domain=domain, iterations=iterations, threads=1,
        solver=pbmpm.Solver.PAPER,
    ) as world:
        body = [0.5 * side, 0.5 * side, 0.2][:dimension]
        world.fill(pbmpm.Box(body, body), world.add_material(parameters))
        start = GRAVITY * float(world.masses.array().astype(float) @ world.positions.array()[:, 1])
        peak = 0.0
        for _ in range(round(2 * rate)):
            world.step(1 / rate)
            peak = max(peak, world.stats.kinetic_energy + world.stats.potential_energy)
    return peak / start


@pytest.mark.parametrize(("rate", "iterations"), [(30, 1), (30, 20), (60, 5), (240, 2)])
@pytest.mark.parametrize("parameters", [pbmpm.Liquid(), pbmpm.Elastic()], ids=["liquid", "elastic"])
def test_tall_column_gains_no_energy(parameters: pbmpm.materials.Parameters, rate: float, iterations: int) -> None:
    """64 cells of height, compressed to a third at the bottom; never above the start by more than 0.1 % (check I14)."""
    assert peak_energy(2, parameters, 64, rate, iterations) < 1.001


@each_material
def test_collapse_gains_no_energy(dimension: int, parameters: pbmpm.materials.Parameters) -> None:
    """Never above the start by more than 0.1 % (check I14)."""
    assert peak_energy(dimension, parameters, 16, RATE, 5) < 1.001


@each_material
def test_moving_wall_adds_no_more_than_its_work(dimension: int, parameters: pbmpm.materials.Parameters) -> None:
    """Seen from a wall of constant speed the wall does no work, so the energy there never rises (check I14: 0.1 %)."""
    speed = 2.0
    along, rest = [speed, 0.0, 0.0][:dimension], [0.0] * (dimension - 1)
    with pbmpm.World(dimension, CELL, capacity=10_000, threads=1, solver=pbmpm.Solver.PAPER) as world:
        world.fill(pbmpm.Sphere([0.6, *rest], 4 * CELL), world.add_material(parameters))
        wall = world.add_collider(pbmpm.Box([-0.5, *rest], [0.5] + [5.0] * (dimension - 1)), kinematic=True)
        masses = by_id(world, world.masses.array())
        start = 0.5 * masses.sum() * speed**2
        for step in range(60):
            wall.move([-0.5 + speed * (step + 1) / RATE, *rest])
            world.step(1 / RATE)
            relative = by_id(world, world.velocities.array()) - along
            assert 0.5 * masses @ (relative**2).sum(axis=1) < 1.001 * start
        assert positions_of(world)[:, 0].mean() > 1.0  # it was hit


# Volume of liquids that rest


@pytest.mark.parametrize("solver", [pbmpm.Solver.PAPER, pbmpm.Solver.DUAL, pbmpm.Solver.PRIMAL])
def test_pool_keeps_its_height(solver: pbmpm.Solver) -> None:
    """12 cells deep, strewn at random: where it is stirred particles close gaps that the grid does not see, and without shifting and volume control the
    primal's pool sinks by 3 % in 40 s. A quarter of a particle's spacing is 1 %."""
    size = [1.6, 1.2]
    with pbmpm.World(2, CELL, domain=((0.0, 0.0), (size[0], 2.0 * size[1])), capacity=1000, gravity=[0.0, -GRAVITY], solver=solver, iterations=5, threads=1) as world:
        world.fill(pbmpm.Box([0.5 * length for length in size], [0.5 * length for length in size]), world.add_material(pbmpm.Liquid()), seed=1)
        for _ in range(600):
            world.step(1 / RATE)
        settled = float(world.positions.array()[:, 1].astype(float).mean())
        for _ in range(6):
            for _ in range(400):
                world.step(1 / RATE)
            assert abs(float(world.positions.array()[:, 1].astype(float).mean()) / settled - 1.0) < 0.01


def filled_by_poured_clay(dimension: int, rate: int) -> float:
    """The cells that clay fills two seconds after it was poured into a bin, over its volume."""
    cell, count = (0.025, 1000) if dimension == 2 else (0.05, 1500)
    flat = slice(0, dimension)
    particle = (0.5 * cell) ** dimension
    with pbmpm.World(dimension, cell, gravity=(0, -GRAVITY, 0)[flat], domain=((0, 0, 0)[flat], (0.6, 1.4, 0.6)[flat]), domain_friction=0.5, capacity=4000, threads=1) as world:
        clay = world.add_material(pbmpm.Visco(density=1500))
        mouth = pbmpm.Box((0.3, 1.2, 0.3)[flat], (0.1, 0.05, 0.1)[flat])
        flow = 0.5 * 0.2 ** (dimension - 1)
        world.add_emitter(mouth, clay, flow, speed=0.5, budget=count)
        for _ in range(int((count * particle / flow + 2.0) * rate)):
            world.step(1 / rate)
        assert len(world) == count
        cells = np.unique(np.floor(world.positions.array() / cell), axis=0)
        return float(len(cells) * cell**dimension / (count * particle))


@pytest.mark.parametrize(("dimension", "rate", "most"), [(2, 60, 1.4), (2, 240, 1.4), (3, 60, 2.2)])
def test_clay_that_is_poured_closes_up(dimension: int, rate: int, most: float) -> None:
    """It stretches and tears as it falls, and its pieces move together where they land: 1.28 and 1.30 in 2D, 2.02 in 3D. Random close packing fills 1.2 (2D) and 1.6 times (3D) the volume, and at the surface
    cells are half empty. Where the voids were borne like matter it filled 2.2, 2.6 and 3.6 times
    its volume."""
    assert filled_by_poured_clay(dimension, rate) < most


@pytest.mark.parametrize("rate", [60, 240])
def test_a_column_of_clay_keeps_its_height(rate: int) -> None:
    """At the sides of what was laid the grid is half empty, but there are no voids. A column of two by four cells bears 1.5 kPa and yields
    at 5; by Hooke's law it is 1 % lower in the mean. It was 2 % lower before voids closed, too."""
    with pbmpm.World(2, 0.025, gravity=(0, -GRAVITY), domain=((0, 0), (1, 1)), domain_friction=0.5, capacity=100, threads=1) as world:
        world.fill(pbmpm.Box((0.5, 0.05), (0.025, 0.05)), world.add_material(pbmpm.Visco(density=1500)))
        for _ in range(6 * rate):
            world.step(1 / rate)
        assert 0.96 < float(world.positions.array()[:, 1].mean()) / 0.05 < 1.0


def stretched_honey(nu: float) -> tuple[np.ndarray, np.ndarray]:
    """Width [m] and kinetic energy [J] of a square of 20 cells that is drawn out in free flight, after each step of a second."""
    cell, half, rate = 0.01, 0.1, 3.0
    with pbmpm.World(2, cell, gravity=(0, 0), capacity=2000, threads=1) as world:
        world.fill(pbmpm.Box((0, 0), (half, half)), world.add_material(pbmpm.Liquid(kinematic_viscosity=nu)))
        gradient = np.array(((-rate, 0), (0, rate)), dtype=np.float32)
        world.velocities = np.array(world.positions) @ gradient
        world.affine_velocities = np.broadcast_to(gradient, (len(world), 2, 2))
        widths, energies = [], []
        for _ in range(60):
            world.step(1 / 60)
            places = np.array(world.positions)
            middle = np.abs(places[:, 1]) < 0.3 * half
            widths.append(math.sqrt(12) * float(places[middle, 0].std()))
            energies.append(world.stats.kinetic_energy)
    return np.array(widths), np.array(energies)


def test_a_stretched_viscous_liquid_does_not_fan_out() -> None:
    """Its free sides are pushed by nothing, so it gets no wider, and viscosity alone acts: the thicker the liquid, the less it thins. Without any it comes to 50 mm. Where the
    deviator pushed the sides apart, the square grew from 200 to 320 mm."""
    for nu, least, most in ((1e-4, 0.045, 0.055), (5e-3, 0.06, 0.1), (5e-2, 0.17, 0.2)):
        widths, energies = stretched_honey(nu)
        assert least < widths[-1] < most
        assert widths.max() < 0.2
        assert (np.diff(energies) < 1e-4 * energies[0]).all()
    assert energies[-1] < 1e-3 * energies[0]
