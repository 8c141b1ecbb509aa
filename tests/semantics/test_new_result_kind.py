"""A kind of member that a shader delivers can be added in four files, like any other kind.

``test_new_member_kind.py`` adds one that contributes a parameter; this one contributes a result.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from .changed_package import CHECK, GRAMMAR, KINDS, MEMBERS, changed_package, run

pytestmark = pytest.mark.xdist_group("new result")  # One process copies the package, for all tests.

DELIVERS = "compiler/semantics/shading/elaborate.py"

CHANGES = (
    (GRAMMAR, "_member: param |", "_member: picture | param |"),
    (GRAMMAR, "\nsetting: name", '\npicture: "picture" name "=" expression\nsetting: name'),
    (MEMBERS, "Param | Texture |", "Picture | Param | Texture |"),
    (
        MEMBERS,
        "\nMember =",
        '''
@frozen(eq=False)
class Picture:
    """``picture glow = e``: a render target with eight bits in each of four lanes."""

    span: Span
    doc: str
    name: Name
    value: Expression


Member =''',
    ),
    (
        KINDS,
        "\nKINDS: tuple[MemberKind, ...] = (",
        """
KINDS: tuple[MemberKind, ...] = (
    MemberKind(
        word="picture",
        node=members.Picture,
        productions={"picture": members.Picture},
        opening=("NAME", "="),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="a picture is `picture name = vec4(1)`",
        doc="what a pass writes to an ordinary render target",
    ),""",
    ),
    (
        DELIVERS,
        "        *_targets(ctx, passing.record, passing),\n",
        "        *_targets(ctx, passing.record, passing),\n"
        "        *_pictures(ctx, passing.record, passing),\n",
    ),
    (
        DELIVERS,
        "\ndef _targets(",
        """
def _pictures(ctx: Context, drawn: Record, passing: Instance) -> Iterator[Result]:
    for picture, owner, level in drawn.every(ast.members.Picture):
        format_ = ast.Name("rgba8", picture.name.span)
        target = ast.Target(
            picture.span, picture.doc, picture.name, format_, picture.value, None
        )
        result = _target(ctx, drawn, passing, target, owner, level)
        if result is not None:
            yield result


def _targets(""",
    ),
)

PROGRAM = """
abstract pass Glowing : Forward {
    /// What shines by itself
    picture glow = vec4(1)
}
pass Dim : Glowing {
    /// Dimmer than the surface
    picture glow = vec4(0.25 * color, alpha)
    picture depth = vec4(frag_coord.z)
}
"""

COMPILE = f"""
import burnish
(made,) = burnish.compile({PROGRAM!r} + "material M {{ }}", ("wgsl",), pass_="Dim").materials
for output in made.reflection.targets:
    print(output.name, output.format, output.doc)
for line in made.text("wgsl", "fragment").splitlines():
    if "@location" in line:
        print(line.strip())
"""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with a copy of the package that has pictures."""
    return changed_package(tmp_path_factory.mktemp("pictures"), CHANGES)


def test_four_files_are_changed() -> None:
    assert {name for name, _, _ in CHANGES} == {GRAMMAR, MEMBERS, KINDS, DELIVERS}


def test_it_is_delivered_and_can_be_replaced(package: Path) -> None:
    assert run(package, COMPILE) == (
        "color rgba8_srgb \n"
        "glow rgba8 Dimmer than the surface\n"
        "depth rgba8 \n"
        "@location(0) color: vec4f,\n"
        "@location(1) glow: vec4f,  /// Dimmer than the surface\n"
        "@location(2) depth: vec4f,\n"
    )


@pytest.mark.parametrize(
    ("text", "first", "advice"),
    [
        (
            "material M { picture a = vec4(1) }",
            "error[B0213]: `picture` does not belong in a material",
            "`picture` belongs in a pass, such as `pass Drawn : Forward { picture a = vec4(1) }`",
        ),
    ],
)
def test_messages_know_it(package: Path, text: str, first: str, advice: str) -> None:
    lines = run(package, CHECK, text).splitlines()
    assert lines[0] == first
    assert lines[-1].endswith(f"help: {advice}")
