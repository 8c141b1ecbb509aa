"""Guards that some languages need and others do not are decided for each profile."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.passes.pipeline import Staged
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.row import Domain
from burnish.targets.description.profile import Profile
from burnish.targets.legalise.legal import Legal
from burnish.targets.legalise.legalise import legalise
from burnish.targets.registry import select
from tests.passes.agreement import lanes
from tests.passes.hardware import hardware
from tests.passes.kit import World

from .kit import staged

MATERIAL = """
material M {
    attribute a : ivec3
    attribute b : ivec3
    attribute u : uvec3
    attribute w : uvec3
    param steps : int = 3

    color = vec3(a / b) + vec3(u / w) + vec3(a / steps) + vec3(a mod b) + vec3(u mod w)
        + vec3(u << w) + vec3(a >> b) + vec3(u >> b) + vec3(float(1u << w.x))
        + vec3(float(extract_bits(u.x, b.x, a.y)))
}
"""
LOOP = """
material M {
    attribute a : ivec3
    attribute b : ivec3

    color = vec3(sum i in 0..40 : float(a.x / (b.y + i)) + float(a.y / (b.y + i)))
        + vec3(if a.x > 3 then float(a.z / b.x) else sqrt(uv.x))
}
"""
MATERIALS = Path(__file__).parents[1] / "conformance" / "materials"
GIVEN: list[tuple[str | Path, str | None]] = [
    (MATERIAL, None),
    (LOOP, None),
    *((MATERIALS / "bits.burnish", pass_) for pass_ in ("Bitwise", "Shifted", "Fields")),
    *((MATERIALS / "integers.burnish", pass_) for pass_ in ("Signed", "Unsigned")),
]
LANGUAGES = ("glsl", "hlsl", "wgsl")
WORLDS = [World(seed, traps=True) for seed in range(40)]


def legalised(given: Staged, language: str) -> Legal:
    target, profile = select(language)
    return legalise(given.program, target, profile, given.undecided)


def values(program_of: Staged | Legal) -> list[Node]:
    return [root for stage in program_of.program.stages for root in stage.roots]


def promised(profile: Profile) -> dict[str, Domain]:
    """The domains in which native builtins agree with their meaning.

    Builtins with a definition are left out: the definition stands in the text instead.
    """
    return {
        name: domain for name, domain in profile.agrees.items() if not BUILTINS[name].definition
    }


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("source", "pass_"), GIVEN, ids=lambda value: str(value)[-12:].strip())
def test_a_legal_program_has_the_same_values_on_what_the_profile_promises(
    source: str | Path, pass_: str | None, language: str
) -> None:
    given = staged(source, pass_)
    assert given.undecided is not None
    legal = legalised(given, language)
    assert not any(node.op == "call" for node in reachable(values(legal)))
    for world in WORLDS:
        informed = World(world.seed, world.traps, given.derived)
        expected = lanes(values(given), informed)
        with hardware(promised(legal.profile)):
            assert lanes(values(legal), informed) == expected


@pytest.mark.parametrize(
    ("color", "language", "written"),
    [
        ("vec3(a / b)", "wgsl", "vec3f(a / b)"),
        ("vec3(a / b)", "hlsl", "safe_div("),
        ("vec3(u mod w)", "wgsl", "vec3f(u % w)"),
        ("vec3(a mod b)", "wgsl", "safe_modulo("),
        ("vec3(u << w)", "wgsl", "& 31u"),
        ("vec3(u << w)", "hlsl", "u << w"),
        ("vec3(a >> b)", "hlsl", "a >> b"),
        ("vec3(a >> b)", "glsl", "& 31u"),
    ],
)
def test_a_language_pays_only_for_what_it_leaves_open(
    color: str, language: str, written: str
) -> None:
    text = f"""
    material M {{
        a = ivec3(vec3(uv, 1) * 7)
        b = ivec3(vec3(1, uv) * 5 - 2)
        u = uvec3(vec3(uv, 1) * 7)
        w = uvec3(vec3(1, uv) * 9)
        color = {color}
    }}
    """
    assert written in burnish.compile(text, [language])["M"].text(language, "fragment")


@pytest.mark.parametrize("language", LANGUAGES)
def test_loops_that_a_profile_alone_writes_out_have_variables_of_their_own(language: str) -> None:
    """With guards, most of the body is for arguments that are the same all over a draw.

    So the calls are written out, for profiles with these guards only, and the loop with them.
    """
    quotients = " + ".join(f"float((y + {j}) / (z + {k}))" for j in range(4) for k in range(2))
    text = f"""
    fn f(x: int, y: int, z: int) -> float = (sum i in 0..x up to 9 : sin(float(i))) + {quotients}
    material M {{
        param n : int = 3
        param m : int = 5
        a = ivec2(uv * 7)
        color = vec3(f(a.x, n, m) + f(a.y, n, m))
    }}
    """
    shader = burnish.compile(text, [language])["M"].text(language, "fragment")
    assert shader.count("for (") == (1 if language == "wgsl" else 2)
    assert shader.count("sin(") == shader.count("for (")


def test_texts_do_not_depend_on_what_else_is_compiled() -> None:
    together = burnish.compile(MATERIAL, LANGUAGES)["M"].files
    for language in LANGUAGES:
        alone = burnish.compile(MATERIAL, [language])["M"].files
        texts = [file.text for file in together if file.target == language]
        assert texts == [file.text for file in alone]


def test_guards_that_no_text_has_are_not_reported() -> None:
    text = "material M { attribute a : int  attribute b : int  color = vec3(float(a / b)) }"
    told = {
        languages: [g.builtin for g in burnish.compile(text, languages)["M"].guards]
        for languages in ("wgsl", "glsl", "wgsl,glsl")
    }
    assert told == {"wgsl": [], "glsl": ["div"], "wgsl,glsl": ["div"]}


def test_what_is_the_same_everywhere_is_not_made_anew() -> None:
    given = staged("material M { color = vec3(sqrt(uv.x) / uv.y) }")
    assert given.undecided is None
    target, profile = select("wgsl")
    assert legalise(given.program, target, profile).program is given.program


def test_statements_of_a_profile_have_their_places_in_the_source() -> None:
    text = """
    material M {
        attribute a : int
        attribute b : int
        c = a / b
        color = vec3(float(c * c + a))
    }
    """
    (_, file) = burnish.compile(text, ["glsl"])["M"].files
    lines = file.text.splitlines()
    told = {lines[number - 1].strip(): span.text for number, span in file.spans.items()}
    assert told["bool c_is_equal = v_a_b.y == -1;"] == "a / b"
