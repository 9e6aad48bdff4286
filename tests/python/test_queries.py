"""Regions, points, heights and rays against sums over all particles in NumPy."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest

import pbmpm

Array = npt.NDArray[np.float64]

# The library sums in double precision and returns floats; positions, masses and velocities are read back as floats. One part in a million
# is twenty times the rounding of one of them.
CLOSE = 1e-6
SAMPLE = 0.25  # cells from one sample on a line to the next
HALVINGS = 12
# Where the filling is within rounding of the level at a halving, the two decide differently, and end one of the smallest steps apart.
STEP = SAMPLE * 0.1 / 2**HALVINGS + CLOSE


class Brute:
    """The definitions of the header, without any lookup."""

    def __init__(self, world: pbmpm.World) -> None:
        self.d, self.dx = world.dimension, float(np.float32(world.cell_size))
        self.x = world.positions.copy().astype(np.float64)
        self.v = world.velocities.copy().astype(np.float64)
        self.c = world.affine_velocities.copy().astype(np.float64)
        self.mass = world.masses.copy().astype(np.float64)
        self.ratio = world.volume_ratios.copy().astype(np.float64)
        self.ids = world.ids.copy()
        self.material = world.material_indices.copy()
        densities = np.zeros(256)
        densities[0], densities[1] = 1000.0, 500.0
        self.rest = self.mass / densities[self.material]

    def spline(self, r: Array) -> Array:
        r = np.abs(r)
        return np.where(r < 0.5, 0.75 - r * r, np.where(r < 1.5, 0.5 * (1.5 - r) ** 2, 0.0))

    def slope(self, r: Array) -> Array:
        outer = np.where(np.abs(r) < 1.5, np.where(r < 0, 1.5 + r, r - 1.5), 0.0)
        return np.where(np.abs(r) < 0.5, -2 * r, outer)

    def weights(self, point: Array) -> Array:
        return self.spline((point - self.x) / self.dx).prod(axis=1)

    def filling(self, point: Array) -> float:
        return float((self.rest * self.weights(point)).sum() / self.dx**self.d)

    def density(self, point: Array) -> float:
        return float((self.mass * self.weights(point)).sum() / self.dx**self.d)

    def velocity(self, point: Array) -> Array:
        share = self.mass * self.weights(point)
        motion = self.v + np.einsum("nij,nj->ni", self.c, point - self.x)
        return share @ motion / share.sum() if share.sum() > 0 else np.zeros(self.d)

    def normal(self, point: Array) -> Array:
        r = (point - self.x) / self.dx
        w, slopes = self.spline(r), self.slope(r)
        gradient = np.zeros(self.d)
        for a in range(self.d):
            others = [w[:, b] for b in range(self.d) if b != a]
            gradient[a] = (self.rest * slopes[:, a] * np.prod(others, axis=0)).sum()
        length = np.linalg.norm(gradient)
        return -gradient / length if length > 0 else gradient

    def nearest(self, point: Array) -> int:
        distance = ((self.x - point) ** 2).sum(axis=1)
        return int(np.where(self.weights(point) > 0, distance, np.inf).argmin())

    def crossing(self, start: Array, direction: Array, first: int, last: int, level: float) -> float | None:
        """The distance at which a line reaches the level."""
        for i in range(first, last + 1):
            if self.filling(start + i * SAMPLE * self.dx * direction) < level:
                continue
            if i == first:
                return i * SAMPLE * self.dx
            below, above = (i - 1) * SAMPLE, i * SAMPLE
            for _ in range(HALVINGS):
                middle = 0.5 * (below + above)
                if self.filling(start + middle * self.dx * direction) >= level:
                    above = middle
                else:
                    below = middle
            return above * self.dx
        return None


def splash(dimension: int, steps: int = 25, threads: int = 2) -> pbmpm.World:
    """A pool that an elastic ball has fallen into."""
    size = 2.0 if dimension == 2 else 1.2
    world = pbmpm.World(
        dimension,
        0.1,
        capacity=20000,
        gravity=(0, -9.81, 0)[:dimension],
        domain=([0.0] * dimension, [size] * dimension),
        threads=threads,
    )
    water = world.add_material(pbmpm.Liquid())
    jelly = world.add_material(pbmpm.Elastic(density=500))
    half = [size / 2, 0.25, size / 2][:dimension]
    world.fill(pbmpm.Box(half, half), water)
    world.fill(pbmpm.Sphere([size / 2, 0.8, size / 2][:dimension], 0.2), jelly, velocity=[0, -2, 0][:dimension])
    for _ in range(steps):
        world.step(1 / 120)
    return world


def some_points(world: pbmpm.World, count: int, seed: int) -> npt.NDArray[np.float32]:
    """Points in and around the matter."""
    x = world.positions.copy()
    random = np.random.default_rng(seed)
    near = x[random.integers(len(x), size=count // 2)] + random.normal(0, 0.1, (count // 2, world.dimension))
    low, high = x.min(axis=0) - 0.3, x.max(axis=0) + 0.3
    anywhere = random.uniform(low, high, (count - count // 2, world.dimension))
    return np.concatenate([near, anywhere]).astype(np.float32)


def edits(world: pbmpm.World) -> None:
    """What happens between steps: matter comes, goes and is moved."""
    d = world.dimension
    world.remove_in(pbmpm.Sphere([0.4] * d, 0.15))
    positions = world.positions.copy()
    random = np.random.default_rng(3)
    moved = random.choice(len(positions), 200, replace=False)
    positions[moved] = random.uniform(0.1, 1.1, (200, d))
    world.positions = positions
    material = pbmpm.materials.Material(world, _material_id(world, 0))
    world.add_particles(material, random.uniform(0.1, 1.1, (150, d)))


def _material_id(world: pbmpm.World, index: int) -> object:
    (share,) = [s for s in world.query_region(pbmpm.Sphere([0.0] * world.dimension, 99.0)) if s.material.index == index]
    return share.material._id


def worlds(dimension: int) -> list[pbmpm.World]:
    """Before the first step, after steps, and after edits."""
    edited = splash(dimension)
    edits(edited)
    return [splash(dimension, steps=0), splash(dimension), edited]


def test_points(dimension: int) -> None:
    for world in worlds(dimension):
        brute = Brute(world)
        points = some_points(world, 200, 1)
        fields = world.query_points(points)
        filling = np.array([brute.filling(p.astype(np.float64)) for p in points])
        assert (filling == 0).any() and (filling > 0.9).any()
        assert np.allclose(fields.filling, filling, rtol=CLOSE, atol=CLOSE)
        assert np.allclose(fields.density, [brute.density(p.astype(np.float64)) for p in points], rtol=CLOSE, atol=1000 * CLOSE)
        # where next to nothing is near, the ratio of two small sums has their relative error
        velocity = np.array([brute.velocity(p.astype(np.float64)) for p in points])
        solid = filling > 1e-3
        assert np.allclose(fields.velocity[solid], velocity[solid], rtol=1e-4, atol=1e-4)
        assert not fields.velocity[filling == 0].any()


def test_a_linear_velocity_comes_out_exactly(dimension: int) -> None:
    with splash(dimension, steps=0) as world:
        random = np.random.default_rng(5)
        gradient = random.normal(size=(dimension, dimension))
        world.velocities = world.positions.copy() @ gradient.T
        world.affine_velocities = np.broadcast_to(gradient, (len(world), dimension, dimension))
        points = some_points(world, 100, 2)
        fields = world.query_points(points)
        matter = fields.filling > 0.01
        assert matter.sum() > 30
        assert np.allclose(fields.velocity[matter], points[matter] @ gradient.T, atol=2e-6 * 10)


def test_regions(dimension: int) -> None:
    shapes = [
        pbmpm.Sphere([0.5] * dimension, 0.3),
        pbmpm.Box([0.6] * dimension, [0.3] * dimension, 0.4 if dimension == 2 else (0, 0, math.sin(0.2), math.cos(0.2))),
        pbmpm.Capsule([0.5] * dimension, 0.2, 0.1),
        pbmpm.Plane([0, 0.3, 0][:dimension], [0.2, 1, 0.1][:dimension]),
        pbmpm.Sphere([50.0] * dimension, 0.3),
    ]
    for world in worlds(dimension):
        brute = Brute(world)
        for shape in shapes:
            ids = {tuple(i) for i in world.query(shape)}
            inside = np.array([tuple(i) in ids for i in brute.ids], bool)
            if isinstance(shape, pbmpm.Sphere):
                distance = np.linalg.norm(brute.x - np.array(shape.position), axis=1) - shape.radius
                assert ((distance < 0) == inside)[np.abs(distance) > 1e-5].all()
            shares = world.query_region(shape)
            assert [share.material.index for share in shares] == sorted(set(brute.material[inside]))
            for share in shares:
                rows = inside & (brute.material == share.material.index)
                assert share.count == rows.sum()
                assert share.mass == pytest.approx(brute.mass[rows].sum(), rel=CLOSE)
                assert share.rest_volume == pytest.approx(brute.rest[rows].sum(), rel=CLOSE)
                assert share.volume == pytest.approx((brute.rest * brute.ratio)[rows].sum(), rel=CLOSE)


def test_query_keeps_storage_order(dimension: int) -> None:
    with splash(dimension) as world:
        shape = pbmpm.Sphere([0.5] * dimension, 0.3)
        rows = world.find(world.query(shape))
        assert len(rows) > 50 and (np.diff(rows.astype(np.int64)) > 0).all()


def test_heights(dimension: int) -> None:
    slanted = np.array([0.3, 1.0, -0.2])[:dimension]
    for world in worlds(dimension):
        brute = Brute(world)
        points = some_points(world, 40, 4)
        for direction, level in ((None, 0.5), (slanted, 0.3)):
            up = np.array([0, 1, 0])[:dimension] if direction is None else np.float32(slanted).astype(np.float64)
            up = up / np.linalg.norm(up)
            heights = world.query_heights(points, direction=direction, level=level)
            for point, height in zip(points.astype(np.float64), heights):
                top = math.ceil((np.linalg.norm(brute.x - point, axis=1).max() / brute.dx + 3) / SAMPLE)
                way = brute.crossing(point, -up, -top, top, level)
                expected = -math.inf if way is None else point @ up - way
                assert height == pytest.approx(expected, abs=STEP)


def test_heights_of_still_water(dimension: int) -> None:
    # A lattice that fills its box to the top: the filling is 1/2 on the surface by symmetry, up to the lattice's ripple.
    with splash(dimension, steps=0) as world:
        still = [0.3, 0.1, 0.3][:dimension]
        assert world.query_heights([still])[0] == pytest.approx(0.5, abs=0.01)


def test_rays(dimension: int) -> None:
    for world in worlds(dimension):
        brute = Brute(world)
        points = some_points(world, 60, 6)
        random = np.random.default_rng(7)
        targets = brute.x[random.integers(len(brute.x), size=len(points))]
        hits = 0
        for i, (point, target) in enumerate(zip(points, targets)):
            direction = (target - point) if i % 3 else random.normal(size=dimension)
            direction = direction.astype(np.float32)
            reach = float(np.float32([0.3, 1.0, 30.0][i % 3]))
            unit = direction.astype(np.float64) / np.linalg.norm(direction.astype(np.float64))
            hit = world.query_ray(point, direction, max_distance=reach)
            last = math.floor(min(reach, 6.0) / brute.dx / SAMPLE)
            way = brute.crossing(point.astype(np.float64), unit, 0, last, 0.5)
            assert (hit is None) == (way is None)
            if hit is None or way is None:
                continue
            hits += 1
            place = point.astype(np.float64) + way * unit
            row = brute.nearest(place)
            assert hit.distance == pytest.approx(way, abs=STEP)
            assert np.allclose(hit.position, place, atol=STEP)
            assert np.allclose(hit.normal, brute.normal(place), atol=1e-4)
            assert hit.particle == tuple(brute.ids[row])
            assert hit.material.index == brute.material[row]
        assert hits > 15


def test_rays_find_what_is_far(dimension: int) -> None:
    with splash(dimension) as world:
        start = [0.6, 3e4, 0.6][:dimension]
        hit = world.query_ray(start, [0, -1, 0][:dimension])
        near = world.query_ray([0.6, 3.0, 0.6][:dimension], [0, -1, 0][:dimension])
        assert hit is not None and near is not None
        # A float of 30000 has steps of 0.002.
        assert hit.position[1] == pytest.approx(near.position[1], abs=0.004)
        assert world.query_ray(start, [0, -1, 0][:dimension], max_distance=100) is None
        assert world.query_ray(start, [0, 1, 0][:dimension]) is None


def test_nothing_is_found_in_an_empty_world(dimension: int) -> None:
    with pbmpm.World(dimension, 0.1, capacity=10, gravity=[0, -1, 0][:dimension]) as world:
        origin = [0.0] * dimension
        assert world.query_region(pbmpm.Sphere(origin, 1)) == []
        assert world.query_points([origin]).filling[0] == 0
        assert world.query_heights([origin])[0] == -math.inf
        assert world.query_ray(origin, [0, -1, 0][:dimension]) is None
        assert len(world.query_points(np.empty((0, dimension))).density) == 0


def test_answers_do_not_depend_on_threads_and_change_nothing(dimension: int) -> None:
    one, three = splash(dimension, threads=1), splash(dimension, threads=3)
    points = some_points(one, 500, 8)
    before, generation = one.hash(), one.generation
    a, b = one.query_points(points), three.query_points(points)
    assert np.array_equal(a.filling, b.filling) and np.array_equal(a.velocity, b.velocity)
    assert np.array_equal(one.query_heights(points), three.query_heights(points))
    assert one.hash() == before and one.generation == generation
    untouched = splash(dimension, threads=1)
    for world in (one, untouched):
        edits_without_queries = world.positions.copy()
        world.positions = edits_without_queries[:, :] * 0.999
        for _ in range(5):
            world.step(1 / 120)
    assert one.hash() == untouched.hash()


@pytest.mark.parametrize(
    ("call", "word"),
    [
        (lambda w: w.query_points([[0.0, math.nan]]), "finite"),
        (lambda w: w.query_points([[0.0, 0.0, 0.0]]), "shape"),
        (lambda w: w.query_heights([[0.0, math.inf]]), "finite"),
        (lambda w: w.query_heights([[0.0, 0.0]], level=0.0), "level"),
        (lambda w: w.query_heights([[0.0, 0.0]], level=math.nan), "level"),
        (lambda w: w.query_heights([[0.0, 0.0]], level=101), "level"),
        (lambda w: w.query_heights([[0.0, 0.0]], direction=(0, 0)), "direction"),
        (lambda w: w.query_heights([[0.0, 0.0]], direction=(math.nan, 1)), "direction"),
        (lambda w: w.query_ray((0, 0), (0, 0)), "direction"),
        (lambda w: w.query_ray((math.inf, 0), (0, 1)), "finite"),
        (lambda w: w.query_ray((0, 0), (0, 1), max_distance=-1), "max_distance"),
        (lambda w: w.query_ray((0, 0), (0, 1), level=0), "level"),
        (lambda w: w.query_region(pbmpm.Sphere((0, 0), -1)), "radius"),
    ],
)
def test_bad_questions(call: object, word: str) -> None:
    with splash(2, steps=0) as world, pytest.raises(pbmpm.InvalidArgumentError, match=word):
        call(world)  # type: ignore[operator]


def test_without_gravity_there_is_no_up() -> None:
    with pbmpm.World(2, 0.1) as world:
        with pytest.raises(pbmpm.InvalidArgumentError, match="gravity"):
            world.query_heights([[0.0, 0.0]])
        assert world.query_heights([[0.0, 0.0]], direction=(0, 1))[0] == -math.inf
