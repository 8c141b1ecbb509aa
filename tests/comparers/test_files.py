"""The comparers are files that can be copied: they need nothing else, and are alike."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from burnish.targets.conformance.comparers import COMPARERS, comparer

from ..suite.processes import run
from .cases import CASES
from .kit import LANGUAGES, compiled, tool

pytestmark = pytest.mark.xdist_group("comparers")  # One process compiles the programs.

NAMES = ("Bounds", "Encoding", "JudgeError", "Outlier", "Picture", "Samples", "Verdict", "judge")
"""The public names of a comparer; in Python, anything with a buffer is what ``Samples`` are."""

MAIN: Mapping[str, tuple[str, ...]] = {
    "c++": ("-DBURNISH_JUDGE_MAIN",),
    "python": (),
    "rust": ("--crate-type", "bin"),
}
"""The languages whose comparer is a command, too, and what makes their compilers make it."""


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_text_begins_with_the_license(language: str) -> None:
    assert "SPDX-License-Identifier: Apache-2.0" in comparer(language).splitlines()[0]


def test_other_languages_have_no_comparer() -> None:
    with pytest.raises(KeyError):
        comparer("fortran")


def test_each_file_is_one_of_them() -> None:
    folder = COMPARERS["python"].parent
    files = {path.name for path in folder.iterdir() if path.is_file()}
    assert files == {path.name for path in COMPARERS.values()} | {"__init__.py"}


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_have_the_same_public_names(language: str) -> None:
    text = comparer(language)
    wanted = set(NAMES) - ({"Samples"} if language == "python" else set())
    assert {name for name in NAMES if re.search(declaration(language, name), text, re.M)} == wanted


def declaration(language: str, name: str) -> str:
    """A pattern of the line that declares a public name."""
    return {
        "c++": rf"^(class|struct|enum class|using|Verdict) {name}\b",
        "python": rf"^(class|def) {name}\b",
        "rust": rf"^pub (struct|enum|fn) {name}\b",
        "typescript": rf"^export (class|interface|type|function) {name}\b",
    }[language]


def test_python_needs_only_its_standard_library() -> None:
    tree = ast.parse(comparer("python"), feature_version=(3, 9))
    imported = {
        node.module if isinstance(node, ast.ImportFrom) else node.names[0].name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
    }
    assert imported <= sys.stdlib_module_names | {"collections.abc"}


@pytest.mark.parametrize(
    ("language", "imports", "allowed"),
    [
        ("c++", r"^ *# *include\b.*", r"#include <\w+>"),
        ("rust", r"^ *(?:pub )?(?:use|mod|extern)\b.*", r"use std::[\w:]+;"),
        ("typescript", r"^ *(?:import|export .* from)\b.*|\bimport\(.*|\brequire\(.*", r"(?!)"),
    ],
)
def test_others_need_only_their_standard_library(language: str, imports: str, allowed: str) -> None:
    found = re.findall(imports, comparer(language), re.M)
    assert [line for line in found if not re.fullmatch(allowed, line)] == []


@pytest.mark.parametrize("option", ["-ffast-math", "-ffinite-math-only"])
def test_cpp_refuses_mathematics_without_nan(option: str) -> None:
    header = str(COMPARERS["c++"])
    check = ["--driver-mode=g++", "-std=c++17", "-fsyntax-only", "-x", "c++"]
    done = run([tool("clang", "clang"), *check, option, header])
    assert done.returncode != 0
    assert "compile it without fast mathematics" in done.stderr


@pytest.mark.parametrize("language", MAIN)
def test_the_command_line(language: str, tmp_path: Path) -> None:
    source = comparer(language) if language != "c++" else '#include "burnish_judge.hpp"\n'
    command = compiled(language, source, tmp_path, *MAIN[language])
    by_name = {case.name: case for case in CASES}
    for name, code in (("f4 inside", 0), ("f4 outside", 1), ("version 4.0", 2), ("u1 in sRGB", 0)):
        case = by_name[name]
        line = case.write(tmp_path / name)
        done = run([*command, str(line.folder), line.output, str(line.picture), line.encoding])
        said = done.stderr if code == 2 else done.stdout
        assert (case.named(said), done.returncode) == (f"{case.expected}\n", code)
    linear = by_name["f4 outside"].write(tmp_path / "linear")
    short = run([*command, str(linear.folder), linear.output, str(linear.picture)])
    assert short.returncode == 1
    for wrong in ([], ["folder", "color"], ["folder", "color", "a.npy", "gamma"], list("abcde")):
        done = run([*command, *wrong])
        usage = "usage: burnish_judge FOLDER OUTPUT PICTURE.npy [linear|srgb]\n"
        assert (done.returncode, done.stdout, done.stderr) == (2, "", usage)
