"""Words of the grammar are free as names: all but the nine that the manual reserves.

Each word is put into each position in which a name may stand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.syntax.lalr_tables import load_tables
from burnish.compiler.syntax.tokens import RESERVED

WORDS = sorted(word for word in load_tables().literals if word.isidentifier())
FREE = [word for word in WORDS if word not in RESERVED]
OF_RECORDS = ("material", "inherited")
"""Words with another meaning in records: no names that expressions read there (`B0214`)."""

FILES: dict[str, str] = {
    "a material": "material W {}",
    "a base": "abstract material W {}\nmaterial M : W {}",
    "a mixin": "mixin W {}\nmaterial M : Surface + W {}\nmaterial N : Surface + W {}",
    "a mixin for lights": "mixin W for light {}\nlight L : Light + W { to_light = normal }",
    "a light": "light W : Light { to_light = normal }\nrig R { a : W  b : W }\nrig W2 {}",
    "a pass": "pass W : Forward blend add {}\npass P : W {}",
    "a pass of a material": "pass W : Forward {}\nmaterial M by W {}\nmaterial N : M by W {}",
    "a rig": "rig W {}",
    "a light of a rig": (
        "light L : Light { to_light = normal  param p : float }\n"
        "rig R { W : L  b : L { p = 1 } }\nrig Q { W : L[2]\nb : L }\nrig O { b : L\nW : L[<= 2] }"
    ),
    "a setting of a rig": (
        "light L : Light { to_light = normal  W = 2.0 }\nrig R { a : L { W = 3 } }"
        "\nrig Q { a : L { to_light = normal\nW = inherited.W } }"
    ),
    "a structure": "struct W { a : float }\nfn f(x: W) -> W = W(x.a)",
    "a member": "struct S { W : float }\nfn f(x: S) -> float = x.W * x.W",
    "a second member": "struct S { a : float, W : float }\nfn f(x: S) -> S = S(x.W, x.a)",
    "a member on a line": "struct S {\n    a : float\n    W : vec3\n    b : float\n}",
    "a constant": "W = 2.0\nc = W * W\nmaterial M { a = -W }",
    "a typed constant": "a = 1.0\nW : float = 2.0\nfn f() = W",
    "a function": "fn W(x: float) -> float = x\nmaterial M { a = W(uv.x) + 2 * W(1) }",
    "a term": "term W() -> rgb per light = light.diffuse\nmaterial M { color = W() }",
    "an argument": "fn f(W: float) -> float = W * 2\nfn g(a: float, W: float) = a * W",
    "a type parameter": "fn f<W: floats>(x: W) -> W = x\nfn g<W: floats>(x: W, y: W) = x",
    "a part": "fn f(x: float) = W where { W = x }\nfn g(x: float) = W where { a = x\nW = a }",
    "a space": (
        "space W\nmaterial M { param t : transform<W, world>  a = (position in W) + vec3(0)\n"
        "  b = (uv.xyx as point<W>) in world }"
    ),
    "a block": "extern block W per frame at group 0, binding 3 { a : float at 0 }\nfn f() = a",
    "a file": "import W.{a}\nfn f() = a",
    "a folder": "import W.W.{a}\nfn f() = a",
    "an imported name": 'import "names.burnish".{W}\nfn f(x: W) -> float = x.a',
    "one of several": 'import "names.burnish".{first, W, last}\nfn f(x: W) -> float = first * last',
    "a member of a block": (
        "extern block B per frame at group 0, binding 3 { b : float at 4, W : float at 0 = 1 }"
        "\nmaterial M { a = W }"
    ),
    "a block's group": "extern block B per W at group 0, binding 3 { a : float at 0 }",
}

MEMBERS: dict[str, str] = {
    "a slot": "W = 1.0\na = W",
    "a slot beside": "a = 1.0  W = 2.0  b = W  c = W",
    "a typed slot": "W : float = 1\na = W  b : float = W",
    "a parameter": "param W : float in 0..1 = 0.5\na = W\nparam b : float",
    "a parameter's group": "param a : float per W = 0.5\nparam b : float per W\nc = a",
    "a parameter's bounds": "W = 1.0\nparam a : float in 0..limit",
    "a texture": "map W : texture2d = white\na = W(uv).x\nb = W.size()",
    "an attribute": "attribute W : vec3\na = W",
    "behind @vertex": "attribute W : vec3\ncolor = @vertex W\nb = @vertex W + W",
    "behind @vertex and more": "attribute W : vec3\na = -@vertex W\nb = @vertex -W.x",
    "operands": "W = 2.0\na = W + W\nb = W * 2 / W\nc = W mod W\nd = -W",
    "comparisons": "W = 2.0\na = W < 1 or W > 2 and not (W == 3)",
    "bools": "W = true\na = W and not W or W\nb = if W then W else W",
    "bits": "W = 3\na = W & W | ~W ^ W << W",
    "a choice": "W = 2.0\na = if W > 1 then W else W\nb = 1.0",
    "brackets": "W = 2.0\na = (W)\nb = [W, W, 1][1]\nc = (vec3(W) as rgb)",
    "elements": "W = [1, 2, 3]\na = W[1]\nn = 1\nb = W[n]",
    "an index": "l = [1, 2, 3]\nW = 1\na = l[W]",
    "lanes": "W = uv\na = W.x\nb = W.xy.y",
    "an argument of a call": "W = 2.0\na = sin(W)\nb = pow(W, W)\nc = pow(1.0, W)",
    "inherited": "W = 1.0\na = material.W",
    "a fold's variable": "a = sum W in 0..3 : float(W)\nb = 2 * (max W in 0..3 : W)",
    "a fold's bounds": "W = 3\na = sum i in 0..4 up to 4 : W\nb = sum i in W..9 up to 9 : i",
    "a fold's upper bound": "W = 3\na = sum i in 0..W up to 4 : i\nb = sum i in 0..4 from W : i",
    "a fold's body": "W = 3\na = sum i in 0..4 : W * i\nb = any i in 0..4 : W > i",
    "a state": "a = iterate W from 1.0 up to 4 while W < 9 : W * 2\nb = 1.0",
    "a state's start": "W = 1.0\na = iterate x from W up to 4 while x < W : x * W",
    "a state's number": "a = iterate x from 1.0 for W in 0..4 : x * float(W)",
    "with": "W = 1.0\na = shine() with { W = 2 }\nb = shine() with { alpha = 1, W = W }",
    "before a member": "W = 1.0\na = W\nparam p : float\nb = W\nmap m : texture2d\nc = W\n"
    "attribute d : vec2",
    "a line of its own": "W = 1.0\na = 1.0 +\n    W\n    + 2\nb = sin(\n    W\n)",
    "a line behind @vertex": "W = uv\na = @vertex\n    W\nb = @vertex\n    W.x",
    "a line of a choice": "W = true\na = if\n  W\n  then\n  W\n  else\n  W\nb = 1.0",
    "a line of a call": "W = 2.0\na = pow(\n    W,\n    W\n)\nb = [\n    W,\n    W\n]",
    "a line of a product": "W = 2.0\na = 1.0 *\n    W * 2\nb = 3.0 /\n    W\nc = -\n    W",
    "a line behind a dot": "W = uv\na = material.\n    W.\n    x",
    "before a separator": "W = 1.0; a = W; b = W, c = W",
}

PASSES: dict[str, str] = {
    "a target": "target W : rgba8 = vec4(1) blend add\ntarget b : rgba8 = vec4(1)",
    "a target's value": "W = vec4(1)\ntarget a : rgba8 = W blend add\ntarget b : rgba8 = W",
    "what discards": "W = true\ndiscard when W\na = 1.0\ndiscard when not W",
}


READ = frozenset(
    (
        "an imported name", "one of several", "a structure", "a constant", "a typed constant",
        "a function", "a term", "a member of a block", "an argument", "a part",
        "a setting of a rig",
    )
)  # fmt: skip
"""The positions that declare what an expression reads by its name alone."""


def texts(word: str) -> Iterator[str]:
    """Files that have the word in each position."""
    readable = word not in OF_RECORDS
    for position, text in FILES.items():
        if readable or position not in READ:
            yield f"// {position}\n{text.replace('W', word)}"
    if readable:
        head = "limit = 1.0\nterm shine() = alpha\n"
        yield head + "\n".join(_records("material M{}", MEMBERS, word))
        yield "\n".join(_records("pass P{} : Forward", PASSES, word))


def _records(header: str, bodies: Mapping[str, str], word: str) -> Iterator[str]:
    for number, (position, body) in enumerate(bodies.items()):
        members = body.replace("W", word)
        yield f"// {position}\n{header.format(number)} {{\n{members}\n}}"


@pytest.mark.parametrize("word", FREE)
def test_a_word_is_free_where_a_name_stands(word: str, tmp_path: Path) -> None:
    (tmp_path / word).mkdir()
    for path in (tmp_path / f"{word}.burnish", tmp_path / word / f"{word}.burnish"):
        path.write_text("a = 1.0\n", encoding="utf-8")
    names = f"first = 1.0\nstruct {word} {{ a : float }}\nlast = 2.0\n"
    (tmp_path / "names.burnish").write_text(names, encoding="utf-8")
    wrong: list[Diagnostic] = []
    for text in texts(word):
        wrong += burnish.check(f"{text}\n", search_path=[tmp_path])
    # The texts are about words: some have materials that set no colour, or slots or groups of such
    # a name.
    about_use = (rules.WITHOUT_COLOR, rules.UNREAD_SLOT, rules.UNUSUAL_GROUP)
    wrong = [each for each in wrong if each.rule not in about_use]
    assert render_all(wrong) == ""


def test_there_are_nine_reserved_words() -> None:
    page = Path(burnish.__file__).parent / "docs" / "language.md"
    listed = ", ".join(f"`{word}`" for word in sorted(RESERVED)[:-1])
    last = sorted(RESERVED)[-1]
    assert len(RESERVED) == 9
    assert f"Only {listed} and `{last}` are **reserved**" in page.read_text(encoding="utf-8")
