"""A value that depends on parameters only leaves the shader, for the group that it belongs to."""

from __future__ import annotations

import pytest

from burnish.compiler.ir.types import Array, Struct
from burnish.compiler.passes.hoist import ROOM
from burnish.compiler.passes.pipeline import Options

from .agreement import disagreements
from .kit import World, calls, history, ops, shader


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


def test_what_a_parameter_is_compared_with_is_no_value_of_the_host() -> None:
    """A block has no bools: reading one would be a comparison, too."""
    text = "param n : int = 1  param a : float = 1.0  color = vec3(if {} then uv.x else uv.y)"
    assert derived(text.format("n == 2")) == {}
    assert derived(text.format("n == 2 and a > 0.5")) == {}
    assert len(derived(text.format("sin(a) > 0.5"))) == 1


def test_a_value_is_moved_if_it_saves_what_it_costs_to_read_it() -> None:
    """A row costs 4, which is what a cosine or a division saves; a sum of vectors saves 3."""
    text = "param a : vec3 = 1  param b : vec3 = 2  param c : float = 3  color = uv.x * ({})"
    assert derived(text.format("a + b")) == {}
    assert len(derived(text.format("vec3(1 / c)"))) == 1
    assert len(derived(text.format("a + b + c"))) == 1


def test_what_a_moved_value_saves_already_does_not_pay_again() -> None:
    """The shader computes `1 - bent` of `bent`, which it reads anyway."""
    text = "param tilt : float = 1  bent = cos(tilt)  color = vec3(uv.x * bent, uv.y * {}, 0)"
    assert derived(text.format("(1 - bent)")) == {"bent": "material"}
    assert len(derived(text.format("sin(bent)"))) == 2


def test_the_number_of_an_element_is_no_gain() -> None:
    """The shader computes it, to know which element of the table it reads."""
    text = "param tints : vec3[3]  color = uv.x * {}(tints[int(uv.y * sin(uv.x)) mod 3])"
    assert derived(text.format("-")) == {}
    assert list(derived(text.format("cos")).values()) == ["material"]


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


# --- elements of arrays --------------------------------------------------------------------------

SPOTS = """
import std.lights.{Spot}
import std.terms.{lambert}
material M { color = lambert(vec3(1)) }
rig R { spots : Spot[<= 8] }
"""


def tables(text: str) -> dict[str, tuple[str, ...]]:
    """The tables of a text, or of a material's text: the names of their members."""
    past = history(shader(text if "material" in text else f"material M {{ {text} }}"))
    found = (value.parameter for value in past.staged.derived)
    return {
        parameter.name: tuple(name for name, _ in parameter.type.element.members)
        for parameter in found
        if isinstance(parameter.type, Array) and isinstance(parameter.type.element, Struct)
    }


def test_what_depends_on_one_light_of_many_stands_in_a_table() -> None:
    past = history(shader(SPOTS))
    assert calls(past.roots["guard"], "cos")
    assert not calls(past.roots["hoist"], "cos")
    (table,) = [value for value in past.staged.derived if value.parameter.name == "spots_derived"]
    assert table.parameter.group == "rig"
    assert str(table.parameter.type) == "SpotsDerived[8]"
    assert tables(SPOTS) == {"spots_derived": ("falloff_cos", "falloff_inverse_width")}


def test_loops_share_what_they_need_alike_of_each_element() -> None:
    text = (
        "param a : float[4]  color = vec3(uv.x * (sum i in 0..4 : cos(a[i]) * uv.y), "
        "sum j in 0..4 : cos(a[j]) * uv.x, max k in 0..3 from 0 : cos(a[k]) * uv.y)"
    )
    assert [len(members) for members in tables(text).values()] == [1]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("param a : float[4]  color = vec3(sum i in 0..4 : uv.x * (a[i] + 1))", 0),
        ("param a : float[64]  color = vec3(sum i in 0..64 : uv.x * cos(a[i]))", 1),
        ("param a : float[65]  color = vec3(sum i in 0..65 : uv.x * cos(a[i]))", 0),
        ("param a : float[4]  color = vec3(sum i in 0..4 : cos(a[i] * uv.x))", 0),
        ("param a : float[4]  color = vec3(sum i in 0..4 : cos(a[i] * float(i)))", 0),
        ("param a : float[4]  color = vec3(cos(a[int(4 * uv.x)]))", 1),
        ("param a : float[4]  color = vec3(sum i in 0..9 : uv.x * cos(a[i]))", 1),
    ],
    ids=["cheap", "not too many", "too many", "pixel", "number", "computed", "clamped"],
)
def test_a_table_has_to_pay(text: str, count: int) -> None:
    assert len(tables(text)) == count


@pytest.mark.parametrize("derivative", ["ddx", "fwidth"])
def test_a_difference_between_pixels_is_that_of_two_elements(derivative: str) -> None:
    """The neighbour may be at another position, so no element has a derivative of its own."""
    text = "param a : float[4]  color = vec3({}(exp(a[int(4 * uv.x)])))"
    past = history(shader(f"material M {{ {text.format(derivative)} }}"))
    assert calls(past.roots["hoist"], "ddx")
    assert list(tables(text.format(derivative)).values()) == [("color_exp",)]


def test_two_arrays_at_one_position_have_the_table_of_the_shorter() -> None:
    text = "param a : float[6]  param b : float[4]  color = vec3(uv.x * (sum i in 0..4 : {}))"
    assert list(tables(text.format("cos(a[i]) + sin(b[i])"))) == ["b_derived"]
    assert list(tables(text.format("cos(b[i]) + sin(a[i])"))) == ["b_derived"]


def test_two_positions_have_a_table_each() -> None:
    text = (
        "param a : float[4]  param b : float[4]  "
        "color = vec3(sum i in 0..4 : sum j in 0..4 : uv.x * cos(a[i]) * sin(b[j]))"
    )
    assert sorted(tables(text)) == ["a_derived", "b_derived"]


def test_of_two_incomparable_groups_each_has_its_table() -> None:
    text = (
        "param a : float[4]  param b : float[4] per draw  "
        "color = vec3(sum i in 0..4 : uv.x * cos(a[i]) * sin(b[i]))"
    )
    past = history(shader(f"material M {{ {text} }}"))
    groups = {value.parameter.name: value.parameter.group for value in past.staged.derived}
    assert (groups["a_derived"], groups["b_derived"]) == ("material", "draw")


def test_a_part_of_what_does_not_pay_is_hoisted_all_the_same() -> None:
    text = (
        "param a : float[4]  param b : float  color = vec3(sum i in 0..4 : uv.x * (a[i] * (b + 1)))"
    )
    assert not tables(text)
    assert list(derived(text).values()) == ["material"]


def test_a_position_may_be_made_of_what_is_hoisted() -> None:
    text = "param a : float[4]  param b : float  color = vec3(cos(a[int(uv.x * exp(b))]))"
    past = history(shader(f"material M {{ {text} }}"))
    assert not calls(past.roots["hoist"], "cos") and not calls(past.roots["hoist"], "exp")


def test_arrays_that_are_members_have_tables_too() -> None:
    text = (
        "struct Curve { weights : float[4] }\n"
        "material M { param c : Curve  color = vec3(sum i in 0..4 : uv.x * exp(c.weights[i])) }"
    )
    assert list(tables(text)) == ["c_weights_derived"]


def test_tables_leave_room_in_a_block_of_any_device() -> None:
    terms = " + ".join(f"(inverse(m[i] * {n}.0) * vec4(uv, uv)).xyz" for n in range(2, 8))
    text = f"material M {{ param m : mat4[64]  color = (sum i in 0..64 : ({terms}) * uv.x) }}"
    given = shader(text)
    (table,) = history(given).staged.derived
    table_type = table.parameter.type
    assert isinstance(table_type, Array) and isinstance(table_type.element, Struct)
    matrices = len(table_type.element.members)
    assert 0 < matrices < 6 and matrices * 64 * table_type.count <= ROOM
    assert not disagreements(given, [World(1)])
