"""Compiles the comparers into programs, and runs each of them once for many cases.

A program of ``programs`` reads a list of cases, a line each with five fields between tabs: the
folder of the case, the output, the ``.npy`` file of the picture, its encoding, and how many lanes
the picture claims to have (nothing for as many as its file has). For each case it prints two
verdicts in a line: one of loaded files, and one of their bytes. A tool that is missing fails.
"""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from burnish.targets.conformance.comparers import COMPARERS
from burnish.targets.toolchain.tools import program

from ..suite.processes import run

PROGRAMS = Path(__file__).with_name("programs")
LANGUAGES = tuple(COMPARERS)
SUFFIXES = {"c++": ".cpp", "python": ".py", "rust": ".rs", "typescript": ".ts"}
"""The endings of programs that use a comparer."""

_PACKAGE = "burnish.targets.conformance.comparers.burnish_judge"
"""The comparer in Python, by the name that it has in this tree but not where it is copied to."""

CPP_STRICT = (
    "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wsign-conversion", "-Werror",
)  # fmt: skip
TYPESCRIPT_STRICT = (
    "--strict", "--noUncheckedIndexedAccess", "--exactOptionalPropertyTypes",
    "--noImplicitOverride", "--noPropertyAccessFromIndexSignature", "--erasableSyntaxOnly",
    "--isolatedModules", "--verbatimModuleSyntax",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Line:
    """A case of a list."""

    folder: Path
    output: str
    picture: Path
    encoding: str = "linear"
    lanes: int | None = None

    def __str__(self) -> str:
        lanes = "" if self.lanes is None else self.lanes
        return f"{self.folder}\t{self.output}\t{self.picture}\t{self.encoding}\t{lanes}"


class Said(NamedTuple):
    """What a program says of a case."""

    loaded: str
    parsed: str


def verdicts(language: str, lines: Sequence[Line], folder: Path) -> list[Said]:
    """What the comparer of a language says of each case of a list, which is written to a folder."""
    cases = folder / "cases.txt"
    cases.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    command = [*_judge_each(language), str(cases)]
    printed = run(command, cwd=folder, check=True).stdout.splitlines()
    assert len(printed) == len(lines)
    return [Said(*line.split("\t")) for line in printed]


@cache
def _programs() -> TemporaryDirectory[str]:
    """A folder for programs. It is removed when the process ends."""
    return TemporaryDirectory(prefix="burnish-comparers-")


@cache
def _judge_each(language: str) -> list[str]:
    folder = Path(_programs().name, language)
    folder.mkdir()
    source = PROGRAMS / f"judge_each{SUFFIXES[language]}"
    return compiled(language, source.read_text(encoding="utf-8"), folder)


def compiled(language: str, text: str, folder: Path, *options: str) -> list[str]:
    """The command that runs a program. It is compiled in a folder beside a copy of the comparer."""
    shutil.copy(COMPARERS[language], folder)
    source = folder / f"program{SUFFIXES[language]}"
    source.write_text(text.replace(_PACKAGE, "burnish_judge"), encoding="utf-8")
    return _COMPILERS[language](source, options)


def tool(name: str, file: str) -> str:
    """The path of a program of a tool, which has to be there."""
    path = program(name, file)
    assert path is not None, f"{name} is missing: make tools"
    return str(path)


def _python(source: Path, _options: Sequence[str]) -> list[str]:
    return [sys.executable, str(source)]


def _rust(source: Path, options: Sequence[str]) -> list[str]:
    output = source.with_suffix("")
    strict = ("--edition", "2021", "-D", "warnings")
    run([tool("rustc", "rustc"), *strict, *options, str(source), "-o", str(output)], check=True)
    return [str(output)]


def _cpp(source: Path, options: Sequence[str]) -> list[str]:
    output = source.with_suffix("")
    command = [tool("clang", "clang"), "--driver-mode=g++", "-std=c++17", *CPP_STRICT]
    run([*command, *options, str(source), "-o", str(output)], check=True)
    return [str(output)]


def _typescript(source: Path, options: Sequence[str]) -> list[str]:
    shutil.copy(PROGRAMS / "node.d.ts", source.parent)
    package = json.dumps({"type": "module"})
    source.with_name("package.json").write_text(package, encoding="utf-8")
    to_modules = ("--target", "es2022", "--lib", "es2022", "--module", "esnext")
    command = [tool("node", "node"), tool("typescript", "tsc"), *TYPESCRIPT_STRICT, *to_modules]
    declarations = source.with_name("node.d.ts")
    run([*command, *options, str(source), str(declarations)], check=True)
    return [tool("node", "node"), str(source.with_suffix(".js"))]


_COMPILERS: Mapping[str, Callable[[Path, Sequence[str]], list[str]]] = {
    "c++": _cpp,
    "python": _python,
    "rust": _rust,
    "typescript": _typescript,
}
