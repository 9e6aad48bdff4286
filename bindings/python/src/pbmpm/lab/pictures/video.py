"""Pictures of a run as an animated GIF."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

from ..files import replace_when_complete

FRAME_MS = 80
"""Of simulated time between two pictures, which is shown as long. GIF counts in 10 ms."""
WIDTH = 480
"""Of the animation [pixels]."""
COLOURS = 256


PALETTE_FROM = 8
"""Pictures, evenly spread, from which the colours are taken: one choice for all, or they would change from picture to picture."""


class Video:
    """Pictures in the order of their times, all as large as the first, until they are saved."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._frames: list[Image.Image] = []

    def due(self, time: float) -> bool:
        """Whether a picture of this simulated time [s] is still missing."""
        return time + 1e-9 >= len(self._frames) * FRAME_MS / 1000

    def add(self, picture: Image.Image) -> None:
        size = self._frames[0].size if self._frames else (WIDTH, round(picture.height * WIDTH / picture.width))
        self._frames.append(picture.convert("RGB").resize(size, Image.Resampling.LANCZOS))

    def save(self) -> None:
        """Writes a complete animation, which begins again for ever; nothing without a picture."""
        if not self._frames:
            return
        palette = self._palette()
        first, *others = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in self._frames)
        with replace_when_complete(self.path) as temporary:
            first.save(temporary, format="GIF", save_all=True, append_images=others, duration=FRAME_MS, loop=0)

    def _palette(self) -> Image.Image:
        chosen = self._frames[:: -(-len(self._frames) // PALETTE_FROM)]
        width, height = chosen[0].size
        strip = Image.new("RGB", (width, height * len(chosen)))
        for place, frame in enumerate(chosen):
            strip.paste(frame, (0, height * place))
        return strip.quantize(COLOURS, method=Image.Quantize.FASTOCTREE)
