"""Every rule of range analysis, and every domain, earns its place; and proofs can be read."""

from __future__ import annotations

from functools import cache
from itertools import product
from pathlib import Path

import pytest

import burnish
from burnish.commands.graph.why import written
from burnish.compiler.ir.rulebook import RULES
from burnish.compiler.passes import guard
from burnish.compiler.passes.pipeline import Options, stage
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNKNOWN, Fact, Kind
from burnish.stdlib.builtins.row import Builtin
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.legalise import legalise
from tests.golden import assert_golden

from .kit import range_rules, shaders

MATERIALS = sorted((Path(__file__).parent / "proofs").glob("*.burnish"))
PROVABLE = [row.name for row in BUILTINS.values() if row.needs]
KINDS: tuple[Kind, ...] = ("float", "int", "uint")


def snapshot(path: Path, *without: str) -> tuple[str, ...]:
    """The GLSL texts and the guards of a material that is compiled without some rules.

    Everything stays in the shader: nothing is hoisted.
    """
    target = registry.load("glsl")
    (shader,) = shaders(path)
    staged = stage(shader, Options(hoist=False, without=frozenset(without)))
    emitted = emit(legalise(staged.program, target, target.profiles[0], staged.undecided))
    guards = sorted(f"{guard.builtin} {guard.span}" for guard in staged.guards)
    return (*(file.text for file in emitted.files), *guards)


@cache
def usual(path: Path) -> tuple[str, ...]:
    """The texts and guards with all rules."""
    return snapshot(path)


def unknown(*facts: Fact) -> tuple[Fact, ...]:
    """The facts that the types of some operands alone imply."""
    return tuple(UNKNOWN.as_kind(fact.kind) for fact in facts)


@pytest.mark.parametrize("rule", range_rules())
def test_every_rule_shows_in_a_material(rule: str) -> None:
    assert any(snapshot(path, rule) != usual(path) for path in MATERIALS)


@pytest.mark.parametrize("name", PROVABLE)
def test_every_domain_shows_in_a_material(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = {path: usual(path) for path in MATERIALS}
    domain = BUILTINS[name].domain
    row = changed(BUILTINS[name], domain=lambda facts: domain(unknown(*facts)))
    monkeypatch.setattr(guard, "BUILTINS", {**BUILTINS, name: row})
    assert any(snapshot(path) != plain[path] for path in MATERIALS)


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


@pytest.mark.parametrize("row", BUILTINS.values(), ids=lambda row: row.name)
def test_builtins_with_something_to_prove_say_what(row: Builtin) -> None:
    count = row.signatures[0].split(" -> ")[0].count(",") + 1
    numbers = [Fact(n, n, length=n, kind=kind) for kind in KINDS for n in (0.0, 1.0, 2.0**24)]
    known = list(product(numbers, repeat=count)) if row.expansion else []
    by_facts = any(row.domain(facts) != row.domain(unknown(*facts)) for facts in known)
    assert bool(row.needs) == by_facts


def test_rules_of_builtins_and_others_have_names_of_their_own() -> None:
    assert len(set(range_rules())) == len(range_rules())
    assert not RULES.keys() & BUILTINS.keys()
