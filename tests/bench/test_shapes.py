"""The shapes of the growth bench are what they say: else it would measure how errors grow."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish

from .closures import LAYERED, layers
from .growth.measure import select
from .growth.shape import MAIN, Shape


@pytest.mark.parametrize("shape", select(()), ids=lambda shape: shape.name)
def test_the_smallest_size_compiles_or_has_the_error_that_it_is_for(
    shape: Shape, tmp_path: Path
) -> None:
    for name, text in shape.files(max(2, shape.first // 4)).items():
        (tmp_path / name).write_text(text)
    try:
        burnish.compile(tmp_path / MAIN)
        codes = set()
    except burnish.CompileError as error:
        codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
    assert codes == ({shape.says} if shape.says else set())


@pytest.mark.parametrize("text", [LAYERED.read_text(), layers(30)], ids=["layered", "layers"])
def test_documents_of_closures_compile_and_read_all_of_them(text: str) -> None:
    (material,) = burnish.compile(text, "wgsl").materials
    read = material.text("wgsl", "fragment")
    assert all(name in read for name in ("coat_weight", "fuzz_weight", "subsurface_color"))
