"""Elastic bodies: on slopes with and without friction, rolling, bouncing, stacked, hanging, spinning."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from harness import G, MEAN, Frame, Run, case, lattice, rms, rows_of
from pbmpm import Box, Elastic, Field, Friction, Plane, Sphere, Visco

SLOPE = "Newton; what is seen as right is within a few per cent"


def _slope(run: Run, world: Any, frame: Frame, floor: str, friction: float) -> None:
    """The floor of a slope: a plane, or a long box that is turned with the frame."""
    more = {"friction_coefficient": friction} if friction else {"friction": Friction.SLIP}
    d = frame.dimension
    if floor == "plane":
        world.add_collider(frame.plane(np.zeros(d), np.eye(d)[1]), **more)
    else:
        low, high = np.full(d, -1.0), np.full(d, 1.0)
        low[0], high[0], low[1], high[1] = -1.5, 4.5, -0.3, 0.0
        world.add_collider(frame.box(low, high), **more)


def _block(run: Run, dimension: int, angle: float, floor: str, modulus: float, friction: float, side: Any = (0.4, 0.2)) -> tuple[Any, Frame]:
    """A block on a slope: the grid lies along it when the floor is a plane, and along gravity when it is a box."""
    a = math.radians(angle)
    cell = 0.025 if dimension == 2 else 0.04
    if floor == "plane":
        frame, down = Frame(dimension), [G * math.sin(a), -G * math.cos(a)] + [0.0] * (dimension - 2)
    else:
        frame, down = Frame(dimension, -angle), [0.0, -G] + [0.0] * (dimension - 2)
    world = run.world(dimension, cell, down)
    _slope(run, world, frame, floor, friction)
    low, high = [-side[0] / 2, 0.0] + [-side[1] / 2] * (dimension - 2), [side[0] / 2, side[1]] + [side[1] / 2] * (dimension - 2)
    world.fill(frame.box(low, high), world.add_material(Elastic(young_modulus=modulus)))
    return world, frame


def _speed(world: Any, frame: Frame) -> float:
    """Of the centre of mass, down the slope."""
    d = frame.dimension
    return float(np.asarray(world.stats.momentum)[:d] / world.stats.mass @ frame.turn[:, 0])


@case(
    plane_10=dict(angle=10, floor="plane"),
    plane_45=dict(angle=45, floor="plane"),
    plane_10_stiff=dict(angle=10, floor="plane", modulus=1e7),
    box_10=dict(angle=10, floor="box"),
    box_45=dict(angle=45, floor="box"),
    box_30_soft=dict(angle=30, floor="box", modulus=1e5),
    box_30_steel=dict(angle=30, floor="box", modulus=1e8),
    plane_10_3d=dict(dimension=3, angle=10, floor="plane"),
    plane_45_3d=dict(dimension=3, angle=45, floor="plane"),
    box_10_3d=dict(dimension=3, angle=10, floor="box"),
    box_45_3d=dict(dimension=3, angle=45, floor="box"),
)
def frictionless_slope(run: Run, angle: float, floor: str, dimension: int = 2, modulus: float = 1e6) -> None:
    """A block slides down with g sin, however stiff it is."""
    world, frame = _block(run, dimension, angle, floor, modulus, 0.0)
    with world:
        run.steps(world, 0.8)
        run.check("speed over true one", _speed(world, frame) / (G * math.sin(math.radians(angle)) * 0.8), 0.97, 1.03, why="g sin t; " + SLOPE)


@case(
    mu_1_30=dict(mu=0.1, angle=30, floor="plane"),
    mu_5_45=dict(mu=0.5, angle=45, floor="plane"),
    mu_1_30_box=dict(mu=0.1, angle=30, floor="box"),
    mu_5_45_box=dict(mu=0.5, angle=45, floor="box"),
    mu_1_30_3d=dict(dimension=3, mu=0.1, angle=30, floor="plane"),
    mu_5_45_3d=dict(dimension=3, mu=0.5, angle=45, floor="plane"),
    mu_5_45_box_3d=dict(dimension=3, mu=0.5, angle=45, floor="box"),
    mu_3_30_soft=dict(mu=0.3, angle=30, floor="plane", modulus=1e5),
    mu_3_30_stiff=dict(mu=0.3, angle=30, floor="plane", modulus=1e7),
)
def rough_slope(run: Run, mu: float, angle: float, floor: str, dimension: int = 2, modulus: float = 1e6) -> None:
    """A block slides down with g (sin - mu cos)."""
    world, frame = _block(run, dimension, angle, floor, modulus, mu)
    with world:
        run.steps(world, 0.8)
        a = math.radians(angle)
        run.check("speed over true one", _speed(world, frame) / (G * (math.sin(a) - mu * math.cos(a)) * 0.8), 0.93, 1.07, why="Coulomb; " + SLOPE)


@case(
    plane_2d=dict(floor="plane"),
    box_2d=dict(floor="box"),
    plane_3d=dict(dimension=3, floor="plane"),
    box_3d=dict(dimension=3, floor="box"),
    stiff=dict(floor="plane", modulus=1e7),
)
def rests_on_slope(run: Run, floor: str, dimension: int = 2, modulus: float = 1e6) -> None:
    """A block on 20 degrees with friction 0.5 (27 degrees) stays where it is."""
    world, frame = _block(run, dimension, 20, floor, modulus, 0.5)
    with world:
        run.steps(world, 2)
        start = frame.positions(world).mean(0)
        run.steps(world, 2)
        creep = np.linalg.norm(frame.positions(world).mean(0) - start) / 2
        run.check("creep", 1e3 * creep, 0, 1, "mm/s", why="Coulomb: 0; a millimetre per second is 2.4 cells per minute")
        run.check("rms speed", rms(world), 0, 0.005, "m/s", why="0; a fifth of a cell per second")


@case(stays=dict(share=0.6), tips=dict(share=0.25))
def tall_block(run: Run, share: float) -> None:
    """On 20 degrees a block tips when its width is less than tan 20 = 0.36 of its height."""
    high = 0.6
    world, frame = _block(run, 2, 20, "plane", 1e6, 1.0, (share * high, high))
    with world:
        run.steps(world, 1.5)
        lean = frame.positions(world)[:, 1].mean() / (high / 2)
        if share > 0.36:
            run.check("height of its centre over the upright one", lean, 0.97, 1.02, why="statics")
        else:
            run.check("height of its centre over the upright one", lean, 0.0, 0.7, why="statics: on its side it is a quarter")


@case(two_5=dict(modulus=1e5), two_6=dict(modulus=1e6), two_7=dict(modulus=1e7), turned=dict(modulus=1e6, angle=20.0), three_d=dict(modulus=1e6, dimension=3))
def stack(run: Run, modulus: float, dimension: int = 2, angle: float = 0.0) -> None:
    """Three boxes on each other stand still, as high as they are."""
    side, cell = 0.2, 0.025 if dimension == 2 else 0.04
    frame = Frame(dimension, angle)
    with run.world(dimension, cell, frame.gravity) as world:
        world.add_collider(frame.plane([0] * dimension, np.eye(dimension)[1]), friction_coefficient=0.5)
        half = [side / 2] * dimension
        for k in range(3):
            low, high = [-h for h in half], list(half)
            low[1], high[1] = k * side, (k + 1) * side
            world.fill(frame.box(low, high), world.add_material(Elastic(young_modulus=modulus)), seed=k + 1)
        speed = []
        run.steps(world, 4, after=lambda t: speed.append(rms(world)) if t > 3 else None)
        # Its own weight presses a column by rho g H^2 / (2 E) at the top, a third of H^3 in the mean.
        sag = 1000 * G * (3 * side) ** 2 / 3 / modulus
        run.check("rms speed", 1e3 * np.mean(speed), 0, 2, "mm/s", why="0; a stack that trembles by 2 mm/s moves less than a pixel")
        run.near("mean height", frame.positions(world)[:, 1].mean(), 1.5 * side - sag, MEAN, cell, why="Hooke, and contact without a gap")


@case(
    one=dict(dimension=2),
    one_3d=dict(dimension=3),
    off_grid=dict(dimension=2, shift=0.4),
    table=dict(dimension=2, shift=0.5, thick=1),
    table_low=dict(dimension=2, shift=0.75, thick=1.5),
    table_3d=dict(dimension=3, shift=0.75, thick=1),
)
def lies_on_floor(run: Run, dimension: int, shift: float = 0.0, thick: float = 0.0) -> None:
    """A block that has fallen by 0.1 m lies on the floor, or on a table of a few cells, without a gap, and still."""
    side, cell = 0.2, 0.025 if dimension == 2 else 0.04
    frame = Frame(dimension, 0, [0.0, shift * cell] + [0.0] * (dimension - 2))
    with run.world(dimension, cell) as world:
        high = [0.5, 0.0] + [0.5] * (dimension - 2)
        table = frame.box([-0.5, -thick * cell] + [-0.5] * (dimension - 2), high)
        world.add_collider(table if thick > 0 else frame.plane([0] * dimension, np.eye(dimension)[1]), friction_coefficient=0.5)
        world.fill(
            frame.box([-side / 2] + [0.1] + [-side / 2] * (dimension - 2), [side / 2, 0.1 + side] + [side / 2] * (dimension - 2)),
            world.add_material(Elastic(young_modulus=1e6)),
        )
        run.steps(world, 4)
        run.near("mean height", frame.positions(world)[:, 1].mean(), side / 2, MEAN, cell, why="contact without a gap")
        run.check("rms speed", 1e3 * rms(world), 0, 2, "mm/s", why="0")


@case(
    disc_10=dict(angle=10, floor="plane"),
    disc_20_box=dict(angle=20, floor="box"),
    disc_soft=dict(angle=20, floor="plane", modulus=3e4),
    ball_20=dict(angle=20, floor="plane", dimension=3),
    ball_20_box=dict(angle=20, floor="box", dimension=3),
)
def rolling(run: Run, angle: float, floor: str, dimension: int = 2, modulus: float = 1e5) -> None:
    """A disc rolls down with 2/3 g sin, a ball with 5/7 g sin."""
    a, radius = math.radians(angle), 0.2
    down = [G * math.sin(a), -G * math.cos(a)] if floor == "plane" else [0.0, -G]
    frame = Frame(dimension, 0 if floor == "plane" else -angle)
    with run.world(dimension, radius / (8 if dimension == 2 else 6), down + [0.0] * (dimension - 2)) as world:
        _slope(run, world, frame, floor, 0.6)
        world.fill(Sphere(frame.out([0.0, radius] + [0.0] * (dimension - 2)).tolist(), radius), world.add_material(Elastic(young_modulus=modulus)))
        run.steps(world, 1)
        true = (2 / 3 if dimension == 2 else 5 / 7) * G * math.sin(a)
        run.check(
            "speed over true one", _speed(world, frame) / true, 0.8, 1.1, why="rolling without slipping; a soft ball that is 6 to 8 cells thick loses some"
        )


@case(flat=dict())
def disc_on_box(run: Run) -> None:
    """A disc on a box on the floor stays on top and does not roll away."""
    with run.world(2, 0.025) as world:
        world.add_collider(Plane((0, 0), (0, 1)), friction_coefficient=0.5)
        world.fill(Box((0, 0.1), (0.3, 0.1)), world.add_material(Elastic(young_modulus=1e6)))
        disc = world.add_material(Elastic(young_modulus=1e6))
        world.fill(Sphere((0, 0.35), 0.15), disc)
        run.steps(world, 4)
        rows = rows_of(world, disc)
        x, y = world.positions.array()[rows].mean(0)
        run.near("height of the disc", y, 0.35, MEAN, 0.025, why="contact without a gap")
        run.near("where it is along the box", x, 0.0, 0.5, 0.025, why="symmetry; its seat is half a cell wide")
        run.check("rms speed", 1e3 * rms(world), 0, 5, "mm/s", why="0; a fifth of a cell per second")


@case(soft=dict(modulus=3e4, fall=0.15), stiff=dict(modulus=3e5, fall=0.3))
def bouncing_ball(run: Run, modulus: float, fall: float) -> None:
    """A ball that falls bounces; it stays on the floor for Hertz's time."""
    radius, poisson = 0.2, 0.3
    with run.world(3, 0.05) as world:
        floor = world.add_collider(Plane((0, 0, 0), (0, 1, 0)), friction_coefficient=0.3, measures_impulse=True)
        world.fill(Sphere((0, radius + fall, 0), radius), world.add_material(Elastic(young_modulus=modulus, poisson_ratio=poisson)))
        height, force = [], []

        def watch(_: float) -> None:
            height.append(world.positions.array()[:, 1].mean())
            force.append(abs(floor.impulse.linear[1]) * run.rate)

        run.steps(world, 1.2, after=watch)
        on = np.flatnonzero(np.array(force) > 0.02 * max(force))
        end = next((k for k in range(on[0], len(force)) if force[k] <= 0.02 * max(force)), len(force) - 1)
        speed, mass = math.sqrt(2 * G * fall), 1000 * 4 / 3 * math.pi * radius**3
        hertz = 2.94 * (15 * mass * speed**2 / (16 * math.sqrt(radius) * modulus / (1 - poisson**2))) ** 0.4 / speed
        run.check(
            "coefficient of restitution",
            math.sqrt(max(0.0, max(height[end:]) - radius) / fall),
            0.6,
            1.0,
            why="an elastic ball: 0.8 to 1, the rest goes to waves",
        )
        run.check("contact time over Hertz's", (end - on[0]) / run.rate / hertz, 0.75, 1.3, why="Hertz; a step is a tenth to a quarter of it")


@case(
    soft=dict(modulus=1e5),
    stiff=dict(modulus=2e5),
    three_d=dict(modulus=1e5, dimension=3),
    sideways=dict(modulus=1e5, angle=90.0),
    turned_20=dict(modulus=1e5, angle=20.0),
    face_above_nodes=dict(modulus=1e5, shift=0.02),
)
def hanging_bar(run: Run, modulus: float, dimension: int = 2, angle: float = 0.0, shift: float = 0.0) -> None:
    """A bar of 1 m that hangs from a ceiling stretches by rho g L^2 / (2 E)."""
    cell, poisson, length, half = 0.05, 0.3, 1.0, 0.1
    frame = Frame(dimension, angle, [0.0, shift * cell] + [0.0] * (dimension - 2))
    with run.world(dimension, cell, frame.gravity) as world:
        p = lattice([-half, -length] + [-half] * (dimension - 2), [half, 0.1] + [half] * (dimension - 2), cell / 2)
        world.add_particles(world.add_material(Elastic(young_modulus=modulus, poisson_ratio=poisson)), frame.out(p))
        low, high = [-1.0, 0.0] + [-1.0] * (dimension - 2), [1.0, 0.4] + [1.0] * (dimension - 2)
        world.add_collider(frame.box(low, high), friction=Friction.STICK)
        tip = []
        # The slowest swing takes 4 L sqrt(rho / E): 0.4 s at E = 1e5. The mean over four seconds is the balance.
        run.steps(world, 6, after=lambda t: tip.append(np.sort(frame.positions(world)[:, 1])[:8].mean()) if t > 2 else None)
        plane = 1 - poisson**2 if dimension == 2 else 1.0
        true = 1000 * G * length**2 / 2 * plane / modulus
        found = -(np.mean(tip) + length - cell / 4)
        slack = max(0.1 * true, 0.1 * cell)
        run.check(
            "stretch over true one",
            found / true,
            1 - slack / true,
            1 + slack / true,
            why="Hooke, plane strain in 2D; a tenth, and a tenth of a cell, for the grip of the ceiling",
        )


@case(slow=dict(speed=2.0, mu=0.3), fast=dict(speed=4.0, mu=0.5), three_d=dict(speed=2.0, mu=0.3, dimension=3))
def skid(run: Run, speed: float, mu: float, dimension: int = 2) -> None:
    """A block that is thrown along the floor stops after v^2 / (2 mu g)."""
    cell = 0.025 if dimension == 2 else 0.04
    frame = Frame(dimension)
    with run.world(dimension, cell) as world:
        _slope(run, world, frame, "plane", mu)
        world.fill(
            frame.box([-0.2, 0] + [-0.1] * (dimension - 2), [0.2, 0.2] + [0.1] * (dimension - 2)),
            world.add_material(Elastic(young_modulus=1e6)),
            velocity=[speed] + [0.0] * (dimension - 1),
        )
        start = world.positions.array()[:, 0].mean()
        run.steps(world, speed / (mu * G) + 1)
        way = world.positions.array()[:, 0].mean() - start
        run.check("way over true one", way / (speed**2 / (2 * mu * G)), 0.9, 1.1, why="Coulomb; " + SLOPE)
        run.check("rms speed afterwards", 1e3 * rms(world), 0, 5, "mm/s", why="0")


@case(slow=dict(spin=3.0), fast=dict(spin=10.0), three_d=dict(spin=6.0, dimension=3))
def spinning(run: Run, spin: float, dimension: int = 2) -> None:
    """A disc that spins in free space goes on spinning."""
    cell, radius = 0.025 if dimension == 2 else 0.04, 0.2
    with run.world(dimension, cell, [0.0] * dimension) as world:
        world.fill(Sphere([0.0] * dimension, radius), world.add_material(Elastic(young_modulus=1e6)))
        p = world.positions.array()
        p = p - p.mean(0)
        v = np.zeros_like(p)
        v[:, 0], v[:, 1] = -spin * p[:, 1], spin * p[:, 0]
        affine = np.zeros((len(p), dimension, dimension), np.float32)
        affine[:, 0, 1], affine[:, 1, 0] = -spin, spin
        world.set(Field.VELOCITY, v)
        world.set(Field.AFFINE_VELOCITY, affine)
        run.steps(world, 2)
        q, u = world.positions.array(), world.velocities.array()
        q = q - q.mean(0)
        turn = (q[:, 0] * u[:, 1] - q[:, 1] * u[:, 0]).sum() / (p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0]).sum()
        run.check("angular momentum over that of the start", turn, 0.95, 1.05, why="conserved; one in twenty over two seconds is not seen")
        size = np.sqrt((q[:, :2] ** 2).sum(1).mean() / (p[:, :2] ** 2).sum(1).mean())
        run.check("radius over that of the start", size, 0.98, 1.02, why="E = 1 MPa: the spin stretches it by less than 0.1 per cent")


@case(head_on=dict(offset=0.0))
def collision(run: Run, offset: float) -> None:
    """A disc hits one that rests, of the same mass, in free space: the momentum stays, and most of the speed goes over."""
    with run.world(2, 0.025, (0.0, 0.0)) as world:
        made = [world.add_material(Elastic(young_modulus=1e5)) for _ in range(2)]
        world.fill(Sphere((-0.3, offset), 0.2), made[0], velocity=(1.0, 0.0))
        world.fill(Sphere((0.3, 0.0), 0.2), made[1])
        run.steps(world, 1.2)
        v = world.velocities.array()
        first, second = (v[rows_of(world, m), 0].mean() for m in made)
        run.check("sum of the speeds over the first one's", first + second, 0.99, 1.01, why="momentum")
        run.check("restitution", second - first, 0.6, 1.0, why="two elastic discs: 0.8 to 1, the rest goes to waves")


@case(
    touching=dict(below=0),
    below_1=dict(below=1),
    below_2=dict(below=2),
    below_4_stiff=dict(below=4, modulus=1e6),
    beside_4=dict(beside=4),
    beside_4_stiff=dict(beside=4, modulus=1e6),
    beside_8_stiff=dict(beside=8, modulus=1e6),
    beside_10_stiff=dict(beside=10, modulus=1e6),
)
def falls_from(run: Run, below: float | None = None, beside: float = 0.0, modulus: float = 1e5) -> None:
    """A block is let go so many cells below or beside another one, which is held: it falls freely."""
    cell, half, seconds = 0.025, 0.1, 0.5
    with run.world(2, cell) as world:
        held, free = (world.add_material(Elastic(young_modulus=modulus)) for _ in range(2))
        world.add_collider(Box((0, 0.2), (1, 0.1)), friction=Friction.STICK)
        world.fill(Box((0, 0), (half, half)), held)
        away = (0.0, -2 * half - below * cell) if below is not None else (2 * half + beside * cell, -half)
        world.fill(Box(away, (half, half)), free)
        start = world.positions.array()[rows_of(world, free), 1].mean()
        run.steps(world, seconds)
        way = start - world.positions.array()[rows_of(world, free), 1].mean()
        run.check("way over true one", way / (G * seconds * (seconds + run.dt) / 2), 0.9, 1.1, why="nothing holds it: Galilei; a tenth")


@case(
    near=dict(),
    nearer=dict(away=4),
    stiff=dict(modulus=1e7),
    cube=dict(dimension=3),
)
def lands_beside(run: Run, away: float = 6.0, modulus: float = 1e6, dimension: int = 2) -> None:
    """A ball falls on the floor so many cells beside a block that lies there."""
    cell, half, height = 0.025, 0.15, 0.5
    with run.world(dimension, cell) as world:
        lying, falling = (world.add_material(Elastic(young_modulus=modulus)) for _ in range(2))
        world.add_collider(Plane((0, 0, 0)[:dimension], (0, 1, 0)[:dimension]), friction_coefficient=0.5)
        world.fill(Box((0, half, 0)[:dimension], (half,) * dimension), lying)
        run.steps(world, 1)
        world.fill(Sphere((-half - away * cell - 0.1, 0.1 + height, 0)[:dimension], 0.1), falling)
        fastest = 0.0

        def look(_: float) -> None:
            nonlocal fastest
            block, ball = rows_of(world, lying), rows_of(world, falling)
            if world.positions.array()[block, 0].min() - world.positions.array()[ball, 0].max() > 3 * cell:
                fastest = max(fastest, float(np.linalg.norm(world.velocities.array()[block].mean(axis=0))))

        run.steps(world, 0.5, after=look)
        run.check("speed of the block until it is touched", fastest, 0.0, 0.01, why="nothing touches it; at that speed a cell takes 2.5 s")


@case(stands=dict(yield_strain=0.05, stands=True), flows=dict(yield_strain=0.0005, stands=False))
def clay(run: Run, yield_strain: float, stands: bool) -> None:
    """A block of clay stands when its own weight is below what it bears, else it slumps."""
    side, modulus = 0.4, 1e6
    with run.world(2, 0.025) as world:
        world.add_collider(Plane((0, 0), (0, 1)), friction_coefficient=1.0)
        world.fill(Box((0, side / 2), (side / 2, side / 2)), world.add_material(Visco(young_modulus=modulus, yield_strain=yield_strain, flow_rate=1e4)))
        run.steps(world, 3)
        high = world.positions.array()[:, 1].mean() / (side / 2)
        # Shear at the foot: rho g h / 2 = 2 kPa; yield stress sqrt(2) mu yield_strain = 27 and 0.27 kPa.
        if stands:
            run.check("mean height over that of the start", high, 0.96, 1.01, why="yield stress of 27 kPa against 2 kPa")
        else:
            # Bingham's heap at rest is sqrt(2 tau (L - x) / (rho g)) high: of this area its mean height is 0.35 of the block's.
            run.check("mean height over that of the start", high, 0.25, 0.6, why="lubrication theory: 0.35; a block keeps a steeper middle")
