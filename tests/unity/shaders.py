"""Parses the package's shaders as HLSL: shaders.py [FOLDER]. Each entry point of each pass goes through glslangValidator, for Direct3D's and for
OpenGL's rows, with what Unity's own headers declare stood in for by tests/unity/shaders. Ends with 1 if one does not parse."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHADERS = ROOT / "bindings" / "unity" / "Runtime" / "Resources" / "Pbmpm"
STAGES = {"vertex": "vert", "fragment": "frag"}
APIS = ("SHADER_API_D3D11", "SHADER_API_GLCORE")


def programs(text: str) -> list[str]:
    """The code of each pass, with what the shader gives to all of them."""
    shared = "".join(re.findall(r"HLSLINCLUDE(.*?)ENDHLSL", text, re.DOTALL))
    return [shared + code for code in re.findall(r"HLSLPROGRAM(.*?)ENDHLSL", text, re.DOTALL)]


def entry_points(code: str) -> dict[str, str]:
    return {stage: name for stage, name in re.findall(r"#pragma (vertex|fragment) (\w+)", code)}


def parse(code: str, stage: str, entry: str, api: str, folder: Path, binary: Path = Path("/dev/null")) -> str:
    """What is wrong with it; empty if nothing. Then the SPIR-V that it becomes is in `binary`."""
    plain = re.sub(r"^\s*#pragma.*$", "", code, flags=re.MULTILINE)
    with tempfile.NamedTemporaryFile("w", suffix=".hlsl", encoding="utf-8") as file:
        file.write(f"#define {api} 1\n{plain}")
        file.flush()
        command = ["glslangValidator", "-D", "-V", "-S", STAGES[stage], "-e", entry, f"-I{folder}", f"-I{ROOT / 'tests' / 'unity' / 'shaders'}"]
        command += ["--auto-map-bindings", "--auto-map-locations", "-o", str(binary), file.name]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def problems(folder: Path) -> tuple[int, list[str]]:
    """How many entry points there are, and what is wrong with them."""
    count, found = 0, []
    for path in sorted(folder.glob("*.shader")):
        for number, code in enumerate(programs(path.read_text(encoding="utf-8"))):
            for stage, entry in entry_points(code).items():
                for api in APIS:
                    count += 1
                    wrong = parse(code, stage, entry, api, folder)
                    if wrong:
                        found.append(f"{path.name}, pass {number}, {entry}, {api}:\n{wrong}")
    return count, found


if __name__ == "__main__":
    total, told = problems(Path(sys.argv[1]) if len(sys.argv) > 1 else SHADERS)
    print("\n".join(told) or f"{total} entry points parse")
    sys.exit(bool(told) or total == 0)
