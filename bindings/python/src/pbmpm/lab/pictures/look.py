"""What the pictures of 2D and 3D scenes have in common: colours, captions, and the way to a file."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ..files import replace_when_complete
from ..frame import Frame
from ..scenes.scene import Scene

BACKGROUND = (246, 247, 249)
INK = (40, 44, 52)
OBSTACLE = (128, 133, 142)

_SPEED_RAMP = np.array(
    [[26, 74, 150], [34, 110, 190], [48, 152, 216], [112, 202, 228], [196, 234, 238], [255, 255, 255]], dtype=np.float32
)
_LIQUID_COLOURS = ((36, 98, 190), (20, 150, 160), (90, 80, 170))
_SOLID_COLOURS = ((232, 119, 46), (60, 160, 92), (178, 74, 160), (170, 60, 60))
_COLOURS = {
    "liquid": _LIQUID_COLOURS,
    "elastic": _SOLID_COLOURS,
    "sand": ((214, 178, 60), (160, 118, 60), (196, 158, 120)),
    "visco": ((140, 92, 84), (120, 130, 70), (96, 70, 110)),
}


@dataclass(frozen=True)
class Look:
    """What is the same in all pictures of one run."""

    scene: Scene
    settings: str
    """One line for the caption: rate, substeps, iterations."""
    particle_diameter: float
    """[m]; the lattice spacing of the finest fill"""
    top_speed: float
    """[m/s] at the bright end of the colour ramp"""


def look_of(scene: Scene, settings: str) -> Look:
    """Derives the look of a scene; the ramp ends at the speed of a fall over 70 % of the highest fill."""
    diameter = scene.cell_size / max(fill.particles_per_axis for fill in scene.sources)
    return Look(scene, settings, diameter, _typical_speed(scene))


def _typical_speed(scene: Scene) -> float:
    gravity = float(np.linalg.norm(scene.gravity))
    sizes = [2 * max(getattr(fill.shape, "half_extents", [getattr(fill.shape, "radius", 0.0)])) for fill in scene.sources]
    falling = (2 * gravity * 0.7 * max(sizes)) ** 0.5
    thrown = max(float(np.linalg.norm(fill.velocity or [0.0])) for fill in scene.sources)
    return max(falling, thrown, 0.1 * scene.cell_size)


def material_colours(scene: Scene) -> np.ndarray:
    """(m, 3) float32: a colour per material of the scene, cold for liquids, warm for solids, those of sand and of mud."""
    cycles = {kind: itertools.cycle(colours) for kind, colours in _COLOURS.items()}
    colours = [next(cycles[material.kind]) for material in scene.materials.values()]
    return np.array(colours, dtype=np.float32)


def particle_colours(frame: Frame, look: Look) -> np.ndarray:
    """(n, 3) float32 in 0..255. Liquids by speed unless the scene asks for materials; solids always by material."""
    own = material_colours(look.scene)[frame.materials]
    liquid = np.array([material.kind == "liquid" for material in look.scene.materials.values()])[frame.materials]
    share = np.clip(frame.speeds / look.top_speed, 0.0, 1.0)
    if look.scene.pictures.colour == "material":
        return own + (255 - own) * (0.45 * share)[:, None]
    shaded = own * (0.85 + 0.15 * share)[:, None]
    return np.where(liquid[:, None], speed_colours(share), shaded).astype(np.float32)


def speed_colours(share: np.ndarray) -> np.ndarray:
    """Colours of speeds given as shares of the top speed; (n,) to (n, 3) in 0..255."""
    place = share * (len(_SPEED_RAMP) - 1)
    lower = np.minimum(place.astype(int), len(_SPEED_RAMP) - 2)
    return _SPEED_RAMP[lower] + (place - lower)[:, None] * (_SPEED_RAMP[lower + 1] - _SPEED_RAMP[lower])


def annotate(image: Image.Image, frame: Frame, look: Look) -> Image.Image:
    """Adds a strip with the time, the settings and the scale of colours above the picture: beside each other, or below where there is no room."""
    size = max(14, image.width // 64)
    font, small = ImageFont.load_default(size), ImageFont.load_default(int(0.8 * size))
    name = f"{look.scene.name}   t = {frame.time:.3f} s"
    error = float(np.sqrt(np.mean((frame.volume_ratios - 1.0) ** 2))) if len(frame.volume_ratios) else 0.0
    facts = f"{look.settings}   {len(frame.positions)} particles   volume error {100 * error:.1f} % rms"
    legend = _legend(look, small, size)
    widest = f"{look.scene.name}   t = 0000.000 s", f"{look.settings}   00000000 particles   volume error 00.0 % rms"  # the same for all pictures of a run
    below = max(font.getlength(widest[0]), small.getlength(widest[1])) + legend.width + 2 * size > image.width
    strip = int(2.9 * size)
    result = Image.new("RGB", (image.width, image.height + strip + below * legend.height), BACKGROUND)
    result.paste(image, (0, result.height - image.height))
    draw = ImageDraw.Draw(result)
    draw.text((size // 2, size // 4), name, fill=INK, font=font)
    draw.text((size // 2, int(1.55 * size)), facts, fill=INK, font=small)
    result.paste(legend, (size // 2, strip) if below else (image.width - legend.width - size, size // 2))
    return result


def _legend(look: Look, font: ImageFont.FreeTypeFont | ImageFont.ImageFont, size: int) -> Image.Image:
    """What the colours mean."""
    if look.scene.pictures.colour == "material":
        names = look.scene.materials
        result = Image.new("RGB", (int(sum(font.getlength(name) + 2 * size for name in names)), int(1.4 * size)), BACKGROUND)
        draw, x = ImageDraw.Draw(result), 0.0
        for name, colour in zip(names, material_colours(look.scene)):
            draw.rectangle((x, 0.2 * size, x + 0.7 * size, 0.9 * size), fill=tuple(colour.astype(int)))
            draw.text((x + size, 0), name, fill=INK, font=font)
            x += 2 * size + font.getlength(name)
        return result
    text, width, height = f"speed 0 to {look.top_speed:.2g} m/s or more", 12 * size, size // 2
    result = Image.new("RGB", (max(width + 1, int(font.getlength(text)) + 1), 2 * size), BACKGROUND)
    ramp = speed_colours(np.linspace(0, 1, width)).astype(np.uint8)
    result.paste(Image.fromarray(np.broadcast_to(ramp, (height, width, 3)).copy()), (0, 0))
    draw = ImageDraw.Draw(result)
    draw.rectangle((0, 0, width, height), outline=INK)
    draw.text((0, height + size // 5), text, fill=INK, font=font)
    return result


def save_png(image: Image.Image, path: Path) -> None:
    """Writes a complete PNG or nothing."""
    with replace_when_complete(path) as temporary:
        image.save(temporary, format="PNG")
