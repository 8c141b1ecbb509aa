"""Any wrong input gives a diagnostic and an exit code, but no traceback, and nothing is written."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest

from .kit import PLAIN, invoke, shell, tree

CASES: dict[str, tuple[str | bytes, str]] = {
    "empty file": (
        "",
        """\
        error[B0206]: `m.burnish` has no material
         --> m.burnish:1:1
        """,
    ),
    "only blanks and comments": (
        "// nothing\n\n",
        "error[B0206]: `m.burnish` has no material",
    ),
    "binary file": (
        bytes(range(256)),
        "error[B0004]: `m.burnish` is not UTF-8 text: it contains NUL bytes",
    ),
    "other encoding": (
        "material Größe { }".encode("latin-1"),
        "error[B0004]: `m.burnish` is not UTF-8 text: byte 11 is 0xf6",
    ),
    "unknown name": (
        "material M {\n    tint = vec3(1)\n    color = tnt\n}",
        """\
        error[B0201]: unknown name `tnt`
         --> m.burnish:3:13
          |
        3 |     color = tnt
          |             ^^^
          = help: did you mean `tint`?
        """,
    ),
    "wrong type": (
        "material M {\n    color = 1.0 < 2.0\n}",
        """\
        error[B0301]: expected rgb, found bool
         --> m.burnish:2:13
          |
        2 |     color = 1.0 < 2.0
          |             ^^^^^^^^^ this is `bool`
        """,
    ),
    "cyclic definition": (
        "material M {\n    a = b\n    b = c\n    c = a\n    color = vec3(a)\n}",
        """\
        error[B0203]: `a` is defined by itself: a → b → c → a
         --> m.burnish:4:9
          |
        2 |     a = b
          |         - `b` is needed here
        3 |     b = c
          |         - `c` is needed here
        4 |     c = a
          |         ^
        """,
    ),
    "duplicate equation": (
        "material M {\n    a = 1\n    a = 2\n}",
        """\
        error[B0202]: `a` is declared twice
         --> m.burnish:3:5
        """,
    ),
    "duplicate material": (
        "material M { }\nmaterial M { }",
        """\
        error[B0202]: `M` is declared twice
         --> m.burnish:2:10
          |
        1 | material M { }
          |          - first declared here
        2 | material M { }
          |          ^
        """,
    ),
    "missing import": (
        'import "wood.burnish"\nmaterial M { }',
        """\
        error[B0006]: cannot find `wood.burnish`
         --> m.burnish:1:1
          |
        1 | import "wood.burnish"
          | ^^^^^^^^^^^^^^^^^^^^^
        """,
    ),
    "missing library import": (
        "import std.ligths.{Point}\nmaterial M { }",
        """\
        error[B0006]: cannot find `std/ligths.burnish`
         --> m.burnish:1:1
          |
        1 | import std.ligths.{Point}
          | ^^^^^^^^^^^^^^^^^^^^^^^^^
          = help: did you mean `std.lights`?
        """,
    ),
    "import of itself": (
        'import "m.burnish"\nmaterial M { }',
        "error[B0008]: these files import each other: m.burnish → m.burnish",
    ),
    "import of everything": (
        'import "../../m.burnish"\nmaterial M { }',
        "error[B0007]: `../../m.burnish` leads out of the search path",
    ),
    "huge number": (
        "material M {\n    color = vec3(1e400)\n}",
        """\
        error[B0402]: `1e400` does not fit into float
         --> m.burnish:2:18
          |
        2 |     color = vec3(1e400)
          |                  ^^^^^
        """,
    ),
    "zero divisor": (
        "material M {\n    color = vec3(1 / 0)\n}",
        """\
        error[B0401]: this divisor is always zero
         --> m.burnish:2:22
          |
        2 |     color = vec3(1 / 0)
          |                      ^
        """,
    ),
    "10 000 parentheses": (
        f"material M {{ color = vec3({'(' * 10_000}1{')' * 10_000}) }}",
        "error[B0111]: brackets are nested too deeply: more than 200",
    ),
    "10 000 open parentheses": (
        f"material M {{ color = vec3({'(' * 10_000}",
        "error[B0111]: brackets are nested too deeply: more than 200",
    ),
}


@pytest.mark.parametrize(("content", "expected"), CASES.values(), ids=CASES)
def test_bad_file(
    content: str | bytes, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    data = content if isinstance(content, bytes) else content.encode()
    Path("m.burnish").write_bytes(data)
    for command in (("compile", "m.burnish", "-o", "out"), ("check", "m.burnish")):
        result = invoke(*command)
        assert dedent(expected) in result.stderr
        assert (result.exit_code, result.stdout) == (1, "")
    assert tree(tmp_path) == {"m.burnish"}


def test_several_errors_are_shown_at_once(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material A { x = y }\nmaterial B { color = 1u }")
    errors = invoke("check", file).stderr
    assert "error[B0201]" in errors
    assert "error[B0301]" in errors
    assert errors.endswith("\n2 errors\n")


def test_missing_file(tmp_path: Path) -> None:
    result = invoke("compile", "no.burnish", "-o", tmp_path / "out")
    assert result.stderr.startswith("error[B0001]: there is no file `no.burnish`\n")
    assert result.exit_code == 1
    assert tree(tmp_path) == set()


def test_folder_for_a_file(tmp_path: Path) -> None:
    result = invoke("check", tmp_path)
    assert result.stderr.startswith(f"error[B0002]: `{tmp_path}` is a folder, not a file\n")
    assert result.exit_code == 1


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("glsll", "error[B0010]: unknown target `glsll`\n  = help: did you mean `glsl`?"),
        (
            "metal",
            "error[B0010]: unknown target `metal`\n  = help: there are glsl, hlsl, ",
        ),
        ("", "error[B0010]: unknown target ``"),
        ("glsl:es30", "error[B0011]: target `glsl` has no profile `es30`\n  = help: did you mean"),
    ],
)
def test_unknown_target(target: str, expected: str, tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, "--target", f"wgsl,{target}", "-o", tmp_path / "out")
    assert result.stderr.startswith(expected)
    assert result.exit_code == 1
    assert tree(tmp_path) == {"m.burnish"}


@pytest.mark.parametrize(
    ("option", "kind"), [("--material", "material"), ("--rig", "rig"), ("--pass", "pass")]
)
def test_unknown_choice(option: str, kind: str, tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, option, "Nothing", "-o", tmp_path / "out")
    assert result.stderr.startswith(f"error[B0201]: unknown {kind} `Nothing`\n")
    assert result.exit_code == 1


def test_a_material_without_a_command() -> None:
    result = invoke("m.burnish")
    assert result.exit_code == 2
    assert "Did you mean 'burnish compile m.burnish -o FOLDER'?" in result.stderr


def test_an_included_folder_that_there_is_not(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    for command in (("check",), ("compile", "-o", tmp_path / "out")):
        result = invoke(*command, file, "--include", tmp_path / "nowhere")
        assert result.exit_code == 1
        assert result.stderr.startswith("error[B0013]: there is no folder")


def test_text_without_single_file_form(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, "--single-file", "-t", "glsl", "-o", tmp_path / "out")
    assert result.stderr.startswith("error[B0701]: glsl:vulkan has no")
    assert result.exit_code == 1


@pytest.mark.parametrize(
    "arguments",
    [(), ("frobnicate",), ("compile", "m.burnish"), ("compile", "m.burnish", "-o", "out", "--no")],
)
def test_senseless_command_lines(arguments: tuple[str, ...]) -> None:
    assert invoke(*arguments).exit_code == 2


def test_a_process_says_the_same(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text("material M { color = tnt }")
    run = shell("compile", "m.burnish", "-o", "out", folder=tmp_path)
    assert run.returncode == 1
    assert run.stderr.startswith("error[B0201]: unknown name `tnt`\n --> m.burnish:1:22\n")
    assert tree(tmp_path) == {"m.burnish"}
