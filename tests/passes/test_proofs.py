"""Every rule of range analysis, and every domain, earns its place; and proofs can be read."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

import burnish
from burnish.commands.graph.why import written
from burnish.compiler.ir.rulebook import RULES, rule_names
from burnish.compiler.passes import guard
from burnish.compiler.passes.pipeline import Options, stage
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.row import everywhere, nowhere
from burnish.targets import registry
from burnish.targets.emit.emitter import emit
from tests.golden import assert_golden

from .kit import shaders

MATERIALS = sorted((Path(__file__).parent / "proofs").glob("*.burnish"))
LIMITED = [
    row.name
    for row in BUILTINS.values()
    if row.expansion and row.domain not in (nowhere, everywhere)
]


def snapshot(path: Path, *without: str) -> tuple[str, ...]:
    """What a material becomes in GLSL, everything in the shader, without some rules; and guards."""
    target = registry.load("glsl")
    (shader,) = shaders(path)
    staged = stage(shader, Options(hoist=False, without=frozenset(without)))
    emitted = emit(staged.program, target, target.profiles[0])
    guards = sorted(f"{guard.builtin} {guard.span}" for guard in staged.guards)
    return (*(file.text for file in emitted.files), *guards)


@cache
def usual(path: Path) -> tuple[str, ...]:
    """The same with all rules."""
    return snapshot(path)


@pytest.mark.parametrize("rule", rule_names())
def test_every_rule_shows_in_a_material(rule: str) -> None:
    assert any(snapshot(path, rule) != usual(path) for path in MATERIALS)


@pytest.mark.parametrize("name", LIMITED)
def test_every_domain_shows_in_a_material(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = [usual(path) for path in MATERIALS]
    row = replace(BUILTINS[name], domain=lambda _facts: False)
    monkeypatch.setattr(guard, "BUILTINS", {**BUILTINS, name: row})
    assert [snapshot(path) for path in MATERIALS] != plain


@pytest.mark.parametrize("path", MATERIALS, ids=lambda path: path.stem)
def test_proofs_can_be_read(path: Path) -> None:
    (material,) = burnish.compile(path, ["glsl"])
    text = written(material.name, material.proofs).replace(f"{path.parent}/", "")
    assert_golden(text, path.with_suffix(".why.txt"))


@pytest.mark.parametrize("path", MATERIALS, ids=lambda path: path.stem)
def test_guards_are_where_proofs_say_so(path: Path) -> None:
    (material,) = burnish.compile(path, ["glsl"])
    told = {(p.builtin, str(p.span)) for p in material.proofs if p.outcome == "guarded"}
    assert {(g.builtin, str(g.span)) for g in material.guards if g.builtin != "div"} <= told


def test_builtins_that_are_limited_say_what_they_need() -> None:
    assert not [name for name in LIMITED if not BUILTINS[name].needs]


def test_rules_of_builtins_and_others_have_names_of_their_own() -> None:
    assert len(set(rule_names())) == len(rule_names())
    assert not RULES.keys() & BUILTINS.keys()
