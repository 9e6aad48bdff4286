"""The generator reads the public headers completely and what it wrote into the tree is current."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import cffi
import pytest

from generator import cdef, fuzz, header, layout, model, parser, sized


@pytest.fixture(scope="module")
def api(root: Path) -> model.Api:
    return parser.parse(root / "include")


def find(items: tuple, name: str):
    return next(item for item in items if item.name == name)


def headers(folder: Path, text: str) -> Path:
    """A folder with a header of this text."""
    (folder / "pbmpm").mkdir()
    (folder / "pbmpm" / "pbmpm.h").write_text(text, encoding="utf-8")
    return folder


def test_committed_layout_list_is_current(api: model.Api, root: Path) -> None:
    committed = (root / "src" / "api" / "layout_table.inc").read_text(encoding="utf-8")
    assert committed == layout.emit(api), (
        "run: cd bindings && python -m generator layout --headers ../include --output ../src/api/layout_table.inc"
    )


def test_committed_table_of_sizes_is_current(api: model.Api, root: Path) -> None:
    committed = (root / "src" / "base" / "sized_table.inc").read_text(encoding="utf-8")
    assert committed == sized.emit(api, root / "tests" / "abi"), (
        "run: cd bindings && python -m generator sized --headers ../include --versions ../tests/abi --output ../src/base/sized_table.inc"
    )


def test_the_header_of_this_version_is_kept(api: model.Api, root: Path) -> None:
    """Clients of this version are tested against later libraries with it; see docs/abi.md."""
    version = header.version_of(api)
    kept = root / "tests" / "abi" / version / "include" / "pbmpm" / "pbmpm.h"
    assert kept.read_text(encoding="utf-8") == header.emit(api), (
        f"run: cd bindings && python -m generator header --headers ../include --output ../tests/abi/{version}/include/pbmpm/pbmpm.h"
    )


def test_committed_calls_of_the_fuzz_target_are_current(api: model.Api, root: Path) -> None:
    committed = (root / "tests" / "fuzz" / "calls.inc").read_text(encoding="utf-8")
    assert committed == fuzz.emit(api), "run: cd bindings && python -m generator fuzz --headers ../include --output ../tests/fuzz/calls.inc"
    for function in api.functions:
        assert f" {function.name}(" in committed or f"({function.name}(" in committed or f"(void){function.name}(" in committed, function.name


def test_every_declared_function_is_exported(api: model.Api, root: Path) -> None:
    exports = (root / "src" / "api" / "exports.txt").read_text(encoding="utf-8").split("\n")
    exported = {line.strip() for line in exports if line.startswith("pbmpm_")}
    assert exported == {function.name for function in api.functions}


def test_no_declaration_of_the_headers_is_left_out(api: model.Api, root: Path) -> None:
    text = "".join(path.read_text(encoding="utf-8") for path in (root / "include" / "pbmpm").glob("*.h"))
    assert len(api.functions) == text.count("\nPBMPM_API ")
    assert len(api.structures) == text.count("typedef struct ")
    assert len(api.enumerations) == text.count("typedef enum ")


def test_constants_come_from_macros_and_nameless_enumerations(api: model.Api) -> None:
    assert api.constant("PBMPM_MAX_PARTICLES") == 1 << 28
    assert api.constant("PBMPM_ABI_VERSION") >= 0
    with pytest.raises(KeyError):
        api.constant("PBMPM_NO_SUCH_THING")


def test_types_of_fields(api: model.Api) -> None:
    fields = find(api.structures, "pbmpm_world_def").fields
    assert find(fields, "domain_min").type == model.Type(model.Kind.SCALAR, "float", length=3)
    assert find(fields, "allocator").type == model.Type(model.Kind.STRUCT, "pbmpm_allocator", const=True, pointers=1)
    allocate = find(find(api.structures, "pbmpm_allocator").fields, "allocate").type
    assert (allocate.kind, allocate.pointers) == (model.Kind.FUNCTION, 1)
    assert [parameter.name for parameter in allocate.signature.parameters] == ["size", "alignment", "user"]


def test_types_of_parameters(api: model.Api) -> None:
    move = find(api.functions, "pbmpm_collider_move").signature
    assert move.result == model.Type(model.Kind.ENUM, "pbmpm_result")
    assert move.parameters[2] == model.Parameter("position", model.Type(model.Kind.SCALAR, "float", True, 0, 3))
    entries = find(api.functions, "pbmpm_layout_table").signature.parameters[0]
    assert entries.type == model.Type(model.Kind.STRUCT, "pbmpm_layout_entry", const=True, pointers=2)
    log = find(api.functions, "pbmpm_set_log_callback").signature.parameters[0]
    assert log.type == model.Type(model.Kind.CALLBACK, "pbmpm_log_callback", pointers=1)


def test_documentation_belongs_to_its_declaration(api: model.Api) -> None:
    assert find(api.functions, "pbmpm_particles_count").doc.startswith("Number of live particles. ")
    assert find(find(api.structures, "pbmpm_stats").fields, "mass").doc.startswith("[kg]")
    viscosity = find(find(api.structures, "pbmpm_material_def").fields, "viscosity").doc
    assert viscosity.startswith("liquid, paper's solver only: share") and "per iteration,\nin [0, 1]" in viscosity
    assert all(item.doc for item in find(api.enumerations, "pbmpm_event_kind").members[:-1])


def test_functions_of_one_paragraph_share_its_documentation(tmp_path: Path) -> None:
    api = parser.parse(headers(tmp_path, "/** Reads and writes. */\nint pbmpm_get(void);\nint pbmpm_set(int value);\n"))
    assert [function.doc for function in api.functions] == ["Reads and writes.", "Reads and writes."]


def test_everything_public_is_documented(api: model.Api) -> None:
    described = [*api.functions, *api.structures, *api.enumerations]
    fields = [field for structure in api.structures for field in structure.fields]
    obvious = {"index", "generation", "user", "material", "shape"}
    assert [item.name for item in described if not item.doc] == []
    assert {field.name for field in fields if not field.doc} <= obvious


def test_cffi_understands_the_declarations(api: model.Api) -> None:
    ffi = cffi.FFI()
    ffi.cdef(cdef.emit(api))
    assert set(ffi.list_types()[1]) == {structure.name for structure in api.structures}
    assert ffi.sizeof("pbmpm_particle_id") == 8
    assert ffi.sizeof("pbmpm_result") == 4


def test_small_header(tmp_path: Path) -> None:
    text = """
    #include <stdint.h>
    #define PBMPM_TWO (1 + 1)
    enum { PBMPM_FOUR = PBMPM_TWO * 2, PBMPM_FIVE };
    /** A pair. */
    typedef struct pbmpm_pair {
        const char *names[PBMPM_FOUR]; /**< both */
    } pbmpm_pair;
    """
    api = parser.parse(headers(tmp_path, text))
    assert [(item.name, item.value) for item in api.constants] == [
        ("PBMPM_TWO", 2),
        ("PBMPM_FOUR", 4),
        ("PBMPM_FIVE", 5),
    ]
    names = model.Field("names", model.Type(model.Kind.SCALAR, "char", True, 1, 4), "both")
    assert api.declarations == (model.Structure("pbmpm_pair", (names,), "A pair."),)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('#include "missing.h"\n', "cannot find the header 'missing.h'"),
        ("typedef int pbmpm_number;\n", "pbmpm_number is no structure"),
        ("extern int pbmpm_global;\n", "only typedefs, functions and enumerations"),
        ("enum { PBMPM_X = 5 % 3 };\n", "cannot evaluate"),
    ],
)
def test_what_the_model_cannot_describe_is_refused(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(parser.ParseError, match=complaint):
        parser.parse(headers(tmp_path, text))


def test_command_line(root: Path, tmp_path: Path, api: model.Api) -> None:
    output = tmp_path / "new" / "cdef.h"
    command = [sys.executable, "-m", "generator", "cdef", "--headers", str(root / "include"), "--output", str(output)]
    subprocess.run(command, cwd=root / "bindings", check=True)
    assert output.read_text(encoding="utf-8") == cdef.emit(api)
    command[5] = str(tmp_path)
    failed = subprocess.run(command, cwd=root / "bindings", capture_output=True, text=True)
    assert failed.returncode == 2 and failed.stderr.startswith("generator: ")
