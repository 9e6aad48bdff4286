"""Presets: settings of the solver for a scene, with what they cost and how good they are, as JSON.

``pbmpm tune`` writes them; ``pbmpm run --preset`` and ``pbmpm advice --preset`` read them. The names under ``settings`` are those of the fields of
``pbmpm_settings``, and ``rate_hz``; a field that is absent stays as the scene says.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ..errors import InputError
from ..files import write_json
from ..names import IntegratorName, PressureName, SolverName
from .reading import describe_problems, read_json
from .scene import Iterations, Milliseconds, Rate, Share, Substeps

FORMAT_NAME = "pbmpm-preset"


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class PresetSettings(_Part):
    """What a preset changes; None: as the scene says."""

    rate_hz: Rate | None = None
    substeps: Substeps | None = None
    iterations: Iterations | None = None
    solver: SolverName | None = None
    pressure: PressureName | None = None
    integrator: IntegratorName | None = None
    flip: Share | None = None
    target_error: Share | None = None
    time_budget_ms: Milliseconds | None = None

    def changes(self) -> dict[str, Any]:
        """The fields that are set, as `RunSettings` takes them."""
        return self.model_dump(exclude_none=True)


class Preset(_Part):
    """One preset. Errors are in cells, times in milliseconds per step of 1/60 s of simulated time."""

    format: Literal["pbmpm-preset"] = FORMAT_NAME
    version: Literal[1] = 1
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_.-]+$", max_length=80)]
    scene: str
    """Name of the scene that it was measured with."""
    settings: PresetSettings
    predicted_error: Annotated[float, Field(ge=0)] | None = None
    ms_median: Annotated[float, Field(ge=0)] | None = None
    ms_p99: Annotated[float, Field(ge=0)] | None = None
    machine: dict[str, Any] = {}


def load_preset(path: Path) -> Preset:
    """Reads a preset; InputError names each field that is wrong."""
    data = read_json(path)
    if not isinstance(data, dict) or data.get("format") != FORMAT_NAME:
        raise InputError(f"{path}: not a preset: the field 'format' must be \"{FORMAT_NAME}\"")
    try:
        return Preset.model_validate(data)
    except ValidationError as error:
        raise InputError(describe_problems(error, data, str(path))) from None


def save_preset(preset: Preset, path: Path) -> None:
    """Writes a preset with only the settings that it changes."""
    write_json({**preset.model_dump(mode="json"), "settings": preset.settings.changes()}, path)
