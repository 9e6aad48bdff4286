"""Draws a dam break with the package's surface shader into a picture: draw.py FILE.png, with OpenGL in software, without Unity.

The shader goes from HLSL through SPIR-V to GLSL. Needs glslangValidator and spirv-cross (Debian: glslang-tools, spirv-cross), EGL (Debian: libegl1,
libgl1-mesa-dri), and the Python package moderngl.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import moderngl
import numpy as np
from PIL import Image
from shaders import SHADERS, entry_points, parse, programs

import pbmpm

WIDTH, HEIGHT = 960, 540
CELL = 0.05  # [m]
DEPTH, THICKNESS, SMOOTH, COMPOSE = range(4)
FAR = 1e6  # as PbmpmSurface.cs has it
EYE, TARGET = np.array([1.6, 1.1, 2.6]), np.array([1.0, 0.25, 0.25])


# From HLSL to OpenGL


class Pass:
    """A pass of the shader as a program of OpenGL. Uniforms lie in a block of each stage, where SPIR-V says."""

    def __init__(self, context: moderngl.Context, code: str) -> None:
        stages = {stage: translate(code, stage, entry) for stage, entry in entry_points(code).items()}
        self.context = context
        self.program = context.program(vertex_shader=stages["vertex"][0], fragment_shader=stages["fragment"][0])
        self.blocks = [block for _, found in stages.values() for block in found]

    def draw(self, values: dict[str, np.ndarray], textures: dict[str, moderngl.Texture], vertices: int, instances: int) -> None:
        for binding, (name, members, size) in enumerate(self.blocks):
            data = bytearray(size)
            for member, offset in members.items():
                raw = np.asarray(values[member], dtype=np.float32).tobytes()
                data[offset : offset + len(raw)] = raw
            self.context.buffer(bytes(data)).bind_to_uniform_block(binding)
            self.program[name].binding = binding
        for unit, name in enumerate(name for name in self.program if isinstance(self.program[name], moderngl.Uniform)):
            textures[next(key for key in textures if key in name)].use(unit)
            self.program[name].value = unit
        self.context.vertex_array(self.program, []).render(moderngl.TRIANGLES, vertices, instances=instances)


def translate(code: str, stage: str, entry: str) -> tuple[str, list[tuple[str, dict[str, int], int]]]:
    """GLSL, and the blocks of uniforms: name, offsets of members, size."""
    with tempfile.TemporaryDirectory() as folder:
        binary = Path(folder) / "shader.spv"
        wrong = parse(code, stage, entry, "SHADER_API_GLCORE", SHADERS, binary)
        if wrong:
            sys.exit(wrong)
        command = ["spirv-cross", str(binary)]
        text = _run([*command, "--version", "430", "--no-es", "--no-support-nonzero-baseinstance"])
        reflected = json.loads(_run([*command, "--reflect"]))
    blocks = []
    for block in reflected.get("ubos", []):
        members = {member["name"]: member["offset"] for member in reflected["types"][block["type"]]["members"]}
        blocks.append((f"{stage}_Global", members, block["block_size"]))
    # Both stages would have a block of one name with different members
    return text.replace("uniform _Global", f"uniform {stage}_Global"), blocks


def _run(command: list[str]) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


# What is drawn


def particles() -> np.ndarray:
    """Records of a dam that breaks, as the shader reads them by OpenGL's rules: vectors begin at multiples of 16 bytes."""
    with pbmpm.World(3, CELL, gravity=(0, -9.81, 0), capacity=40000, domain=((0, 0, 0), (2, 1, 0.5))) as world:
        world.fill(pbmpm.Box((0.3, 0.3, 0.25), (0.3, 0.3, 0.25)), world.add_material(pbmpm.Liquid()))
        for _ in range(30):
            world.step(1 / 60)
        records = np.zeros((world.stats.particle_count, 8), dtype=np.float32)  # std430: 32 bytes each
        records[:, :3] = world.positions
    return records


def look() -> np.ndarray:
    """From the world to the eye, which looks along -z."""
    back = (EYE - TARGET) / np.linalg.norm(EYE - TARGET)
    right = np.cross([0, 1, 0], back)
    right /= np.linalg.norm(right)
    view = np.eye(4)
    view[:3, :3] = [right, np.cross(back, right), back]
    view[:3, 3] = -view[:3, :3] @ EYE
    return view


def perspective(angle: float, near: float, far: float) -> np.ndarray:
    """OpenGL's."""
    scale = 1 / np.tan(angle / 2)
    made = np.zeros((4, 4))
    made[0, 0], made[1, 1] = scale * HEIGHT / WIDTH, scale
    made[2, 2], made[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far)
    made[3, 2] = -1
    return made


def floor_picture(view: np.ndarray, projection: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A floor of squares under the water, and its depths, as the scene before it: by rays, from the lowest row up."""
    x, y = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH * 2 - 1, (np.arange(HEIGHT) + 0.5) / HEIGHT * 2 - 1)
    rays = np.stack([x / projection[0, 0], y / projection[1, 1], -np.ones_like(x)], axis=-1) @ view[:3, :3]
    reach = np.where(rays[..., 1] < -1e-6, -EYE[1] / np.minimum(rays[..., 1], -1e-6), 1e3)
    places = EYE + reach[..., None] * rays
    squares = (np.floor(places[..., 0] * 5) + np.floor(places[..., 2] * 5)) % 2
    colour = np.where(reach < 100, 0.55 + 0.3 * squares, 0.8)[..., None] * np.array([1.0, 0.97, 0.9])
    clip = projection[2, 2] * -reach + projection[2, 3]
    return colour, np.clip((clip / reach + 1) / 2, 0, 1)


# The frame, as PbmpmSurface.cs records it


def main(target: Path) -> None:
    context = moderngl.create_context(standalone=True, backend="egl", require=430)
    passes = [Pass(context, code) for code in programs((SHADERS / "PbmpmSurface.shader").read_text(encoding="utf-8"))]
    view, projection = look(), perspective(0.7, 0.1, 50)
    records = particles()
    context.buffer(records.tobytes()).bind_to_storage_buffer(0)
    floor, depths = floor_picture(view, projection)

    def texture(components: int, data: np.ndarray | None = None) -> moderngl.Texture:
        raw = None if data is None else data.astype(np.float32).tobytes()
        return context.texture((WIDTH, HEIGHT), components, raw, dtype="f4")

    surface, other, thickness = (texture(1) for _ in range(3))
    picture = texture(4, np.concatenate([floor, np.ones((HEIGHT, WIDTH, 1))], axis=-1))
    scene = texture(1, depths)
    light = view[:3, :3] @ np.array([0.3, 0.9, 0.3])
    values = {  # matrices column by column, as Unity gives them
        "_PbmpmView": view.T, "_PbmpmProjection": projection.T, "_PbmpmUnprojection": np.linalg.inv(projection).T, "_PbmpmOrigin": np.zeros(4),
        "_PbmpmRadius": np.array(0.6 * CELL), "_PbmpmOnly": np.array(-1.0), "_PbmpmTint": np.array([0.1, 0.35, 0.5, 1]), "_PbmpmClarity": np.array(0.5),
        "_PbmpmLight": np.append(light / np.linalg.norm(light), 0), "_PbmpmFlip": np.array(0.0), "_PbmpmAxis": np.zeros(4),
    }  # fmt: skip

    def draw(number: int, onto: moderngl.Texture, empty: float | None, read: dict[str, moderngl.Texture], vertices: int, instances: int) -> None:
        frame = context.framebuffer([onto])
        frame.use()
        if empty is not None:
            frame.clear(empty, 0, 0, 0)
        passes[number].draw(values, read, vertices, instances)

    context.enable(moderngl.BLEND)
    context.blend_func, context.blend_equation = (moderngl.ONE, moderngl.ONE), moderngl.MIN
    draw(DEPTH, surface, FAR, {}, 6, len(records))
    context.blend_equation = moderngl.FUNC_ADD
    draw(THICKNESS, thickness, 0, {}, 6, len(records))
    context.disable(moderngl.BLEND)
    for _ in range(2):
        values["_PbmpmAxis"] = np.array([1.0, 0, 0, 0])
        draw(SMOOTH, other, None, {"_PbmpmSource": surface}, 3, 1)
        values["_PbmpmAxis"] = np.array([0, 1.0, 0, 0])
        draw(SMOOTH, surface, None, {"_PbmpmSource": other}, 3, 1)
    context.enable(moderngl.BLEND)
    context.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
    draw(COMPOSE, picture, None, {"_PbmpmDepths": surface, "_PbmpmThickness": thickness, "_CameraDepthTexture": scene}, 3, 1)
    rows = np.frombuffer(picture.read(), dtype=np.float32).reshape(HEIGHT, WIDTH, 4)[::-1, :, :3]
    Image.fromarray((np.clip(rows, 0, 1) * 255).astype(np.uint8)).save(target)
    print(f"{len(records)} particles in {target}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
