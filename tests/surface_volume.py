"""Surfaces of the 3D scenes of samples/scenes: whether they are closed, what they enclose of the matter, what they cost beside a step.

`surface_volume.py [--subdivision N] [--no-thin] [--seconds S] [SCENE...]` prints a table. The matter's volume is that of its particles at rest, of solids times
their volume ratio; spray is what surfaces leave out. Crushed is what matter in a cell of the grid has more than the cell's volume: no surface can enclose it.
Uneven particles alone make some percent of that. CPU times are medians over steps and surfaces that take turns. The exit status is 1 if a surface is open,
or if one differs by more than 5 % from matter without spray.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from statistics import median

import numpy as np

import pbmpm
from pbmpm.lab.loading import load_scene
from pbmpm.lab.simulation import RunSettings, Simulation

SCENES = Path(__file__).resolve().parents[1] / "samples" / "scenes"
MOST = 0.05


def open_edges(mesh: pbmpm.Mesh) -> int:
    """Edges that lack a triangle in one of the two directions."""
    corners = mesh.triangles.astype(np.int64)
    ways = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    there, back = (np.sort(a * len(mesh.positions) + b) for a, b in (ways.T, ways.T[::-1]))
    return int((there != back).sum() + (there[1:] == there[:-1]).sum())


def cpu_ms(work) -> tuple[float, object]:
    start = time.process_time()
    result = work()
    return 1e3 * (time.process_time() - start), result


def measure(path: Path, options: argparse.Namespace) -> dict[str, float]:
    scene = load_scene(path)
    settings = RunSettings.of(scene, threads=1)
    with Simulation(scene, settings) as simulation:
        world, looks, steps, costs, kept = simulation.world, [], [], [], []
        every = max(1, round(settings.rate_hz / 4))
        while simulation.time < options.seconds:
            steps.append(cpu_ms(simulation.step)[0])
            cost, _ = cpu_ms(lambda: world.surface(subdivision=options.subdivision, keeps_thin=options.thin))
            costs.append(cost)
            if simulation.steps % every == 0:
                kept.append(look_at(world, list(simulation.materials.values()), options))
        looks = [look for look in kept if look]
        return {
            "particles": len(world),
            "triangles": looks[-1]["triangles"],
            "open": max(look["open"] for look in looks),
            "least": min(look["volume"] for look in looks),
            "most": max(look["volume"] for look in looks),
            "spray": max(look["spray"] for look in looks),
            "crushed": max(look["crushed"] for look in looks),
            "step": median(steps),
            "surface": median(costs),
        }


def crushed(points: np.ndarray, volumes: np.ndarray, cell_size: float) -> float:
    cells, place = np.unique(np.floor(points / cell_size).astype(np.int64), axis=0, return_inverse=True)
    held = np.bincount(place.ravel(), volumes, len(cells))
    return np.maximum(held - cell_size**3, 0.0).sum() / volumes.sum()


def look_at(world: pbmpm.World, materials: list[pbmpm.Material], options: argparse.Namespace) -> dict[str, float]:
    """Each material by itself: between two that touch there are two surfaces."""
    meshes = [world.surface([material], subdivision=options.subdivision, keeps_thin=options.thin) for material in materials]
    points, spray = world.surface_points(), [world.surface_points([material], spray_only=True) for material in materials]
    volumes, left_out = (4 / 3 * np.pi * it["radius"].astype(float) ** 3 for it in (points, np.concatenate(spray)))
    matter, left_out = volumes.sum(), left_out.sum()
    return {
        "triangles": sum(len(mesh.triangles) for mesh in meshes),
        "open": sum(open_edges(mesh) for mesh in meshes),
        "volume": sum(mesh.volume for mesh in meshes) / (matter - left_out),
        "spray": left_out / matter,
        "crushed": crushed(points["position"].astype(float), volumes, world.cell_size),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=["glass_jelly_3d", "boat_3d", "water_wheel_3d", "dam_break_blocks_3d", "hourglass_3d", "workshop_3d"])
    parser.add_argument("--subdivision", type=int, default=2)
    parser.add_argument("--no-thin", dest="thin", action="store_false")
    parser.add_argument("--seconds", type=float, default=2.0)
    options = parser.parse_args()
    print("| scene | particles | triangles | open edges | volume / matter % | spray % | crushed % | step ms | surface ms | share % |\n|---|---:|---:|---:|---|---:|---:|---:|---:|---:|")
    bad = 0
    for name in options.scenes:
        it = measure(SCENES / f"{name}.json", options)
        print(
            f"| {name} | {it['particles']} | {it['triangles']} | {it['open']} | {100 * it['least']:.1f} to {100 * it['most']:.1f} | {100 * it['spray']:.1f} | {100 * it['crushed']:.1f}"
            f" | {it['step']:.2f} | {it['surface']:.2f} | {100 * it['surface'] / it['step']:.0f} |",
            flush=True,
        )
        bad += it["open"] > 0 or abs(it["least"] - 1) > MOST or abs(it["most"] - 1) > MOST
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
