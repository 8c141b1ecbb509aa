"""Every value is computed once, in the innermost region that encloses its uses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

import pytest

from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.statements import Branch, Let, Loop, Region, Statement
from burnish.compiler.ir.types import VEC2

from .kit import calls, history, shader

Inner = TypeVar("Inner", Branch, Loop)


def region(text: str) -> Region:
    """The fragment stage of a material's text."""
    return history(shader(f"material M {{ {text} }}")).staged.program.stage("fragment").region


def everywhere(region: Region) -> Iterator[Statement]:
    """All statements, also those of inner regions."""
    for statement in region.statements:
        yield statement
        if isinstance(statement, Branch):
            yield from everywhere(statement.then)
            yield from everywhere(statement.otherwise)
        elif isinstance(statement, Loop):
            yield from everywhere(statement.body)


def only(region: Region, kind: type[Inner]) -> Inner:
    """The one statement of a kind at the top."""
    (found,) = [s for s in region.statements if isinstance(s, kind)]
    return found


def bound(region: Region) -> set[Node]:
    """The values that the statements of a region bind."""
    return {statement.node for statement in region.statements}


def named(region: Region, name: str) -> Let:
    """The statement that binds a name."""
    (found,) = [s for s in everywhere(region) if isinstance(s, Let) and s.name == name]
    return found


INVARIANT = "wave = sin(uv.x) * cos(uv.y)  color = vec3(sum i in 0..9 : wave * float(i) * uv.x)"


def test_what_a_loop_does_not_change_is_computed_before_it() -> None:
    top = region(INVARIANT)
    loop = only(top, Loop)
    assert named(top, "wave").node in bound(top)
    assert named(top, "wave").node not in bound(loop.body)
    order = [statement.node for statement in top.statements]
    assert order.index(named(top, "wave").node) < order.index(loop.node)


def test_what_depends_on_the_index_is_computed_inside() -> None:
    top = region("color = vec3(sum i in 0..9 : sin(float(i) * uv.x) * cos(float(i) * uv.x))")
    loop = only(top, Loop)
    outside = [s.node for s in top.statements if isinstance(s, Let)]
    inner = {loop.index}
    assert not any(inner & {n.data for n in reachable([node])} for node in outside)


DEAR = "dear = pow(sin(uv.x) + 2.0, cos(uv.y)) * pow(sin(uv.y) + 2.0, cos(uv.x))  "


def test_what_only_one_side_needs_is_computed_there() -> None:
    top = region(DEAR + "color = vec3(if uv.x > 0.5 then dear * dear else 0.0)")
    branch = only(top, Branch)
    assert named(top, "dear").node in bound(branch.then)
    assert named(top, "dear").node not in bound(top)


def test_what_both_sides_need_is_computed_before() -> None:
    text = DEAR + (
        "color = vec3(if uv.x > 0.5 then dear * pow(uv.y + 2.0, sin(uv.x)) "
        "else dear * pow(uv.x + 2.0, sin(uv.y)))"
    )
    top = region(text)
    assert named(top, "dear").node in bound(top)


def test_a_cheap_choice_is_no_branch() -> None:
    top = region("color = vec3(if uv.x > 0.5 then uv.y else uv.x + 1.0)")
    assert not any(isinstance(statement, Branch) for statement in everywhere(top))


def test_reads_with_implicit_level_stay_in_uniform_control_flow() -> None:
    text = "map m : texture2d  " + DEAR
    top = region(text + "color = if uv.x > 0.5 then m(uv * 2.0).rgb * dear else m(uv).rgb * uv.x")
    reads = calls([s.node for s in top.statements], "sample")
    inside = [
        statement
        for branch in top.statements
        if isinstance(branch, Branch)
        for side in (branch.then, branch.otherwise)
        for statement in everywhere(side)
    ]
    assert len(reads) == 2
    assert not any(statement.node in reads for statement in inside)


@pytest.mark.parametrize("connective", ["and", "or"])
def test_what_a_connective_may_skip_is_read_before_it(connective: str) -> None:
    text = f"color = vec3(if uv.x > 0.5 {connective} m(uv).r > 0.2 then uv.y else fwidth(uv.x))"
    top = region("map m : texture2d  " + text)
    assert calls([s.node for s in top.statements], "sample")
    skipped_nothing = region(
        f"color = vec3(if uv.x > 0.5 {connective} sin(uv.y) > 0.2 then 1 else 0)"
    )
    assert not calls([s.node for s in skipped_nothing.statements], "sin")


def test_a_shared_value_is_bound_once() -> None:
    top = region("color = vec3(sin(uv.x) * sin(uv.x) + sin(uv.x), sin(uv.x), 0)")
    nodes = [statement.node for statement in everywhere(top)]
    assert len(nodes) == len(set(nodes))
    assert len([node for node in nodes if node.data == "sin"]) == 1


def test_parts_of_what_has_a_name_have_none() -> None:
    top = region("wide = sin(uv) * cos(uv)  color = vec3(wide.x * wide.x, wide.y * wide.y, 0)")
    assert [s.name for s in top.statements if isinstance(s, Let)] == ["wide", "color"]


def test_uses_of_a_part_are_uses_of_what_the_user_named() -> None:
    top = region("bent = sin(uv)  color = vec3(bent.x * bent.x, 0, 0)")
    assert named(top, "bent").node.type == VEC2


def test_a_part_that_the_user_named_has_a_name() -> None:
    top = region("wide = sin(uv) * cos(uv)  u = wide.x  color = vec3(u * u, wide.y * wide.y, 0)")
    assert [s.name for s in top.statements if isinstance(s, Let)] == ["wide", "u", "color"]


def test_the_only_part_of_an_unnamed_value_stands_for_it() -> None:
    top = region("color = vec3((sin(uv) * cos(uv)).x * exp((sin(uv) * cos(uv)).x))")
    (statement,) = top.statements
    assert statement.node.op == "swizzle"


def test_a_loop_takes_parts_of_what_is_computed_before_it() -> None:
    top = region("bent = sin(uv)  color = vec3(sum i in 0..9 : sin(float(i) * uv.x) * bent.y)")
    assert named(top, "bent").node in bound(top)
    assert not only(top, Loop).body.statements


@pytest.mark.parametrize(
    ("whole", "part", "name"),
    [
        ("x * x", "dot(v, uv * 7.0)", "color_cosine"),
        ("float(x * x)", "dot(ivec2(uv * 3.0), ivec2(uv * 7.0))", "color_inner_product"),
    ],
)
def test_products_are_called_after_what_they_can_be(whole: str, part: str, name: str) -> None:
    """A cosine is one of directions, which have no integers as lanes."""
    made = whole.replace("x", part)
    top = region(f"v = uv + 1.0  color = vec3({made} + uv.x)")
    assert name in {each.name for each in top.statements if isinstance(each, Let)}
