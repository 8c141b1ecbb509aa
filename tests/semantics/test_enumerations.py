"""Enumerations: members are values with names, which are numbers in shaders."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError

from . import kit

HEAD = """\
enum Mode {
    add,        /// Their sum.
    mix,        /// Their mean.
    first
}
struct Layer { tint : float, mode : Mode }
usual : Mode = Mode.mix
fn joined(a: float, b: float, mode: Mode) -> float =
    if mode == Mode.add then a + b else if mode == Mode.mix then 0.5 * (a + b) else a
fn number(mode: Mode) -> float = float(int(mode))
fn number(n: int) -> float = 100.0
fn defaulted(a: float, b: float, mode: Mode = Mode.mix) -> float = joined(a, b, mode)
fn last<N: counts>(modes: Mode[N]) -> Mode = modes[N - 1]
"""
VALUES = {
    "a member": ("joined(2, 4, Mode.add)", 6.0),
    "a constant": ("joined(2, 4, usual)", 3.0),
    "a parameter": ("joined(2, 4, mode)", 2.0),
    "another overload": ("number(Mode.mix)", 1.0),
    "an index": ("[5.0, 6, 7][Mode.mix]", 6.0),
    "a choice": ("number(if uv.x > 0.5 then Mode.add else Mode.first)", 2.0),
    "a member of a structure": ("joined(2, 4, Layer(1, Mode.add).mode)", 6.0),
    "an array": ("number(last([Mode.add, mode, Mode.mix]))", 1.0),
    "the member of a number": ("number((int(uv.x * 4) as Mode))", 1.0),
    "unequal": ("if mode != Mode.add then 1 else 0", 1.0),
    "a slot": ("number(kind)", 0.0),
    "an overridden slot": ("number(set_anew)", 2.0),
    "a lane": ("float(Mode.first)", 2.0),
    "a default": ("defaulted(2, 4)", 3.0),
    "by name": ("defaulted(2, mode = Mode.add, b = 4)", 6.0),
    "a value for each member": ("choose(mode, first = uv.x, add = 1, mix = 2)", 0.25),
    "a value for a constant member": (
        "choose(Mode.mix, add = 1 / nothing, mix = 2, first = 3)",
        2.0,
    ),
    "members for members": (
        "number(choose(mode, add = mode, mix = Mode.add, first = Mode.mix))",
        1.0,
    ),
    "a state of a loop": (
        "number(iterate m from Mode.add for i in 0..3 : if i == 1 then mode else m)",
        2.0,
    ),
    "a state in a structure": (
        "number((iterate l from Layer(1, mode) for i in 0..3 : Layer(2 * l.tint, l.mode)).mode)",
        2.0,
    ),
    "vectors": ("choose(mode, add = uv.xyx, mix = vec3(1), first = 0.5)", 0.5),
}


def whole(expression: str) -> str:
    return f"""{HEAD}
abstract material Base : Surface {{
    kind : Mode = Mode.add
    param set_anew : Mode = Mode.add
}}
material M : Base {{
    param mode : Mode = Mode.first
    nothing = 0.0
    set_anew = Mode.first
    color = vec3({expression})
}}
"""


@pytest.mark.parametrize("name", VALUES)
def test_members_are_values(name: str) -> None:
    expression, expected = VALUES[name]
    assert kit.color(whole(expression))[0] == expected


CHOICES = {
    "choose(mode, add = 1, mix = 2)": "`choose` needs a value for `first`",
    "choose(mode, first = 1)": "`choose` needs values for `add` and `mix`",
    "choose(mode, add = 1, mix = 2, furst = 3)": "`choose` has no argument `furst`",
    "choose(mode, add = 1, mix = 2, first = 3, add = 4)": "the argument `add` is given twice",
    "choose(mode, add = uv, mix = uv.xyx, first = uv)": "the branches differ: vec2 and vec3",
    "choose(mode, 1, mix = 2, first = 3)": "`choose` takes its arguments by position",
    "choose(add = 1, mix = 2, first = 3)": "`choose` takes its arguments by position",
    "choose(2, add = 1, mix = 2, first = 3)": "expected a member of an enumeration, found int",
    "choose(uv.x, add = 1, mix = 2, first = 3)": "expected a member of an enumeration, found float",
}


@pytest.mark.parametrize("expression", CHOICES)
def test_a_choice_between_members_says_something_of_each(expression: str) -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(whole(expression))
    (found,) = raised.value.diagnostics
    assert found.message.startswith(CHOICES[expression])


def test_a_parameter_has_the_range_of_the_members_and_their_names() -> None:
    compiled = burnish.compile(
        f"{HEAD}material M : Surface {{\n    param mode : Mode = Mode.mix   /// How.\n"
        "    param modes : Mode[2]\n    param layer : Layer\n"
        "    alpha = [uv.x, uv.y, 1][mode] + layer.tint * number(modes[1]) + number(layer.mode)\n}",
        "glsl",
    )
    (material,) = compiled.materials
    rows = {row.name: row for row in material.reflection.parameters}
    mode, modes, layer = rows["mode"], rows["modes"], rows["layer"]
    assert mode.choices is not None
    assert [(choice.name, choice.doc) for choice in mode.choices] == [
        ("add", "Their sum."), ("mix", "Their mean."), ("first", ""),
    ]  # fmt: skip
    assert (mode.type, mode.representation, mode.range, mode.default) == ("Mode", "int", (0, 2), 1)
    assert (modes.choices, modes.range) == (mode.choices, (0, 2))
    assert (layer.members[1].choices, layer.members[1].range) == (mode.choices, (0, 2))
    assert layer.choices is None and layer.members[0].choices is None
    (text,) = [file.text for file in material.files if "out_color" in file.text]
    assert "int mode;  /// How. (0 add, 1 mix, 2 first)" in text


def test_a_constant_member_leaves_nothing_of_the_others() -> None:
    compiled = burnish.compile(whole("joined(uv.x, 4, Mode.mix)"), "glsl")
    text = next(file.text for file in compiled.materials[0].files if "out_color" in file.text)
    assert "==" not in text and "?" not in text


def test_a_host_sets_a_member_by_its_name_or_number() -> None:
    compiled = burnish.compile(whole("joined(uv.x, 4, mode)"), "glsl")
    instance = compiled.materials[0].instance()
    assert instance.get("mode") == 2
    for given in ("mix", "Mode.mix", 1):
        instance.set("mode", given)
        assert instance.get("mode") == 1
    with pytest.raises(ValueError, match=r"`mode` \(Mode\) has no member `mixx`: did you mean"):
        instance.set("mode", "mixx")
    with pytest.raises(ValueError, match=r"there is add, mix, first"):
        instance.set("mode", "nothing")


def test_an_enumeration_is_imported_like_anything_else(tmp_path: Path) -> None:
    (tmp_path / "modes.burnish").write_text(HEAD, encoding="utf-8")
    main = tmp_path / "main.burnish"
    for names in ("", ".{Mode, number}"):
        main.write_text(
            f"import modes{names}\n"
            "material M : Surface { param m : Mode = Mode.mix  color = vec3(number(m)) }",
            encoding="utf-8",
        )
        assert kit.color(main) == (1, 1, 1)


def test_two_files_may_each_have_a_mode(tmp_path: Path) -> None:
    (tmp_path / "modes.burnish").write_text(HEAD, encoding="utf-8")
    main = tmp_path / "main.burnish"
    main.write_text(
        "import modes.{number}\nenum Mode { add, mix, first }\n"
        "material M : Surface { color = vec3(number(Mode.add)) }",
        encoding="utf-8",
    )
    with pytest.raises(CompileError, match="number"):
        kit.shader(main)


def test_a_member_without_its_enumeration_is_offered_with_it() -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(whole("joined(2, 4, add)"))
    (found,) = raised.value.diagnostics
    assert found.hint == "did you mean `Mode.add`?"
    assert [edit.text for edit in found.fixes[0].edits] == ["Mode.add"]


MISTAKES = {
    "a misspelt member": ("joined(2, 4, Mode.mixx)", "did you mean `mix`?", "mix"),
    "no member": ("joined(2, 4, Mode.banana)", "there is `add`, `mix`, `first`", ""),
    "a member alone, misspelt": ("joined(2, 4, frst)", "did you mean `Mode.first`?", "Mode.first"),
    "a number": ("joined(2, 4, 1)", "did you mean `Mode.mix`?", "Mode.mix"),
    "a number without a member": (
        "joined(2, 4, 7)",
        "its members are `Mode.add`, `Mode.mix`, `Mode.first`",
        "",
    ),
    "a converted number": (
        "joined(2, 4, Mode(1))",
        "the member of a number is `(1 as Mode)`",
        "(1 as Mode)",
    ),
    "another enumeration": ("joined(2, 4, Filter.mix)", "did you mean `Mode.mix`?", "Mode.mix"),
    "compared with another one": (
        "if mode == Filter.mix then 1 else 0",
        "did you mean `Mode.mix`?",
        "Mode.mix",
    ),
    "compared with a number": (
        "if mode == 1 then 1 else 0",
        "did you mean `Mode.mix`?",
        "Mode.mix",
    ),
    "arithmetic": (
        "mode + 1",
        "`int(mode)` is the number of the member, counted from 0",
        "int(mode)",
    ),
    "order": (
        "if mode < Mode.first then 1 else 0",
        "`int(mode)` and `int(Mode.first)` are the numbers of the members, counted from 0",
        "int(mode) int(Mode.first)",
    ),
    "a choice by position": (
        "choose(mode, 1, 2, 3)",
        "a value has the name of its member in front: `choose(mode, add = …, mix = …, first = …)`",
        "add =  mix =  first = ",
    ),
    "too few by position": (
        "choose(mode, 1, 2)",
        "each member has a value: `choose(of, add = …, mix = …, first = …)`",
        "",
    ),
    "a member of a value": (
        "joined(2, 4, mode.mix)",
        "did you mean `Mode.mix`, or `mode == Mode.mix`?",
        "Mode.mix",
    ),
    "no member of a value": (
        "joined(2, 4, mode.banana)",
        "its members are `Mode.add`, `Mode.mix`, `Mode.first`",
        "",
    ),
    "a quoted member": (
        'joined(2, 4, "mix")',
        "quoted texts are only used in imports; a colour is written `#ff0000`, and a member of an "
        "enumeration `Mode.mix`",
        "",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_are_told_with_the_members(name: str) -> None:
    expression, hint, edits = MISTAKES[name]
    with pytest.raises(CompileError) as raised:
        kit.shader(f"enum Filter {{ mix, none }}\n{whole(expression)}")
    (found,) = raised.value.diagnostics
    assert found.hint == hint
    first = found.fixes[0].edits if found.fixes else ()
    assert " ".join(edit.text for edit in first) == edits


DECLARATIONS = {
    "enum Mode { add, mix, add }": "each member has a name of its own: leave one of the two out",
    "enum Mode { add = 0, mix = 1 }": (
        "members have no values: their numbers are 0, 1, 2 … in the order in which they stand"
    ),
    "enum Mode { }": "Give it the values that there are: `enum Mode { add, mix }`.",
    "fn Mode(x: float) -> float = x\nenum Mode { add }": (
        "a file has one declaration of a name, whatever it declares: give one of the two another "
        "name"
    ),
}


@pytest.mark.parametrize("text", DECLARATIONS)
def test_wrong_declarations_are_told_with_the_way_out(text: str) -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(f"{text}\nmaterial M : Surface {{ alpha = 1 }}")
    (found,) = raised.value.diagnostics
    assert (found.hint or found.rule.help) == DECLARATIONS[text]


PARAMETERS = {
    "mode : Mode in 0..1 = Mode.add": "its members are its range: leave `in …` out",
    "mode : Mode = 1": "did you mean `Mode.mix`?",
    "mode : Modes = Mode.mix": "did you mean `Mode`?",
}


@pytest.mark.parametrize("text", PARAMETERS)
def test_wrong_parameters_are_told_with_the_way_out(text: str) -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(f"{HEAD}material M : Surface {{ param {text}  alpha = float(int(mode)) }}")
    assert raised.value.diagnostics[0].hint == PARAMETERS[text]


STATES = {
    "iterate m from mode for i in 0..2 : 1": "`m` is Mode at the start, and int after an iteration",
    "iterate n from 1 for i in 0..2 : mode": "`n` is int at the start, and Mode after an iteration",
    "iterate o from mode for i in 0..2 : Other.add": (
        "`o` is Mode at the start, and Other after an iteration"
    ),
}


@pytest.mark.parametrize("loop", STATES)
def test_a_state_stays_a_member_of_its_enumeration(loop: str) -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(f"enum Other {{ add, mix }}\n{whole(f'float(int({loop}))')}")
    assert [each.message for each in raised.value.diagnostics] == [STATES[loop]]
