"""Liquids and elastic solids in real time by the Position Based Material Point Method.

>>> import pbmpm
>>> with pbmpm.World(2, 0.05, gravity=(0, -9.81), domain=((0, 0), (2, 1))) as world:
...     water = world.add_material(pbmpm.Liquid())
...     count = world.fill(pbmpm.Box((0.5, 0.25), (0.4, 0.2)), water)
...     for _ in range(60):
...         world.step(1 / 60)
...     heights = world.positions[:, 1]
"""

from ._ffi import ffi as _ffi
from ._library import lib as _lib
from ._library import library_path, version_text
from .advice import Advice, AdviceCode, Change
from .colliders import Collider, Friction, Touch, TouchState
from .debug import DebugPart
from .domain import Wall
from .errors import (
    BusyError,
    CapacityError,
    ClosedError,
    DamagedError,
    ExpiredViewError,
    ForeignError,
    ForkedError,
    InUseError,
    InvalidArgumentError,
    InvalidIdError,
    LibraryError,
    OutOfMemoryError,
    PbmpmError,
    ThreadError,
    UnsupportedCpuError,
    UnsupportedError,
)
from .flow import Drain, DrainStatus, Emitter, EmitterStatus, Flow, Region
from .forces import Falloff, Force, ForceKind
from .materials import Effective, Elastic, ElasticModel, Liquid, Material, Sand, StrainPolicy, Visco, built_materials
from .queries import PointFields, RayHit, RegionShare
from .rigid import Freedom, Mass, RigidBody, Submersion
from .settings import Integrator, Pressure, Solver, Stop
from .shapes import Baked, Box, Capsule, Plane, Shape, Sphere
from .solids import BakedSolid, Impulse, LoadedSolid, SolidInfo, bake_heights, bake_hull, bake_mesh
from .stats import Event, EventKind, Stats, StepStats
from .surface import Mesh
from .views import RECORD, Field, View
from .world import World

__version__ = version_text(_lib.pbmpm_version())


def isa() -> str:
    """The instruction set of the kernels in use ("AVX2"). The environment variable PBMPM_ISA may lower the choice."""
    name: str = _ffi.string(_lib.pbmpm_isa_name(_lib.pbmpm_active_isa())).decode()
    return name


def is_strict() -> bool:
    """Whether the library is a strict build (PBMPM_STRICT), with the same results on every instruction set, bit for bit."""
    return bool(_lib.pbmpm_build_is_strict())


__all__ = [
    "Advice",
    "AdviceCode",
    "Baked",
    "BakedSolid",
    "Box",
    "BusyError",
    "CapacityError",
    "Capsule",
    "Change",
    "ClosedError",
    "Collider",
    "DamagedError",
    "DebugPart",
    "Drain",
    "DrainStatus",
    "Effective",
    "Elastic",
    "ElasticModel",
    "Emitter",
    "EmitterStatus",
    "Event",
    "EventKind",
    "ExpiredViewError",
    "Falloff",
    "Field",
    "Flow",
    "Force",
    "ForceKind",
    "ForeignError",
    "ForkedError",
    "Freedom",
    "Friction",
    "Impulse",
    "InUseError",
    "Integrator",
    "InvalidArgumentError",
    "InvalidIdError",
    "LibraryError",
    "Liquid",
    "LoadedSolid",
    "Mass",
    "Mesh",
    "Material",
    "OutOfMemoryError",
    "PbmpmError",
    "Plane",
    "PointFields",
    "Pressure",
    "RayHit",
    "RECORD",
    "Region",
    "RegionShare",
    "RigidBody",
    "Sand",
    "Shape",
    "SolidInfo",
    "Solver",
    "Sphere",
    "Stats",
    "StepStats",
    "Stop",
    "Submersion",
    "StrainPolicy",
    "ThreadError",
    "Touch",
    "TouchState",
    "UnsupportedCpuError",
    "UnsupportedError",
    "View",
    "Visco",
    "Wall",
    "World",
    "bake_heights",
    "bake_hull",
    "bake_mesh",
    "built_materials",
    "is_strict",
    "isa",
    "library_path",
]
