"""Water: at rest behind walls of every kind and angle, moving with its tank, oscillating, pressing, running out."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from harness import G, MEAN, SURFACE, Frame, Run, case, lattice, pool, rms, tank
from pbmpm import Baked, Box, Field, Friction, Liquid, Plane, Region, Sand, Sphere, bake_heights, bake_mesh

CELL, WIDTH, DEPTH = 0.05, 1.6, 0.6
REST = "water at rest stays at rest; 10 mm/s is a fifth of a cell per second"


def _places(kind: str) -> dict[str, dict[str, Any]]:
    offsets = {f"{kind}_{cells}": dict(kind=kind, cells=float(cells)) for cells in ("0.1", "0.5", "0.7")}
    return {**offsets, **{f"turned_{angle}_{kind}": dict(kind=kind, angle=angle) for angle in (10, 15, 20, 28, 36, 45)}}


@case(
    one=dict(thick=1),
    two=dict(thick=2),
    two_off=dict(thick=2, shift=0.3),
    two_3d=dict(thick=2, dimension=3),
    half=dict(thick=0.5),
    half_3d=dict(thick=0.5, dimension=3),
    quarter_off=dict(thick=0.25, shift=0.3),
    tenth=dict(thick=0.1),
    tenth_3d=dict(thick=0.1, dimension=3),
    fifth_turned_20=dict(thick=0.2, angle=20),
    fifth_turned_30=dict(thick=0.2, angle=30),
)
def thin_glass(run: Run, thick: float, shift: float = 0.0, dimension: int = 2, angle: float = 0.0) -> None:
    """A glass of boxes whose walls are so few cells thick: water rests in it, and none is pressed into its corners."""
    cell, width, depth = 0.05, 1.2 if dimension == 2 else 0.6, 0.6 if dimension == 2 else 0.4
    frame = Frame(dimension, angle, shift * cell)
    with run.world(dimension, cell, frame.gravity) as world:
        tank(world, frame, width, depth + 0.2, "boxes", thick=thick * cell)
        pool(world, frame, [0.0] * dimension, [width, depth] + [width] * (dimension - 2), Liquid())
        run.steps(world, 5)
        run.near("mean level", 2 * frame.positions(world)[:, 1].mean(), depth, 0.25, cell, why="the water keeps its volume; a quarter of a cell")
        run.check("rms speed", rms(world), 0, 0.01, "m/s", why="water at rest stays at rest; 10 mm/s is a fifth of a cell per second")
        run.check("least volume ratio", float(world.volume_ratios.array().min()), 0.8, 2, why="no particle is crushed")


@case(**_places("planes"), **_places("boxes"))
def still_pool(run: Run, kind: str, cells: float = 0.0, angle: float = 0.0) -> None:
    """A pool of 32 x 12 cells in a tank that stands off the grid, or turned together with gravity."""
    frame = Frame(2, angle, cells * CELL)
    with run.world(2, CELL, frame.gravity) as world:
        tank(world, frame, WIDTH, 1.5, kind)
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid())
        _rest(run, world, frame, DEPTH / 2, 0.01)


def _rest(run: Run, world: Any, frame: Frame, true: float, limit: float, seconds: float = 8.0, drift: Any = 0.0) -> None:
    """Speed and mean height over the last two seconds."""
    speed, height = [], []

    def watch(t: float) -> None:
        if t > seconds - 2:
            speed.append(rms(world, drift=drift))
            height.append(frame.positions(world)[:, 1].mean())

    run.steps(world, seconds, after=watch)
    run.check("rms speed", np.mean(speed), 0, limit, "m/s", why=REST)
    run.near("mean height", np.mean(height), true, MEAN, world.cell_size, why="water keeps its volume and lies level")


@case(
    on_grid=dict(boxes=[((0.8, 0.3), (0.1, 0.1), 0)]),
    off_grid=dict(boxes=[((0.815, 0.315), (0.1, 0.1), 0)]),
    turned_20=dict(boxes=[((0.81, 0.3), (0.1, 0.1), 20)]),
    turned_45=dict(boxes=[((0.81, 0.3), (0.1, 0.1), 45)]),
    step=dict(boxes=[((0.8, 0.0), (0.2, 0.2), 0)]),
    step_off=dict(boxes=[((0.815, 0.0), (0.2, 0.215), 0)]),
    step_at_wall=dict(boxes=[((0.075, 0.075), (0.075, 0.075), 0)]),
    stairs=dict(boxes=[((0.225, 0.05), (0.225, 0.05), 0), ((0.15, 0.15), (0.15, 0.05), 0), ((0.075, 0.25), (0.075, 0.05), 0)]),
    ramp_10=dict(boxes=[((1.1, -0.1), (0.9, 0.2), 10)]),
    ramp_20=dict(boxes=[((1.1, -0.1), (0.9, 0.2), 20)]),
    shelf=dict(boxes=[((1.6, 0.3), (0.3, 0.05), 0)]),
    shelf_off=dict(boxes=[((1.6, 0.315), (0.315, 0.05), 0)]),
)
def furnished_pool(run: Run, boxes: list[tuple[tuple[float, float], tuple[float, float], float]]) -> None:
    """A pool with a box in it, on its floor or at its wall: each edge is a place where an even pressure might do work."""
    with run.world(2, CELL, domain=((0, 0), (WIDTH, 2))) as world:
        p = lattice((0, 0), (WIDTH, DEPTH), CELL / 2)
        for centre, half, degrees in boxes:
            world.add_collider(Box(centre, half, rotation=math.radians(degrees)), friction=Friction.SLIP)
            along = Frame(2, degrees).local(p - np.asarray(centre))
            p = p[~(np.abs(along) < half).all(1)]
        world.add_particles(world.add_material(Liquid()), p)
        _rest(run, world, Frame(), p[:, 1].mean(), 0.01)


@case(blunt_15=dict(slope=15), blunt_25_off=dict(slope=25, shift=0.4), blunt_35_off=dict(slope=35, shift=0.3), ridge_15=dict(slope=-15), ridge_30=dict(slope=-30))
def creased_floor(run: Run, slope: float, shift: float = 0.0) -> None:
    """A pool on a floor that is folded in its middle: two planes that meet in a valley, or a ridge that is baked."""
    middle, rise = WIDTH / 2 + shift * CELL, math.tan(math.radians(slope))
    floor = lambda x: rise * np.abs(x - middle)  # noqa: E731
    with run.world(2, CELL) as world:
        if slope > 0:
            for side in (-1, 1):
                world.add_collider(Plane((middle, 0), (side * rise, 1)), friction=Friction.SLIP)
        else:
            x = np.array([-0.4, middle, WIDTH + 0.4])
            points = np.array([(x[0], -1.2), (x[2], -1.2), *zip(x[::-1], floor(x[::-1]))])
            edges = [(k, (k + 1) % len(points)) for k in range(len(points))]
            world.add_collider(Baked((0, 0), world.load_solid(bake_mesh(points, edges, resolution=128))), friction=Friction.SLIP)
        for at, normal in ((0.0, 1.0), (WIDTH, -1.0)):
            world.add_collider(Plane((at, 0), (normal, 0)), friction=Friction.SLIP)
        p = lattice((0, -1), (WIDTH, DEPTH), CELL / 2)
        p = p[p[:, 1] > floor(p[:, 0])]
        world.add_particles(world.add_material(Liquid()), p)
        _rest(run, world, Frame(), p[:, 1].mean(), 0.01)


@case(ball=dict())
def ball_in_pool(run: Run) -> None:
    """A pool around a ball at rest."""
    with run.world(2, CELL, domain=((0, 0), (WIDTH, 2))) as world:
        world.add_collider(Sphere((0.81, 0.3), 0.15), friction=Friction.SLIP)
        p = lattice((0, 0), (WIDTH, DEPTH), CELL / 2)
        p = p[np.hypot(*(p - (0.81, 0.3)).T) > 0.15]
        world.add_particles(world.add_material(Liquid()), p)
        _rest(run, world, Frame(), p[:, 1].mean(), 0.01)


@case(light=dict(density=500), mercury=dict(density=13600))
def density(run: Run, density: float) -> None:
    """How heavy a liquid is makes no difference to its rest."""
    frame = Frame(2, 0, 0.3 * CELL)
    with run.world(2, CELL) as world:
        tank(world, frame, WIDTH, 1.5, "boxes")
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid(density=density))
        _rest(run, world, frame, DEPTH / 2, 0.01)


@case(domain=dict(kind="domain"), boxes=dict(kind="boxes"))
def deep_pool(run: Run, kind: str) -> None:
    """24 cells deep: at most twice the speed of 12 cells."""
    frame = Frame(2, 0, 0.0 if kind == "domain" else 0.3 * CELL)
    with run.world(2, CELL, domain=((0, 0), (0.8, 2)) if kind == "domain" else None) as world:
        if kind == "boxes":
            tank(world, frame, 0.8, 1.8, kind)
        pool(world, frame, (0, 0), (0.8, 1.2), Liquid())
        _rest(run, world, frame, 0.6, 0.02)


@case(right_45=dict(left=45, right=45), steep_60_30=dict(left=60, right=30))
def trough(run: Run, left: float, right: float) -> None:
    """Water in a V of two planes, 14 cells deep; gravity along the grid."""
    depth = 0.7
    a, b = math.radians(left), math.radians(right)
    with run.world(2, CELL) as world:
        world.add_collider(Plane((0, 0), (math.sin(a), math.cos(a))), friction=Friction.SLIP)
        world.add_collider(Plane((0, 0), (-math.sin(b), math.cos(b))), friction=Friction.SLIP)
        p = lattice((-2, 0), (2, depth), CELL / 2)
        inside = (p[:, 0] > -p[:, 1] / math.tan(a)) & (p[:, 0] < p[:, 1] / math.tan(b))
        world.add_particles(world.add_material(Liquid()), p[inside])
        # Of a triangle on its tip of the area V = h^2 (cot a + cot b) / 2 the centroid is at 2 h / 3.
        area = inside.sum() * (CELL / 2) ** 2
        height = math.sqrt(2 * area / (1 / math.tan(a) + 1 / math.tan(b)))
        _rest(run, world, Frame(), 2 * height / 3, 0.01)


@case(on_grid=dict(shift=0.0), off_grid=dict(shift=0.37))
def bowl(run: Run, shift: float) -> None:
    """Water in a half circle of 0.8 m that is baked from a polygon."""
    radius, wall = 0.8, 0.3
    arc = [(radius * math.cos(t), radius * math.sin(t)) for t in np.linspace(0, -math.pi, 49)]
    out = radius + wall
    points = np.array([(-out, -out), (out, -out), (out, 0), *arc, (-out, 0)])
    edges = [(k, (k + 1) % len(points)) for k in range(len(points))]
    frame = Frame(2, 0, shift * CELL)
    with run.world(2, CELL) as world:
        solid = world.load_solid(bake_mesh(points, edges, resolution=128))
        world.add_collider(Baked(frame.shift.tolist(), solid), friction=Friction.SLIP)
        p = lattice((-radius, -radius), (radius, -0.3), CELL / 2)
        p = p[np.hypot(*p.T) < radius]
        world.add_particles(world.add_material(Liquid()), frame.out(p))
        _rest(run, world, frame, _segment_centroid(radius, len(p) * (CELL / 2) ** 2), 0.01)


def _segment_centroid(radius: float, area: float) -> float:
    """Height of the centroid of a segment of a circle, from the centre: -2/3 (R sin a)^3 / area with the half angle a that has the area."""
    low, high = 0.0, math.pi
    for _ in range(60):
        a = (low + high) / 2
        low, high = (a, high) if radius**2 * (a - math.sin(a) * math.cos(a)) < area else (low, a)
    return -2 / 3 * (radius * math.sin(a)) ** 3 / area


@case(valley=dict())
def terrain(run: Run) -> None:
    """A lake in a valley of a terrain that is baked from heights; the valley is a cosine of 0.5 m depth."""
    spacing, half = 0.05, 1.0
    x = np.arange(-1.4, 1.4 + spacing / 2, spacing)
    ground = lambda v: -0.25 * (1 + np.cos(np.pi * np.clip(v, -half, half) / half))  # noqa: E731
    with run.world(2, CELL) as world:
        solid = world.load_solid(bake_heights(ground(x).astype(np.float32), spacing, thickness=0.5))
        world.add_collider(Baked((x[0], 0.0), solid), friction=Friction.SLIP)
        p = lattice((-1, -0.5), (1, -0.1), CELL / 2)
        p = p[p[:, 1] > ground(p[:, 0])]
        world.add_particles(world.add_material(Liquid()), p)
        _rest(run, world, Frame(), p[:, 1].mean(), 0.01)


@case(
    water=dict(material=Liquid()),
    water_fine=dict(material=Liquid(), wide=0.63),
    water_off=dict(material=Liquid(), shift=0.55),
    sand=dict(material=Sand()),
    sand_off=dict(material=Sand(), shift=0.3),
    sand_steep=dict(material=Sand(), shift=0.3, steep=0.8),
    water_3d=dict(material=Liquid(), shift=0.3, sides=(1.0, 0.3)),
    sand_3d=dict(material=Sand(), shift=0.3, sides=(1.0, 0.3)),
)
def flush_terrain(run: Run, material: Liquid | Sand, wide: float = 1.0, shift: float = 0.0, steep: float = 0.4, sides: tuple[float, ...] = (2.0,)) -> None:
    """A ridge that is baked from heights, with cells as wide as `wide` of the world's. Its sides stand flush on boxes; matter falls on it from 0.3 m and
    runs down to them."""
    dimension, long = 1 + len(sides), sides[0]
    off, down = np.insert(np.full(len(sides), shift * CELL), 1, 0.0), np.insert(np.array(sides), 1, 0.0)
    heights = (0.6 - steep * np.abs(np.arange(0, long + 0.05, 0.1) - long / 2)).astype(np.float32)
    ground = lambda at: 0.6 - steep * np.abs(at[:, 0] - long / 2)  # noqa: E731
    if dimension == 3:
        heights = np.repeat(heights[:, None], round(sides[1] / 0.1) + 1, axis=1)
    p = lattice(0 * down, np.where(down == 0, 1.1, down), CELL / 2)
    with run.world(dimension, CELL) as world:
        solid = world.load_solid(bake_heights(heights, 0.1, thickness=0.6, resolution=round(long / (wide * CELL))))
        world.add_collider(Baked(off.tolist(), solid))
        for a in range(0, dimension, 2):
            for middle in (-0.2, down[a] + 0.2):
                half, at = np.full(dimension, 2.5), np.full(dimension, 1.0)
                half[a], at[a] = 0.2, middle + off[a]
                world.add_collider(Box(at.tolist(), half.tolist()))
        world.add_particles(world.add_material(material), (p[p[:, 1] > ground(p)] + off + np.eye(dimension)[1] * 0.3).astype(np.float32))
        run.steps(world, 4 if dimension == 2 else 2)
        q = world.positions.array() - off
        inside = (np.abs(q - down / 2)[:, ::2] > down[::2] / 2 + CELL / 4).any(axis=1)
        run.check("particles below the ground or in the walls", ((ground(q) - q[:, 1] > CELL) | inside).sum(), 0, 0, why="what stands flush does not leak")


@case(
    water=dict(material=Liquid()),
    water_off=dict(material=Liquid(), shift=0.3),
    sand=dict(material=Sand()),
    sand_off=dict(material=Sand(), shift=0.3),
    water_coarse=dict(material=Liquid(), shift=0.3, resolution=13),
    sand_coarse=dict(material=Sand(), shift=0.3, resolution=13),
    water_tiles=dict(material=Liquid(), shift=0.6, rise=0.4, tiles=2),
    water_tiles_coarse=dict(material=Liquid(), shift=0.3, rise=0.6, tiles=2, resolution=13),
    sand_tiles=dict(material=Sand(), shift=0.6, rise=0.4, tiles=2),
)
def flush_floor(run: Run, material: Liquid | Sand, shift: float = 0.0, rise: float = 0.0, tiles: int = 1, resolution: int = 20) -> None:
    """A level floor of tiles that are baked from heights, and end at the boxes that are its walls; what is put on it rests."""
    place = np.array([shift, rise]) * CELL
    with run.world(2, CELL) as world:
        solid = world.load_solid(bake_heights(np.zeros(11, np.float32), 0.1, thickness=0.3, resolution=resolution))
        for tile in range(tiles):
            world.add_collider(Baked(place + [tile, 0], solid))
        for middle in (-0.1, tiles + 0.1):
            world.add_collider(Box(place + [middle, 0.3], (0.1, 0.8)))
        world.add_particles(world.add_material(material), (lattice((0, 0), (tiles, 0.4), CELL / 2) + place).astype(np.float32))
        run.steps(world, 6)
        run.check("rms speed", rms(world), 0, 0.01, "m/s", why=REST)
        run.check("least volume ratio", float(world.volume_ratios.array().min()), 0.8, 2, why="no particle is crushed")


GROUND = {"waves": lambda x: 0.15 * np.sin(math.pi * x), "valley": lambda x: math.tan(math.radians(10)) * np.abs(x - 1) - 0.15}


@case(
    waves=dict(ground="waves"),
    waves_off=dict(ground="waves", shift=0.4),
    tiles_off=dict(ground="waves", shift=0.3, tiles=2),
    valley_10_off=dict(ground="valley", shift=0.5),
    valley_10_two_substeps=dict(ground="valley", shift=0.5, substeps=2),
)
def lake(run: Run, ground: str, shift: float = 0.0, tiles: int = 1, substeps: int = 1) -> None:
    """A lake on terrain that is baked, of tiles beside each other, and ends at boxes."""
    step, count = 0.1, 20 // tiles
    x = np.arange(21) * step
    heights = GROUND[ground](x)
    with run.world(2, CELL) as world:
        world.substeps = substeps
        for tile in range(tiles):
            part = heights[tile * count : (tile + 1) * count + 1].astype(np.float32)
            solid = world.load_solid(bake_heights(part, step, thickness=0.3, resolution=round(count * step / CELL)))
            world.add_collider(Baked((tile * count * step + shift * CELL, 0), solid))
        for middle in (-0.2, 2.2):
            world.add_collider(Box((middle + shift * CELL, 0.3), (0.2, 0.8)))
        p = lattice((0, -0.3), (2, 0.45), CELL / 2)
        p = p[p[:, 1] > np.interp(p[:, 0], x, heights) + CELL / 4]
        world.add_particles(world.add_material(Liquid()), (p + [shift * CELL, 0]).astype(np.float32))
        run.steps(world, 6)
        q = world.positions.array() - [shift * CELL, 0]
        below = np.interp(q[:, 0], x, heights) - q[:, 1] > 0.75 * CELL
        run.check("particles below the ground", int(below.sum()), 0, 0, why="the ground is solid")
        run.check("rms speed", rms(world), 0, 0.01, "m/s", why=REST)


@case(
    wide_off=dict(cells=16, depth=6, kind="boxes"),
    narrow_off=dict(cells=6, depth=12, kind="boxes"),
    turned_20=dict(cells=10, depth=8, kind="boxes", angle=20.0),
    planes_off=dict(cells=10, depth=8, kind="planes"),
)
def glass(run: Run, cells: int, depth: int, kind: str, angle: float = 0.0) -> None:
    """Glasses of other sizes in 3D, 0.3 cells off the grid or turned."""
    cell = 0.025
    frame = Frame(3, angle, 0.0 if angle else 0.3 * cell)
    w, h = cells * cell, depth * cell
    with run.world(3, cell, frame.gravity) as world:
        tank(world, frame, w, 2 * h, kind, thick=0.1)
        pool(world, frame, (0, 0, 0), (w, h, w), Liquid())
        _levels_3d(run, world, frame, w, h)


def _levels_3d(run: Run, world: Any, frame: Frame, w: float, h: float) -> None:
    count = len(world)
    run.steps(world, 3)
    level = frame.levels(world, [[x * w, 0, z * w] for x in (0.25, 0.5, 0.75) for z in (0.25, 0.5, 0.75)]).mean()
    p = frame.positions(world)
    out = ((p < -world.cell_size / 2).any(1) | (p[:, [0, 2]] > w + world.cell_size / 2).any(1)).sum()
    run.near("level", level, h, SURFACE, world.cell_size, why="water keeps its volume")
    run.check("share that has left", (out + count - len(world)) / count, 0, 0.001, why="glass does not leak")


@case(on_grid=dict(shift=0.0), off_grid=dict(shift=0.4))
def baked_glass(run: Run, shift: float) -> None:
    """A square glass of 10 x 8 cells with walls of 3 cells, baked from a mesh."""
    cell, w, h, top, wall = 0.025, 0.25, 0.2, 0.35, 0.075
    frame = Frame(3, 0, shift * cell)
    outer = [(-wall, w + wall), (-wall, top), (-wall, w + wall)]
    inner = [(0.0, w), (0.0, top), (0.0, w)]
    corner = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    points = [[box[axis][index[axis]] for axis in range(3)] for box in (outer, inner) for index in corner]
    number = {index: at for at, index in enumerate(corner)}
    quads = []
    for axis in (0, 2):
        for end in (0, 1):
            ring = [(j, m) for j, m in ((0, 0), (1, 0), (1, 1), (0, 1))]
            side = [number[(end, j, m) if axis == 0 else (m, j, end)] for j, m in ring]
            quads += _facing(points, side, [(2 * end - 1) if a == axis else 0 for a in range(3)])
            quads += _facing(points, [8 + s for s in side], [(1 - 2 * end) if a == axis else 0 for a in range(3)])
            rim = [number[(end, 1, m) if axis == 0 else (m, 1, end)] for m in (0, 1)]
            quads += _facing(points, [rim[0], rim[1], 8 + rim[1], 8 + rim[0]], [0, 1, 0])
    floor = [number[(i, 0, k)] for i, k in ((0, 0), (1, 0), (1, 1), (0, 1))]
    quads += _facing(points, floor, [0, -1, 0]) + _facing(points, [8 + f for f in floor], [0, 1, 0])
    with run.world(3, cell) as world:
        # The floor is as thick as the walls: its lower side is 3 cells below the inside.
        place = np.array(points)
        place[: len(corner)][place[: len(corner), 1] < 0.01, 1] = -wall
        solid = world.load_solid(bake_mesh(place, quads, resolution=96))
        world.add_collider(Baked(frame.shift.tolist(), solid), friction=Friction.SLIP)
        pool(world, frame, (0, 0, 0), (w, h, w), Liquid())
        _levels_3d(run, world, frame, w, h)


def _facing(points: Any, quad: list[int], normal: list[float]) -> list[list[int]]:
    """A quad as two triangles wound so that they face along the normal."""
    p = np.array(points)[quad]
    if np.cross(p[1] - p[0], p[2] - p[0]) @ normal < 0:
        quad = quad[::-1]
    return [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]


@case(two_cells_turned_15=dict(tile=2, angle=15.0), ten_cells_turned_15=dict(tile=10, angle=15.0), odd_3_3=dict(tile=3.3, angle=0.0))
def tiled_floor(run: Run, tile: float, angle: float) -> None:
    """A pool on a floor of flush boxes that is turned, or whose joints miss the grid."""
    frame, size = Frame(2, angle), tile * CELL
    with run.world(2, CELL, frame.gravity) as world:
        tank(world, frame, WIDTH, 1.5, "planes", floor=False)
        for i in range(-1, math.ceil(WIDTH / size) + 1):
            world.add_collider(frame.box((i * size, -size), ((i + 1) * size, 0)))
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid())
        run.steps(world, 4)
        below = (frame.positions(world)[:, 1] < -0.25 * CELL).mean()
        run.check("share of water below the floor", below, 0, 0.001, why="flush tiles do not leak")


@case(three_cells=dict())
def tiled_floor_3d(run: Run) -> None:
    """The same in 3D: tiles of 3 cells under a pool of 12 x 6 x 12 cells."""
    cell, frame = 0.05, Frame(3)
    w, h, size = 0.6, 0.3, 0.15
    with run.world(3, cell) as world:
        tank(world, frame, w, 1, "planes", floor=False)
        for i in range(-1, 5):
            for k in range(-1, 5):
                world.add_collider(Box(((i + 0.5) * size, -size / 2, (k + 0.5) * size), (size / 2,) * 3))
        pool(world, frame, (0, 0, 0), (w, h, w), Liquid())
        run.steps(world, 3)
        below = (frame.positions(world)[:, 1] < -0.25 * cell).mean()
        run.check("share of water below the floor", below, 0, 0.001, why="flush tiles do not leak")


@case(flush=dict(offset=0.0), staggered=dict(offset=0.6))
def block_wall(run: Run, offset: float) -> None:
    """A wall that is a stack of boxes of 3 cells holds a pool of 12 cells; staggered, every second box stands back."""
    size = 3 * CELL
    with run.world(2, CELL) as world:
        frame = Frame()
        tank(world, frame, WIDTH, 1.5, "boxes")
        for i in range(6):
            at = 0.8 + (offset * CELL if i % 2 else 0.0)
            world.add_collider(Box((at + size / 2, (i + 0.5) * size), (size / 2, size / 2)), friction=Friction.SLIP)
        pool(world, frame, (0, 0), (0.8, DEPTH), Liquid())
        run.steps(world, 4)
        x = frame.positions(world)[:, 0]
        run.check("share of water behind the wall", (x > 0.8 + size / 2).mean(), 0, 0.001, why="stacked boxes do not leak")


@case(
    on_domain=dict(floor="domain"),
    on_box=dict(floor="box"),
    off_grid=dict(floor="box", shift=0.4),
    turned_20=dict(floor="box", angle=20.0),
    on_mesh=dict(floor="mesh"),
    on_mesh_off=dict(floor="mesh", shift=0.4),
    coarse=dict(floor="box", resolution=24),
    coarse_off=dict(floor="box", resolution=27, shift=0.4),
    medium_off=dict(floor="box", resolution=45, shift=0.55),
    one_and_a_half_cells=dict(floor="box", resolution=16, shift=0.4),
    two_cells=dict(floor="box", resolution=12),
    on_box_3d=dict(floor="box", dimension=3),
)
def mesh_wall(run: Run, floor: str, shift: float = 0.0, angle: float = 0.0, dimension: int = 2, resolution: int = 64) -> None:
    """A wall of 4 cells that is baked from a mesh, and stands flush on a floor, holds a pool on its one side."""
    at, thick, deep = (0.8, 0.2, DEPTH) if dimension == 2 else (0.4, 0.2, 0.3)
    frame, wide = Frame(dimension, angle, shift * CELL), 2 * at + thick
    domain = ([0.0] * dimension, [wide, 1.5] + [at] * (dimension - 2)) if floor == "domain" else None
    with run.world(dimension, CELL, frame.gravity, domain=domain) as world:

        def bake(low: Any, high: Any) -> None:
            solid = world.load_solid(bake_mesh(*_block(low, high), resolution=resolution))
            world.add_collider(Baked(frame.out([0.0] * dimension).tolist(), solid, rotation=frame.rotation), friction=Friction.SLIP)

        if domain is None:
            tank(world, frame, at if dimension == 3 else wide, 1.5, "boxes", floor=False)
        low, high = [-0.5, -0.5] + [-0.5] * (dimension - 2), [wide + 0.5, 0.0] + [at + 0.5] * (dimension - 2)
        if floor == "box":
            world.add_collider(frame.box(low, high), friction=Friction.SLIP)
        elif floor == "mesh":
            bake(low, high)
        bake([at, 0.0, -0.1][:dimension], [at + thick, 1.0, at + 0.1][:dimension])
        pool(world, frame, [0.0] * dimension, [at, deep, at][:dimension], Liquid())
        run.steps(world, 6 if dimension == 2 else 3)
        p = frame.positions(world)
        run.check("share of water behind the wall or below", ((p[:, 0] > at + CELL) | (p[:, 1] < -CELL / 2)).mean(), 0, 0.001, why="a wall on a floor does not leak")
        run.check("rms speed", rms(world), 0, 0.01, "m/s", why=REST)


@case(two=dict(gap=2.0), one_and_a_half=dict(gap=1.5))
def baked_channel(run: Run, gap: float) -> None:
    """A column of water, 20 cells high, between two baked blocks. Their grids are as coarse as the channel is wide."""
    high, wide, step = 20 * CELL, 8 * CELL, 2 * CELL
    with run.world(2, CELL) as world:
        world.add_collider(Box((0, -0.2), (1, 0.2)), friction=Friction.SLIP)
        for side in (-1, 1):
            low, top = (-wide, -0.2), (0.0, high + 0.2)
            solid = world.load_solid(bake_mesh(*_block(low, top), resolution=round((top[1] - low[1]) / step)))
            world.add_collider(Baked((side * gap * CELL / 2 + (wide if side > 0 else 0.0), 0.0), solid), friction=Friction.SLIP)
        pool(world, Frame(), (-gap * CELL / 2, 0), (gap * CELL / 2, high), Liquid())
        run.steps(world, 3)
        y = world.positions.array()[:, 1]
        run.near("mean height", y.mean(), high / 2, 0.5, CELL, why="water keeps its volume; half a cell of 20")
        run.check("share of water outside", (y < -CELL / 2).mean(), 0, 0.001, why="walls do not leak")


def _block(low: Any, high: Any) -> tuple[Any, Any]:
    """Corners and faces of a box, which face outwards: edges in 2D, triangles in 3D."""
    d = len(low)
    if d == 2:
        return [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    points = [[(low, high)[k >> a & 1][a] for a in range(3)] for k in range(8)]
    faces: list[list[int]] = []
    for axis in range(3):
        one, two = (1 << a for a in range(3) if a != axis)
        for end in (0, 1):
            first = end << axis
            faces += _facing(points, [first, first | one, first | one | two, first | two], [(2 * end - 1) if a == axis else 0 for a in range(3)])
    return points, faces


@case(
    two_cells=dict(cells=2.0, shift=0.0),
    two_cells_off=dict(cells=2.0, shift=0.5),
    one_cell=dict(cells=1.0, shift=0.0),
    one_cell_off=dict(cells=1.0, shift=0.4),
    half_a_cell=dict(cells=0.5, shift=0.0),
    tenth_of_a_cell=dict(cells=0.1, shift=0.4),
)
def two_pools(run: Run, cells: float, shift: float) -> None:
    """A thin wall between pools of 12 and 6 cells."""
    half, thick = 0.8, cells * CELL
    with run.world(2, CELL) as world:
        frame = Frame(2, 0, (shift * CELL, 0))
        tank(world, frame, 2 * half + thick, 1.5, "boxes")
        world.add_collider(frame.box((half, -0.2), (half + thick, 1.5)), friction=Friction.SLIP)
        water = pool(world, frame, (0, 0), (half, DEPTH), Liquid())
        world.fill(frame.box((half + thick, 0), (2 * half + thick, DEPTH / 2)), water)
        left = len(frame.positions(world)) * 2 / 3
        run.steps(world, 6)
        p = frame.positions(world)
        side = p[:, 0] < half + thick / 2
        run.check("change of the higher pool's share", abs(side.sum() / left - 1), 0, 0.001, why="a wall does not leak")
        run.near("mean height, higher pool", p[side, 1].mean(), DEPTH / 2, MEAN, CELL, why="water keeps its volume")
        run.near("mean height, lower pool", p[~side, 1].mean(), DEPTH / 4, MEAN, CELL, why="water keeps its volume")


@case(up=dict(velocity=(0.0, 0.15)), down=dict(velocity=(0.0, -0.15)), fast=dict(velocity=(1.0, 0.0)), oblique=dict(velocity=(0.3, 0.2)))
def moving_tank(run: Run, velocity: tuple[float, float]) -> None:
    """Water in a tank of boxes that moves at constant speed rests in it (Galilei)."""
    v = np.array(velocity)
    with run.world(2, CELL) as world:
        frame = Frame()
        walls = tank(world, frame, WIDTH, 1.5, "boxes", kinematic=True)
        starts = [np.array(wall.shape.position) for wall in walls]
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid(), velocity=velocity)
        speed = []

        def move(t: float) -> None:
            for wall, start in zip(walls, starts):
                wall.move((start + v * t).tolist())

        run.steps(world, 6, before=move, after=lambda t: speed.append(rms(world, drift=v)) if t > 4 else None)
        run.check("rms speed in the tank", np.mean(speed), 0, 0.02, "m/s", why="Galilei; " + REST + ", twice that for walls that cross the grid")


@case(domain=dict(kind="domain"), planes_off=dict(kind="planes"), boxes_off=dict(kind="boxes"))
def standing_wave(run: Run, kind: str) -> None:
    """The first mode of a tank, 1 cell high: omega^2 = g k tanh(k h), and hardly damped in nine periods."""
    frame = Frame(2, 0, 0.0 if kind == "domain" else 0.3 * CELL)
    k, high = math.pi / WIDTH, 0.05
    omega = math.sqrt(G * k * math.tanh(k * DEPTH))
    with run.world(2, CELL, domain=((0, 0), (WIDTH, 2)) if kind == "domain" else None) as world:
        if kind != "domain":
            tank(world, frame, WIDTH, 1.5, kind)
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid())
        x, y = frame.positions(world).T
        # Airy's wave at the moment when its surface is flat.
        swing = high * omega / math.sinh(k * DEPTH)
        world.set(Field.VELOCITY, np.stack([-swing * np.cosh(k * y) * np.sin(k * x), swing * np.sinh(k * y) * np.cos(k * x)], 1))
        centre = []
        period = 2 * math.pi / omega
        run.steps(world, 9.5 * period, after=lambda t: centre.append((t, frame.positions(world)[:, 0].mean() - WIDTH / 2)))
    t, c = np.array(centre).T
    # The centre of mass swings by the first moment of the surface: 2 a w / (pi^2 h).
    true = 2 * high * WIDTH / (math.pi**2 * DEPTH)
    last = t > 8.5 * period
    run.check(
        "amplitude in the ninth period over the first one's true one",
        np.ptp(c[last]) / 2 / true,
        0.85,
        1.03,
        why="Airy: 1; water loses less than a per cent, what is seen as the same wave is 0.85",
    )
    zero = np.flatnonzero((c[:-1] < 0) & (c[1:] >= 0))
    cross = t[zero] - c[zero] * (t[zero + 1] - t[zero]) / (c[zero + 1] - c[zero])
    found = 2 * math.pi * (len(cross) - 1) / (cross[-1] - cross[0]) if len(cross) > 1 else math.nan
    run.check("frequency over Airy's", found / omega, 0.97, 1.03, why="omega^2 = g k tanh(k h); half a cell of depth changes it by 1.5 %")


@case(tank=dict(), ball=dict(ball=True))
def splash(run: Run, ball: bool = False) -> None:
    """A column of water falls in a tank, over a ball or not. From 5 s on its energy may only fall."""
    with run.world(2, CELL, domain=((0, 0), (3.2, 2.4))) as world:
        if ball:
            world.add_collider(Sphere((2.2, 0.0), 0.35), friction=Friction.SLIP)
        world.add_particles(world.add_material(Liquid()), lattice((0, 0), (1.0, 1.2), CELL / 2))
        height, energy, speed = [], [], []

        def watch(t: float) -> None:
            height.append(world.positions.array()[:, 1].mean())
            speed.append(rms(world))
            energy.append(speed[-1] ** 2 / 2 + G * height[-1])

        run.steps(world, 30, after=watch)
    seconds = np.reshape(energy, (30, -1)).mean(1)
    fallen = energy[0] - seconds[5]
    run.check("rise of the energy from 5 s on over what fell", max(seconds[k:].max() - seconds[k] for k in range(5, 30)) / fallen, -1, 0.005, why="nothing drives it")
    late, early = np.mean(speed[-2 * round(run.rate) :]), np.mean(speed[8 * round(run.rate) : 10 * round(run.rate)])
    run.check("rms speed after 30 s over that after 10 s", late / early, 0, 1, why="what breaks and splashes comes to rest")


@case(upright=dict(angle=0.0), turned_20=dict(angle=20.0))
def wall_forces(run: Run, angle: float) -> None:
    """The floor bears the weight, a side wall rho g h^2 / 2."""
    frame = Frame(2, angle, 0.0 if angle else 0.3 * CELL)
    with run.world(2, CELL, frame.gravity) as world:
        left, right, floor = tank(world, frame, WIDTH, 1.5, "boxes", measures_impulse=True)
        pool(world, frame, (0, 0), (WIDTH, DEPTH), Liquid())
        weight = world.stats.mass * G
        down, side = [], []

        def watch(t: float) -> None:
            if t > 3:
                down.append(-np.dot(floor.impulse.linear, frame.up) * run.rate)
                side.append(np.dot(right.impulse.linear, frame.turn[:, 0]) * run.rate)

        run.steps(world, 6, after=watch)
        run.check("force on the floor over the weight", np.mean(down) / weight, 0.98, 1.02, why="walls without friction bear no weight")
        run.check(
            "force on a side wall over rho g h^2 / 2", np.mean(side) / (1000 * G * DEPTH**2 / 2), 0.92, 1.08, why="hydrostatics; half a cell of level is 8 %"
        )


@case(box=dict(shape="box"), turned_box=dict(shape="turned"), ball=dict(shape="ball"))
def buoyancy(run: Run, shape: str) -> None:
    """What water does to a body that is held under it: the weight of the water that it displaces (Archimedes)."""
    at, half = (0.8, 0.5), 0.2
    body = Sphere(at, half) if shape == "ball" else Box(at, (half, half), rotation=0.5 if shape == "turned" else 0.0)
    area = math.pi * half**2 if shape == "ball" else 4 * half**2
    with run.world(2, CELL, domain=((0, 0), (WIDTH, 2))) as world:
        held = world.add_collider(body, friction=Friction.SLIP, measures_impulse=True)
        p = lattice((0, 0), (WIDTH, 1.0), CELL / 2)
        away = np.abs((p - at) @ np.array([[math.cos(0.5), -math.sin(0.5)], [math.sin(0.5), math.cos(0.5)]])) if shape == "turned" else np.abs(p - at)
        inside = np.hypot(*(p - at).T) < half if shape == "ball" else (away < half).all(1)
        world.add_particles(world.add_material(Liquid()), p[~inside])
        up = []
        run.steps(world, 5, after=lambda t: up.append(held.impulse.linear[1] * run.rate) if t > 3 else None)
        run.check("lift over the weight displaced", np.mean(up) / (1000 * G * area), 0.88, 1.12, why="Archimedes; a quarter of a cell around 8 cells is 12 %")


@case(three_cells=dict())
def vessels(run: Run) -> None:
    """Two vessels that are joined below a wall come to one level, each within half a cell."""
    with run.world(2, CELL) as world:
        frame = Frame(2, 0, 0.3 * CELL)
        tank(world, frame, 1.4, 1.8, "boxes")
        world.add_collider(frame.box((0.6, 0.2), (0.8, 1.8)), friction=Friction.SLIP)
        water = pool(world, frame, (0, 0.2), (0.6, 1.0), Liquid())
        world.fill(frame.box((0, 0), (1.4, 0.2)), water)
        world.fill(frame.box((0.8, 0.2), (1.4, 0.4)), water)
        volume = len(world) * (CELL / 2) ** 2
        true = 0.2 + (volume - 0.2 * 1.4) / 1.2
        left, right = [], []

        def watch(t: float) -> None:
            if t > 8:
                left.append(frame.levels(world, [[x, 0] for x in (0.15, 0.3, 0.45)]).mean())
                right.append(frame.levels(world, [[x, 0] for x in (0.95, 1.1, 1.25)]).mean())

        run.steps(world, 12, after=watch)
        run.near("level on the left", np.mean(left), true, SURFACE, CELL, why="communicating vessels")
        run.near("level on the right", np.mean(right), true, SURFACE, CELL, why="communicating vessels")


@case(narrow=dict(width=0.2, depth=0.3, angle=0.0), wide=dict(width=0.5, depth=0.2, angle=0.0), turned_20=dict(width=0.3, depth=0.2, angle=20.0))
def pour(run: Run, width: float, depth: float, angle: float) -> None:
    """What is poured into a glass fills it as high as its volume says."""
    cell, nozzle, speed = 0.02, 0.06, 1.2
    frame = Frame(2, angle, 0.3 * cell)
    with run.world(2, cell, frame.gravity) as world:
        tank(world, frame, width, 0.5, "boxes", thick=0.06, friction=Friction.COULOMB, friction_coefficient=0.1)
        mouth = Sphere(frame.out((width / 2, 0.6)).tolist(), nozzle / 2)
        budget = int(width * depth / (cell / 2) ** 2)
        emitter = world.add_emitter(
            mouth,
            world.add_material(Liquid()),
            nozzle * speed,
            region=Region.DISC,
            speed=speed,
            direction=(-frame.up).tolist(),
            budget=budget,
        )
        run.steps(world, width * depth / (nozzle * speed) + 3)
        level = frame.levels(world, [[x, 0] for x in np.linspace(0.15 * width, 0.85 * width, 9)]).mean()
        inside = (np.abs(frame.positions(world)[:, 0] - width / 2) < width / 2).sum()
        run.near("level", level, inside * (cell / 2) ** 2 / width, SURFACE, cell, why="water keeps its volume")
        run.check("share of the budget that is in the glass", inside / budget, 0.97, 1.0, why="a jet narrower than the glass hits it")
        assert emitter


@case(block=dict(modulus=5e4), soft=dict(modulus=1e4))
def soft_liquid(run: Run, modulus: float) -> None:
    """A block of a soft liquid falls and spreads in a tank: its weight alone compresses it."""
    cell, width, side = 0.0125, 0.8, 0.3
    with run.world(2, cell, domain=((0, 0), (width, 1.2))) as world:
        world.fill(Box((width / 2, 0.5), (side / 2, side / 2)), world.add_material(Liquid(bulk_modulus=modulus)))
        depth = side**2 / width
        strain = 1000 * G * depth / 2 / modulus
        ratio = []

        def watch(t: float) -> None:
            if t > 3:
                ratio.append(world.volume_ratios.array().mean())

        run.steps(world, 4, after=watch)
        run.check("volume over what its weight leaves", np.mean(ratio) / (1 - strain), 0.95, 1.05, why="p = K (1 - J): half the pressure below, on average")


@case(tray=dict())
def drips(run: Run) -> None:
    """Twelve drops fall into a tray and lie level; what they stirred dies away.

    Water of 6.7 cm in a tray of 40 cm sloshes at 6.1 rad/s, and its floor brakes it by the factor e in sinh(2 k h) / (k sqrt(nu w / 2)) = 90 s
    (J. Miles, "Surface-wave damping in closed basins", Proc. R. Soc. A 297, 1967). So it need not rest after four seconds, as was asked until 2026-11-26."""
    cell, width = 0.02, 0.4
    with run.world(2, cell) as world:
        frame = Frame(2, 0, 0.3 * cell)
        tank(world, frame, width, 0.3, "boxes", thick=0.1)
        emitter = world.add_emitter(Sphere((0.15, 0.4), 0.03), world.add_material(Liquid()), 0.06 * 0.6, region=Region.DISC, speed=0.6)

        def drip(t: float) -> None:
            emitter.enabled = (t - run.dt) % 0.25 < 0.0625

        run.steps(world, 3, before=drip)
        emitter.enabled = False
        true = emitter.status.emitted_mass / 1000 / width / 2
        speed, height = [], []

        def watch(_: float) -> None:
            speed.append(rms(world))
            height.append(frame.positions(world)[:, 1].mean())

        run.steps(world, 4, after=watch)
        early, late = np.reshape(speed, (2, -1)).mean(1)
        run.check("rms speed of the third and fourth second over that of two before", late / early, 0, 1, why="nothing drives it")
        run.near("mean height", np.mean(height[len(height) // 2 :]), true, MEAN, cell, why="water keeps its volume and lies level")


@case(tenth=dict(slot=0.1), third=dict(slot=0.3))
def slot(run: Run, slot: float) -> None:
    """Water leaves through a slot of the floor of a tank 1 m wide."""
    cell, w, depth, base = 0.025, 1.0, 1.0, 0.8
    # Contraction of a plane jet from a slot in the end of a channel (von Mises 1917), and the speed of approach: c / sqrt(1 - (c b / B)^2).
    contraction = {0.1: 0.612, 0.3: 0.622}[slot]
    true = contraction / math.sqrt(1 - (contraction * slot / w) ** 2)
    with run.world(2, cell) as world:
        for side in (-1, 1):
            world.add_collider(Box((side * (w / 2 + 0.1), base + 1), (0.1, 1.2)), friction=Friction.SLIP)
            half = (w - slot) / 4 + 0.1
            world.add_collider(Box((side * (slot / 2 + half), base - 0.05), (half, 0.05)), friction=Friction.SLIP)
        world.fill(Box((0, base + depth / 2), (w / 2, depth / 2)), world.add_material(Liquid()))
        world.kill_bounds = ((-3, -0.5), (3, 5))
        log = []

        def watch(t: float) -> None:
            if t > 0.4:
                p = world.positions.array()
                inside = ((p[:, 1] > base) & (np.abs(p[:, 0]) < w / 2)).sum() * (cell / 2) ** 2
                log.append((t, inside, world.query_heights([[x, 0] for x in (-0.4, -0.3, 0.3, 0.4)]).mean() - base))

        run.steps(world, 1.1, after=watch)
        t, volume, level = np.array(log).T
        flow = -np.polyfit(t, volume, 1)[0] / (slot * np.sqrt(2 * G * level).mean())
        spread = 2 * 0.25 * cell / slot  # a quarter of a cell at each edge
        run.check(
            "discharge over the true one",
            flow / true,
            1 - max(spread, 0.08),
            1 + max(spread, 0.08),
            why="Torricelli, von Mises' contraction; a quarter of a cell at each edge",
        )
