"""Runs an example of Taichi's as it is but for its size, and says what its substeps cost. A program of its own, which needs Taichi and not pbmpm:

    python peer_taichi.py EXAMPLE

It prints a line of JSON when the example is ready: its particles, its time step and Taichi's version. Then for each number that it reads it does so many substeps, and prints a line with the CPU time that they took
and the particles' mean height.
"""

import ast
import importlib.util
import json
import sys
import tempfile
import time
from pathlib import Path
from unittest.mock import MagicMock

EXAMPLES = {
    # Of cells a side only powers of two run. A cube of 0.4 of the width: 8 particles per cell, as in our scenes. Its file has this time step for 64 cells, too.
    "mpm3d": ("simulation/mpm3d.py", {"n_grid": 64, "dt": 2e-4, "n_particles": 134217}),
    "jelly": ("ggui_examples/mpm3d_ggui.py", {"n_grid": 64, "dt": 2e-4, "n_particles": 134217}),
    "mpm99": ("simulation/mpm99.py", {"quality": 2}),
}
"""Per name the file, and constants of it that are set."""


def with_constants(source, constants):
    """The source, with other values in the first assignments to names at its top level."""
    places = {}
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign):
            target, value = node.targets[0], node.value
            pairs = zip(target.elts, value.elts) if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) else [(target, value)]
            for name, old in pairs:
                if isinstance(name, ast.Name):
                    places.setdefault(name.id, old)
    missing = sorted(set(constants) - set(places))
    if missing:
        raise SystemExit(f"the example has no constant {', '.join(missing)}")
    lines = source.splitlines(keepends=True)
    for name in sorted(constants, key=lambda name: (places[name].lineno, places[name].col_offset), reverse=True):
        old = places[name]
        row = old.lineno - 1
        lines[row] = lines[row][: old.col_offset] + repr(constants[name]) + lines[row][old.end_col_offset :]
    return "".join(lines)


def load(taichi, name, folder):
    """The example as a module, on one thread of the CPU and without a window."""
    path, constants = EXAMPLES[name]
    source = (Path(taichi.__file__).parent / "examples" / path).read_text(encoding="utf-8")
    copy = Path(folder) / f"{name}.py"
    copy.write_text(with_constants(source, constants), encoding="utf-8")
    start = taichi.init
    taichi.init = lambda **options: start(arch=taichi.cpu, cpu_max_num_threads=1)
    taichi.ui = MagicMock()
    specification = importlib.util.spec_from_file_location(name, copy)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def begin(taichi, name, module):
    """Places the particles; returns what does a substep, and their positions."""
    if name == "mpm3d":
        module.init()
        return module.substep, module.F_x
    if name == "mpm99":
        module.initialize()
        return module.substep, module.x
    cube = module.CubeVolume(taichi.Vector([0.55, 0.05, 0.55]), taichi.Vector([0.4, 0.4, 0.4]), module.JELLY)
    module.init_vols([cube])
    return lambda: module.substep(*module.GRAVITY), module.F_x


def main():
    name = sys.argv[1]
    said, sys.stdout = sys.stdout, sys.stderr  # Taichi and its examples print
    try:
        import taichi
    except ImportError:
        raise SystemExit("Taichi is not installed") from None
    with tempfile.TemporaryDirectory() as folder:
        module = load(taichi, name, folder)
        substep, positions = begin(taichi, name, module)
        substep()
        taichi.sync()  # compiled now
        facts = {"particles": module.n_particles, "dt": module.dt, "version": "Taichi " + ".".join(map(str, taichi.__version__))}
        print(json.dumps(facts), file=said, flush=True)
        for line in sys.stdin:
            started = time.process_time()
            for _ in range(int(line)):
                substep()
            taichi.sync()
            seconds = time.process_time() - started
            print(json.dumps({"seconds": seconds, "height": float(positions.to_numpy()[:, 1].mean())}), file=said, flush=True)


if __name__ == "__main__":
    main()
