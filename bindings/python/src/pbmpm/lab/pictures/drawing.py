"""The picture of one moment of a scene, 2D or 3D."""

from __future__ import annotations

from PIL import Image

from ..frame import Frame
from .look import Look, annotate
from .flat import draw_2d
from .traced import draw_3d


def draw_picture(frame: Frame, look: Look) -> Image.Image:
    """The picture of one moment."""
    return annotate(draw_2d(frame, look) if frame.dimension == 2 else draw_3d(frame, look), frame, look)
