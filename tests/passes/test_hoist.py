"""What depends on parameters only leaves the shader, for the group that it belongs to."""

from __future__ import annotations

import pytest

from burnish.compiler.passes.pipeline import Options

from .kit import calls, history, ops, shader


def derived(text: str) -> dict[str, str]:
    """Names and groups of the derived values of a material's text."""
    past = history(shader(f"material M {{ {text} }}"))
    own = [d for d in past.staged.derived if d.parameter.name != "normal_matrix"]
    return {value.parameter.name: value.parameter.group for value in own}


def test_a_cosine_of_a_parameter_is_derived_under_a_name_that_says_so() -> None:
    names = derived("param tilt : angle = 20deg  color = vec3(uv.x * cos(tilt))")
    assert list(names.values()) == ["material"]
    (name,) = names
    assert "cos" in name


def test_a_named_value_keeps_its_name() -> None:
    names = derived("param tilt : float = 1.0  slope = sin(tilt) + 2.0  color = vec3(uv.x * slope)")
    assert names == {"slope": "material"}


@pytest.mark.parametrize(
    ("groups", "owner"),
    [
        (("material", "material"), "material"),
        (("frame", "material"), "material"),
        (("frame", "draw"), "draw"),
        (("frame", "frame"), "frame"),
        (("frame", "cascade"), "cascade"),
        (("cascade", "cascade"), "cascade"),
    ],
)
def test_the_finest_group_owns_the_value(groups: tuple[str, str], owner: str) -> None:
    text = (
        f"param a : float per {groups[0]}  param b : float per {groups[1]} "
        "both = sin(a) * cos(b)  color = vec3(uv.x * both)"
    )
    assert derived(text) == {"both": owner}


@pytest.mark.parametrize(
    "groups", [("draw", "material"), ("rig", "view"), ("cascade", "draw"), ("cascade", "tile")]
)
def test_incomparable_groups_meet_in_the_shader(groups: tuple[str, str]) -> None:
    text = (
        f"param a : float per {groups[0]}  param b : float per {groups[1]} "
        "both = sin(a) * cos(b)  color = vec3(uv.x * both)"
    )
    assert sorted(derived(text).values()) == sorted(groups)


def test_only_the_largest_value_is_derived() -> None:
    assert len(derived("param a : float  color = vec3(uv.x * sin(cos(a) + 1.0))")) == 1


def test_a_plain_parameter_is_not_copied() -> None:
    assert not derived("param a : vec3  color = a.zyx * uv.x")
    assert not derived("param a : float  color = vec3(-a * uv.x)")


def test_without_hoisting_everything_stays() -> None:
    given = shader("material M { param a : float  color = vec3(uv.x * cos(a)) }")
    past = history(given, Options(hoist=False))
    assert not past.staged.derived
    assert calls(past.roots["lower_reads"], "cos")


def test_a_derived_value_is_read_like_any_parameter() -> None:
    past = history(shader("material M { param a : float  color = vec3(uv.x * cos(a)) }"))
    assert not calls(past.roots["hoist"], "cos")
    assert "MaterialDerived" in [block.name for block in past.staged.program.blocks]
    (value,) = past.staged.derived
    assert value.parameter in [node.data for node in ops(past.roots["hoist"], "parameter")]
