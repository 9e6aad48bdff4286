"""What `pbmpm bench` says of phases, of what a core can do, of peers and of memory: its arithmetic and its words. No test looks at how long anything took."""

from __future__ import annotations

import importlib.util
import io
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from click.testing import CliRunner

from pbmpm.lab.bench import peers, phases
from pbmpm.lab.bench.counts import Counts, Part, core_cache, flops_of, per_particle, read_parts, steps_of
from pbmpm.lab.bench.memory import measure_memory, memory_pieces, memory_row, memory_text
from pbmpm.lab.bench.peak import Peak
from pbmpm.lab.bench.peer_taichi import with_constants
from pbmpm.lab.bench.peers import PAIRS, RUNNER, Own, Peer, measure_peer, peer_pieces, peer_row, peers_text
from pbmpm.lab.bench.phases import LAPS, MANY_ITERATIONS, PHASES, PhaseCosts, measure_phases, phase_pieces, phase_rows, phases_text, split_solve
from pbmpm.lab.bench.roofline import COUNTED_ISAS, roofline_of, roofline_text
from pbmpm.lab.commands import bench as bench_command
from pbmpm.lab.commands.bench import bench
from pbmpm.lab.errors import InputError


def laps(solve: float, sort: float = 10e-6) -> dict[str, float]:
    own = {"sort": sort, "scatter": 5e-6, "contacts": 1e-6, "solve": solve, "integrate": 4e-6, "other": 0.0}
    return own | {"step": sum(own.values())}


def costs(few: list[float], many: list[float], used: tuple[int, int] = (5, 20)) -> PhaseCosts:
    return PhaseCosts("dual", 1000, few=[laps(solve) for solve in few], many=[laps(solve) for solve in many], wall_over_cpu=[1.0], used=used)


def test_what_starts_a_solver_is_told_from_its_iterations() -> None:
    """30 us to start and 4 us per iteration; a round that was disturbed does not count."""
    rows = {row["phase"]: row for row in phase_rows("liquid", 3, costs([50e-6, 50e-6, 50e-6], [110e-6, 990e-6, 110e-6]))}
    assert rows["iteration"]["ns_per_particle"] == pytest.approx(4.0)
    assert rows["start"]["ns_per_particle"] == pytest.approx(30.0)
    assert rows["rest"]["ns_per_particle"] == pytest.approx(50.0) and rows["rest"]["ns_per_particle_min"] == pytest.approx(50.0)
    assert rows["sort"]["ns_per_particle_min"] is None and rows["step"]["ns_per_particle_min"] == pytest.approx(70.0)
    assert sum(rows[phase]["share"] for phase in PHASES if phase in rows) == pytest.approx(1.0)


def test_a_solver_that_iterates_no_more_is_one_phase() -> None:
    assert split_solve({"solve": 3.0, "step": 5.0}, 0.0, (5, 5)) == {"solve": 3.0, "step": 5.0}
    rows = phase_rows("elastic", 3, costs([50e-6], [40e-6], used=(11, 10)))
    assert [row["phase"] for row in rows] == ["sort", "scatter", "contacts", "solve", "integrate", "other", "step"]


def test_a_disturbed_measurement_says_so() -> None:
    own = costs([50e-6], [110e-6])
    assert "Others had the core" not in phases_text(phase_rows("liquid", 3, own))
    own.wall_over_cpu = [1.5]
    assert "wall time 1.50 times CPU time" in phases_text(phase_rows("liquid", 3, own))


def test_phases_of_steps_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(phases, "TRIES", 1)
    ticks: list[None] = []
    found = measure_phases("liquid", 2, ("convergent", "paper"), 1, 2, lambda: ticks.append(None))
    assert len(ticks) == phase_pieces(1) and [own.variant for own in found] == ["convergent", "paper"]
    for own in found:
        assert own.used == (phases.ITERATIONS, MANY_ITERATIONS) and own.state is not None and own.memory_bytes > 100 * own.particles
        (few,), (many,) = own.few, own.many
        for taken in (few, many):
            assert sum(taken[name] for name in (*LAPS, "other")) == pytest.approx(taken["step"])
            assert min(taken[name] for name in LAPS) > 0.0


DISASSEMBLY = """
0000000000001000 <kernel>:
    1000:\tvfmadd213ps 0x10(%rax),%ymm1,%ymm2
    1006:\tvaddps %ymm1,%ymm2,%ymm3
    100a:\tmulps  %xmm1,%xmm2
    100d:\tvdivsd %xmm1,%xmm2,%xmm3
    1011:\tvfnmadd231ss %xmm1,%xmm2,%xmm3
    1016:\tvsqrtpd %zmm1,%zmm2
    101c:\tvmaxps %ymm1,%ymm2,%ymm3
    1020:\tvmovups %ymm1,(%rax)
    1024:\tvpaddd %ymm1,%ymm2,%ymm3
    1028:\taddq   $0x1,%rax
""".splitlines()
FLOPS = {0x1000: 16, 0x1006: 8, 0x100A: 4, 0x100D: 1, 0x1011: 2, 0x1016: 8}


def test_operations_of_instructions() -> None:
    assert flops_of(DISASSEMBLY) == FLOPS


def test_parts_of_callgrind(tmp_path: Path) -> None:
    """Lines of calls are what was called, counted elsewhere; other objects have other instructions at the same addresses."""
    library = tmp_path / "libpbmpm.so"
    part = tmp_path / "counts.1"
    part.write_text(
        "desc: Trigger: --dump-before=solver_solve\n"
        "events: Ir Dr Dw I1mr D1mr D1mw ILmr DLmr DLmw ILdmr DLdmr DLdmw\n"
        f"\nob={library}\nfn=kernel\n0x1000 10 10\n0x1006 3\ncalls=1 0x1000\n0x1000 500\n0x1020 7 0 7\n"
        "ob=/lib/libm.so\nfn=sin\n0x1000 900\n"
        "totals: 10 0 0 0 0 0 0 1 2 0 3 4\n"
    )
    (read,) = read_parts([part], library, FLOPS)
    assert read == Part("solver_solve", Counts(10 * 16 + 3 * 8, 64 * 10))


def test_a_part_belongs_to_the_phase_that_began_it() -> None:
    """Two groups of islands in one step; what is before and between steps is in none."""
    ends = ["pool_set_serial", "granular_prepare", "reach_find_groups", "solver_solve", "solver_before_going"]
    ends += ["granular_prepare", "reach_find_groups", "solver_solve", "solver_before_going", "colliders_end_step", "pool_set_serial", ""]
    steps = steps_of(Part(end, Counts(10**i, i)) for i, end in enumerate(ends))
    assert {name: own.flops for name, own in steps[0].items()} == {
        "sort": 10,
        "scatter": 10**2 + 10**6,
        "contacts": 10**3 + 10**7,
        "solve": 10**4 + 10**8,
        "integrate": 10**5 + 10**9,
    }
    assert len(steps) == 2 and list(steps[1]) == ["sort"]


def test_counts_per_particle() -> None:
    few = {"sort": Counts(0.0, 640.0), "solve": Counts(500.0, 64.0), "integrate": Counts(100.0, 0.0)}
    found = per_particle(few, {"solve": Counts(1700.0, 64.0)}, (5, 20), 10)
    assert found["iteration"] == Counts(8.0, 0.0) and found["start"] == Counts(10.0, 6.4)
    assert found["step"] == Counts(60.0, 70.4) and found["rest"] == Counts(20.0, 70.4) and found["contacts"] == Counts()


def test_the_cache_of_a_core(tmp_path: Path) -> None:
    for number, values in enumerate((("1", "48K", "12", "64"), ("2", "2048K", "16", "64"), ("3", "491520K", "16", "64"))):
        cache = tmp_path / f"index{number}"
        cache.mkdir()
        for name, value in zip(("level", "size", "ways_of_associativity", "coherency_line_size"), values):
            (cache / name).write_text(f"{value}\n")
    assert core_cache(tmp_path) == (2048 * 1024, 16, 64)
    assert core_cache(tmp_path / "none") is None


PEAK = Peak(100.0, 40.0, 48_000_000, "BLAS")


def test_shares_of_what_a_core_can_do() -> None:
    """20 ns per particle with 500 operations and 400 bytes: 25 of 100 GFLOP/s, 20 of 40 GB/s."""
    row = {"phase": "sort", "ns_per_particle": 20.0}
    got = roofline_of(row, PEAK, {"sort": Counts(500.0, 400.0)})
    assert (got["peak_units"], got["share_of_peak"], got["share_of_bandwidth"]) == pytest.approx((2000.0, 0.25, 0.5))
    assert "gflops" not in roofline_of(row, PEAK, {}) and roofline_of(row, PEAK, {})["peak_units"] == pytest.approx(2000.0)


def test_a_roofline_for_a_person(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = phase_rows("liquid", 3, costs([50e-6], [110e-6]))
    bare = [row | roofline_of(row, PEAK, {}) for row in rows]
    monkeypatch.setattr("pbmpm.lab.bench.roofline.missing_tools", lambda: ["valgrind"])
    assert "Operations and bytes are not counted: valgrind not installed." in roofline_text(bare)
    text = roofline_text([row | roofline_of(row, PEAK, {"sort": Counts(500.0, 200.0)}) for row in rows])
    assert "100.0 GFLOP/s (product of matrices, BLAS), 40.0 GB/s (sum of arrays of 48 MB in all" in text
    (sort,) = (line for line in text.splitlines() if line.startswith("  sort"))
    assert sort.split()[1:] == ["10.0", "-", "14%", "1000", "500", "200", "50.0", "50%", "20.0", "50%"]


def fake_peer(text: str) -> list[str]:
    return [sys.executable, "-c", text]


FAKE = """
import json, sys
print(json.dumps({"particles": 1000, "dt": 1e-4, "version": "Fake 1"}), flush=True)
for line in sys.stdin: print(json.dumps({"seconds": 1e-3 * int(line), "height": 0.5}), flush=True)
"""


def test_a_peer_has_its_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peers, "ITERATIONS", (5,))
    ticks: list[None] = []
    rows = measure_peer(fake_peer(FAKE), ("mpm99", "liquid", 2), 2, 1, lambda: ticks.append(None))
    assert len(ticks) == peer_pieces(2) and [(row["solver"], row["iterations"]) for row in rows] == [("convergent", 5), ("paper", 5)]
    assert all(row["peer_million_particle_substeps_per_second"] == pytest.approx(1.0) for row in rows)
    assert all(row["particles"] == 48000 and row["ratio"] > 0.0 for row in rows)
    assert "mpm99 of Fake 1, 1000 particles: 1.00 (0.1000); liquid 2D, 48000 particles:" in peers_text(rows)


def test_the_ratio_to_a_peer_is_that_of_the_same_rounds() -> None:
    """10 iterations of 2,000 particles in 20 ms are one per microsecond; the peer does half as much. A disturbed round disturbs both."""
    own = Own("paper", 10, 2000, seconds=[0.02, 0.04, 0.02])
    row = peer_row("mpm3d", "liquid", 3, own, {"particles": 1000, "dt": 1e-4, "version": "V"}, [0.002, 0.004, 0.002])
    assert row["million_particle_iterations_per_second"] == pytest.approx(1.0) and row["peer_million_particle_substeps_per_second"] == pytest.approx(0.5)
    assert row["ratio"] == pytest.approx(2.0) and row["ratio_of_least"] == pytest.approx(2.0)
    assert row["simulated_seconds_per_second"] == pytest.approx(1 / 60 / 0.02) and row["peer_simulated_seconds_per_second"] == pytest.approx(0.05)


def test_peers_that_do_not_run_say_why() -> None:
    with pytest.raises(InputError, match=r"Taichi is not installed \(pip install 'pbmpm\[peers\]'"):
        Peer(fake_peer("raise SystemExit('Taichi is not installed')"))
    with Peer(fake_peer(FAKE.replace("0.5", "float('nan')"))) as peer, pytest.raises(InputError, match="not finite"):
        peer.take(1)


def test_constants_of_an_example_are_set() -> None:
    source = "dim, n_grid, dt = 3, 32, 4e-4  # here\nn = n_grid**dim // 2\nif dim == 3:\n    n = 7\nx = n_grid\n"
    scope: dict[str, object] = {}
    exec(with_constants(source, {"dt": 1e-3, "n": 50, "n_grid": 128}), scope)
    assert (scope["dim"], scope["n_grid"], scope["dt"], scope["x"]) == (3, 128, 1e-3, 128)
    assert with_constants(source, {"n": 50}).splitlines()[1] == "n = 50"
    with pytest.raises(SystemExit, match="no constant quality"):
        with_constants(source, {"quality": 2})


FAKE_TAICHI = """
__version__, cpu, gpu = (9, 8, 7), "cpu", "gpu"
def init(arch, cpu_max_num_threads): assert (arch, cpu_max_num_threads) == ("cpu", 1)
def sync(): print("noise")
"""
FAKE_EXAMPLE = """
import numpy as np
import taichi as ti
ti.init(arch=ti.gpu)
dim, n_grid, steps, dt = 3, 32, 25, 4e-4
n_particles = n_grid
class F_x:
    @staticmethod
    def to_numpy(): return np.full((4, 3), done)
done = -1
def init():
    global done
    done = 0
def substep():
    global done
    done += 1
"""


def test_the_runner_of_an_example(tmp_path: Path) -> None:
    """With a stand-in for Taichi, which prints. One substep is for compilation."""
    folder = tmp_path / "taichi" / "examples" / "simulation"
    folder.mkdir(parents=True)
    (tmp_path / "taichi" / "__init__.py").write_text(FAKE_TAICHI)
    (folder / "mpm3d.py").write_text(FAKE_EXAMPLE)
    command = [sys.executable, "-c", f"import sys, runpy; sys.path.insert(0, {str(tmp_path)!r}); sys.argv[1:] = ['mpm3d']; runpy.run_path({str(RUNNER)!r}, run_name='__main__')"]
    with Peer(command) as peer:
        assert peer.facts == {"particles": 134217, "dt": 2e-4, "version": "Taichi 9.8.7"}
        assert peer.take(3) >= 0.0
    answers = subprocess.run(command, input="3\n2\n", capture_output=True, text=True, check=True).stdout
    assert '"height": 4.0' in answers.splitlines()[1] and '"height": 6.0' in answers.splitlines()[2]


def test_each_pair_has_an_example() -> None:
    from pbmpm.lab.bench.peer_taichi import EXAMPLES

    assert {example for example, *_ in PAIRS} == set(EXAMPLES)


def test_bytes_of_worlds() -> None:
    """300 bytes for each of 1,000, and 10,000 besides."""
    row = memory_row("liquid", 3, "dual", (1000, 300_000), (100, 40_000))
    assert row["bytes_per_particle"] == 300.0 and row["small_world_bytes_besides"] == 10_000.0
    assert "300 per particle of 1000; a world of 100 takes 10 KB besides" in memory_text([row], 60)
    ticks: list[None] = []
    (measured,) = measure_memory("liquid", 2, ["paper"], 1, lambda: ticks.append(None))
    assert len(ticks) == memory_pieces(["paper"]) and (measured["particles"], measured["small_world_particles"]) == (48000, 64)
    assert 100 < measured["bytes_per_particle"] < 1000


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--phases", "--roofline"], "choose one"),
        (["--peers", "--memory"], "choose one"),
        (["--peer-python", sys.executable], "--peers"),
        (["--peers", "--solvers", "dual"], "--solvers cannot be used with it"),
        (["--phases", "--solvers", "explicit"], "has no iterations"),
    ],
)
def test_what_cannot_be_measured_together_is_refused(options: list[str], says: str) -> None:
    done = CliRunner().invoke(bench, options)
    assert done.exit_code == 2 and says in done.output


def test_instructions_that_are_not_counted_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pbmpm.lab.bench.counts.missing_tools", lambda: [])
    monkeypatch.setattr("pbmpm.isa", lambda: "AVX-512")
    done = CliRunner().invoke(bench, ["--roofline"])
    assert done.exit_code == 2 and "set PBMPM_ISA=avx2" in done.output and "AVX-512" not in COUNTED_ISAS


def test_every_way_to_measure_is_an_option() -> None:
    assert {option.name for option in bench.params} >= set(bench_command.MODES)


@pytest.fixture(scope="module")
def table(root: Path) -> ModuleType:
    specification = importlib.util.spec_from_file_location("table", root / "tests" / "bench" / "table.py")
    assert specification is not None and specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_tables_are_compared(table: ModuleType) -> None:
    def written(ns: float, **more: float) -> dict[tuple[str, ...], dict[str, str]]:
        row = {"material": "liquid", "dims": 3, "solver": "dual", "phase": "sort", "ns_per_particle_min": ns, **more}
        report = {"machine": {"cpu": "C, D", "isa": "AVX2", "date": "2026-01-02"}, "compilers": ["gcc 12"], "rows": [row, {"material": "sand", "dims": 2}]}
        file = io.StringIO()
        table.write_table(table.rows_of("mine", [report]), file)
        file.seek(0)
        read: dict[tuple[str, ...], dict[str, str]] = table.read_table(file)
        return read

    old, new = written(40.0), written(30.0, peak_units=3000.0)
    assert len(old) == 2 and next(iter(old.values()))["cpu"] == "C, D"
    (line,) = table.comparison(old, new, table.COMPARED)
    assert line.split() == ["liquid", "3", "dual", "sort", "ns_per_particle_min", "40", "30", "0.75"]


def test_the_kept_tables_can_be_read(table: ModuleType, root: Path) -> None:
    kept = sorted((root / "tests" / "bench").glob("*.csv"))
    assert kept
    for path in kept:
        with path.open(encoding="utf-8", newline="") as file:
            rows = table.read_table(file)
        assert rows and {row["label"] for row in rows.values()} == {path.stem}
        assert table.comparison(rows, rows, table.COMPARED)
