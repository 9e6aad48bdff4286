"""What a step cost, what state it left, and what happened in it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, TypeVar

from ._choice import Choice
from ._convert import plain
from ._ffi import ffi
from .settings import Solver, Stop


@dataclass(frozen=True)
class StepStats:
    """Figures that the last step has left behind; before the first all are 0 but the counts. Times are of the whole step (all
    substeps)."""

    particle_count: int  #: live particles
    step_count: int  #: steps since creation
    simulated_seconds: float  #: since creation
    memory_bytes: int  #: held by the world
    particle_blocks: int  #: blocks of 4^d cells with particles
    node_blocks: int  #: blocks of 4^d nodes that they touch
    contacts: int  #: node-obstacle pairs in the last substep
    substeps: int  #: of the step
    iterations: int  #: per substep
    thread_count: int  #: shares the work was cut into
    ms_total: float  #: wall time of the step [ms]
    ms_sort: float  #: ... of which binning and reordering
    ms_scatter: float  #: first particle-to-grid transfer and predictor
    ms_contacts: float  #: finding nodes near obstacles
    ms_iterate: float  #: the iterations
    ms_integrate: float  #: last grid-to-particle transfer, integration, guards
    max_displacement: float  #: largest displacement of the last substep [cells]
    cell_changes: float  #: share of particles that left their cell in the last substep
    deleted_total: int  #: particles deleted by the library since creation
    clamped_total: int  #: times a particle was slowed to max_displacement since creation
    solver: Solver  #: that the last substep was solved with; CONVERGENT: with several
    stop: Stop  #: what ended its iterations
    iterations_used: int  #: by it; passes that a line search repeats and those of deep sand beyond the set ones count too
    residual: float  #: its last change per iteration [cells], root mean square; 0 for the paper's and the explicit solver
    predicted_error: float  #: root mean square distance from the converged displacements [cells], as predicted from it
    energy_checks_failed: int  #: primal: bodies whose unfinished solution would have gained energy and was replaced
    particles_asleep: int  #: particles that the last substep did not move because they sleep
    blocks_asleep: int  #: blocks that took no part in it; particle_blocks counts those that did
    blocks_drowsy: int  #: of particle_blocks, those that took part without being moved: next to blocks that are awake
    blocks_woken: int  #: blocks that woke in the last step, and by calls before it


@dataclass(frozen=True)
class Stats(StepStats):
    """Those, and figures of the present state. Momenta are relative to the world's origin; in 2D only the third component of the
    angular momentum is used."""

    volume_error_rms: float  #: root mean square of |J - 1| over particles
    volume_error_max: float  #: largest |J - 1|
    max_speed: float  #: [m/s]
    mass: float  #: [kg]
    momentum: tuple[float, float, float]  #: [kg m/s]
    angular_momentum: tuple[float, float, float]  #: about the origin [kg m^2/s]
    kinetic_energy: float  #: translation of particles [J]
    potential_energy: float  #: in gravity, relative to the origin [J]
    lane_occupancy: float  #: share of SIMD lanes that held a particle


class EventKind(Choice):
    """What happened."""

    DELETED_NOT_FINITE = ffi.integer_const("PBMPM_EVENT_DELETED_NOT_FINITE")  #: its state was NaN or infinite
    DELETED_OUT_OF_RANGE = ffi.integer_const("PBMPM_EVENT_DELETED_OUT_OF_RANGE")  #: too far from the origin
    DELETED_CONDITION = ffi.integer_const("PBMPM_EVENT_DELETED_CONDITION")  #: strained beyond condition_max
    SPEED_CLAMPED = ffi.integer_const("PBMPM_EVENT_SPEED_CLAMPED")  #: slowed to max_displacement
    CAPACITY = ffi.integer_const("PBMPM_EVENT_CAPACITY")  #: a call asked for more particles than there is room for
    EMISSION_REFUSED = ffi.integer_const("PBMPM_EVENT_EMISSION_REFUSED")  #: an emitter had no space, budget or room
    KILLED = ffi.integer_const("PBMPM_EVENT_KILLED")  #: left the kill bounds


@dataclass(frozen=True)
class Event:
    """Something that happened to particles in the last step or in a call since then.

    Attributes:
        kind: what.
        count: how many particles (deletions: always 1).
        particle: identifier (index, generation) of the particle, or of the first one.
        position: where [m], one number per axis.
        substep: in which substep of the step.
        step: `Stats.step_count` when it happened.
    """

    kind: EventKind
    count: int
    particle: tuple[int, int]
    position: tuple[float, ...]
    substep: int
    step: int


_Kind = TypeVar("_Kind", bound=StepStats)


def stats_from_c(stats: Any, kind: type[_Kind]) -> _Kind:
    values = {item.name: plain(getattr(stats, item.name)) for item in fields(kind)}
    return kind(**{**values, "solver": Solver(stats.solver), "stop": Stop(stats.stop)})


def event_from_c(event: Any, dimension: int) -> Event:
    return Event(
        kind=EventKind(event.kind),
        count=event.count,
        particle=(event.particle.index, event.particle.generation),
        position=tuple(event.position)[:dimension],
        substep=event.substep,
        step=event.step,
    )
