"""Stages are rows: who names one in a text is listed here, and everybody else walks the chain."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from burnish.compiler.ir.stages import INSTANCES, STAGES, VIEWS, StageRow
from burnish.targets import registry

from .kit import ROOT, files

TABLE = "compiler/ir/stages.py"

OUTSIDE = {
    "compiler/documents/drawing.py": "the document's words for steps and for ways to expand",
    "compiler/reflection/reflect.py": "the document's words for steps and for ways to expand",
    "compiler/semantics/checking/expressions.py": "`@vertex` is a word of the language",
    "compiler/semantics/frames/pass_draws.py": "`vertices(n)` is a word of the language",
    "compiler/syntax/advice.py": "`@vertex` is a word of the language",
    "compiler/syntax/foreign_functions.py": "names of functions in other languages",
    "stdlib/builtins/elsewhere.py": "words of other languages",
    "targets/runner/scene.py": "the document's words for steps",
    "targets/runner/drivers/checks.py": "what reads the vertex inputs",
    "targets/runner/drivers/pipeline.py": "the vertex inputs' steps, which WebGPU calls so",
    "targets/runner/drivers/opengl/program.py": "a call that takes both stages",
    "targets/runner/drivers/opengl/vertices.py": "the library's words for steps",
    "targets/runner/drivers/webgpu.py": "WebGPU's words for steps",
    "targets/runner/drivers/wgpu/pipeline.py": "the library's words for both stages",
    "targets/runner/drivers/vulkan/graphics_pipeline.py": "Vulkan's bits for stages and steps",
    "targets/toolchain/checkers.py": "DXC's profiles, and how Metal's entry points look",
    "targets/toolchain/spirv.py": "SPIR-V's execution models",
}
"""The files that name a stage, besides the table and the languages' folders, and what for."""

NAMES = {name for row in STAGES.values() for name in (row.name, row.domain, row.suffix, row.entry)}


def sources() -> Iterator[Path]:
    """The files that a new stage must not need to change."""
    languages = [ROOT / "targets" / name for name in registry.names()]
    for folder in ("compiler", "targets", "commands", "stdlib", "api"):
        for path in files(ROOT / folder):
            if not any(path.is_relative_to(language) for language in languages):
                yield path


def named_in(path: Path) -> set[str]:
    """The names of stages that a file has as texts of their own."""
    tree = ast.parse(path.read_text("utf-8"))
    return {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value in NAMES
    }


def test_only_the_table_and_the_listed_files_name_stages() -> None:
    naming = {
        str(path.relative_to(ROOT)) for path in sources() if path.suffix == ".py" and named_in(path)
    }
    assert naming == {TABLE, *OUTSIDE}


@pytest.mark.parametrize("row", STAGES.values(), ids=list(STAGES))
def test_a_stages_inputs_are_of_its_domain_or_a_wider_one(row: StageRow) -> None:
    assert {supplied.domain for supplied in row.inputs} <= {row.domain, INSTANCES, VIEWS}


def test_no_two_stages_share_a_name() -> None:
    for column in ("name", "domain", "suffix", "entry"):
        found = [getattr(row, column) for row in STAGES.values()]
        assert len(set(found)) == len(found), column
