"""How much strain no motion can remove: the particles of a cell share one displacement gradient."""

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
