"""What is kept of the library's functions changes nothing: no text and no message."""

from __future__ import annotations

import random
import shutil
from itertools import count
from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.library import FOLDER
from burnish.compiler.semantics.checking import signatures
from burnish.compiler.semantics.checking.kept_bodies import taken
from burnish.compiler.semantics.shading import assembly, kept_bodies
from burnish.compiler.semantics.shading.kept_bodies import KeptBodies
from burnish.compiler.semantics.state.context import Context, Signature
from burnish.compiler.watching import VARIABLE
from burnish.tests.semantics.elaborations import keep_nothing
from burnish.tests.suite.processes import at_once


@pytest.fixture(autouse=True)
def kept(monkeypatch: pytest.MonkeyPatch) -> KeptBodies:
    """The bodies of this test; tests verify graphs otherwise, and then none are used."""
    monkeypatch.delenv(VARIABLE)
    kept = KeptBodies()
    monkeypatch.setattr(assembly, "KEPT_BODIES", kept)
    return kept


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of functions whose bodies were taken from what is kept."""
    found: list[str] = []

    def noted(ctx: Context, signature: Signature, *others: object) -> object:
        body = taken(ctx, signature, *others)  # type: ignore[arg-type]
        found.extend([signature.symbol.name] if body is not None else [])
        return body

    monkeypatch.setattr(signatures, "taken", noted)
    return found


def said(source: str) -> list[str]:
    """All that a compile gives: texts and messages, or errors."""
    try:
        # A text that was compiled before would not be compiled again.
        result = burnish.compile(f"{source}// {next(NUMBERS)}\n", ("glsl:gl330", "wgsl"))
    except burnish.CompileError as error:
        return [render_all(error.diagnostics)]
    texts = [file.text for material in result for file in material.files]
    return [render_all(result.diagnostics), *texts]


NUMBERS = count()


def fresh_of(source: str) -> list[str]:
    """The same where nothing is kept."""
    with pytest.MonkeyPatch.context() as patch:
        keep_nothing(patch)
        return said(source)


VALUES = (
    "uv.x", "0.5", "rough", "1 - rough", "2 * 3 + 4 * 5 - 6 / 7 + 8", "1 / none", "none", "-1", "0",
    "if rough > 0.5 then 1 else 2", "large", "large + 0", "dot(normal, to_eye)",
    "if none > 0 then 1 / none else 3",
)  # fmt: skip
VECTORS = (
    "to_eye", "normal", "vec3(0.5)", "vec3(rough)", "vec3(1, 2, 3)", "vec3(uv, large)", "tint",
    "vec3(large)", "normalize(to_eye + vec3(large, 0, 0))", "vec3(1 / none)", "tint * none",
    "rgb(large, 0.2, 0.3 + 0.1 + 0.1 + 0.1)",
)  # fmt: skip
CALLS = (
    "grey({})", "schlick_fresnel({v}, {v}, {v}, {}, {}, {}, {})",
    "dielectric_fresnel({}, {}, {}, {})", "facet_shares({}, {})", "f0_of_ior({}) * {v}",
    "mixed(one, two, {}).response",
    "dielectric_bsdf(asked, {}, ior = {}, normal = {v}, tangent = {v}).response",
    "sheen_bsdf(asked, {}, color = {v}, normal = normal, mode = {}).throughput",
    "scaled(one, {v}).response", "value_noise({v} * {})", "smooth({})",
    "oren_nayar_diffuse_bsdf(asked, {}, color = {v}, normal = normal).response",
)  # fmt: skip
HEAD = """burnish 1
import std.mtlx.asking.{Asked, Bsdf, from_everywhere, mixed, scaled}
import std.mtlx.closures.{dielectric_bsdf, oren_nayar_diffuse_bsdf, sheen_bsdf}
import std.mtlx.facets.{facet_shares}
import std.mtlx.fresnel.{dielectric_fresnel, grey, schlick_fresnel}
import std.microfacets.{f0_of_ior}
import std.noise.{value_noise}
none = 0.0
large = 1.0 + 2 + 3 + 4 + 5 + 6 + 7 + 8 + 9 + 10 - 54.5
fn smooth(x: float) -> vec3 = if x > 0 then vec3(dielectric_fresnel(x, 0, 1, x)) else vec3(none / x)
"""
BESIDE = (
    "struct Bsdf { mine : float }\n",
    "struct Facets { mine : float }\nfn own(f: Facets) -> float = f.mine\n",
    "fn grey(x: float) -> vec3 = vec3(x)\n",
)


def program(chance: random.Random) -> str:
    """A program of a few calls of the library's functions, right or wrong."""
    calls = chance.sample(CALLS, 3)
    slots = [f" call{number} = {_filled(chance, call)}\n" for number, call in enumerate(calls)]
    beside = chance.choice(BESIDE) if chance.random() < 0.2 else ""
    return (
        f"{HEAD}{beside}material M {{\n param rough : float in 0..1 = 0.5\n"
        " param tint : rgb = vec3(0.5)\n asked = from_everywhere(to_eye, ambient_light)\n"
        " one = sheen_bsdf(asked, rough, normal = normal)\n"
        " two = oren_nayar_diffuse_bsdf(asked, normal = normal)\n"
        f"{''.join(slots)} color = call0 + call1 * call2\n}}\n"
    )


def _filled(chance: random.Random, call: str) -> str:
    while "{" in call:
        call = call.replace("{}", chance.choice(VALUES), 1)
        call = call.replace("{v}", chance.choice(VECTORS), 1)
    return call


@pytest.mark.parametrize("seed", range(4))
def test_random_calls_are_the_same_in_a_process_that_has_compiled_others(
    seed: int, calls: list[str]
) -> None:
    chance = random.Random(seed)
    for _ in range(8):
        text = program(chance)
        assert said(text) == fresh_of(text), text
    assert {"oren_nayar_diffuse_bsdf", "sheen_bsdf"} <= set(calls)


RIGHT = (
    HEAD + "material M {\n asked = from_everywhere(to_eye, ambient_light)\n"
    " color = dielectric_bsdf(asked, large / 10, normal = normal, tangent = normal).response\n}\n"
)


def test_bodies_with_errors_are_checked_for_each_call() -> None:
    """The library's own are right, but a call may give what they cannot take."""
    text = RIGHT.replace("large / 10", "1 / none")
    fresh = fresh_of(text)
    assert "is always zero" in fresh[0]
    assert [said(text) for _ in range(3)] == [fresh] * 3


def test_a_library_that_changes_is_checked_anew(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shutil.copytree(FOLDER, tmp_path / "stdlib")
    monkeypatch.setattr(frontend, "FOLDER", tmp_path / "stdlib")
    changed = tmp_path / "stdlib" / "mtlx" / "closures.burnish"
    own = changed.read_text()
    for text in (own, own.replace("if weight < mtlx_least", "if weight < 0.25"), own):
        changed.write_text(text)
        assert [said(RIGHT) for _ in range(2)] == [fresh_of(RIGHT)] * 2


def test_few_bodies_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    few = KeptBodies(most=2)
    monkeypatch.setattr(assembly, "KEPT_BODIES", few)
    monkeypatch.setattr(kept_bodies, "MOST_NODES", 100)
    for chance in map(random.Random, range(4)):
        text = program(chance)
        assert said(text) == fresh_of(text)
    assert len(few) == 2


def test_nothing_is_kept_of_what_was_not_finished(
    kept: KeptBodies, monkeypatch: pytest.MonkeyPatch
) -> None:
    fresh = fresh_of(RIGHT)
    with monkeypatch.context() as patch:

        def interrupted(*_arguments: object) -> None:
            raise KeyboardInterrupt

        patch.setattr(kept_bodies, "check_body", interrupted)
        with pytest.raises(KeyboardInterrupt):
            said(RIGHT)
    assert len(kept) == 0
    assert said(RIGHT) == fresh


def test_who_watches_passes_gets_everything_checked(
    monkeypatch: pytest.MonkeyPatch, calls: list[str]
) -> None:
    monkeypatch.setenv(VARIABLE, "1")
    said(RIGHT)
    assert not calls


def test_threads_share_bodies() -> None:
    texts = [program(random.Random(seed)) for seed in range(3)]
    fresh = [fresh_of(text) for text in texts]

    def work() -> list[list[str]]:
        return [said(text) for text in texts]

    assert at_once([work] * 4) == [fresh] * 4
