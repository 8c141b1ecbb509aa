"""Costly values that only one side of a choice needs are computed behind an `if`."""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import dedent

import pytest

import burnish
from burnish.targets.toolchain import Job, Toolchain

from ..suite.verdicts import refused

HEAD = """
fn blurred(t: texture2d, p: vec2, r: float) -> float =
    sum i in 0..64 : t.level(p + r * float(i), 0).x
fn speckled(p: vec2) -> bool = (sum i in 0..30 : sin(p.x * float(i))) > 0.5
material M {
    map t          : texture2d
    param fine : bool
    param near     : float in 0..1
    param n        : int in 0..9
"""

BODIES = {
    "calls cost what the function does": (
        """
        a = blurred(t, uv, near)
        alpha = if uv.x < 0.9 then a else mix(a, blurred(t, uv, 0.2), uv.y)
        """,
        """
        float a = blurred_t(v_uv, near);
        float alpha;
        if (v_uv.x < 0.9) {
            alpha = a;
        } else {
            alpha = mix(a, blurred_t(v_uv, 0.2), v_uv.y);
        }
        out_color = vec4(vec3(0.8), alpha);
        """,
    ),
    "and, or": (
        "alpha = if uv.x > 0.5 and speckled(uv) or speckled(uv.yx) then 0.5 else near",
        """
        bool alpha_both = v_uv.x > 0.5;
        if (alpha_both) {
            alpha_both = speckled(v_uv);
        }
        bool alpha_either = alpha_both;
        if (!alpha_either) {
            alpha_either = speckled(v_uv.yx);
        }
        out_color = vec4(vec3(0.8), alpha_either ? 0.5 : near);
        """,
    ),
    "reads that compare pixels, where all go the same way": (
        "alpha = if fine then t(uv).x else near",
        """
        float alpha;
        if (fine != 0u) {
            alpha = texture(sampler2D(t, t_sampler), v_uv).x;
        } else {
            alpha = near;
        }
        out_color = vec4(vec3(0.8), alpha);
        """,
    ),
    "reads that compare pixels, where they go different ways": (
        """
        alpha = if uv.x < 0.5 then 0 else
            (if fine then t(uv).x else near) * blurred(t, uv, 2) + blurred(t, uv, 3)
        """,
        """
        vec4 t_ = texture(sampler2D(t, t_sampler), v_uv);
        float alpha = 0.0;
        if (v_uv.x >= 0.5) {
            alpha = (fine != 0u ? t_.x : near) * blurred_t(v_uv, 2.0) + blurred_t(v_uv, 3.0);
        }
        out_color = vec4(vec3(0.8), alpha);
        """,
    ),
    "branches in loops": (
        "alpha = sum i in 0..n : if uv.x > float(i) * 0.1 then blurred(t, uv, float(i)) else 0",
        """
        float alpha = 0.0;
        for (int i = 0; i < min(n, 9); i++) {
            float alpha_to_float = float(i);
            float alpha_chosen = 0.0;
            if (v_uv.x > alpha_to_float * 0.1) {
                float alpha_blurred = 0.0;
                for (int i_ = 0; i_ < 64; i_++) {
                    alpha_blurred += textureLod(
                        sampler2D(t, t_sampler), v_uv + alpha_to_float * float(i_), 0.0
                    ).x;
                }
                alpha_chosen = alpha_blurred;
            }
            alpha += alpha_chosen;
        }
        out_color = vec4(vec3(0.8), alpha);
        """,
    ),
    "branches in branches": (
        """
        alpha = if uv.x > 0.5 then (if uv.y > 0.5 then blurred(t, uv, near) else 0.25)
                else if uv.y > 0.25 then blurred(t, uv.yx, near)
                else blurred(t, 2 * uv, near)
        """,
        """
        float alpha;
        if (v_uv.x > 0.5) {
            if (v_uv.y > 0.5) {
                alpha = blurred_t(v_uv, near);
            } else {
                alpha = 0.25;
            }
        } else if (v_uv.y > 0.25) {
            alpha = blurred_t(v_uv.yx, near);
        } else {
            alpha = blurred_t(2.0 * v_uv, near);
        }
        out_color = vec4(vec3(0.8), alpha);
        """,
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def complaints(material: burnish.CompiledMaterial, toolchain: Toolchain) -> str:
    """The compilers' errors about the fragment stages that they refuse."""
    jobs = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for file in material.files
        if "fragment" in file.entry_points
        for checker in file.checkers
    ]
    return "\n".join(each.report() for each in refused(jobs, toolchain))


@pytest.mark.parametrize("name", BODIES)
def test_bodies(name: str, toolchain: Toolchain) -> None:
    equations, body = BODIES[name]
    (material,) = burnish.compile(f"{HEAD}{equations}}}", "all").materials
    (text,) = (f.text for f in material.files if f.name == "M.frag.glsl")
    main = text.partition("void main() {\n")[2].removesuffix("}\n")
    assert dedent(main).strip() == dedent(body).strip()
    assert not complaints(material, toolchain)


DEEP = 100
CHAINS = {
    "choices": "(if uv.x > {k} then {next} + 0.5 else {k})",
    "choices on the other side": "(if uv.x > {k} then {k} else {next} + 0.5)",
    "dear choices": "(if uv.x > {k} then pow(sin(uv.x + {k}) + 2, 1 + abs({next})) else {k})",
    "guards": "(if uv.x > {k} then 1 / (uv.x - {k}) + {next} else {k})",
    "connectives": "(if uv.x > {k} and speckled(uv + {k}) then {next} else {k})",
    "elements": "[uv.x, {k}, {next}][int({next}) & 1]",
    "reads": "t.level(vec2({next}, {k}), 0).x",
    "calls": "sin({next} + {k})",
    "matrices": "(if uv.x > {k} then turned * {next} else turned)",
}


@pytest.mark.parametrize("name", CHAINS)
def test_deep_chains_are_accepted(name: str, toolchain: Toolchain) -> None:
    """Compilers take neither many blocks nor many brackets inside of each other."""
    links = "\n".join(
        f"s{i} = {CHAINS[name].format(k=(i + 1) / 1024, next=f's{i + 1}')}" for i in range(DEEP)
    )
    last, lane = ("turned", "[0].x") if name == "matrices" else ("uv.y", "")
    text = f"{HEAD}param turned : mat3\n{links}\ns{DEEP} = {last}\nalpha = s0{lane}}}"
    (material,) = burnish.compile(text, "all").materials
    assert not complaints(material, toolchain)


def nested(levels: int) -> str:
    """Loops with a branch in each, that are there for what stands behind the condition."""
    value = "uv.y"
    for i in range(levels):
        place = f"(uv.x - float(i{i}) - {i})"
        value = f"(sum i{i} in 0..n : if {place} > 0 then 1 / {place} + {value} else 0)"
    return f"{HEAD}alpha = {value}}}"


def test_what_nests_too_deeply_is_told_for_the_profile(toolchain: Toolchain) -> None:
    (material,) = burnish.compile(nested(31), "all").materials
    assert not complaints(material, toolchain)
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(nested(32), "all")
    assert str(caught.value) == "64 nested blocks of M, but wgsl:webgpu has only 62"
