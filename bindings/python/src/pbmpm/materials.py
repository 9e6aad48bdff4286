"""Materials: their parameters, and the handle of a material in a world."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from ._choice import Choice
from ._convert import assign, initialised, shortest, sized
from ._ffi import ffi
from ._fixed import tells_names
from ._library import lib
from ._member import Member

_DEFAULTS = initialised("pbmpm_material_def")


def _default(field: str) -> float:
    return shortest(getattr(_DEFAULTS, field))


class StrainPolicy(Choice):
    """What happens to an elastic particle that is strained beyond all measure."""

    CLAMP = ffi.integer_const("PBMPM_STRAIN_CLAMP")  #: singular values of F stay in [strain_min, strain_max]
    DELETE = ffi.integer_const("PBMPM_STRAIN_DELETE")  #: deleted, with an event, beyond condition_max


class ElasticModel(Choice):
    """How the stress of an elastic body follows from F; not used by the paper's solver."""

    FIXED_COROTATED = ffi.integer_const("PBMPM_FIXED_COROTATED")  #: mu |F - R|^2 + lambda/2 (J - 1)^2
    NEO_HOOKEAN = ffi.integer_const("PBMPM_NEO_HOOKEAN")  #: mu/2 (|F|^2 - d) - mu ln J + lambda/2 (ln J)^2


_CHOICES: dict[str, type[Choice]] = {"strain_policy": StrainPolicy, "elastic_model": ElasticModel}
_DECODED = {**_CHOICES, "volume_correction": bool, "groups": int}


@tells_names
@dataclass(frozen=True)
class Liquid:
    """Keeps its volume. Defaults are those of the C library.

    Attributes:
        density: rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6].
        relaxation: share of the volume error removed per iteration, in (0, 2).
        viscosity: share of the deviatoric strain rate removed per iteration, in [0, 1]. Acts as a kinematic viscosity
            of iterations * viscosity * cell_size^2 / (8 * substep length).
        volume_feedback: share per substep by which the volume ratio follows the volume measured on the grid where
            that shows compression, in [0, 1]. Above 0, in gravity and where the liquid is strained, particles also
            shift from where the grid holds too much, and the mean volume ratio of blocks follows the grid.
        bulk_modulus: K [Pa] (2D: N/m), in [1e-3, 1e15], or 0: incompressible. Not the paper's solver.
        kinematic_viscosity: [m^2/s], in [0, 1e6]. The paper's solver reaches at most N dx^2 / (8 dt) with N iterations.
        groups: bit by bit, the groups that it belongs to, in [1, 2^32); see `World.add_collider()`.
    """

    density: float = _default("density")
    relaxation: float = _default("relaxation")
    viscosity: float = _default("viscosity")
    volume_feedback: float = _default("volume_feedback")
    bulk_modulus: float = _default("bulk_modulus")
    kinematic_viscosity: float = _default("kinematic_viscosity")
    groups: int = int(_DEFAULTS.groups)


@dataclass(frozen=True)
class Solid:
    """What all matter with a deformation gradient F has: `Elastic`, `Sand` and `Visco`.

    Attributes:
        density: rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6].
        relaxation: share of the constraint error removed per iteration, in (0, 2).
        elasticity_ratio: blend of keeping the shape (1) and keeping only the volume; elastic bodies in [0, 1], sand and visco in
            [0.01, 1]. Paper's solver.
        strain_policy: what happens beyond all measure of strain.
        strain_min: lower bound of the singular values of F, in [1e-3, 1].
        strain_max: upper bound, in [1, 1e4].
        condition_max: largest condition number of F with StrainPolicy.DELETE, in [10, 1e6].
        rebound_max: largest strain that the constraint asks for per iteration, in (0, 10]: how fast crushed matter grows
            back. Paper's solver.
        young_modulus: E [Pa] (2D: plane strain), in [1e-3, 1e15]. Not the paper's solver.
        poisson_ratio: in [0, 0.495]. Not the paper's solver.
        groups: bit by bit, the groups that it belongs to, in [1, 2^32); see `World.add_collider()`.
    """

    density: float = _default("density")
    relaxation: float = _default("relaxation")
    elasticity_ratio: float = _default("elasticity_ratio")
    strain_policy: StrainPolicy = StrainPolicy(_DEFAULTS.strain_policy)
    strain_min: float = _default("strain_min")
    strain_max: float = _default("strain_max")
    condition_max: float = _default("condition_max")
    rebound_max: float = _default("rebound_max")
    young_modulus: float = _default("young_modulus")
    poisson_ratio: float = _default("poisson_ratio")
    groups: int = int(_DEFAULTS.groups)

    def __post_init__(self) -> None:
        for item in fields(self):
            if item.name in _CHOICES:
                object.__setattr__(self, item.name, _CHOICES[item.name](getattr(self, item.name)))


@tells_names
@dataclass(frozen=True)
class Elastic(Solid):
    """Keeps its shape and its volume, with the parameters of all `Solid` matter. Defaults are those of the C library.

    Attributes:
        elastic_model: how the stress follows from F. Not the paper's solver.
    """

    elastic_model: ElasticModel = ElasticModel(_DEFAULTS.elastic_model)


@tells_names
@dataclass(frozen=True)
class Sand(Solid):
    """Shears as far as friction lets it and bears no tension beyond its cohesion.

    Below yield it is an elastic body, with the parameters of all `Solid` matter. Defaults are those of the C library.

    Attributes:
        friction_angle: [rad], in [0, 1.4]; its tangent is the friction coefficient.
        cohesion: ln of the volume ratio up to which it bears tension, in [0, 0.5]; 0: dry.
        volume_correction: whether sand that has come apart closes up again before it bears pressure.
    """

    friction_angle: float = _default("friction_angle")
    cohesion: float = _default("cohesion")
    volume_correction: bool = bool(_DEFAULTS.volume_correction)


@tells_names
@dataclass(frozen=True)
class Visco(Solid):
    """Flows where it is strained too far, at constant volume: clay, dough, mud.

    Below yield it is an elastic body, with the parameters of all `Solid` matter; beyond, a Bingham fluid with the viscosity
    mu / flow_rate [Pa s]. Defaults are those of the C library.

    Attributes:
        yield_strain: largest norm of the deviator of the logarithmic strain that is borne, in [0, 10]. The yield stress in
            shear is sqrt(2) mu yield_strain.
        flow_rate: [1/s]; strain beyond that shrinks by exp(-flow_rate dt), in [0, 1e9].
        volume_feedback: share per 1/60 s by which it gives up volume where the grid holds more than 1.5 times what belongs
            there, in [0, 1]. Unless it is 0, matter that came apart closes up again before it bears pressure.
    """

    yield_strain: float = _default("yield_strain")
    flow_rate: float = _default("flow_rate")
    volume_feedback: float = _default("volume_feedback")


Parameters = Liquid | Elastic | Sand | Visco


@dataclass(frozen=True)
class Effective:
    """How stiff a material is with a world's settings and rate.

    Attributes:
        bulk_modulus: [Pa]; 0: incompressible.
        young_modulus: [Pa]; 0 for a liquid.
        kinematic_viscosity: of a liquid [m^2/s], without what the transfers add.
        courant: cells that its pressure wave travels per substep; 0: incompressible. The explicit solver needs less than 1.
    """

    bulk_modulus: float
    young_modulus: float
    kinematic_viscosity: float
    courant: float

_KINDS: dict[type, int] = {
    Liquid: ffi.integer_const("PBMPM_LIQUID"),
    Elastic: ffi.integer_const("PBMPM_ELASTIC"),
    Sand: ffi.integer_const("PBMPM_SAND"),
    Visco: ffi.integer_const("PBMPM_VISCO"),
}


def built_materials() -> tuple[type[Parameters], ...]:
    """The materials that the library was built with; a world refuses the others with an UnsupportedError."""
    built = lib.pbmpm_materials_built()
    return tuple(material for material, kind in _KINDS.items() if built >> kind & 1)


def to_c(parameters: Parameters, definition: Any = None) -> Any:
    """The C structure of a material; what it does not say is as in the definition."""
    if type(parameters) not in _KINDS:
        raise TypeError(f"a Liquid, Elastic, Sand or Visco is needed, not {type(parameters).__name__}")
    out = definition or initialised("pbmpm_material_def")
    out.kind = _KINDS[type(parameters)]
    for item in fields(parameters):
        value = getattr(parameters, item.name)
        assign(out, item.name, value.value if item.name in _CHOICES else value)
    return out


def from_c(definition: Any) -> Parameters:
    """The parameters in a C structure."""
    kind = next(kind for kind, number in _KINDS.items() if number == definition.kind)
    return kind(**{item.name: _value(definition, item.name) for item in fields(kind)})


def _value(definition: Any, field: str) -> Any:
    return _DECODED.get(field, shortest)(getattr(definition, field))


class Material(Member):
    """A material in a world. Made by `World.add_material()`."""

    __slots__ = ()
    _instead = "it names a thing of one world; give its `parameters` to add_material() of another"
    _name = "material"

    @property
    def index(self) -> int:
        """What `World.material_indices` shows for particles of this material."""
        return int(self._id.index)

    @property
    def parameters(self) -> Parameters:
        """The current parameters. Setting them takes effect with the next step; kind and density cannot change."""
        return from_c(self._definition())

    @parameters.setter
    def parameters(self, value: Parameters) -> None:
        self._apply("set", to_c(value, self._definition()))

    def effective(self, dt: float) -> Effective:
        """How stiff the material is when the world is stepped by `dt` [s] with its present settings."""
        out = sized("pbmpm_effective")
        self._apply("effective", dt, out)
        return Effective(**{item.name: shortest(getattr(out, item.name)) for item in fields(Effective)})

    def destroy(self) -> None:
        """Removes the material; InUseError while particles refer to it."""
        self._apply("destroy")
