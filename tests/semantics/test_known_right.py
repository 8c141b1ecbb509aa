"""Declarations that were right before are not checked again, and no mistake is missed by that."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.semantics.names.modules import Symbol
from burnish.compiler.semantics.shading import unused
from burnish.compiler.semantics.shading.keys import _circles
from burnish.compiler.semantics.shading.known_right import KnownRight
from burnish.compiler.syntax import stored
from burnish.compiler.watching import VARIABLE
from burnish.support.late import Late, unfinished

PARTS = (
    ("import std.lights.{Directional}\n", "import std.lights.{Directional, Point}\n", ""),
    ("import std.terms.{lambert, phong}\n", "import std.terms\n", ""),
    ('import "own.burnish".{own}\n', 'import "own.burnish"\n', ""),
    ("space inner\n", ""),
    ("wide = 2.5\n", "wide = 0\n", "wide = vec2(1)\n", ""),
    ("struct Pair { a : float, b : vec3 }\n", "struct Pair { a : vec3, b : vec3 }\n", ""),
    ("fn twice(x: float) -> float = x * wide\n", "fn twice(x: float) -> float = x / wide\n",
     "fn twice(x: float) -> vec2 = vec2(x)\n", "fn twice(x: float, y: float = wide) = x * y\n",
     "fn twice(x: float, y: float = missing) -> float = x * y\n", ""),
    ("", "fn twice(x: int) -> float = 0.5\n", "fn twice(x: float) -> float = 1\n"),
    ("fn pair(x: float) -> Pair = Pair(twice(x), vec3(x))\n", "fn pair(x: float) = twice(x)\n", ""),
    ("term matt(k: rgb) = lambert(k) * pair(rough).a\n",
     "term matt(k: rgb) = lambert(k) * other\n", "term matt(k: rgb) = missing(k)\n", ""),
    ("term shine(k: rgb) per light = k * light.specular\n",
     "term shine(k: rgb) per light = k * light.reach\n", ""),
    ("light Own : Directional { param reach : float = 3 }\n",
     "light Own : Light { to_light = 1 }\n", ""),
    ("mixin Rough for material { rough = 0.5 }\n", "mixin Rough for material { rough = true }\n"),
    ("material First : Surface + Rough { param tint : rgb = #ffffff\n color = matt(tint) }\n",
     "material First : Surface + Rough { color = shine(vec3(wide)) }\n",
     "material First : Surface { rough = 1\n color = nothing }\n", ""),
    ("material Second : First { rough = 0.25\n color = shine(tint) + own(1) }\n",
     "material Second : First { rough = vec3(1) }\n", "material Second : Surface {}\n"),
    ("abstract material Base { other : float\n color = vec3(other) }\n",
     "abstract material Base { other : float\n color = vec3(other, twice(other)) }\n", ""),
    ("material Third : Base { other = 1 }\n", "material Third : Base { other = uv }\n", ""),
    ("mixin Placed for pass { clip_position = vec4(1) }\n",
     "mixin Placed for pass { clip_position = missing }\n"),
    ("pass Framed : Forward + Placed { clip_position = vec4(0.5) }\n",
     "pass Framed : Forward { }\n", ""),
    ("abstract light Far : Directional + Dim { }\n", "abstract light Far : Directional { }\n"),
    ("mixin Dim for light { diffuse = vec3(wide) }\n",
     "mixin Dim for light { diffuse = missing }\n"),
    ("term glossed() = kd\n", "term glossed() = kd + missing\n", "fn glossed() = 1\n"),
    ("material Y { kd : rgb = #fff\n color = kd * glossed() }\n",
     "material Y { kd : rgb = #fff\n color = kd }\n"),
    ("material Z { kd : rgb = #fff\n color = glossed() }\n", ""),
    ("pass Plain : Forward { }\n", "pass Plain : Forward { clip_position = 1 }\n", ""),
    ("rig R { key : Own }\n", "rig R { key : Directional }\n", "rig R { key : Own\n key : Own }\n"),
    ("", "rig R2 { key : Directional[4] }\n"),
)  # fmt: skip
"""The forms that each part of a program may have, right and wrong ones; the first are right."""
OWN = (
    "fn own(x: float) -> vec3 = vec3(x)\n",
    "fn own(x: float) -> vec3 = x\n",
    "fn own(x: vec3) -> vec3 = x\nwide = 3\n",
)


@pytest.fixture(autouse=True)
def known(monkeypatch: pytest.MonkeyPatch) -> KnownRight:
    """The memory of this test; tests verify graphs otherwise, and then nothing is remembered."""
    monkeypatch.delenv(VARIABLE)
    known = KnownRight()
    monkeypatch.setattr(frontend, "KNOWN_RIGHT", known)
    return known


@pytest.fixture
def tries(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of declarations that are tried."""
    tried: list[str] = []
    attempts = unused.UnusedDeclarations._attempts

    def noted(self: unused.UnusedDeclarations, symbol: Symbol) -> object:
        tried.append(symbol.name)
        return attempts(self, symbol)

    monkeypatch.setattr(unused.UnusedDeclarations, "_attempts", noted)
    return tried


def told(source: str | Path) -> str:
    return render_all(burnish.check(source))


def fresh(source: Path) -> str:
    """The messages about a file where nothing is remembered."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(frontend, "KNOWN_RIGHT", KnownRight())
        return told(source)


def edits(seed: int) -> Callable[[Path], None]:
    """A function that edits a program: a part gets another form, or the parts another order."""
    chance = random.Random(seed)
    forms = [0] * len(PARTS)
    order = list(range(len(PARTS)))

    def edit(folder: Path) -> None:
        if chance.random() < 0.1:
            chance.shuffle(order)
        if chance.random() < 0.4:  # There has to be something right to remember.
            forms[:] = [0] * len(PARTS)
        for _ in range(chance.choice((0, 1, 1, 2))):
            part = chance.randrange(len(PARTS))
            forms[part] = chance.randrange(len(PARTS[part]))
        text = "".join(PARTS[part][forms[part]] for part in order)
        (folder / "main.burnish").write_text(f"burnish 1\n{text}")
        own = OWN[0] if chance.random() < 0.8 else chance.choice(OWN)
        (folder / "own.burnish").write_text(own)

    return edit


@pytest.mark.parametrize("seed", range(8))
def test_after_any_edits_the_messages_are_those_of_a_fresh_check(
    seed: int, tmp_path: Path, tries: list[str]
) -> None:
    edit, main = edits(seed), tmp_path / "main.burnish"
    saved = right = 0
    for _ in range(60):
        edit(tmp_path)
        tries.clear()
        found = told(main)
        tried = len(tries)
        tries.clear()
        assert found == fresh(main), main.read_text()
        saved += tried < len(tries)
        right += not found
    assert saved > 5 and right > 2, "too few programs to say anything"


def test_the_parts_are_right(tmp_path: Path) -> None:
    (tmp_path / "own.burnish").write_text(OWN[0])
    main = tmp_path / "main.burnish"
    main.write_text("burnish 1\n" + "".join(forms[0] for forms in PARTS))
    assert told(main) == ""


def test_an_edit_tries_what_it_changes_and_what_names_that(tries: list[str]) -> None:
    text = (
        "fn f(x: float) -> float = x\nfn g(x: float) -> float = f(x)\nfn h(x: float) -> float = x\n"
    )
    assert not told(text)
    assert sorted(tries) == ["f", "g", "h"]
    tries.clear()
    assert not told(text.replace("f(x: float) -> float = x", "f(x: float) -> float = x * 2"))
    assert sorted(tries) == ["f", "g"]
    tries.clear()
    assert not told(f"// A comment.\n{text}")
    assert not tries


def test_declarations_that_are_known_to_be_right_are_not_even_loaded(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of their trees, only the headers are; ``M0`` is the material with which others are tried."""
    made: list[str] = []

    def noted(kind: type[Late], fields: tuple[object, ...], make: Callable[[], object]) -> Late:
        def now() -> object:
            made.append(record.name.text)  # type: ignore[attr-defined]
            return make()

        record = unfinished(kind, fields, now)
        return record

    monkeypatch.setattr(stored, "unfinished", noted)
    parts = [f"fn f{i}(x: float) -> float = x\n" for i in range(8)]
    parts += [f"material M{i} {{ color = vec3(f{i}(1)) }}\n" for i in range(8)]
    parts += ["import std.lights\nrig R { key : Directional }\n"]
    for _ in range(2):  # Trees are kept when a text is read again.
        assert not told("".join(parts))
    made.clear()
    parts[3] = "fn f3(x: float) -> float = x * 2\n"
    assert not told("".join(parts))
    assert {name for name in made if name[-1].isdigit()} == {"M0", "M3"}


def test_what_another_material_reached_first_is_reached_by_those_that_are_left(
    tmp_path: Path,
) -> None:
    """``glossed`` is right only with the slots of its materials, and there are many others."""
    others = "".join(f"material M{i} {{ }}\n" for i in range(20))
    main = tmp_path / "main.burnish"
    text = (
        f"{others}term glossed() = kd\nmaterial Y {{ kd : rgb = #fff\n color = kd * glossed() }}\n"
        "material Z { kd : rgb = #fff\n color = glossed() }\n"
    )
    main.write_text(text)
    assert told(main) == fresh(main) == ""
    main.write_text(text.replace("kd * glossed()", "kd"))
    assert told(main) == fresh(main) == ""


@pytest.mark.parametrize(
    "kind, record",
    [("pass", "pass P : Forward"), ("light", "abstract light P : Light")],
)
def test_a_mixin_that_was_part_of_a_record_is_tried_when_it_is_not(
    kind: str, record: str, tmp_path: Path
) -> None:
    name = "clip_position" if kind == "pass" else "diffuse"
    mixin = f"mixin Mx for {kind} {{ {name} = missing }}\n"
    main = tmp_path / "main.burnish"
    right = "vec4(1)" if kind == "pass" else "vec3(1)"
    main.write_text(f"{mixin}{record} + Mx {{ {name} = {right} }}\n")
    assert told(main) == fresh(main) == ""
    main.write_text(f"{mixin}{record} {{ {name} = {right} }}\n")
    assert told(main) == fresh(main) != ""


def test_limits_count_what_is_remembered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unused, "MOST_TRIED", 900)
    main, text = tmp_path / "main.burnish", "abstract light {} : Light {{ a = {} }}\n"
    found = []
    for count in range(1, 400, 20):
        main.write_text("".join(text.format(name, "+".join("1" * count)) for name in "ABC"))
        found.append(told(main))
        assert found[-1] == fresh(main)
    assert not found[0] and "B0016" in found[-1]


def test_a_warning_is_told_each_time_and_the_others_are_known(tries: list[str]) -> None:
    text = "material A { unread = 1\n color = vec3(1) }\nmaterial B { color = vec3(0.5) }\n"
    first = told(text)
    tries.clear()
    assert told(text) == first
    assert tries == (["A"] if first else [])


def test_circles_of_names_have_one_key_and_chains_are_read_once() -> None:
    arrows = {"a": "b", "b": "c", "c": "ad", "d": "e", "e": "", "f": "ef", "g": "fa"}
    graph = {name: frozenset(others) for name, others in arrows.items()}
    circles = list(_circles(graph))
    assert sorted(map(sorted, circles)) == [["a", "b", "c"], ["d"], ["e"], ["f"], ["g"]]
    seen: set[str] = set()
    for circle in circles:
        seen |= circle
        assert all(graph[name] <= seen for name in circle)
    chain = {str(i): frozenset({str(i + 1)} if i < 5000 else ()) for i in range(5001)}
    assert len(list(_circles(chain))) == 5001


def test_a_mistake_elsewhere_leaves_what_is_known(tries: list[str]) -> None:
    text = "fn f(x: float) -> float = x\nfn g(x: float) -> float = x\n"
    assert not told(text)
    tries.clear()
    assert told(text.replace("g(x: float) -> float = x", "g(x: float) -> float = y"))
    assert tries == ["g"]


def test_the_oldest_outcomes_are_forgotten(known: KnownRight, tries: list[str]) -> None:
    known._most = 2
    text = "".join(f"fn f{i}(x: float) -> float = x\n" for i in range(4))
    assert not told(text)
    tries.clear()
    assert not told(text)
    assert tries == ["f0", "f1"]


def test_another_library_counts(known: KnownRight) -> None:
    assert not told("fn f(x: float) -> float = x\n")
    (key,) = known._kept
    library = known._library
    assert known.find(key, library) is not None
    assert known.find(key, object()) is None
    known.keep((), object())
    assert known.find(key, library) is None
