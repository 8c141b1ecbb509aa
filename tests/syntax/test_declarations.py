"""The syntax trees of each declaration and member."""

from __future__ import annotations

import pytest

from burnish.compiler.syntax import ast

from .dump import messages, parsed, show


def members(body: str) -> tuple[ast.Member, ...]:
    """The members of a material with this body."""
    (record,) = parsed(f"material M {{ {body} }}").declarations
    assert isinstance(record, ast.Record)
    return record.members


def spelt(type_: ast.TypeName | None) -> str:
    """A type as it was written."""
    return type_.span.source.text[type_.span.start : type_.span.end] if type_ else ""


def test_an_empty_file_has_no_declarations() -> None:
    file = parsed("\ufeff \r\n\t// nothing\n")
    assert file.declarations == ()
    assert file.edition == 1


def test_the_first_line_may_name_the_edition() -> None:
    assert len(parsed("burnish 1\na = 1").declarations) == 1


def test_imports() -> None:
    text = 'import std.lights.{Point, Spot,} import std.terms import "a/wood.burnish".{Wood}'
    described = [
        (i.path, i.quoted, tuple(name.text for name in i.names) if i.names else None)
        for i in parsed(text).declarations
        if isinstance(i, ast.Import)
    ]
    assert described == [
        (("std", "lights"), False, ("Point", "Spot")),
        (("std", "terms"), False, None),
        (("a/wood.burnish",), True, ("Wood",)),
    ]


def test_mixins() -> None:
    text = "mixin A {} mixin B for light { x = 1 } material C : D + A + E { mixin = 1  for = 2 }"
    first, second, record = parsed(text).declarations
    assert isinstance(first, ast.Mixin) and isinstance(second, ast.Mixin)
    assert isinstance(record, ast.Record)
    assert (first.kind, second.kind) == ("material", "light")
    assert [name.text for name in record.mixins] == ["A", "E"]
    assert record.base is not None and record.base.text == "D"
    assert [m.name.text for m in record.members if isinstance(m, ast.Slot)] == ["mixin", "for"]


def test_vertex_inputs() -> None:
    body = "attribute a : vec2  attribute b : mat4 per instance  attribute per : uint  c = 1"
    rates = [m.rate and m.rate.text for m in members(body) if isinstance(m, ast.Attribute)]
    assert rates == [None, "instance", None]


def test_blocks_of_the_hosts() -> None:
    text = """
    /// Once a frame
    extern block PerFrame per frame at group 0, binding 3 {
        viewProj : transform<world, clip> at 0      /// World to clip
        at       : float[2] at 64 = 1
    }
    extern block Bare at group 1, binding 0 {}
    extern = 1
    """
    block, bare, constant = parsed(text).declarations
    assert isinstance(block, ast.ExternBlock) and isinstance(bare, ast.ExternBlock)
    assert isinstance(constant, ast.Constant)
    assert block.group is not None and block.group.text == "frame"
    assert (block.doc, block.bind_group.text, block.binding.text) == ("Once a frame", "0", "3")
    described = [(m.name.text, m.offset.text, m.default is None, m.doc) for m in block.members]
    assert described == [("viewProj", "0", True, "World to clip"), ("at", "64", False, "")]
    assert (bare.group, bare.members) == (None, ())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mixin A : B {}", "expected `for` or `{`, found `:`"),
        ("material M : A + {}", "expected a name, found `{`"),
        ("extern block B { x : float at 0 }", "expected `at` or `per`, found `{`"),
        ("extern block B at group 0 { x : float at 0 }", "expected `,`, found `{`"),
        (
            "extern block B at group 0, binding 0 { x : float  y : float at 4 }",
            "expected `at`, found `y`",
        ),
    ],
)
def test_one_mistake_in_a_header_is_told_once(text: str, message: str) -> None:
    assert messages(text) == [message]


def test_records() -> None:
    text = "abstract material A {} light B : C {} pass D : E blend alpha {} material F : A by D {}"
    described = [
        (
            r.kind,
            r.name.text,
            r.abstract,
            r.base and r.base.text,
            r.blend and r.blend.text,
            r.by and r.by.text,
        )
        for r in parsed(text).declarations
        if isinstance(r, ast.Record)
    ]
    assert described == [
        ("material", "A", True, None, None, None),
        ("light", "B", False, "C", None, None),
        ("pass", "D", False, "E", "alpha", None),
        ("material", "F", False, "A", None, "D"),
    ]


def test_a_param_with_everything() -> None:
    (param,) = members("param power : float in -1..2 * pi per material = 48")
    assert isinstance(param, ast.Param)
    assert param.range and param.group and param.default
    assert [show(bound) for bound in param.range] == ["(- 1)", "(2 * pi)"]
    assert (param.name.text, spelt(param.type), param.group.text) == ("power", "float", "material")
    assert show(param.default) == "48"


def test_a_map_with_everything() -> None:
    (made,) = members(
        "map m : texture2d of rgb per draw = white with { filter = linear, wrap = repeat }"
    )
    assert isinstance(made, ast.Texture)
    assert made.content and made.group and made.default
    said = (made.content.text, made.group.text, made.default.text)
    assert said == ("rgb", "draw", "white")
    state = [(name.text, value.text) for name, value in made.state]
    assert state == [("filter", "linear"), ("wrap", "repeat")]


def test_members_follow_one_another_without_separators() -> None:
    found = members("a = b c : rgb d : vec3[4] = e param f : float map g : texture2d h = sum i = 1")
    assert [m.name.text for m in found if ast.is_named(m)] == list("acdfghi")


def test_targets_and_discards() -> None:
    target, discard = members("target lit : rgba8 = a + b blend add  discard when a < 0")
    assert isinstance(target, ast.Target)
    assert isinstance(discard, ast.Discard)
    assert (target.format.text, show(target.value)) == ("rgba8", "(a + b)")
    assert target.blend and target.blend.mode and target.blend.mode.text == "add"
    assert show(discard.condition) == "(a < 0)"


@pytest.mark.parametrize(
    "word",
    [
        "param",
        "map",
        "attribute",
        "target",
        "discard",
        "with",
        "blend",
        "per",
        "in",
        "light",
        "sum",
        "when",
        "base",
    ],
)
def test_words_of_the_grammar_are_names_of_members(word: str) -> None:
    first, second, third = members(f"{word} = a {word} : rgb param {word} : float = {word} b = 1")[
        :3
    ]
    for member in (first, second, third):
        assert ast.is_named(member)
        assert member.name.text == word


def test_functions_and_terms() -> None:
    text = (
        "fn lerp<T: floats>(a: T, b: vec3[2]) -> T = a\n"
        "term lambert(k: rgb) per light = k * light.diffuse\n"
        "term none() = 0"
    )
    described = [
        (
            f.kind,
            [(p.name.text, p.family.text) for p in f.type_parameters],
            [(a.name.text, spelt(a.type)) for a in f.arguments],
            spelt(f.result),
            f.per and f.per.text,
        )
        for f in parsed(text).declarations
        if isinstance(f, ast.Function)
    ]
    assert described == [
        ("fn", [("T", "floats")], [("a", "T"), ("b", "vec3[2]")], "T", None),
        ("term", [], [("k", "rgb")], "", "light"),
        ("term", [], [], "", None),
    ]


def test_rigs() -> None:
    text = "rig R { a : A  b : B[<= 8], c : C[2]; d : D { inner = 10deg outer = 2rad } e : E[] }"
    (rig,) = parsed(text).declarations
    assert isinstance(rig, ast.Rig)
    described = [
        (e.name.text, e.light.text, e.count and show(e.count), e.number, len(e.overrides))
        for e in rig.entries
    ]
    assert described == [
        ("a", "A", None, "one", 0),
        ("b", "B", "8", "at_most", 0),
        ("c", "C", "2", "exactly", 0),
        ("d", "D", None, "one", 2),
        ("e", "E", None, "any", 0),
    ]


def test_structures_spaces_and_constants() -> None:
    text = "struct Layer { tint : rgb, weight : float } space bench golden = 1.618 n : int = 3"
    structure, space, golden, n = parsed(text).declarations
    assert isinstance(structure, ast.StructDeclaration)
    assert [spelt(member.type) for member in structure.members] == ["rgb", "float"]
    assert isinstance(space, ast.Space)
    assert isinstance(golden, ast.Constant)
    assert isinstance(n, ast.Constant)
    assert (space.name.text, golden.type, spelt(n.type)) == ("bench", None, "int")


def test_type_arguments_are_part_of_the_type() -> None:
    (slot,) = members("t : transform<object, world>")
    assert isinstance(slot, ast.Slot) and slot.type
    assert [argument.text for argument in slot.type.arguments] == ["object", "world"]
    assert spelt(slot.type) == "transform<object, world>"


def test_spans_end_where_the_text_ends() -> None:
    text = "material M {\n    a : vec3   // typed\n    b = (c)   \n}\n"
    (record,) = parsed(text).declarations
    assert isinstance(record, ast.Record)
    assert [text[m.span.start : m.span.end] for m in record.members] == ["a : vec3", "b = (c)"]


def test_docs_stand_above_or_behind() -> None:
    text = (
        "//! The file,\n//! in two lines.\n"
        "/// Above,\n/// twice.\nmaterial M {\n"
        "    /// Above a.\n    a = 1   /// Behind a.\n"
        "    b : rgb;   /// Behind b.\n"
        "    c = 2   // none\n    //// none\n    d = 3\n}\n"
        "rig R { e : E   /// Behind e.\n}   /// Behind R.\n"
    )
    file = parsed(text)
    record, rig = file.declarations
    assert isinstance(record, ast.Record)
    assert isinstance(rig, ast.Rig)
    assert file.doc == "The file,\nin two lines."
    assert record.doc == "Above,\ntwice."
    states = ast.Raster | ast.Depth | ast.Stencil
    undocumented = (
        ast.Discard | ast.Clear | ast.Layers | ast.Views | states | ast.Extent | ast.WorkGroup
    )
    docs = [m.doc for m in record.members if not isinstance(m, undocumented)]
    assert docs == ["Above a.\nBehind a.", "Behind b.", "", ""]
    assert (rig.doc, rig.entries[0].doc) == ("Behind R.", "Behind e.")
