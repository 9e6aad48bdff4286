"""How much strain motion can remove: the particles of a cell share one displacement gradient."""

from __future__ import annotations

import itertools

import numpy as np
import numpy.typing as npt

import pbmpm

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


def unremovable_strain(world: pbmpm.World) -> float:
    """Root mean square over particles of |R - (I + grad u) F| for the best displacements u of the nodes, R the U V^T of F.

    It is a linear least squares problem, the same for each axis of u: rows of (grad u) F against rows of R - F. Matter that has
    flown apart so far that there are more nodes than rows counts as free to undo all.
    """
    places = world.positions.array().astype(float) / world.cell_size
    deformations = world.deformations.array().astype(float)
    u, _, vt = np.linalg.svd(deformations)
    missing = (u @ vt - deformations).transpose(0, 2, 1).reshape(-1, world.dimension)
    matrix = _gradient_matrix(places, deformations)
    if matrix.shape[1] >= matrix.shape[0]:
        return 0.0
    best, *_ = np.linalg.lstsq(matrix, missing, rcond=None)
    return float(np.sqrt(((missing - matrix @ best) ** 2).sum() / len(places)))


def movable_strain(world: pbmpm.World, rebound_max: float) -> float:
    """Root mean square over particles of what the grid lets through of the paper's corrections: how far a body is from rest by its law.

    A particle asks for X = sym((R - F) F^-1), R the U V^T of F, no longer than `rebound_max` (project_elastic() of the kernels). P2G and
    G2P make of it u_i = sum_p m_p w_ip X_p (x_i - x_p) / m_i and 4 sum_i w_ip u_i (x_i - x_p)^T, in cells. Where that vanishes nothing moves, though X may be
    large: X is V^-1 - I, at most 1 for a stretch and more for what is flat, so it balances elsewhere than at the least |R - F|.
    """
    places = world.positions.array().astype(float) / world.cell_size
    masses = world.masses.array().astype(float).reshape(-1)
    deformations = world.deformations.array().astype(float)
    u, _, vt = np.linalg.svd(deformations)
    asked = (u @ vt - deformations) @ np.linalg.inv(deformations)
    asked = 0.5 * (asked + asked.transpose(0, 2, 1))
    sizes = np.sqrt((asked**2).sum(axis=(1, 2)))
    asked *= np.minimum(1.0, rebound_max / np.maximum(sizes, 1e-30))[:, None, None]
    shared = _through_the_grid(places, masses, asked)
    return float(np.sqrt((shared**2).sum(axis=(1, 2)).mean()))


def _through_the_grid(places: Matrix, masses: Matrix, gradients: Matrix) -> Matrix:
    """The gradients that particles have after P2G and G2P of theirs alone, shape (particles, d, d)."""
    d = places.shape[1]
    nearest = np.round(places).astype(int)
    splines = [_spline(places[:, a] - nearest[:, a])[0] for a in range(d)]
    numbers: dict[tuple[int, ...], int] = {}
    columns, weights, ways = [], [], []
    for steps in itertools.product(range(3), repeat=d):
        nodes = nearest + np.array(steps) - 1
        columns.append([numbers.setdefault(tuple(node), len(numbers)) for node in nodes.tolist()])
        weights.append(np.prod([splines[a][steps[a]] for a in range(d)], axis=0))
        ways.append(nodes - places)
    column, weight, way = np.array(columns), np.array(weights), np.array(ways)
    mass, momentum = np.zeros(len(numbers)), np.zeros((len(numbers), d))
    np.add.at(mass, column, weight * masses)
    np.add.at(momentum, column, (weight * masses)[..., None] * np.einsum("pab,spb->spa", gradients, way))
    motion = momentum / np.maximum(mass, 1e-30)[:, None]
    return 4.0 * np.einsum("sp,spa,spb->pab", weight, motion[column], way)
