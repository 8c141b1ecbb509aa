"""Bindings in Python: the bytes and the sentences of the runtime, and types that mypy accepts."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from burnish.bindings import registry
from burnish.bindings.fields import Field, Structure
from burnish.bindings.model import Block
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import deriving, spelling_of, written
from burnish.bindings.writing import drawing as drawing_of

from .calls import ROUNDS, every_builtin, expected, is_close, operands, stored
from .frame_calls import Drawing, drawings, wrong
from .kit import defaults, difference, everything, samples

pytestmark = pytest.mark.xdist_group("bindings")


@cache
def _text() -> str:
    return written(everything(), registry.load("python"))


@cache
def _spelling() -> Spelling:
    return spelling_of(everything(), registry.load("python"))


@cache
def _module() -> ModuleType:
    module = ModuleType("examples_binding")
    exec(compile(_text(), "examples_binding.py", "exec"), module.__dict__)
    return module


def _block(block: Block) -> Any:
    return getattr(_module(), _spelling().type(block.name))()


def _host(field: Field, value: Any) -> Any:
    """A value as a host gives it."""
    if field.capacity:
        return [_element(field, each) for each in value]
    return _element(field, value)


def _element(field: Field, value: Any) -> Any:
    if isinstance(field.type, Structure):
        members = zip(field.type.fields, value, strict=True)
        values = {_spelling().member(each.word): _host(each, one) for each, one in members}
        return getattr(_module(), _spelling().type(field.type.name))(**values)
    return value if field.type.columns or field.type.lanes > 1 else value[0]


def _filled(block: Block, values: dict[str, Any]) -> Any:
    found = _block(block)
    # An array sets its count, and the count is set behind it.
    for field in sorted(block.structure.fields, key=lambda field: bool(field.counts)):
        setattr(found, _spelling().member(field.word), _host(field, values[field.word]))
    return found


def test_values_have_the_bytes_of_the_runtime_and_so_have_derived_ones() -> None:
    filled: dict[tuple[str, int, str], Any] = {}
    wrong = []
    for sample in samples():
        key = sample.material, sample.seed, sample.block.plain_name
        if sample.block.derivation is None:
            filled[key] = _filled(sample.block, sample.values)
            found = filled[key]
        else:
            sources = [filled[sample.material, sample.seed, name] for name in sample.sources]
            name = _spelling().function(deriving(sample.block))
            found = getattr(_module(), name)(*sources)
        if told := difference(sample.expected, bytes(found)):
            wrong.append(f"{sample.block.name} of {sample.material}, {sample.seed}: {told}")
    assert not wrong, "\n".join(wrong)


def test_blocks_begin_with_their_defaults() -> None:
    assert not [block.name for block, expected in defaults() if bytes(_block(block)) != expected]


def test_mypy_accepts_the_binding_of_all_examples(tmp_path: Path) -> None:
    (tmp_path / "examples_binding.py").write_text(_text(), "utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", "--no-incremental", "examples_binding.py"]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stdout


def test_builtins_mean_what_they_do_in_the_reference() -> None:
    binding, rows = every_builtin()
    module = ModuleType("builtins_binding")
    text = written(binding, registry.load("python"))
    exec(compile(text, "builtins_binding.py", "exec"), module.__dict__)
    spelling = spelling_of(binding, registry.load("python"))
    wrong = []
    for seed in range(ROUNDS):
        values = operands(seed)
        block = module.Operands()
        for row in rows:
            for field, _ in row.operands:
                setattr(block, spelling.member(field.word), _host(field, values[field.word]))
        found = bytes(module.derive_results(block))
        for row in rows:
            pair = expected(row, values), stored(row, found)
            if not all(is_close(*each) for each in zip(*pair, strict=True)):
                given = [values[field.word] for field, _ in row.operands]
                wrong.append(f"{row.function}({given}) is {pair[0]}, not {pair[1]}")
    assert not wrong, "\n".join(wrong[:20])


class _Recorder:
    """An engine that writes its calls down, in the form that ``frame_calls`` reads."""

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.calls: list[list[Any]] = []

    def begin(self, _frame: Any, sizes: Any, _counts: Any) -> bool:
        self.calls.append(["begin", [list(each) for each in sizes]])
        return not self._drawing.first

    def begin_pass(self, pass_: Any) -> None:
        attachments = [
            [each.texture, each.layer, each.level, each.load, _clear(each), each.store]
            for each in (*pass_.targets, *((pass_.depth,) if pass_.depth else ()))
        ]
        settings = (pass_.viewport, pass_.scissor, pass_.blend_constant)
        listed = (None if each is None else list(each) for each in settings)
        self.calls.append(["pass", pass_.name, attachments, *listed])

    def draw_models(self, tag: str, uses: Any) -> None:
        by_material = {use.material: use for use in uses}
        for model in self._drawing.models:
            if tag in model["tags"]:
                self.calls.append(["draw", _used(by_material[model["material"]]), None])

    def fill(self, use: Any, vertices: int) -> None:
        self.calls.append(["draw", _used(use), vertices // 3])

    def end_pass(self) -> None:
        self.calls.append(["end pass"])

    def dispatch(self, use: Any, groups: Any, images: Any, _buffers: Any) -> None:
        self.calls.append(["dispatch", _used(use), list(groups), images])

    def copy(self, source: int, target: int) -> None:
        self.calls.append(["copy", source, target])

    def end(self, _frame: Any) -> None:
        self.calls.append(["end"])


def _clear(attachment: Any) -> list[float]:
    return [*attachment.clear, 0.0, 0.0, 0.0][:4]


def _used(use: Any) -> list[Any]:
    blocks = use.shader.blocks()
    before = [bytes(each) for each in blocks.given()]
    use.give(blocks)
    reads = {name: {each.kind: each.number} for name, each in use.reads.items()}
    return [use.shader.name, reads, before, [bytes(each) for each in blocks.given()]]


def _drawn(drawing: Drawing) -> list[list[Any]]:
    frame = drawing.frame
    parameters = _block(frame.parameters)
    fields = [each for each in frame.parameters.structure.fields if each.word in drawing.values]
    # The number of an array's elements behind the array, which sets it.
    for field in sorted(fields, key=lambda field: bool(field.counts)):
        value = _host(field, drawing.values[field.word])
        setattr(parameters, _spelling().member(field.word), value)
    recorder = _Recorder(drawing)
    getattr(_module(), _spelling().function(drawing_of(frame)))(recorder, parameters)
    return recorder.calls


def test_frames_are_drawn_as_burnish_draws_them() -> None:
    assert not [text for each in drawings() if (text := wrong(each, _drawn(each)))]
