"""A kind of member can be added in four files, and everything else derives what it knows of it.

The test changes a copy of the package as ``docs/architecture.md`` says it, and compiles with that.
Two kinds are added: one with a name that expressions read, and one without a name, of which the
nearest counts.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from .changed_package import CHECK, GRAMMAR, KINDS, MEMBERS, changed_package, generate, run

pytestmark = pytest.mark.xdist_group("new member")  # One process copies the package, for all tests.

CONTRIBUTES = "compiler/semantics/declarations/parameters.py"
DELIVERS = "compiler/semantics/shading/passes/blending.py"

KNOB = (
    (GRAMMAR, "_member: param |", "_member: knob | param |"),
    (GRAMMAR, "\nsetting: name", '\nknob: "knob" name "=" expression\nsetting: name'),
    (MEMBERS, "Param | Texture |", "Knob | Param | Texture |"),
    (
        MEMBERS,
        "\nMember =",
        '''
@frozen(eq=False)
class Knob:
    """``knob gain = 0.5``: a number that the host sets."""

    span: Span
    doc: str
    name: Name
    type: TypeName | None
    value: Expression


Member =''',
    ),
    (
        KINDS,
        "\nKINDS: tuple[MemberKind, ...] = (",
        """
def _knob(span: Span, doc: str, name: Name, value: Expression) -> members.Knob:
    return members.Knob(span, doc, name, None, value)


KINDS: tuple[MemberKind, ...] = (
    MemberKind(
        word="knob",
        node=members.Knob,
        productions={"knob": _knob},
        opening=("NAME", "="),
        records=("material",),
        inheritance="overridden",
        contribution="leaf",
        form="a knob is `knob name = 0.5`",
        doc="a number that the host sets",
    ),""",
    ),
    (
        CONTRIBUTES,
        "from ...syntax import ast\n",
        "from ...syntax import ast\nfrom ...syntax.ast.members import Knob\n",
    ),
    (
        CONTRIBUTES,
        "\n_LEAVES_OF: Mapping[type, Callable[[Context, Definition, str, str], Leaves]] = {",
        """
def _of_knob(ctx: Context, definition: Definition, name: str, owner: str) -> Leaves:
    knob = definition.member
    assert isinstance(knob, Knob)
    number = ast.TypeName(knob.span, ast.Name("float", knob.name.span))
    param = ast.Param(knob.span, knob.doc, knob.name, number, None, None, knob.value)
    parameter = Definition(param, definition.owner, definition.level)
    return _of_param(ctx, parameter, name, owner)


_LEAVES_OF: Mapping[type, Callable[[Context, Definition, str, str], Leaves]] = {
    Knob: _of_knob,""",
    ),
)

MIXING = (
    (GRAMMAR, "_member: ", "_member: mixing | "),
    (GRAMMAR, "\nsetting: name", '\nmixing: "mixing" name\nsetting: name'),
    (MEMBERS, "Param | Texture |", "Mixing | Param | Texture |"),
    (
        MEMBERS,
        "\nMember =",
        '''
@frozen(eq=False)
class Mixing:
    """``mixing alpha``: how a pass blends its targets unless they say otherwise."""

    span: Span
    mode: Name


Member =''',
    ),
    (
        KINDS,
        "\nKINDS: tuple[MemberKind, ...] = (",
        """
KINDS: tuple[MemberKind, ...] = (
    MemberKind(
        word="mixing",
        node=members.Mixing,
        productions={"mixing": members.Mixing},
        opening=("NAME",),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="a pass mixes by `mixing alpha`",
        doc="how a pass blends its targets",
    ),""",
    ),
    (
        DELIVERS,
        "from ....syntax import ast\n",
        "from ....syntax import ast\nfrom ....syntax.ast.members import Mixing\n",
    ),
    (
        DELIVERS,
        "    named = [mode, ",
        "    mixing = (member.mode for member, _owner, _level in drawn.every(Mixing))\n"
        "    named = [mode, *mixing, ",
    ),
)

PROGRAM = """
material Bright {
    /// How much
    knob gain = 0.5
    knob bias = 0.25
    color = vec3(gain + bias)
}
material Half : Bright {
    gain = 0.5 * inherited.gain
    bias = 0.125
}
"""

COMPILE = f"""
import burnish
for made in burnish.compile({PROGRAM!r}, targets=("wgsl",)).materials:
    shown = [(p.name, p.type, p.default, p.doc) for p in made.reflection.parameters
             if p.name in ("gain", "bias")]
    print(made.name, shown)
"""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with a copy of the package that has knobs."""
    package = changed_package(tmp_path_factory.mktemp("knobs"), (*KNOB, *MIXING))
    generate(package)
    return package


def test_four_files_are_changed() -> None:
    assert {name for name, _, _ in KNOB} == {GRAMMAR, MEMBERS, KINDS, CONTRIBUTES}
    assert {name for name, _, _ in MIXING} == {GRAMMAR, MEMBERS, KINDS, DELIVERS}


def test_it_is_a_parameter_that_can_be_overridden(package: Path) -> None:
    assert run(package, COMPILE) == (
        "Bright [('gain', 'float', 0.5, 'How much'), ('bias', 'float', 0.25, '')]\n"
        "Half [('gain', 'float', 0.5, 'How much')]\n"
    )


MIXED = """
pass Over { mixing = 0.5 mixing alpha target a : rgba8 = vec4(mixing) }
pass Added : Over { mixing add target b : rgba8 = vec4(1) }
pass Both : Added { target c : rgba8 = vec4(1) blend none }
material M { color = #fff }
"""

BLENDING = f"""
import burnish
from burnish.compiler.documents.writing import to_json
for name in ("Over", "Added", "Both"):
    (made,) = burnish.compile({MIXED!r}, targets=("wgsl",), pass_=name).materials
    print(name, [row.blend and to_json(row.blend.color) for row in made.reflection.targets])
"""


def test_of_a_kind_without_names_the_nearest_counts(package: Path) -> None:
    alpha = {"source": "src-alpha", "destination": "one-minus-src-alpha", "operation": "add"}
    added = {"source": "one", "destination": "one", "operation": "add"}
    assert run(package, BLENDING) == (
        f"Over {[alpha]}\nAdded {[added, added]}\nBoth {[added, added, None]}\n"
    )


def material(members: str) -> str:
    return f"material M {{\n{members}\ncolor = #fff\n}}"


@pytest.mark.parametrize(
    ("text", "first", "advice"),
    [
        (
            "light L { knob a = 1 to_light = vec3(0, 0, 1) }",
            "error[B0213]: `knob` does not belong in a light",
            "`knob` belongs in a material",
        ),
        (
            f"knob a = 1\n{material('')}",
            "error[B0101]: expected a declaration, found `knob`",
            "`knob` belongs in a material",
        ),
        (
            material("konb a = 1"),
            "error[B0101]: expected a member, found `konb`",
            "did you mean `knob`?",
        ),
        (
            material("knob a : float"),
            "error[B0101]: expected `=`, found `:`",
            "a value follows `=`: `a = …`",
        ),
        (material("knob a = 1\nknob a = 2"), "error[B0202]: `a` is declared twice", ""),
        (
            "pass P { mixing alpha\nmixing add\ntarget a : rgba8 = vec4(1) }\n"
            "material M { color = #fff }",
            "error[B0202]: `mixing` is declared twice",
            "",
        ),
        (
            material("mixing alpha"),
            "error[B0213]: `mixing` does not belong in a material",
            "`mixing` belongs in a pass, such as `pass Drawn : Forward { mixing alpha }`",
        ),
        (material("b = vec3(1 +\nknob a = 2"), "error[B0108]: this `(` is never closed", ""),
    ],
)
def test_messages_know_it(package: Path, text: str, first: str, advice: str) -> None:
    lines = run(package, CHECK, text).splitlines()
    assert lines[0] == first
    assert lines[-1].endswith(f"help: {advice}") or not advice
