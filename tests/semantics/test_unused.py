"""Mistakes in what nobody uses are found, and what is right in some setting is not blamed."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.shader import Shader
from burnish.compiler.semantics.names.modules import Symbol
from burnish.compiler.semantics.names.standard_library import files_of, import_path
from burnish.compiler.semantics.shading.assembly import Setting
from burnish.compiler.semantics.shading.elaborate import elaborate

LIBRARY = Path(burnish.__file__).parent / "stdlib"
STANDS_FOR_BUILTINS = "meaning.burnish"
"""The file whose functions have the names of the builtins that they define; it is an exception."""


def codes(text: str) -> list[str]:
    return [found.rule.code for found in burnish.check(f"{text}\n")]


BROKEN = [
    "fn f(x: float) -> float = missing",
    "term t(k: rgb) = missing",
    "term t(k: rgb) per light = k * light.missing",
    "fn f<T: floats>(x: T) -> T = missing * x",
    "fn f<T: floats, U: numbers>(x: T, y: U) -> T = x.missing + y",
    "fn f<M: matrices, N: counts>(x: M[N]) = x[0] * missing",
    "fn f<A: spaces>(x: point<A>) = x + missing",
    "term t<T: floats>(x: T) per light = light.diffuse * missing",
    "abstract material A { kd : rgb  color = kd + missing }",
    "abstract material A { param k : float in 0..missing }",
    "abstract light L { boost : float  falloff = boost * missing }",
    "light L : Light { to_light = normal  falloff = missing }",
    "mixin A { color = inherited.color * missing }",
    "mixin A for light { falloff = inherited.falloff * missing }",
    "mixin A for pass { color = inherited.color * missing }",
    "pass P { target c : rgba8 = vec4(missing)  clip_position = position in clip }",
    "pass P : Forward { discard when missing }",
    "mixin A for pass { target t : rgba9 = vec4(1) }",
    "mixin A for pass { target t : rgba8 = vec4(1) blend missing }",
    "mixin A for pass { uv : vec2  target t : rgba8 = vec4(uv, missing) }",
    "abstract pass P { uv : vec2  faint = uv * missing }",
    "abstract pass P { uv : vec3 }",
    "abstract light L { falloff : float  twice = falloff * missing }",
    "abstract light L { falloff : vec2 }",
    "abstract material A { color : rgb  faint = color * missing }",
    "abstract material A { color : vec2 }",
    "abstract material A { color : Missing  faint = color.xy }",
    "light L { to_light : Missing }",
    "pass P : Forward { color : Missing }",
    "abstract pass P { faint = missing }",
    "import std.lights  rig R { a : Spot { inner = missing } }",
    "import std.lights  rig Q { a : Spot }  rig R { a : Spot { inner = missing } }",
    "rig R { a : Missing }",
    "fn f(n: int) -> int = sum i in 0..n : missing",
    "abstract light L { param n : int  falloff = float(sum i in 0..n : i) }",
    "abstract material A { k : float  normal = vec3(k, 0, 0) }",
    "a = missing",
    "struct S { a : missing }",
]


@pytest.mark.parametrize("declaration", BROKEN)
@pytest.mark.parametrize(
    "material", ["", "material Whole { color = #fff }"], ids=["alone", "beside"]
)
def test_a_mistake_in_what_nobody_uses_is_found_once(declaration: str, material: str) -> None:
    text = f"{declaration}\n{material}"
    assert len(codes(text)) == 1
    if material:
        with pytest.raises(CompileError) as caught:
            burnish.compile(text, "wgsl", rig="R" if " rig " in text else None)
        assert [found.rule.code for found in caught.value.diagnostics] == codes(text)


RIGHT = [
    "fn f<T: floats>(x: T) = x.xy",
    "fn f<T: numbers, W: widths>(x: T, y: vec<T, W>) = y * x",
    "fn f<T: vectors, N: counts>(x: T[N]) = x[7]",
    "fn f<M: matrices, K: textures>(m: M, t: K) = t.size()",
    "fn f<B: bools>(x: B) -> B = not x",
    "fn f<A: spaces, B: spaces>(t: transform<A, B>, p: point<A>) -> point<B> = t * p",
    "abstract material A { n : direction<world>  color = abs(n) }",
    "abstract material A { kd : rgb  color = glossed() }  term glossed() = kd",
    "material A { kd = #fff  color = kd }  material B {}  term glossed() = kd",
    "material B {}  material A { kd = #fff  color = kd }  term glossed() = kd",
    "light L : Light { to_light = normal  cone = 2.0 }  term coned() per light = light.cone",
    "abstract material A { t : texture2d  color = t(uv).rgb * t.level(uv, 1).rgb }",
    "abstract material A { t : depth2d  alpha = t(uv, 0.5) }  material M : A { map t : depth2d }",
    "mixin A { t : texture2d  color = inherited.color * t(uv).rgb }",
    "material A { map t : texture2d  twin : texture2d = t  color = twin(uv).rgb }",
    "fn f(n: int) -> int = sum i in 0..n : i",
    "fn f(n: int, m: int) -> int = sum i in 0..n up to (m) : i",
    "abstract material A { n : int  map t : texture2d"
    "  color = t.gather(uv, n).rgb * float(sum i in n..9 : i) }",
    "abstract pass P { faint = alpha }",
    "abstract pass P { uv : vec2  faint = alpha * uv }  pass Q : P + R { uv = vec2(1) }"
    "mixin R for pass { target t : rgba8 = vec4(uv, uv) }",
    "mixin R for pass { uv : vec2  target t : rgba8 = vec4(uv, uv) }",
    "abstract light L { falloff : float  twice = 2 * falloff }"
    "light K : L { falloff = 0.5  to_light = normal }",
    "abstract material A { color : rgb }  abstract material B : A { faint = inherited.color }",
    "abstract material A { color : rgb }  mixin R { color = inherited.color / 2 }"
    "abstract material B : A + R {}",
    "pass P : Forward { color = vec3(material.k) }  material A {}  material B { k = 1  alpha = k }",
    "import std.lights  rig R {}  term lit() per light = light.diffuse",
    "import std.lights  rig A { a : Point }  rig B { b : Spot[2] }  material M {}",
    "import std.lights  rig A { a : Point }  rig B { b : Spot }"
    "material M { color = vec3(wide()) }  term wide() per light = light.inner",
]


@pytest.mark.parametrize("text", RIGHT)
def test_what_is_right_in_some_setting_is_right(text: str) -> None:
    assert codes(text) == []


def test_what_is_wrong_in_every_setting_is_told_of_the_best() -> None:
    materials = "material A {}  material B { kd = #fff  color = kd }"
    (found,) = burnish.check(f"{materials}  term t() = kd * missing\n")
    assert "missing" in found.message


def test_a_generic_body_is_shown_with_an_example() -> None:
    (found,) = burnish.check("fn f<T: numbers>(x: T) = x.missing\n")
    assert [label.text for label in found.labels] == ["in `f<float>`, for example"]


def test_a_material_that_is_named_is_compiled_whatever_is_wrong_with_others() -> None:
    text = "material A { color = #fff }  material B { color = missing }"
    (compiled,) = burnish.compile(text, "wgsl", material="A")
    assert compiled.name == "A"
    for material in (None, "B"):
        with pytest.raises(CompileError, match="missing"):
            burnish.compile(text, "wgsl", material=material)
    assert [found.rule.code for found in burnish.check(text)] == ["B0201"]


def test_a_material_that_is_named_is_not_compiled_from_a_file_with_an_error_of_syntax() -> None:
    text = "material A { color = #fff }  material B { color = }"
    with pytest.raises(CompileError, match="expression"):
        burnish.compile(text, "wgsl", material="A")


def test_a_material_that_is_named_does_not_wait_for_others(monkeypatch: pytest.MonkeyPatch) -> None:
    entered: list[str] = []

    def noted(setting: Setting, reached: set[Symbol]) -> Shader | None:
        entered.append(setting.surface.record.name)
        return elaborate(setting, reached)

    monkeypatch.setattr("burnish.compiler.frontend.elaborate", noted)
    monkeypatch.delattr("burnish.compiler.frontend.UnusedDeclarations.check")
    others = "".join(f"material M{i} {{ color = #fff }}\n" for i in range(20))
    burnish.compile(others, "wgsl", material="M7")
    assert entered == ["M7"]


def test_only_what_is_asked_for_has_to_agree_with_the_pass_and_the_rig() -> None:
    text = """
    import std.lights
    abstract material Base {}
    material A : Base { k = 1  alpha = k }
    material B : Base { color = vec3(wide()) }
    term wide() per light = light.inner
    pass P : Forward { color = vec3(material.k) }
    rig R { a : Point }
    rig S { a : Spot }"""
    assert burnish.compile(text, "wgsl", material="A", rig="R", pass_="P")
    for wanted in ({"rig": "R"}, {"pass_": "P"}):
        assert [found.rule.code for found in burnish.check(text, **wanted)] == ["B0201"]


def test_of_imported_files_only_what_is_used_is_checked(tmp_path: Path) -> None:
    offer = tmp_path / "offer.burnish"
    offer.write_text("fn good() = 1.0\nfn bad() = missing\n")
    user = tmp_path / "user.burnish"
    user.write_text('import "offer.burnish"\nmaterial M { alpha = good() }')
    assert burnish.check(user) == ()
    assert [found.rule.code for found in burnish.check(offer)] == ["B0201"]


@pytest.mark.parametrize("path", files_of(LIBRARY), ids=lambda path: import_path(path, LIBRARY))
def test_the_library(path: Path) -> None:
    if path.name != STANDS_FOR_BUILTINS:
        assert burnish.check(path) == ()
