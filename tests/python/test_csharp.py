"""The C# binding: what the generator wrote into the tree is current, and C# and Python compute the same."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import pbmpm
from generator import csharp, model, parser

COMPILER, RUNTIME = shutil.which("mcs"), shutil.which("mono")
needs_mono = pytest.mark.skipif(
    not (COMPILER and RUNTIME), reason="mcs and mono are needed (Debian: mono-mcs, mono-runtime)"
)


def declarations(folder: Path, text: str) -> str:
    """What the generator makes of a header with this text."""
    (folder / "pbmpm").mkdir()
    (folder / "pbmpm" / "pbmpm.h").write_text(text, encoding="utf-8")
    return csharp.emit(parser.parse(folder))


@pytest.fixture(scope="module")
def api(root: Path) -> model.Api:
    return parser.parse(root / "include")


def test_committed_declarations_are_current(api: model.Api, root: Path) -> None:
    committed = (root / "bindings" / "csharp" / "src" / "Native.g.cs").read_text(encoding="utf-8")
    assert committed == csharp.emit(api), (
        "run: cd bindings && python -m generator csharp --headers ../include --output csharp/src/Native.g.cs"
    )


def test_every_function_structure_and_enumeration_is_declared(api: model.Api) -> None:
    text = csharp.emit(api)
    assert re.findall(r"public static extern \S+ (\w+)\(", text) == [function.name for function in api.functions]
    assert text.count("LayoutKind.Sequential") == len(api.structures) + len(set(re.findall(r"struct (\w+\d)\n", text)))
    assert text.count("public enum ") == len(api.enumerations)
    assert "FORCE32" not in text.upper()


def test_types_become_blittable(tmp_path: Path) -> None:
    text = declarations(
        tmp_path,
        """
        typedef enum pbmpm_kind { PBMPM_KIND_A = 1, PBMPM_KIND_B_C = 2, PBMPM_KIND_FORCE32 = 0x7fffffff } pbmpm_kind;
        typedef void pbmpm_hook(int32_t index, void *user);
        typedef struct pbmpm_plain { uint32_t size; pbmpm_kind kind; double at[3]; size_t room; } pbmpm_plain;
        typedef struct pbmpm_raw {
            const char *text; void *user; float *values; void (*call)(int32_t index); pbmpm_hook *hook; pbmpm_plain inner;
        } pbmpm_raw;
        pbmpm_kind pbmpm_try(pbmpm_plain by_value, const pbmpm_plain **list, const float place[2], void **out,
                             uint64_t *event);
        const char *pbmpm_text(void);
        void pbmpm_nothing(void);
        """,
    )
    for expected in (
        "public enum Kind : int",
        "A = 1,",
        "BC = 2,",
        "public partial struct Plain",
        "public Kind Kind;",
        "public Double3 At;",
        "public UIntPtr Room;",
        "public IntPtr Text;",
        "public IntPtr User;",
        "public float* Values;",
        "public IntPtr Call;",
        "public IntPtr Hook;",
        "public Plain Inner;",
        "Kind pbmpm_try(Plain byValue, Plain** list, Float2* place, IntPtr* @out, ulong* @event);",
        "public unsafe delegate void Hook(int index, IntPtr user);",
        "public unsafe delegate void RawCall(int index);",
        "IntPtr pbmpm_text();",
        "void pbmpm_nothing();",
    ):
        assert expected in text
    before, native = text.split("namespace Pbmpm.Native")
    assert "struct Plain" in before and "struct Raw" in native


def test_one_symbol_says_that_the_library_is_linked_in(api: model.Api) -> None:
    static, shared = re.findall(r'^ *#(if|else)\b.*\n *public const string LibraryName = "(\w+)";$', csharp.emit(api), re.MULTILINE)
    assert (static, shared) == (("if", "__Internal"), ("else", "pbmpm"))
    assert csharp.emit(api).count("[DllImport(LibraryName, ") == len(api.functions)


def test_comments_are_carried_over(tmp_path: Path) -> None:
    text = declarations(
        tmp_path,
        """
/** Holds a & b. */
typedef struct pbmpm_pair {
    float a; /**< at least
                  < 1 */
} pbmpm_pair;
""",
    )
    assert "/// <summary>Holds a &amp; b.</summary>" in text
    assert "/// <summary>at least\n        /// &lt; 1</summary>\n        public float A;" in text


@pytest.mark.parametrize("field", ["float a[5]", "float *a[3]", "long double a"])
def test_what_has_no_counterpart_is_refused(tmp_path: Path, field: str) -> None:
    with pytest.raises(csharp.UnsupportedType):
        declarations(tmp_path, f"typedef struct pbmpm_s {{ {field}; }} pbmpm_s;")


def run_csharp(root: Path, folder: Path, program: Path) -> str:
    """What a program prints that is compiled together with the binding and uses the library of the Python package."""
    assembly = folder / "program.exe"
    sources = sorted((root / "bindings" / "csharp" / "src").glob("*.cs"))
    subprocess.run([COMPILER, "-langversion:7.2", "-unsafe", "-r:System.Numerics", f"-out:{assembly}", *sources, program], check=True)
    environment = {**os.environ, "LD_LIBRARY_PATH": str(pbmpm.library_path().parent)}
    done = subprocess.run([RUNTIME, assembly], env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def tank_hash(threads: int) -> int:
    """The scene of the C# sample, built from its numbers in Python."""
    domain = (0, 0), (2, 1)
    with pbmpm.World(2, 0.025, capacity=10000, gravity=(0, -9.81), domain=domain, threads=threads) as world:
        world.fill(pbmpm.Box((0.5, 0.4), (0.5, 0.4)), world.add_material(pbmpm.Liquid()))
        for _ in range(60):
            world.step(1 / 60)
        return world.hash()


@needs_mono
def test_sample_and_python_end_in_the_same_state(root: Path, tmp_path: Path) -> None:
    printed = run_csharp(root, tmp_path, root / "bindings" / "csharp" / "sample" / "Tank.cs")
    found = re.search(r"^state hash ([0-9a-f]{16})$", printed, re.MULTILINE)
    assert found, printed
    assert int(found[1], 16) == tank_hash(threads=1) == tank_hash(threads=2)


@needs_mono
def test_example_of_the_readme_runs(root: Path, tmp_path: Path) -> None:
    readme = (root / "bindings" / "csharp" / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"^```csharp\n(.*?)^```$", readme, re.DOTALL | re.MULTILINE)
    program = tmp_path / "Example.cs"
    program.write_text(example, encoding="utf-8")
    assert re.fullmatch(r"512 particles\nfirst particle at \d\.\d\d \d\.\d\d\n", run_csharp(root, tmp_path, program))
