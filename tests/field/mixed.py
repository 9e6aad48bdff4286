"""Several kinds of matter, and rigid bodies, in one world."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from harness import G, SURFACE, Frame, Run, case, lattice, pool, rms, rows_of, tank
from pbmpm import Box, Elastic, Friction, Liquid, Plane, Region, RigidBody, Sand, Sphere, Visco

FLOATS = "Archimedes, of a body that water and its weight press as Hooke says; 0.4 cells"
SPIN = "what floats does not go on turning; half a radian per second is what is left of its rocking"


def _wet_share(y: np.ndarray, level: float, spacing: float) -> float:
    """Share of a body below a level; a particle at the level counts half."""
    return float(np.clip((level - y) / spacing + 0.5, 0, 1).mean())


def _draught(density: float, side: float, modulus: float, dimension: int) -> float:
    """Share of a floating cube that is below the level. Its weight presses that part by density g side (1 - s / 2) in the mean, and water by half of what it has at
    its bottom from each side; it displaces less by their mean over its bulk modulus (of plane strain in 2D)."""
    share, poisson = density / 1000, 0.3
    shear = modulus / (2 * (1 + poisson))
    bulk = 2 * shear * poisson / (1 - 2 * poisson) + 2 * shear / dimension
    pressure = (density * G * side * (1 - share / 2) + (dimension - 1) * 1000 * G * share * side / 2) / dimension
    return share / (1 - pressure / bulk)


def _level(world: Any, frame: Frame, width: float, centre: float, reach: float) -> float:
    """Of the water beside a body that may drift; a tenth of the width in front of it in 3D."""
    across = [0.1 * width] * (frame.dimension - 2)
    return float(frame.levels(world, [[x, 0.0, *across] for x in np.linspace(0.04, 0.96, 24) * width if abs(x - centre) > reach]).mean())


@case(
    light=dict(density=300),
    half=dict(density=500),
    heavy=dict(density=800),
    stiff=dict(density=500, modulus=1e6),
    small=dict(density=500, cells=6),
    disc=dict(density=500, round=True),
    boxes=dict(density=500, walls="boxes"),
    light_3d=dict(density=300, dimension=3),
    heavy_3d=dict(density=800, dimension=3),
)
def floats(run: Run, density: float, modulus: float = 5e4, cells: int = 10, round: bool = False, walls: str = "domain", dimension: int = 2) -> None:  # noqa: A002
    """A jelly floats as deep as its density says."""
    cell = 0.04 if dimension == 2 else 0.06
    cells = cells if dimension == 2 else 6
    side = cells * cell
    width, depth = (1.6, 0.64) if dimension == 2 else (1.08, 0.54)
    middle = [width / 2] * (dimension - 2)
    domain = ([0.0] * dimension, [width, 1.6] + [width] * (dimension - 2)) if walls == "domain" else None
    frame = Frame(dimension)
    with run.world(dimension, cell, domain=domain) as world:
        if walls != "domain":
            tank(world, frame, width, 1.5, walls)
        water = pool(world, frame, [0.0] * dimension, [width, depth] + [width] * (dimension - 2), Liquid())
        jelly = world.add_material(Elastic(density=density, young_modulus=modulus))
        at = [width / 2, depth + side / 2 + cell] + middle
        volume = math.pi * side**2 / 4 if round else side**dimension
        world.fill(Sphere(at, side / 2) if round else Box(at, [side / 2] * dimension), jelly)
        seconds = 5 if dimension == 2 else 2.5
        shares, levels = [], []

        def watch(t: float) -> None:
            if t > seconds - 1:
                p = world.positions.array()[rows_of(world, jelly)]
                levels.append(_level(world, frame, width, p[:, 0].mean(), 0.71 * side + 2 * cell))
                shares.append(_wet_share(p[:, 1], levels[-1], cell / 2))

        run.steps(world, seconds, after=watch)
        high = side if not round else side * math.pi / 4  # mean height of a disc
        slack, true = 0.4 * cell / high, _draught(density, high, modulus, dimension)
        run.check("share below the level", np.mean(shares), true - slack, true + slack, why=FLOATS)
        run.near("level", np.mean(levels), depth + volume * density / 1000 / width ** (dimension - 1), SURFACE, cell, why="water keeps its volume")
        assert water


@case(jelly=dict(density=1500, modulus=1e5), clay=dict(density=1800, modulus=5e5))
def sinks(run: Run, density: float, modulus: float) -> None:
    """What is heavier than water lies on the bottom, and the level rises by its volume. Waves of a length of the tank stand there for long, with a period of
    2 pi / sqrt(g k tanh(k depth)) = 1.02 s (Airy). Beside the body alone one instant sees their crest, so the level is the mean of a second."""
    cell, width, depth, side = 0.04, 1.6, 0.64, 0.32
    with run.world(2, cell, domain=((0, 0), (width, 1.6))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        body = world.add_material(Elastic(density=density, young_modulus=modulus))
        world.fill(Box((width / 2, depth + side / 2 + cell), (side / 2, side / 2)), body)
        levels = []

        def watch(_: float) -> None:
            centre = world.positions.array()[rows_of(world, body), 0].mean()
            levels.append(_level(world, Frame(), width, centre, 0.71 * side + 2 * cell))

        run.steps(world, 4)
        run.steps(world, 1, after=watch)
        y = world.positions.array()[rows_of(world, body), 1].mean()
        run.near("height of its centre", y, side / 2, 0.4, cell, why="it lies on the bottom; 0.4 cells")
        run.near("level", np.mean(levels), depth + side**2 / width, SURFACE, cell, why="both keep their volume")


@case(half_again=dict(density=1500), double=dict(density=2000), lead=dict(density=8000), light=dict(density=500))
def block_falls_in(run: Run, density: float) -> None:
    """A hard block falls into a pool of 20 cells and makes waves. They go on for a while, but nothing drives them."""
    cell, width, depth, side, half_time, time = 0.05, 2.0, 1.0, 0.3, 4.0, 10.0
    with run.world(2, cell, domain=((0, 0), (width, 2.0))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        block = world.add_material(Elastic(density=density, young_modulus=1e6))
        world.fill(Box((width / 2, depth + side / 2 + cell), (side / 2, side / 2)), block)

        def energy() -> float:
            mass = np.where(rows_of(world, block), density, 1000) * (cell / 2) ** 2
            return float((mass * (0.5 * (world.velocities.array() ** 2).sum(1) + G * world.positions.array()[:, 1])).sum())

        run.steps(world, half_time)
        before = energy()
        run.steps(world, time - half_time)
        fall = density * side**2 * G * (side + cell)
        gain = (energy() - before) / fall
        run.check("energy gained from 4 s to 10 s over that of the fall", gain, -math.inf, 0.02, why="nothing drives it; 2 % as in random_scenes.py")
        if density > 1000:
            place = world.positions.array()[rows_of(world, block), 0].mean()
            run.near("place of the block", place, width / 2, side / 2 / cell, cell, why="it lies on the bottom: half of its width")


@case(two_cells=dict(gap=2, density=2000), three_cells=dict(gap=3, density=2000), five_cells=dict(gap=5, density=2000), up_three_cells=dict(gap=3, density=500))
def in_a_narrow_glass(run: Run, gap: int, density: float) -> None:
    """A block of six cells between walls: water goes around it, so it sinks or comes up."""
    cell, side, depth = 0.05, 0.3, 1.2
    width = side + 2 * gap * cell
    with run.world(2, cell, domain=((0, 0), (width, 2.2))) as world:
        places = lattice((0, 0), (width, depth), cell / 2)
        inside = (abs(places - (width / 2, depth / 2)) < side / 2).all(1)
        world.add_particles(world.add_material(Liquid()), places[~inside])
        block = world.add_material(Elastic(density=density, young_modulus=1e6))
        world.add_particles(block, places[inside])
        run.steps(world, 5)
        true = side / 2 if density > 1000 else depth - (density / 1000 - 0.5) * side
        run.near("height of its centre", world.positions.array()[rows_of(world, block), 1].mean(), true, 1.0, cell, why="at the bottom, or afloat; a cell")


@case(thin=dict(thick=2), thick=dict(thick=4))
def jelly_in_a_glass(run: Run, thick: int) -> None:
    """A glass of 24 x 20 cells, its walls so many cells thick: a heavy jelly falls in and sinks, and the water rests over it."""
    cell, width, depth, side, time = 0.025, 0.6, 0.5, 0.2, 10.0
    frame = Frame(2)
    with run.world(2, cell) as world:
        tank(world, frame, width, 0.9, "boxes", thick=thick * cell)
        water = pool(world, frame, (0, 0), (width, depth), Liquid())
        jelly = world.add_material(Elastic(density=1500))
        world.fill(Box((width / 2, depth + side), (side / 2, side / 2)), jelly)
        run.steps(world, time)
        wet = rows_of(world, water)
        height = 2 * world.positions.array()[wet, 1].mean()
        # The water's mean height: that of the full glass less the jelly's, which lies on the floor and has the share J of its volume.
        volume = side**2 * float(world.volume_ratios.array()[~wet].mean())
        full = depth + volume / width
        true = 2 * (width * full**2 / 2 - volume * side / 2) / (width * full - volume)
        run.near("mean level", height, true, 0.5, cell, why="the glass is full, its water keeps its volume")
        run.check("rms speed", float(np.sqrt((world.velocities.array() ** 2).sum(1).mean())), 0, 0.02, "m/s", why="at rest in the end; 24 cells deep")


@case(
    stiff=dict(density=2500, modulus=1e7),
    jelly=dict(density=1500, modulus=1e5),
    clay=dict(density=1800, modulus=1e5, yields_at=0.05),
    stiff_off=dict(density=2500, modulus=1e7, off=0.5),
    jelly_off=dict(density=1500, modulus=1e5, off=0.5),
    clay_off=dict(density=1800, modulus=1e5, yields_at=0.05, off=0.5),
)
def over_the_floor(run: Run, density: float, modulus: float, yields_at: float = 0.0, off: float = 0.0) -> None:
    """A pool of 20 cells over a body of 8, which starts a cell above the floor; all lies so many cells off the grid."""
    cell, width, depth, half = 0.025, 0.6, 0.5, 0.1
    start = off * cell
    kind = Visco(density=density, young_modulus=modulus, yield_strain=yields_at) if yields_at else Elastic(density=density, young_modulus=modulus)
    with run.world(2, cell, domain=((start, start), (start + width, start + 2.5 * depth))) as world:
        places = lattice((0, 0), (width, depth), cell / 2)
        inside = (abs(places - (width / 2, half + cell)) < half).all(1)
        world.add_particles(world.add_material(Liquid()), start + places[~inside])
        world.add_particles(world.add_material(kind), start + places[inside])
        run.steps(world, 8)
        run.near("level", 2 * (world.positions.array()[:, 1].mean() - start), depth, 0.25, cell, why="water and body keep their volume; a quarter of a cell is little over one percent")
        run.check("rms speed", rms(world), 0, 0.01, "m/s", why="nothing moves, as in a pool by itself")


@case(slow=dict(cells=1.5), fast=dict(cells=5.0))
def water_hits_jelly(run: Run, cells: float) -> None:
    """A block of water of 8 cells hits a jelly of 12 at so many cells per step, in free space, and flows around it."""
    cell = 0.025
    with run.world(2, cell, gravity=(0, 0)) as world:
        water, jelly = world.add_material(Liquid()), world.add_material(Elastic(young_modulus=1e5))
        world.fill(Box((0, 0), (6 * cell, 6 * cell)), jelly)
        world.fill(Box((-14 * cell, 0), (4 * cell, 4 * cell)), water, velocity=(cells * cell * run.rate, 0))
        run.steps(world, 30 / cells / run.rate)
        wet = rows_of(world, water)
        p = world.positions.array()
        way = p[wet][:, None] - p[~wet][None]
        near = (way**2).sum(2) < cell**2
        around = [(near & (x * way[..., 0] > 0) & (y * way[..., 1] > 0)).any(1) for x in (-1, 1) for y in (-1, 1)]
        run.check("share of the water inside the jelly", np.all(around, 0).mean(), 0, 0.01, why="inside: jelly within a cell in all four quarters; a jelly has no holes")


@case(from_half_a_metre=dict())
def dropped_jelly(run: Run) -> None:
    """A jelly of 5e4 Pa that falls half a metre into water is pressed by the fall as elasticity lets it, and keeps its form afterwards."""
    cell, width, depth, side = 0.04, 1.6, 0.64, 0.4
    with run.world(2, cell, domain=((0, 0), (width, 2.4))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        jelly = world.add_material(Elastic(density=800, young_modulus=5e4))
        world.fill(Box((width / 2, depth + 0.5 + side / 2), (side / 2, side / 2)), jelly)
        strain = []

        def watch(t: float) -> None:
            f = world.deformations.array().reshape(-1, 2, 2)[rows_of(world, jelly)].astype(float)
            strain.append(math.sqrt(((np.linalg.svd(f, compute_uv=False) - 1) ** 2).sum(1).mean()))

        run.steps(world, 5, after=watch)
        # Plane modulus 67 kPa: waves travel at 9.2 m/s, and a body that is stopped dead is strained by v / c.
        run.check("largest rms strain", max(strain), 0.0, 0.34, why="water stops it less than a wall would: v / c with v = sqrt(2 g h)")
        run.check("rms strain in the end", strain[-1], 0.0, 0.05, why="hydrostatics around a floating square: 0.027; twice that is another body")


@case(jelly=dict(young_modulus=1e5), stiff=dict(young_modulus=1e6), slosh=dict(young_modulus=1e6, room=8))
def turns_in_water(run: Run, young_modulus: float, room: int = 0) -> None:
    """A block turns in a closed box of water, without gravity; full, or with room above. Nothing drives it."""
    cell, cells, side, spin = 0.025, 24, 8, 2.0
    width = cells * cell
    with run.world(2, cell, domain=((0, 0), (width, width + room * cell)), gravity=(0, 0)) as world:
        places = lattice((0, 0), (width, width), cell / 2)
        r = places - width / 2
        inside = (abs(r) < side * cell / 2).all(1)
        block = world.add_material(Elastic(young_modulus=young_modulus))
        world.add_particles(block, places[inside], velocities=spin * np.stack([-r[inside, 1], r[inside, 0]], 1))
        world.add_particles(world.add_material(Liquid()), places[~inside])
        run.steps(world, 1)
        before = rms(world)
        run.steps(world, 9)
        run.check("rms speed after 10 s over that after 1 s", rms(world) / before, 0, 1, why="energy does not grow")


@case(alone=dict(), loaded=dict(load=1500), laid=dict(load=1500, gap=0), higher=dict(gap=1.3), much_higher=dict(gap=3))
def wide_raft(run: Run, load: float = 0.0, gap: float = 1) -> None:
    """A rigid raft of 30 x 5 cells falls by `gap` cells onto water, with a hard box as high above its middle or without. Nothing tips it."""
    cell, width, depth, long, high, side = 0.02, 1.6, 0.4, 0.6, 0.1, 0.12
    with run.world(2, cell, domain=((0, 0), (width, 1.0))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        middle = depth + gap * cell + high / 2
        raft = RigidBody(world.add_collider(Box((width / 2, middle), (long / 2, high / 2)), kinematic=True, measures_impulse=True), density=400)
        if load:
            box = world.add_material(Elastic(density=load, young_modulus=1e6))
            world.fill(Box((width / 2, middle + high / 2 + gap * cell + side / 2), (side / 2, side / 2)), box)
        tilts, speeds = [], []

        def after(_: float) -> None:
            _, _, z, w = raft.rotation
            tilts.append(abs(2 * math.degrees(math.atan2(z, w))))
            speeds.append(world.stats.max_speed)

        run.steps(world, 4, before=lambda _: raft.advance(run.dt), after=after)
        run.check("largest tilt", max(tilts), 0, 10, "degrees", why="it is as wide as six of its heights, and loaded in the middle: what waves do")
        run.check("fastest", max(speeds), 0, math.sqrt(2 * G * depth), "m/s", why="what falls from the level to the floor")


@case(half=dict(density=500), light=dict(density=250), turned=dict(density=500, angle=0.4))
def rigid_box(run: Run, density: float, angle: float = 0.0) -> None:
    """A rigid box that impulses move floats as deep as its density says."""
    cell, width, depth, side = 0.04, 1.6, 0.64, 0.4
    with run.world(2, cell, domain=((0, 0), (width, 2))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        start = np.array([width / 2, depth + side])
        box = world.add_collider(Box(start.tolist(), (side / 2, side / 2), rotation=angle), friction=Friction.SLIP, kinematic=True, measures_impulse=True)
        body = RigidBody(box, density=density)
        under, levels, turns = [], [], []

        def before(_: float) -> None:
            body.advance(run.dt)

        def after(t: float) -> None:
            if t > 6:
                turns.append(abs(body.angular_velocity[2]))
                levels.append(_level(world, Frame(), width, body.position[0], 0.71 * side + 2 * cell))
                _, _, z, w = body.rotation
                c, s = w * w - z * z, 2 * z * w
                inside = lattice((-side / 2, -side / 2), (side / 2, side / 2), cell / 4) @ np.array([[c, s], [-s, c]]) + np.array(body.position)
                under.append(_wet_share(inside[:, 1], levels[-1], cell / 4))

        run.steps(world, 8, before=before, after=after)
        slack = 0.4 * cell / side
        run.check("share below the level", np.mean(under), density / 1000 - slack, density / 1000 + slack, why=FLOATS)
        run.check(
            "mean spin",
            np.mean(turns),
            0,
            0.5,
            "rad/s",
            why=SPIN,
        )
        run.near("level", np.mean(levels), depth + side**2 * density / 1000 / width, SURFACE, cell, why="water keeps its volume")


def _floats_in_3d(run: Run, shape: Box | Sphere, density: float, depth: float, afloat: float) -> None:
    """A rigid body is put on water. After four seconds its centre is `afloat` above the level before, and it turns no more."""
    cell, width = 0.025, 0.4
    with run.world(3, cell, domain=((0, 0, 0), (width, depth + 0.3, width))) as world:
        pool(world, Frame(3), (0, 0, 0), (width, depth, width), Liquid())
        body = RigidBody(world.add_collider(shape, friction=Friction.SLIP, kinematic=True, measures_impulse=True), density=density)
        heights, turns = [], []

        def after(t: float) -> None:
            if t > 4:
                heights.append(body.position[1])
                turns.append(float(np.linalg.norm(body.angular_velocity)))

        run.steps(world, 6, before=lambda _: body.advance(run.dt), after=after)
        run.near("height of its centre", np.mean(heights), depth + afloat, 0.8, cell, why="Archimedes; a fifth of a height of four cells")
        run.check("mean spin", np.mean(turns), 0, 0.5, "rad/s", why=SPIN)


@case(light=dict(density=400), ice=dict(density=800), deep=dict(density=917, depth=0.4))
def rigid_cube(run: Run, density: float, depth: float = 0.2) -> None:
    """A rigid cube of four cells, turned, is put on water of 8 or 16 cells and floats as deep as its density says, without turning on."""
    width, side, share = 0.4, 0.1, density / 1000
    cube = Box((width / 2, depth + side / 2, width / 2), (side / 2,) * 3, rotation=(0.0, math.sin(0.25), 0.0, math.cos(0.25)))
    _floats_in_3d(run, cube, density, depth, side**3 * share / width**2 + (0.5 - share) * side)


@case(half=dict())
def rigid_ball(run: Run) -> None:
    """A ball of six cells and half of water's density sinks in by half. Nothing can turn what is round and slips."""
    width, depth, radius = 0.4, 0.3, 0.075
    ball = Sphere((width / 2, depth + radius, width / 2), radius)
    _floats_in_3d(run, ball, 500, depth, 2 / 3 * math.pi * radius**3 / width**2)


@case(sand_heap=dict(what="sand"), water_drop=dict(what="water"), clay=dict(what="clay"), water_3d=dict(what="water", dimension=3))
def far_away(run: Run, what: str, dimension: int = 2) -> None:
    """Other matter somewhere else changes nothing for a bar that hangs."""
    cell, tips = 0.05, []
    kinds = {"sand": Sand(density=1600, young_modulus=1e6), "water": Liquid(), "clay": Visco(young_modulus=1e6)}
    last = [0.0] * (dimension - 2)
    for other in (False, True):
        with run.world(dimension, cell) as world:
            bar = world.add_material(Elastic(young_modulus=1e5))
            p = lattice([-0.1, -1.0] + [-0.1] * (dimension - 2), [0.1, 0.1] + [0.1] * (dimension - 2), cell / 2)
            ids = world.add_particles(bar, p)
            world.add_collider(Box([0.0, 0.2] + last, [1.0, 0.2] + [1.0] * (dimension - 2)), friction=Friction.STICK)
            world.add_collider(Plane([0.0, -2.0] + last, [0.0, 1.0] + last), friction_coefficient=0.8)
            if other:
                world.fill(Box([1.5, -1.85] + last, [0.2, 0.15] + [0.2] * (dimension - 2)), world.add_material(kinds[what]))
            run.steps(world, 1.5)
            tips.append(world.positions.array()[world.find(ids[p[:, 1] < -0.95])][:, 1].mean())
            if other:
                run.check("modulus that the bar claims over its own", bar.effective(run.dt).young_modulus / 1e5, 0.95, 1.05, why="it is the material's own")
    run.check("what the other matter moves the tip by", 1e3 * abs(tips[1] - tips[0]), 0, 5, "mm", why="nothing joins them; a tenth of a cell")


@case(light_above=dict(above=800, below=1000), far_apart=dict(above=500, below=2000))
def two_liquids(run: Run, above: float, below: float) -> None:
    """A light liquid lies on a heavy one, both at rest."""
    cell, width, depth = 0.04, 1.2, 0.32
    with run.world(2, cell, domain=((0, 0), (width, 1.6))) as world:
        water = pool(world, Frame(), (0, 0), (width, depth), Liquid(density=below))
        oil = pool(world, Frame(), (0, depth), (width, 2 * depth), Liquid(density=above), seed=2)
        speed = []
        run.steps(world, 6, after=lambda t: speed.append(rms(world)) if t > 5 else None)
        y = world.positions.array()[:, 1]
        run.check("rms speed", np.mean(speed), 0, 0.01, "m/s", why="0; a quarter of a cell per second")
        run.near(
            "mean height of the heavy one",
            y[rows_of(world, water)].mean(),
            depth / 2,
            SURFACE,
            cell,
            why="layers keep their order and volume; the border is known to a particle",
        )
        run.near("mean height of the light one", y[rows_of(world, oil)].mean(), 1.5 * depth, SURFACE, cell, why="layers keep their order and volume")


@case(heavy_above=dict())
def turns_over(run: Run) -> None:
    """A heavy liquid on a light one comes down (Rayleigh and Taylor), and the level stays."""
    cell, width, depth = 0.04, 0.8, 0.32
    with run.world(2, cell, domain=((0, 0), (width, 1.6))) as world:
        oil = pool(world, Frame(), (0, 0), (width, depth), Liquid(density=500))
        water = pool(world, Frame(), (0, depth), (width, 2 * depth), Liquid(density=1500), seed=2)
        run.steps(world, 8)
        y = world.positions.array()[:, 1]
        run.check(
            "height of the light one over that of the heavy one",
            y[rows_of(world, oil)].mean() / y[rows_of(world, water)].mean(),
            1.4,
            3.2,
            why="parted they are at 1 to 3; half mixed still above 1.4",
        )
        run.near("mean height of all", y.mean(), depth, SURFACE, cell, why="both keep their volume")


@case(poured=dict())
def sand_in_water(run: Run) -> None:
    """Sand that is poured into a tank of water lies on the bottom, and the level rises by its volume."""
    cell, width, depth = 0.04, 1.2, 0.48
    with run.world(2, cell, domain=((0, 0), (width, 1.6))) as world:
        pool(world, Frame(), (0, 0), (width, depth), Liquid())
        grains = world.add_material(Sand(density=2000, young_modulus=1e6))
        emitter = world.add_emitter(Sphere((width / 2, 1.2), 0.06), grains, 0.12, region=Region.DISC, speed=1.0)
        run.steps(world, 1)
        emitter.enabled = False
        run.steps(world, 4)
        volume = emitter.status.emitted_mass / 2000
        level = Frame().levels(world, [[x * width, 0] for x in np.linspace(0.1, 0.9, 15)]).mean()
        y = world.positions.array()[rows_of(world, grains), 1]
        run.near("level", level, depth + volume / width, SURFACE, cell, why="both keep their volume")
        run.check(
            "mean height of the sand",
            y.mean() / math.sqrt(volume * math.tan(math.radians(30))),
            0.1,
            0.45,
            why="at the bottom: a heap of 30 degrees is sqrt(V tan 30) high, its mean a third",
        )
        run.check("rms speed of the sand", 1e3 * rms(world, rows_of(world, grains)), 0, 10, "mm/s", why="it has come to rest")


@case(cube=dict(), heavy=dict(density=2500.0, young_modulus=1e6), dropped=dict(fall=0.2), dropped_heavy=dict(fall=0.2, density=2500.0), off_grid=dict(shift=0.4), three_d=dict(dimension=3))
def jelly_on_sand(run: Run, density: float = 800.0, young_modulus: float = 1e5, fall: float = 0.0, shift: float = 0.0, dimension: int = 2) -> None:
    """A jelly cube on a bed of sand stays on top and rests."""
    cell, width = (0.025, 0.8) if dimension == 2 else (0.04, 0.64)
    middle, half = width / 2, 4 * cell if dimension == 2 else 3 * cell
    frame, bed = Frame(dimension, 0, shift * cell), 8 * cell
    with run.world(dimension, cell) as world:
        tank(world, frame, width, 0.8, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=0.5)
        pool(world, frame, [0.0] * dimension, [width, bed] + [width] * (dimension - 2), Sand(density=1600, young_modulus=1e6))
        low, high = np.full(dimension, middle - half), np.full(dimension, middle + half)
        low[1], high[1] = bed + fall, bed + fall + 2 * half
        jelly = pool(world, frame, low, high, Elastic(density=density, young_modulus=young_modulus))
        run.steps(world, 3)
        rows = rows_of(world, jelly)
        p = frame.positions(world)
        # A crater of 0.14 / tan(phi) sqrt(density over that of sand) D^(2/3) H^(1/3) (Uehara 2003).
        crater = 0.14 / math.tan(math.pi / 6) * math.sqrt(density / 1600) * (2 * half) ** (2 / 3) * fall ** (1 / 3)
        run.check(
            "height of the cube, off by",
            (p[rows, 1].mean() - bed - half) / cell,
            -crater / cell - SURFACE,
            SURFACE,
            "cells",
            why="the bed bears many times its weight (Prandtl); what falls on sand makes a crater of that depth at most (Uehara 2003)",
        )
        run.near("mean height of the bed", p[~rows, 1].mean(), bed / 2, 0.25, cell, why="grains keep their volume")
        run.check("rms speed", 1e3 * rms(world), 0, 10, "mm/s", why="all rests")


@case(crate=dict(), four_substeps=dict(substeps=4))
def rigid_on_sand(run: Run, substeps: int = 1) -> None:
    """A rigid crate that is put on a bed of sand stands there."""
    cell, bed, half = 0.025, 0.2, 0.125
    with run.world(2, cell, domain=((0, 0), (3, 1.5)), domain_friction=0.6, substeps=substeps) as world:
        pool(world, Frame(), (0, 0), (3, bed), Sand(density=1600))
        run.steps(world, 1)
        box = world.add_collider(Box((1.5, bed + half), (half, half)), kinematic=True, measures_impulse=True, friction_coefficient=0.5)
        crate = RigidBody(box, density=600)
        run.steps(world, 10, before=lambda t: crate.advance(run.dt))
        tilt = math.degrees(2 * math.asin(crate.rotation[2]))
        run.check("tilt", abs(tilt), 0, 3, "degrees", why="the bed is level; half a cell at one edge of ten is 3 degrees")
        run.check("height, off by", (crate.position[1] - bed - half) / cell, -1, 0.5, "cells", why="the bed bears many times its weight (Prandtl)")


@case(domain=dict(walls="domain"), boxes_off=dict(walls="boxes"))
def all_in_a_tank(run: Run, walls: str) -> None:
    """Water, jelly, sand and clay in one tank: all is still there, fills its volume and comes to rest."""
    cell, width, depth, side = 0.04, 1.6, 0.48, 0.24
    frame = Frame(2, 0, 0.0 if walls == "domain" else 0.3 * cell)
    with run.world(2, cell, domain=((0, 0), (width, 1.6)) if walls == "domain" else None) as world:
        if walls != "domain":
            tank(world, frame, width, 1.5, walls)
        pool(world, frame, (0, 0), (width, depth), Liquid())
        bodies = [
            (0.3, Elastic(density=500, young_modulus=5e4)),
            (0.8, Sand(density=1800, young_modulus=1e6)),
            (1.3, Visco(density=1800, young_modulus=5e5, yield_strain=0.05)),
        ]
        for x, parameters in bodies:
            pool(world, frame, (x - side / 2, depth + cell), (x + side / 2, depth + cell + side), parameters)
        count, speed, levels = len(world), [], []

        def watch(t: float) -> None:
            if t > 9:
                speed.append(rms(world))
                levels.append(frame.levels(world, [[x, 0] for x in (0.05, 0.1, 0.55, 1.05, 1.5, 1.55)]).mean())

        run.steps(world, 10, after=watch)
        run.check("particles over those of the start", len(world) / count, 1, 1, why="nothing is lost")
        run.near("level", np.mean(levels), depth + 2.5 * side**2 / width, SURFACE, cell, why="all keep their volume; the jelly floats half under")
        run.check("rms speed", np.mean(speed), 0, 0.02, "m/s", why="0; half a cell per second")
