"""How much strain motion can remove: the particles of a cell share one displacement gradient."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

import pbmpm

from .least import least

Matrix = npt.NDArray[np.float64]


def _spline(offsets: Matrix) -> tuple[Matrix, Matrix]:
    """Weights of the quadratic spline on the nodes before, at and after the nearest, and their slopes; one row each."""
    weights = np.stack([0.5 * (0.5 - offsets) ** 2, 0.75 - offsets**2, 0.5 * (0.5 + offsets) ** 2])
    return weights, np.stack([offsets - 0.5, -2.0 * offsets, offsets + 0.5])


def _gradient_matrix(places: Matrix, deformations: Matrix) -> Matrix:
    """What nodes' displacements along one axis make of the rows of (grad u) F, shape (particles * d, nodes)."""
    count, d = places.shape
    nearest = np.round(places).astype(int)
    parts = [_spline(places[:, a] - nearest[:, a]) for a in range(d)]
    numbers: dict[tuple[int, ...], int] = {}
    columns, values = [], []
    for steps in itertools.product(range(3), repeat=d):
        nodes = nearest + np.array(steps) - 1
        columns.append([numbers.setdefault(tuple(node), len(numbers)) for node in nodes.tolist()])
        slopes = [np.prod([parts[b][int(a == b)][steps[b]] for b in range(d)], axis=0) for a in range(d)]
        values.append(np.einsum("ap,pab->pb", np.stack(slopes), deformations))
    matrix = np.zeros((count, d, len(numbers)))
    for column, value in zip(columns, values, strict=True):
        matrix[np.arange(count)[:, None], np.arange(d)[None, :], np.array(column)[:, None]] = value
    return matrix.reshape(count * d, -1)


def _least_strain(world: pbmpm.World) -> Matrix:
    """R - (I + grad u) F of each particle for the displacements u of the nodes that leave the least of it, R the U V^T of F.

    It is a linear least squares problem, the same for each axis of u: rows of (grad u) F against rows of R - F. Matter that has
    flown apart so far that there are more nodes than rows counts as free to undo all.
    """
    places = world.positions.array().astype(float) / world.cell_size
    deformations = world.deformations.array().astype(float)
    u, _, vt = np.linalg.svd(deformations)
    turned = u @ vt
    matrix = _gradient_matrix(places, deformations)
    if matrix.shape[1] >= matrix.shape[0]:
        return np.zeros_like(turned)
    best, *_ = np.linalg.lstsq(matrix, (turned - deformations).transpose(0, 2, 1).reshape(-1, world.dimension), rcond=None)
    return turned - deformations - (matrix @ best).reshape(deformations.shape).transpose(0, 2, 1)


def unremovable_strain(world: pbmpm.World) -> float:
    """Root mean square over particles of |R - (I + grad u) F| for the best displacements u of the nodes, R the U V^T of F."""
    return float(np.sqrt((_least_strain(world) ** 2).sum(axis=(1, 2)).mean()))


def relaxed_strain(world: pbmpm.World, energy: Callable[[Matrix], tuple[Matrix, Matrix]]) -> Matrix:
    """(I + grad u) F of the particles for the displacements u of the nodes that leave the least energy, shape (particles, d, d).

    `energy` gives that of each particle, which weigh the same, and its derivative by F. A substep of the dual and the primal minimises it beside the
    inertia: where it is least, they rest. Coordinates are orthonormal in (grad u) F, so that |R - F|^2 is as steep along each.
    """
    places = world.positions.array().astype(float) / world.cell_size
    deformations = world.deformations.array().astype(float)
    matrix = _gradient_matrix(places, deformations)
    squares, modes = np.linalg.eigh(matrix.T @ matrix)
    kept = squares > 1e-12 * squares[-1]  # the others, translations among them, strain nothing
    basis = matrix @ (modes[:, kept] / np.sqrt(squares[kept]))

    def moved(way: Matrix) -> Matrix:
        return deformations + (basis @ way).reshape(deformations.shape).transpose(0, 2, 1)

    def at(way: Matrix) -> tuple[float, Matrix]:
        values, stress = energy(moved(way))
        return float(values.sum()), basis.T @ stress.transpose(0, 2, 1).reshape(len(basis), -1)

    return moved(least(at, np.zeros((basis.shape[1], world.dimension))))


class _Grid:
    """P2G and G2P of particles that stand still: which nodes they share, and how."""

    def __init__(self, world: pbmpm.World) -> None:
        places = world.positions.array().astype(float) / world.cell_size
        d = places.shape[1]
        nearest = np.round(places).astype(int)
        splines = [_spline(places[:, a] - nearest[:, a]) for a in range(d)]
        numbers: dict[tuple[int, ...], int] = {}
        columns, weights, ways, slopes = [], [], [], []
        for steps in itertools.product(range(3), repeat=d):
            nodes = nearest + np.array(steps) - 1
            columns.append([numbers.setdefault(tuple(node), len(numbers)) for node in nodes.tolist()])
            weights.append(np.prod([splines[a][0][steps[a]] for a in range(d)], axis=0))
            ways.append(nodes - places)
            slopes.append(np.stack([np.prod([splines[b][int(a == b)][steps[b]] for b in range(d)], axis=0) for a in range(d)], axis=1))
        self._column, self._weight, self._way, self._slope = (np.array(part) for part in (columns, weights, ways, slopes))
        self._masses = world.masses.array().astype(float).reshape(-1)
        self._mass = np.zeros(len(numbers))
        np.add.at(self._mass, self._column, self._weight * self._masses)

    def motion(self, gradients: Matrix) -> Matrix:
        """Where P2G of particles that have these gradients, and do not move, takes the nodes, as each particle sees its own [cells]."""
        momentum = np.zeros((len(self._mass), self._way.shape[2]))
        np.add.at(momentum, self._column, (self._weight * self._masses)[..., None] * np.einsum("pab,spb->spa", gradients, self._way))
        return (momentum / np.maximum(self._mass, 1e-30)[:, None])[self._column]

    def affine(self, motion: Matrix) -> Matrix:
        """The affine velocities of G2P, as gradients: 4 sum_i w_ip u_i (x_i - x_p)^T."""
        return 4.0 * np.einsum("sp,spa,spb->pab", self._weight, motion, self._way)

    def gradient(self, motion: Matrix) -> Matrix:
        """The gradients of G2P that F follows: sum_i u_i (grad w_ip)^T."""
        return np.einsum("spa,spb->pab", motion, self._slope)


def _corrections(deformations: Matrix, longest: float) -> Matrix:
    """What the particles of the paper's solver ask for: X = sym((R - F) F^-1), R the U V^T of F, no longer than that (project_elastic() of the kernels)."""
    u, _, vt = np.linalg.svd(deformations)
    asked = (u @ vt - deformations) @ np.linalg.inv(deformations)
    asked = 0.5 * (asked + asked.transpose(0, 2, 1))
    sizes = np.sqrt((asked**2).sum(axis=(1, 2)))
    asked *= np.minimum(1.0, longest / np.maximum(sizes, 1e-30))[:, None, None]
    return asked


def movable_strain(world: pbmpm.World, rebound_max: float) -> float:
    """Root mean square over particles of what the grid lets through of the paper's corrections: how far a body is from rest by its law.

    P2G and G2P make of the corrections X_p the motion u_i = sum_p m_p w_ip X_p (x_i - x_p) / m_i and 4 sum_i w_ip u_i (x_i - x_p)^T, in cells. Where that
    vanishes nothing moves, though X may be large: X is V^-1 - I, at most 1 for a stretch and more for what is flat, so it balances elsewhere than at
    the least |R - F|.
    """
    grid = _Grid(world)
    shared = grid.affine(grid.motion(_corrections(world.deformations.array().astype(float), rebound_max)))
    return float(np.sqrt((shared**2).sum(axis=(1, 2)).mean()))


BALANCE_STEPS = 200
BALANCE_SHARE = 0.5  # of the corrections in each


def balanced_strain(world: pbmpm.World, longest: float) -> Matrix:
    """F of the particles where the paper's corrections, no longer than that, balance: where they lie, without mass or weight, shape (particles, d, d).

    The particles of a cell share one gradient, which multiplies their F. Where these differ, as in matter that is as flat as a sheet and was
    pressed by different shares, they differ by as much when it has grown back.
    """
    grid, deformations = _Grid(world), world.deformations.array().astype(float)
    for _ in range(BALANCE_STEPS):
        shared = grid.gradient(grid.motion(_corrections(deformations, longest)))
        deformations = deformations + BALANCE_SHARE * shared @ deformations
    return deformations
