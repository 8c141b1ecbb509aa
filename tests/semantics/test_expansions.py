"""Expansions in passes: they mean the same as in the material, and set the pass's slots too."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all

EXPANSIONS = {
    "points": "expand point { strip of 4 as i { uv = vec2(float(i)) } }",
    "several strips": """expand triangle {
        strip of 3 as i for s in 0..count where corner[0].mark < 0.4 {
            mark     = float(s) + corner[i].uv.x
            position = inherited.position + float(s) * normal
        }
    }""",
    "several groups": """expand line_adjacency {
        strip of 4 as i like corner[i] { mark = inherited.mark + 1 }
        list of 6 as i like corner[0] { uv = corner[i mod 4].uv  color = vec3(mark) }
    }""",
}
MATERIAL = """
material M {{
    param count : int in 1..3 = 2
    mark  : float = uv.y
    color = vec3(mark, uv.x, 0)
    {}
}}
"""
PASS = """
pass P : Forward {{
    {}
}}
"""


def texts(source: str, pass_: str | None = None, *, native_stages: bool = False) -> list[str]:
    (material,) = burnish.compile(
        source, "glsl:vulkan", pass_=pass_, native_stages=native_stages
    ).materials
    return [file.text for file in material.files]


@pytest.mark.parametrize("native_stages", [False, True])
@pytest.mark.parametrize("name", EXPANSIONS)
def test_a_pass_expands_as_its_material_would(name: str, native_stages: bool) -> None:
    written = EXPANSIONS[name]
    in_material = texts(MATERIAL.format(written), native_stages=native_stages)
    in_pass = texts(MATERIAL.format("") + PASS.format(written), "P", native_stages=native_stages)
    assert in_pass == in_material


def test_that_of_the_pass_counts() -> None:
    both = MATERIAL.format(EXPANSIONS["points"]) + PASS.format(EXPANSIONS["several strips"])
    assert texts(both, "P") == texts(MATERIAL.format(EXPANSIONS["several strips"]))


def test_slots_of_the_pass() -> None:
    """The pass's own slots, vertex inputs and overrides have their values at the new vertices."""
    source = MATERIAL.format("") + PASS.format("""
        param far : float = 0.1
        attribute weight : float
        height : float = 0
        double = 2 * height
        expand triangle {
            strip of 3 as i for s in 0..3 like corner[2 - i] {
                height   = float(s) * corner[i].weight
                position = inherited.position + far * double * normal
            }
        }
        color = inherited.color * weight + vec3(double, height, inherited.alpha)
    """)
    _vertex, geometry, fragment = texts(source, "P", native_stages=True)
    assert "max_vertices = 9" in geometry
    (weights,) = re.findall(r"in vec\d (v_\w*weight\w*)\[\]", geometry)
    assert re.search(rf"float height = float\(s\) \* {weights}\[i\]\.[xyzw];", geometry)
    # What is not set is that of the corner behind `like`.
    assert f"v_uv[uv_difference], height, {weights}[uv_difference].w);" in geometry
    assert "+ far * (2.0 * height) * v_normal[uv_difference];" in geometry
    (varying,) = re.findall(r"in vec4 (\w+);", fragment)
    assert f"+ vec3(2.0 * {varying}.z, {varying}.z, 1.0);" in fragment


def test_what_it_overrides_can_be_set_too() -> None:
    """The slot is one, of the material and of the pass."""
    source = """
        material M { color = vec3(alpha) }
        pass P : Forward {
            alpha = 0.5 * inherited.alpha
            expand triangle { strip of 3 as i { alpha = 0.25 * inherited.alpha * float(i) } }
        }
    """
    _vertex, geometry, fragment = texts(source, "P", native_stages=True)
    (varying,) = re.findall(r"out float (\w+);", geometry)
    assert f"{varying} = 0.125 * float(i);" in geometry
    assert f"vec4(vec3({varying}), {varying})" in fragment


def test_a_slot_that_neither_has() -> None:
    source = MATERIAL.format("") + PASS.format(
        "height : float = 0\n    expand point { strip of 4 as i { hight = 1  colour = vec3(1) } }"
    )
    assert (
        told(source)
        == """\
error[B0201]: unknown slot of `P` `hight`
  --> <text>:11:38
   |
11 |     expand point { strip of 4 as i { hight = 1  colour = vec3(1) } }
   |                                      ^^^^^
   = help: did you mean `height`?

error[B0201]: unknown slot of `P` `colour`
  --> <text>:11:49
   |
11 |     expand point { strip of 4 as i { hight = 1  colour = vec3(1) } }
   |                                                 ^^^^^^
   = help: did you mean `color`?"""
    )


DIVIDED = """
material M {{
    mark  : float = uv.y
    tessellate triangle by 4 as at {{ mark = at.x  uv = inherited.uv * at.y }}
    color = vec3(mark, uv.x, 0)
    {}
}}
"""
PARTS = """expand triangle {
    strip of 3 as i where corner[0].mark < 0.4 {
        mark     = inherited.mark + corner[i].uv.x + float(patch_index)
        position = inherited.position + mark * normal
    }
}"""


@pytest.mark.parametrize("native_stages", [False, True])
def test_a_pass_expands_divided_patches_as_their_material_would(native_stages: bool) -> None:
    in_material = texts(DIVIDED.format(PARTS), native_stages=native_stages)
    in_pass = texts(DIVIDED.format("") + PASS.format(PARTS), "P", native_stages=native_stages)
    assert in_pass == in_material
    assert len(in_pass) == (5 if native_stages else 2)


def test_what_the_pass_overrides_is_so_at_divided_patches_too() -> None:
    """The tessellation reads what the pass says, and not what the expansion makes of it."""
    source = """
        material M {
            tessellate triangle by 4 { position = inherited.position + alpha * normal }
            color = vec3(alpha)
        }
        pass P : Forward {
            alpha = uv.x
            expand triangle { strip of 3 as i { alpha = 0.25 * inherited.alpha * float(i) } }
        }
    """
    _vertex, _control, evaluation, geometry, fragment = texts(source, "P", native_stages=True)
    assert "float alpha = uv.x;" in evaluation
    assert "vec3 position = inherited_position + alpha * normal;" in evaluation
    assert "v_position_alpha_product = vec4(position, 0.25 * alpha);" in evaluation
    (varying,) = re.findall(r"out float (\w+);", geometry)
    assert f"{varying} = v_position_alpha_product[i].w * float(i);" in geometry
    assert f"vec4(vec3({varying}), {varying})" in fragment


def test_what_parts_of_patches_do_not_have() -> None:
    source = DIVIDED.format("""expand triangle {
        strip of 3 as i { mark = corner[3].mark + float(primitive_index) }
    }""")
    assert (
        told(source + PASS.format(""))
        == """\
error[B0520]: there is no corner 3: the last one is 2
 --> <text>:7:41
  |
7 |         strip of 3 as i { mark = corner[3].mark + float(primitive_index) }
  |                                         ^
  = help: Corners are numbered from 0: a point has one, a line two and a triangle three. With \
adjacency a line has four and a triangle six. A patch has as many as it has control points, and \
each of its edges has two ends.

error[B0201]: unknown name `primitive_index`
 --> <text>:7:57
  |
7 |         strip of 3 as i { mark = corner[3].mark + float(primitive_index) }
  |                                                         ^^^^^^^^^^^^^^^
  = help: what is counted here is `patch_index`"""
    )


def told(source: str) -> str:
    """The diagnostics of a source as text."""
    return render_all(burnish.check(source, pass_="P"))


def test_two_in_one_pass() -> None:
    bases = """
abstract pass Base : Forward { expand point { strip of 4 {} } }
pass P : Base { expand triangle { strip of 3 {} } }
"""
    assert told(MATERIAL.format("") + bases).startswith("""\
error[B0527]: `P` expands its primitives twice
  --> <text>:10:24
   |
 9 | abstract pass Base : Forward { expand point { strip of 4 {} } }
   |                                       ----- expanded here already
10 | pass P : Base { expand triangle { strip of 3 {} } }
   |                        ^^^^^^^^
   = help: A record has one expansion, with as many groups of strips as it needs.""")


def test_an_abstract_pass_and_a_mixin_are_checked() -> None:
    """No concrete pass has them, so placeholders stand for the slots that they leave open."""
    source = (
        MATERIAL.format("")
        + """
mixin Tall for pass {
    height : float
    expand triangle { strip of 3 as i { height = corner[i].heigth } }
}
abstract pass Open : Forward {
    rise : float
    expand line { strip of 4 as i like corner[i / 2] { rise = corner[i].uv } }
}
pass P : Forward {}
"""
    )
    assert (
        told(source)
        == """\
error[B0201]: unknown slot of `Tall` `heigth`
  --> <text>:11:60
   |
11 |     expand triangle { strip of 3 as i { height = corner[i].heigth } }
   |                                                            ^^^^^^
   = help: did you mean `height`?

error[B0301]: expected float, found vec2
  --> <text>:15:63
   |
15 |     expand line { strip of 4 as i like corner[i / 2] { rise = corner[i].uv } }
   |                                                               ^^^^^^^^^^^^ this is `vec2`
   = help: read one lane, as in `corner[i].uv.x`"""
    )
