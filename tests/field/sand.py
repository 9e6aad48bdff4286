"""Sand: in bins, piles, on slopes, out of funnels and silos."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from harness import G, MEAN, SURFACE, Frame, Run, case, lattice, pool, rms, tank
from pbmpm import Box, Friction, Plane, Region, Sand, Sphere

CREEP = "sand below its angle of repose rests; 1 mm/s is three cells per minute"
CELL = 0.02


def _sand(degrees: float = 30.0, **more: Any) -> Sand:
    return Sand(density=1600, friction_angle=math.radians(degrees), **{"young_modulus": 1e6, **more})


def _creep(run: Run, world: Any, frame: Frame, seconds: float) -> float:
    """Speed of the centre of mass over some seconds [mm/s]."""
    start = frame.positions(world).mean(0)
    run.steps(world, seconds)
    return 1e3 * float(np.linalg.norm(frame.positions(world).mean(0) - start)) / seconds


@case(
    phi_20=dict(phi=20),
    phi_40=dict(phi=40),
    turned_20=dict(phi=30, angle=20.0),
    off_grid=dict(phi=30, shift=0.4),
    light=dict(phi=30, density=500.0),
    three_d=dict(phi=30, dimension=3),
    thin=dict(phi=30, shift=0.5, thick=1),
    thin_on_grid=dict(phi=30, thick=2),
    thin_3d=dict(phi=30, shift=0.75, dimension=3, thick=1),
)
def bin(run: Run, phi: float, angle: float = 0.0, shift: float = 0.0, density: float = 1600.0, dimension: int = 2, thick: float | None = None) -> None:  # noqa: A001
    """Sand that fills a bin of 20 x 15 cells (3D: 8 x 8 x 8), with walls of 0.1 m or `thick` cells, stays as high as it is."""
    cell = CELL if dimension == 2 else 0.04
    w, h = (0.4, 0.3) if dimension == 2 else (0.32, 0.32)
    frame = Frame(dimension, angle, shift * cell)
    with run.world(dimension, cell, frame.gravity) as world:
        tank(world, frame, w, 0.5, "boxes", thick=thick * cell if thick else 0.1, friction=Friction.COULOMB, friction_coefficient=0.4)
        grains = Sand(density=density, young_modulus=1e6, friction_angle=math.radians(phi))
        pool(world, frame, [0.0] * dimension, [w, h] + [w] * (dimension - 2), grains)
        run.steps(world, 2)
        run.near("mean height", frame.positions(world)[:, 1].mean(), h / 2, MEAN, cell, why="grains keep their volume")
        run.check("rms speed", 1e3 * rms(world), 0, 5, "mm/s", why="sand in a bin rests")
        run.check("creep", _creep(run, world, frame, 1), 0, 1, "mm/s", why=CREEP)


@case(slope_25_phi_35=dict(slope=25, phi=35), slope_15_phi_30=dict(slope=15, phi=30), slope_25_off_grid=dict(slope=25, phi=35, shift=0.4))
def pile_stays(run: Run, slope: float, phi: float, shift: float = 0.0) -> None:
    """A pile that is flatter than its angle of repose stays."""
    half, frame = 0.5, Frame(2, 0, shift * CELL)
    steep = math.tan(math.radians(slope))
    with run.world(2, CELL) as world:
        world.add_collider(frame.plane((0, 0), (0, 1)), friction_coefficient=1.0)
        p = lattice((-half, 0), (half, half * steep), CELL / 2)
        p = p[p[:, 1] < (half - np.abs(p[:, 0])) * steep]
        world.add_particles(world.add_material(_sand(phi)), frame.out(p))
        run.steps(world, 2)
        q = frame.positions(world)
        # Volume and moments of a triangle: the slope is that of the isosceles one with the same spread and height.
        ratio = q[:, 1].mean() / np.abs(q[:, 0]).mean() / (p[:, 1].mean() / np.abs(p[:, 0]).mean())
        run.check("steepness over that of the start", ratio, 0.95, 1.05, why="a pile below its angle of repose keeps its form; a degree is 5 per cent")
        run.check(
            "volume by its mean height and spread",
            q[:, 1].mean() * np.abs(q[:, 0]).mean() / (p[:, 1].mean() * np.abs(p[:, 0]).mean()),
            0.95,
            1.05,
            why="grains keep their volume",
        )
        run.check("creep", _creep(run, world, frame, 1), 0, 1, "mm/s", why=CREEP)


@case(phi_30=dict(phi=30), phi_35=dict(phi=35), phi_25=dict(phi=25))
def pile_slumps(run: Run, phi: float) -> None:
    """A pile of 50 degrees slides until it is no steeper than its angle of repose, and then rests."""
    half, steep = 0.35, math.tan(math.radians(50))
    with run.world(2, CELL) as world:
        world.add_collider(Plane((0, 0), (0, 1)), friction_coefficient=1.0)
        p = lattice((-half, 0), (half, half * steep), CELL / 2)
        p = p[p[:, 1] < (half - np.abs(p[:, 0])) * steep]
        world.add_particles(world.add_material(_sand(phi)), p)
        run.steps(world, 3)
        found = _slope(world)
        run.check(
            "slope of its sides",
            found,
            phi - 12,
            phi + 3,
            "degrees",
            why="at most the angle of repose; what has slid arrives with speed and lies up to a third flatter",
        )
        run.check("creep", _creep(run, world, Frame(), 1), 0, 1, "mm/s", why=CREEP)


def _slope(world: Any) -> float:
    """Mean slope of both sides of a heap around x = 0, between a fifth and four fifths of its reach [degrees]."""
    p = world.positions.array()
    reach = np.percentile(np.abs(p[:, 0]), 97)
    x = np.linspace(0.2 * reach, 0.8 * reach, 20)
    heights = world.query_heights([[v, 0] for v in np.r_[x, -x]])
    return math.degrees(math.atan(-np.polyfit(np.r_[x, x], heights, 1)[0]))


@case(below=dict(angle=20, phi=30), below_box=dict(angle=20, phi=30, box=True), above=dict(angle=40, phi=25))
def layer(run: Run, angle: float, phi: float, box: bool = False) -> None:
    """A layer of 8 cells in a flat tray on a slope: it stays below its angle of friction and runs above."""
    w, h, a = 0.8, 0.16, math.radians(angle)
    frame = Frame(2, -angle if box else 0)
    down = (0.0, -G) if box else (G * math.sin(a), -G * math.cos(a))
    with run.world(2, CELL, down) as world:
        tank(world, frame, w, h if angle < phi else 0.6, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=0.8)
        pool(world, frame, (0, 0), (w, h), _sand(phi))
        run.steps(world, 1)
        if angle > phi:
            moved = frame.positions(world)[:, 0].mean() - w / 2
            # Between a surface at the angle of friction (15 degrees to the tray: w^2 tan 15 / (12 h)) and a level one (a wedge of 40 degrees).
            run.check(
                "way of its centre down the tray [widths]",
                moved / w,
                0.09,
                0.29,
                why="a surface between 25 degrees and level: 0.11 to 0.27, and half a cell of 40",
            )
            return
        run.near("mean height", frame.positions(world)[:, 1].mean(), h / 2, MEAN, CELL, why="grains keep their volume")
        run.check("creep", _creep(run, world, frame, 2), 0, 1, "mm/s", why=CREEP)


@case(phi_30=dict(phi=30), phi_40=dict(phi=40))
def tilted_tray(run: Run, phi: float) -> None:
    """A tray that is tilted by five degrees a second: its sand stays up to its angle of friction, then runs."""
    w, h, rate = 0.8, 0.16, 5.0
    with run.world(2, CELL) as world:
        tank(world, Frame(), w, h, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=1.0)
        pool(world, Frame(), (0, 0), (w, h), _sand(phi))
        run.steps(world, 0.5)
        start = world.positions.array()[:, 0].mean()
        log = []

        def tilt(t: float) -> None:
            angle = math.radians(rate * t)
            world.gravity = (G * math.sin(angle), -G * math.cos(angle))

        def watch(t: float) -> None:
            log.append((rate * t, world.positions.array()[:, 0].mean() - start))

        run.steps(world, (phi + 12) / rate, before=tilt, after=watch)
        angle, moved = np.array(log).T
        run.check("way of its centre up to 3 degrees below", 1e3 * moved[angle < phi - 3][-1], -5, 5, "mm", why="friction holds it; a quarter of a cell")
        gone = moved > CELL / 4
        begins = float(angle[gone][0]) if gone.any() else math.nan
        run.check(
            "angle at which it has moved by a quarter of a cell",
            begins,
            phi - 3,
            phi + 6,
            "degrees",
            why="the angle of friction, as well as it is known from heaps; layers start up to 5 degrees above the angle at which they stop (Daerr 1999)",
        )


@case(low=dict(aspect=1.0), flat=dict(aspect=0.5))
def column(run: Run, aspect: float) -> None:
    """A column on a rough floor slumps: run-out 1.2 a (Lube 2005) to 1.8 a (Lajeunesse 2005) of its width."""
    w, mu = 0.25, 0.6
    with run.world(2, CELL) as world:
        world.fill(Box((w / 2, aspect * w / 2), (w / 2, aspect * w / 2)), world.add_material(_sand()))
        world.add_collider(Plane((0, 0), (0, 1)), friction_coefficient=mu)
        world.add_collider(Plane((0, 0), (1, 0)), friction=Friction.SLIP)
        run.steps(world, 3)
        p = world.positions.array()
        front = np.sort(p[:, 0])[int(0.99 * len(p))]
        run.check(
            "run-out over its width",
            (front - w) / w,
            1.2 * aspect - 0.21,
            1.8 * aspect + 0.04,
            why="1.2 a to 1.8 a, less a toe of 20 degrees that is thinner than half a cell (0.11), less the hundredth of grains at the front (0.1)",
        )
        x = np.linspace(CELL / 2, 1.5 * front, 200)
        area = np.trapezoid(np.clip(world.query_heights([[v, 0] for v in x]), 0, 9), x)
        run.check("volume over that of the start", area / (aspect * w * w), 0.95, 1.1, why="grains keep their volume; loose sand takes up to a tenth more")
        run.check("rms speed", 1e3 * rms(world), 0, 5, "mm/s", why="it has come to rest")


@case(a_1=dict())
def column_3d(run: Run) -> None:
    """A round column as high as its radius: run-out 1.24 a (Lube 2004) of its radius, 2.0 sqrt a (Lajeunesse 2004)."""
    radius, cell = 0.2, 0.025
    with run.world(3, cell) as world:
        world.add_collider(Plane((0, 0, 0), (0, 1, 0)), friction_coefficient=0.6)
        p = lattice((-radius, 0, -radius), (radius, radius, radius), cell / 2)
        p = p[np.hypot(p[:, 0], p[:, 2]) < radius]
        world.add_particles(world.add_material(_sand()), p)
        run.steps(world, 1.5)
        q = world.positions.array()
        r = np.hypot(q[:, 0], q[:, 2])
        front = np.sort(r)[int(0.99 * len(r))]
        run.check(
            "run-out over its radius",
            (front - radius) / radius,
            0.9,
            2.1,
            why="1.24 a to 2.0 sqrt a, and half a cell of 8 less, and a hundredth of the grains at the front",
        )
        around = [np.sort(r[np.abs(np.arctan2(q[:, 2], q[:, 0]) - t) < 0.2])[-20:].mean() for t in (0.0, math.pi / 4, math.pi / 2)]
        run.check(
            "front along the grid over that along its diagonal",
            (around[0] + around[2]) / 2 / around[1],
            0.93,
            1.07,
            why="the floor has no direction; half a cell of 8",
        )
        run.check("rms speed", 1e3 * rms(world), 0, 20, "mm/s", why="it has come to rest")


@case(narrow=dict(half=0.2), wide=dict(half=0.5), turned_box=dict(half=0.3, boxes=True))
def poured(run: Run, half: float, boxes: bool = False) -> None:
    """Sand that is poured into a bin fills it as high as its volume says, and rests."""
    frame = Frame(2, 0, (-half, 0.0)) if not boxes else Frame(2, 0, (-half + 0.3 * CELL, 0.3 * CELL))
    with run.world(2, CELL) as world:
        tank(world, frame, 2 * half, 1.0, "boxes" if boxes else "planes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=0.4)
        rate = 0.3 * half
        emitter = world.add_emitter(Sphere((0, 0.6), 0.04), world.add_material(_sand()), rate, region=Region.DISC, speed=1.2)
        run.steps(world, 1.6)
        emitter.enabled = False
        run.steps(world, 2)
        x = np.linspace(0.01, 2 * half - 0.01, 120)
        area = np.trapezoid(np.clip(frame.levels(world, [[v, 0] for v in x]), 0, 9), x) * 2 * half / (x[-1] - x[0])
        run.check(
            "volume of the heap over that of its grains",
            area / (emitter.status.emitted_mass / 1600),
            0.95,
            1.15,
            why="grains keep their volume; poured sand takes up to a tenth more, the surface is known to half a cell",
        )
        run.check("rms speed", 1e3 * rms(world), 0, 5, "mm/s", why="it has come to rest")


@case(two_thirds=dict(), smooth=dict(friction_coefficient=0.0))
def falls(run: Run, friction_coefficient: float = 0.2) -> None:
    """A block of sand that falls two thirds of a metre into a bin keeps its volume and comes to rest."""
    cell, w, h, fall = 0.0125, 0.5, 0.2, 2 / 3
    with run.world(2, cell) as world:
        tank(world, Frame(), w, 1.2, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=friction_coefficient)
        pool(world, Frame(), (0, fall), (w, fall + h), _sand())
        run.steps(world, math.sqrt(2 * fall / G) + 1)
        why = "grains keep their volume; poured sand takes up to a tenth more"
        run.check("volume a second after it landed", 2 * world.positions.array()[:, 1].mean() / h, 0.95, 1.1, why=why)
        run.steps(world, 2.5)
        run.check("volume in the end", 2 * world.positions.array()[:, 1].mean() / h, 0.95, 1.1, why=why)
        run.check("rms speed", 1e3 * rms(world), 0, 5, "mm/s", why="it has come to rest")


@case(neck_8=dict(neck=8), neck_4=dict(neck=4), fine_8=dict(neck=8, cell=0.0125), fine_4=dict(neck=4, cell=0.0125), soft=dict(neck=8, cell=0.0125, young_modulus=1e5))
def hourglass(run: Run, neck: int, cell: float = CELL, young_modulus: float = 1e6) -> None:
    """Sand runs through the neck between two boards and heaps up two thirds of a metre below, with its volume."""
    width, slope, length, half, neck_height = 0.8, math.radians(50), 0.5, 0.03, 0.65
    along, out = np.array([math.cos(slope), math.sin(slope)]), np.array([math.sin(slope), -math.cos(slope)])
    with run.world(2, cell, domain=((0, 0), (width, 1.4))) as world:
        for side in (-1, 1):
            middle = along * length / 2 + out * half + (neck * cell / 2, 0)
            world.add_collider(Box((width / 2 + side * middle[0], neck_height + middle[1]), (length / 2, half), rotation=slope if side > 0 else math.pi - slope))
        world.fill(Box((width / 2, 1.1), (0.24, 0.16)), world.add_material(_sand(young_modulus=young_modulus)))
        volume, count = world.stats.mass / 1600, len(world)
        x = np.linspace(0.01, width - 0.01, 120)
        log, heaps = [], []

        def heap(at: Any) -> float:
            heights = [max(at[abs(at[:, 0] - v) < cell, 1], default=0.0) + cell / 4 for v in x]
            return np.trapezoid(heights, x) * width / (x[-1] - x[0]) / (volume * len(at) / count)

        def watch(t: float) -> None:
            at, speed = world.positions.array(), np.hypot(*world.velocities.array().T)
            log.append((t, (at[:, 1] < neck_height).mean()))
            lies = (at[:, 1] < neck_height - 0.1) & (speed < 0.5)
            if lies.mean() > 0.5 and not heaps:
                heaps.append(heap(at[lies]))

        run.steps(world, 8, after=watch)
        below = world.positions.array()
        why = "grains keep their volume; poured sand takes up to a tenth more, the surface is known to half a cell"
        run.check("volume of the heap over that of its grains", heap(below[below[:, 1] < neck_height - 0.1]), 0.95, 1.15, why=why)
        run.check("the same as soon as half of it lies", heaps[0] if heaps else math.nan, 0.95, 1.15, why=why)
        t, out = np.array(log).T
        k = (out > 0.1) & (out < 0.6)
        flow = np.polyfit(t[k], out[k], 1)[0] * volume / (math.sqrt(G) * (neck * cell) ** 1.5) if k.sum() > 3 else math.nan
        run.check("flow over sqrt(g) D^1.5", flow, 0.8, 1.9, why="Beverloo in the plane: 0.8 to 1.45; a funnel lets through up to a third more")


@case(wide=dict(w=0.5, slot=0.2), narrow=dict(w=0.4, slot=0.1), sloped=dict(w=0.5, slot=0.14, sloped=True))
def silo(run: Run, w: float, slot: float, sloped: bool = False) -> None:
    """Sand runs out of a silo, or of an hourglass, at an even rate: Beverloo's law in the plane."""
    cell, depth = 0.0125, 0.8
    with run.world(2, cell) as world:
        for side in (-1, 1):
            world.add_collider(Box((side * (w / 2 + 0.1), 0.8), (0.1, 1.2)), friction_coefficient=0.4)
            if sloped:
                # A floor that falls by 45 degrees to the slot.
                long = 0.4
                at = np.array([side * slot / 2, 0.0]) + long / math.sqrt(2) * np.array([side, 1.0]) + 0.05 * np.array([side, -1.0]) / math.sqrt(2)
                world.add_collider(Box(at.tolist(), (long, 0.05), rotation=side * math.pi / 4), friction_coefficient=0.4)
            else:
                world.add_collider(Box((side * (slot / 2 + 0.25), -0.05), (0.25, 0.05)), friction_coefficient=0.4)
        plug = world.add_collider(Box((0, -0.05), (slot / 2 + 0.05 * sloped, 0.05)), friction_coefficient=0.4)
        p = lattice((-w / 2, 0), (w / 2, depth), cell / 2)
        if sloped:
            p = p[p[:, 1] > np.abs(p[:, 0]) - slot / 2]
        world.add_particles(world.add_material(_sand()), p)
        world.kill_bounds = ((-3, -0.8), (3, 5))
        run.steps(world, 0.5)
        run.near(
            "mean height before it flows", world.positions.array()[:, 1].mean(), p[:, 1].mean(), 2 * MEAN, cell, why="sand is not crushed by its own weight"
        )
        plug.teleport((0, -5))
        log = []

        def watch(t: float) -> None:
            q = world.positions.array()
            log.append((t, ((q[:, 1] > 0) & (np.abs(q[:, 0]) < w / 2)).sum() / len(p)))

        run.steps(world, 1.6, after=watch)
        t, share = np.array(log).T
        begun = t[share < 0.98] - t[0]
        run.check("seconds until a fiftieth has run out", begun[0] if len(begun) else math.inf, 0, 0.25, why="nothing holds it over a hole: no eye should wait")

        def flow(above: float, below: float) -> float:
            k = (share < above) & (share > below)
            return -np.polyfit(t[k], share[k], 1)[0] * len(p) * (cell / 2) ** 2 / (math.sqrt(G) * slot**1.5) if k.sum() > 3 else math.nan

        first, last = flow(0.95, 0.75), flow(0.7, 0.5)
        low, high = (0.8, 1.45) if not sloped else (0.8, 1.9)
        run.check("flow over sqrt(g) D^1.5", first, low, high, why="Beverloo in the plane: 0.8 to 1.45; a funnel of 45 degrees lets through up to a third more")
        run.check("flow later over flow before", last / first, 0.9, 1.1, why="Beverloo: it does not depend on how full it is")


@case(coarse=dict(cell=0.02), fine=dict(cell=0.0125), box=dict(cell=0.02, box=True))
def funnel(run: Run, cell: float, box: bool = False) -> None:
    """Sand (30 degrees) that runs out of a funnel piles up, a few degrees less steep than it could be."""
    frame = Frame(shift=0.3 * cell)
    with run.world(2, cell) as world:
        world.add_collider(frame.box((-2, -0.2), (2, 0)) if box else frame.plane((0, 0), (0, 1)), friction_coefficient=1.0)
        for side in (-1, 1):
            world.add_collider(Box(frame.out((0.34 * side, 0.92)).tolist(), (0.35, 0.02), rotation=side * math.pi / 4), friction_coefficient=0.1)
        p = lattice((-0.5, 0.8), (0.5, 1.25), cell / 2)
        p = p[np.abs(p[:, 0]) < p[:, 1] - 0.68]
        world.add_particles(world.add_material(_sand()), frame.out(p))
        run.steps(world, 5)
        q = frame.positions(world)
        low = q[q[:, 1] < 0.55]
        run.check("share that has run out", len(low) / len(p), 0.9, 1.0, why="a funnel of 45 degrees with a friction of 6 keeps nothing but what lies in its mouth")
        reach = np.percentile(np.abs(low[:, 0]), 97)
        x = np.linspace(0.2 * reach, 0.8 * reach, 20)
        top = [low[np.abs(np.abs(low[:, 0]) - v) < cell, 1].max() for v in x]
        slope = math.degrees(math.atan(-np.polyfit(x, top, 1)[0]))
        run.check("angle of repose", slope, 17, 33, "degrees", why="friction of 30 degrees; what falls comes with speed and lies flatter")


@case(dry=dict())
def weight_of_sand(run: Run) -> None:
    """Floor and rough walls of a silo bear the weight together, and the walls their share (Janssen)."""
    w, h, mu = 0.3, 0.9, 0.5
    with run.world(2, CELL) as world:
        left, right, floor = tank(world, Frame(), w, 1.2, "boxes", thick=0.1, friction=Friction.COULOMB, friction_coefficient=mu, measures_impulse=True)
        pool(world, Frame(), (0, 0), (w, h), _sand())
        weight = world.stats.mass * G
        down, both = [], []

        def watch(t: float) -> None:
            if t > 2:
                forces = [-c.impulse.linear[1] * run.rate / weight for c in (floor, left, right)]
                down.append(forces[0])
                both.append(sum(forces))

        run.steps(world, 3, after=watch)
        run.check("force on all over the weight", np.mean(both), 0.98, 1.02, why="momentum: the sand rests")
        # The most that walls can bear is with K = 1: (1 - exp(-2 mu h / w)) / (2 mu h / w) stays on the floor.
        x = 2 * mu * h / w
        run.check(
            "force on the floor over the weight", np.mean(down), (1 - math.exp(-x)) / x, 0.95, why="Janssen with K = 1, and walls that bear at least something"
        )
        run.near("level", 2 * world.positions.array()[:, 1].mean(), h, SURFACE, CELL, why="grains keep their volume")
