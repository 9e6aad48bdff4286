"""Who carries out runs: processes of this machine and workers of a Dask cluster; what happens to those that die."""

from __future__ import annotations

import importlib.util
import itertools
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import errands
import pytest
from dask_cluster import DaskCluster

from pbmpm.lab.accuracy.registry import all_cases
from pbmpm.lab.accuracy.sweep import Choice
from pbmpm.lab.accuracy.task import Task, measure_case
from pbmpm.lab.errors import InputError
from pbmpm.lab.files import json_text
from pbmpm.lab.loading import load_scene
from pbmpm.lab.stability.cases import find_case
from pbmpm.lab.stability.plan import Run, Selection, plan
from pbmpm.lab.stability.result import row_of
from pbmpm.lab.stability.sweep import sweep
from pbmpm.lab.tune.report import text_of
from pbmpm.lab.tune.sweep import Plan, measure_family, tune
from pbmpm.lab.workers import cores
from pbmpm.lab.workers.attempt import Children, Lost, Terms
from pbmpm.lab.workers.child import Child, ChildDied
from pbmpm.lab.workers.cluster import Cluster
from pbmpm.lab.workers.facts import differences, own_facts
from pbmpm.lab.workers.workers import Workers

HERE = str(Path(__file__).parent)
SCENE = Path(__file__).parents[2] / "samples" / "scenes" / "column_2d.json"
WAIT_SECONDS = 60.0

needs_dask = pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="no Dask: pip install 'pbmpm[cluster]'")
needs_affinity = pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="the system binds no process to a core")


@pytest.fixture(autouse=True)
def _children_find_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", HERE, prepend=os.pathsep)


def results(workers: Workers, work: Callable[[Any], Any], items: list[Any]) -> list[Any]:
    found: dict[int, Any] = {}
    workers.carry_out(work, items, found.__setitem__)
    return [found[index] for index in range(len(items))]


def wait_for(true: Callable[[], bool]) -> None:
    end = time.monotonic() + WAIT_SECONDS
    while not true():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def alive(process: int) -> bool:
    """Whether it runs: one that ended and that nobody has asked for yet does not."""
    try:
        return " Z " not in Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except OSError:
        return False


@pytest.mark.parametrize("workers", [Workers(), Workers(2), Workers(2, timed=True)], ids=["here", "processes", "timed"])
def test_results_come_with_their_index(workers: Workers) -> None:
    assert results(workers, errands.double, [5, 6, 7]) == [10, 12, 14]


def test_those_first_in_the_order_begin_first() -> None:
    told: list[int] = []
    Workers().carry_out(errands.double, [1, 2, 3], lambda index, _: told.append(index), [2, 0, 1])
    assert told == [2, 0, 1]


def test_a_process_serves_many_runs() -> None:
    assert len(set(results(Workers(2), errands.process, list(range(8))))) <= 2


def test_what_a_run_raises_is_raised_here() -> None:
    child = Child()
    with pytest.raises(ValueError, match="plain"):
        child.do(errands.fail, "plain")
    with pytest.raises(RuntimeError, match="Unpicklable: very odd"):
        child.do(errands.fail, "odd")
    assert child.do(errands.double, 4) == 8
    child.end()
    with pytest.raises(ChildDied):
        child.do(errands.double, 4)


def test_a_process_that_dies_takes_its_own_run_alone() -> None:
    found = results(Workers(2), errands.die_at_three, list(range(6)))
    assert found == [0, 2, 4, Lost("the process died"), 8, 10]


def test_a_run_whose_process_died_is_tried_once_more(tmp_path: Path) -> None:
    notes = tmp_path / "notes"
    assert results(Workers(2), errands.die_once, [str(tmp_path / "a"), str(tmp_path / "b")]) == ["done", "done"]
    assert isinstance(results(Workers(2), errands.note_and_die, [str(notes)])[0], Lost)
    assert notes.read_text(encoding="utf-8").splitlines() == ["tried", "tried"]


def test_a_run_that_dies_is_a_failed_row() -> None:
    """Its case is in no catalogue of the process: there is nothing that could die as surely as one that is made to."""

    class Dying(Workers):
        def carry_out(self, work: Any, items: Any, told: Any, order: Any = None) -> None:
            for index in order:
                told(index, Lost("the process died"))

    runs = plan(Selection(cases=(find_case("H04"),), solvers=("paper",), dimensions=(2,), quick=True))
    outcomes = sweep(runs, Dying())
    assert [outcome.setting for outcome in outcomes] == [run.setting for run in runs]
    assert all(not row_of(outcome)["passed"] and row_of(outcome)["check"] == "the process died" for outcome in outcomes)


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGINT])
def test_no_process_is_left_when_the_one_that_asked_is_gone(tmp_path: Path, end: signal.Signals) -> None:
    mark = tmp_path / "mark"
    code = (
        "import signal, errands\n"
        "from pbmpm.lab.workers.workers import Workers\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"Workers(2).carry_out(errands.sleep, [{str(mark)!r}, {str(mark)!r}], print)\n"
    )
    asking = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    wait_for(lambda: mark.exists() and bool(mark.read_text()))
    child = int(mark.read_text())
    assert alive(child)
    asking.send_signal(end)
    assert asking.wait(WAIT_SECONDS) != 0
    wait_for(lambda: not alive(child))


def test_a_worker_that_would_give_other_rows_is_refused() -> None:
    facts = own_facts()
    assert differences(facts, facts) == ""
    assert differences(facts, {**facts, "library": "1", "ISA": "none"}) == (
        f"ISA is {facts['ISA']}, not none; library is {facts['library']}, not 1"
    )
    children = Children()
    with pytest.raises(InputError, match="would give other rows: Python code is .*, not older"):
        children.attempt(errands.double, 1, Terms(False, {**facts, "Python code": "older"}))
    assert children.attempt(errands.double, 1, Terms(False, facts)) == 2
    children.close()


@needs_affinity
def test_timed_runs_have_a_core_each_and_wait_for_it() -> None:
    """More of them than there are cores."""
    allowed = os.sched_getaffinity(0)
    runs = results(Workers(len(allowed) + 1, timed=True), errands.core, [0.3] * (len(allowed) + 1))
    assert all(len(run.processors) == 1 and run.processors <= allowed for run in runs)
    for one, other in itertools.combinations(runs, 2):
        together = one.begin < other.end and other.begin < one.end
        assert not (together and one.processors == other.processors)


@needs_affinity
def test_a_core_is_given_back() -> None:
    allowed = os.sched_getaffinity(0)
    for _ in range(2 * len(allowed)):
        with cores.own_core():
            assert len(os.sched_getaffinity(0)) == 1
        assert os.sched_getaffinity(0) == allowed


def test_of_processors_that_share_a_core_one_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cores, "_siblings", lambda processor: {processor % 2, processor % 2 + 2})
    assert cores._one_of_each_core({0, 1, 2, 3}) == [0, 1]
    assert cores._one_of_each_core({2, 3}) == [2, 3]


def test_cases_of_accuracy_travel() -> None:
    child = Child()
    assert [case.name for case in child.do(list, all_cases())] == [case.name for case in all_cases()]
    child.end()


def command(*options: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "pbmpm", *map(str, options)]
    return subprocess.run(line, capture_output=True, text=True, timeout=300, check=False, cwd=folder)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("stability", "H04", "--scheduler", "somewhere"), "not an address like tcp://HOST:8786"),
        (("stability", "H04", "--scheduler", "tcp://localhost:1", "--processes", 2), "do not go with --scheduler"),
        (("accuracy", "couette", "--processes", 2, "--threads", 2), "they need --threads 1"),
        (("tune", SCENE, "--budget-ms", 4, "--scheduler", "tcp://localhost:1"), "they need --threads 1"),
    ],
)
def test_bad_usage(tmp_path: Path, options: tuple[object, ...], said: str) -> None:
    done = command(*options, folder=tmp_path)
    assert done.returncode == 2 and said in done.stderr


def test_without_dask_the_command_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'pbmpm\[cluster\]'"):
        Workers(scheduler="tcp://localhost:1").carry_out(errands.double, [1], print)


def without(names: set[str], rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Rows without what differs from run to run."""
    return [{name: value for name, value in row.items() if name not in names} for row in rows]


def test_rows_of_accuracy_from_two_processes_are_those_of_one(tmp_path: Path) -> None:
    names, file = ("taylor-green", "couette"), tmp_path / "rows.json"
    options = ("--solvers", "dual", "--rates", 30, "--iterations", 2, "--cells", 8, "--no-converged", "--json", file)
    assert command("accuracy", *names, *options, "--processes", 2).returncode == 0
    choice = Choice(variants=["dual"], rates=[30.0], iterations=[2], cells=[8])
    serial = [row for name in names for row in measure_case(Task(name, choice, 1.0, False)).rows]
    times = {"ms_per_simulated_second"}
    assert without(times, json.loads(file.read_text())["rows"]) == without(times, json.loads(json_text(serial)))


def test_rows_of_tune_from_two_processes_are_those_of_one() -> None:
    scene = load_scene(SCENE)
    asked = Plan(seconds=0.02, frame_rate=60.0, budget_ms=1e5, threads=1, percentile=50.0, reference_iterations=5)
    alone, together = (tune(scene, asked, Workers(count, timed=True)) for count in (1, 2))
    times = {"ms_median", "ms_p99", "interruptions"}
    rows = [without(times, [result.as_dict() for result in tuning.results]) for tuning in (alone, together)]
    assert rows[0] == rows[1] and len(rows[0]) > 50 and together.reference.observation.machine["cpu"] == own_facts()["CPU"]


def test_settings_whose_process_died_are_failed_rows_of_tune(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second half of what is to be done: the families, after the reference."""
    original = Workers.carry_out

    def dying(self: Workers, work: Any, items: Any, told: Any, order: Any = None) -> None:
        if work is not measure_family:
            original(self, work, items, told, order)
            return
        for index in range(len(items)):
            told(index, Lost("the process died"))

    monkeypatch.setattr(Workers, "carry_out", dying)
    scene = load_scene(SCENE)
    asked = Plan(seconds=0.02, frame_rate=60.0, budget_ms=4.0, threads=1, percentile=50.0, reference_substeps=2, reference_iterations=1)
    found = tune(scene, asked, Workers())
    assert found.results and found.skipped == 0 and found.cheapest() is None
    assert all(result.reasons == ("the process died",) and not result.usable for result in found.results)
    assert "the process died" in text_of(found, {}, {})


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[DaskCluster]:
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("PYTHONPATH", HERE, prepend=os.pathsep)
        made = DaskCluster(tmp_path_factory.mktemp("dask"))
    yield made
    made.end()


@needs_dask
def test_a_run_that_dies_on_a_cluster_ends_no_worker_and_other_builds_are_refused(
    cluster: DaskCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    notes, working = tmp_path / "notes", cluster.working
    assert results(Workers(scheduler=cluster.address), errands.note_and_die, [str(notes)]) == [Lost("the process died")]
    assert notes.read_text(encoding="utf-8").splitlines() == ["tried", "tried"]
    assert results(Workers(scheduler=cluster.address), errands.die_at_three, [1, 3, 5])[2] == 10
    assert cluster.working == working
    monkeypatch.setattr("pbmpm.lab.workers.cluster.own_facts", lambda: {**own_facts(), "library": "newer"})
    with pytest.raises(InputError, match="would give other rows: library is .*, not newer"):
        results(Workers(scheduler=cluster.address), errands.double, [1])


@needs_dask
def test_times_of_different_cpus_are_not_mixed(cluster: DaskCluster, monkeypatch: pytest.MonkeyPatch) -> None:
    workers = Workers(scheduler=cluster.address, timed=True)
    assert results(workers, errands.double, [1]) == [2]
    cpu = own_facts()["CPU"]
    original = Cluster.facts
    monkeypatch.setattr(Cluster, "facts", lambda self, timed: {**original(self, timed), "CPU": "of the first worker"})
    with pytest.raises(InputError, match="CPU is .*, not of the first worker") as problem:
        results(workers, errands.double, [1])
    assert cpu in str(problem.value)


def small_map() -> list[Run]:
    return plan(Selection(cases=(find_case("H04"), find_case("H10")), dimensions=(2,), quick=True))


@needs_dask
def test_a_worker_that_is_killed_half_way_costs_no_row(cluster: DaskCluster) -> None:
    """Each run that it had is run again by the other one, and the rows are those of the serial run. The last test: it leaves one
    worker."""
    runs, told, working = small_map(), 0, cluster.working

    def kill_half_way(_: object) -> None:
        nonlocal told
        told += 1
        if told == len(runs) // 2:
            cluster.kill_one()

    found = [row_of(outcome) for outcome in sweep(runs, Workers(scheduler=cluster.address), kill_half_way)]
    serial = [row_of(outcome) for outcome in sweep(runs, Workers())]
    assert cluster.working == working - 1 and told == len(runs) >= 20
    assert [{**row, "seconds": 0} for row in found] == [{**row, "seconds": 0} for row in serial]
