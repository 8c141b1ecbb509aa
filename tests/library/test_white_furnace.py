"""Laws that reflectances obey: light and eye may be exchanged, and no surface sends out more than
what arrives (the white furnace).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from .many import albedo, directions, dots, singles, values
from .truth import truth

MODULE = "std.reflectances\nimport std.microfacets"
WHITE, UP = "vec3(1)", "vec3(0, 0, 1)"
SIDES = f"{UP}, to_light, to_eye"

REFLECTANCES = {
    "oren_nayar_reflectance": f"oren_nayar_reflectance({WHITE}, 0.5, {SIDES}).x",
    "fujii_reflectance": f"fujii_reflectance({WHITE}, 0.8, {SIDES}).x",
    "eon_reflectance": f"eon_reflectance({WHITE}, 0.8, {SIDES}).x",
    "burley_reflectance": f"burley_reflectance({WHITE}, 0.3, {SIDES}).x",
    "frostbite_reflectance": f"frostbite_reflectance({WHITE}, 0.9, {SIDES}).x",
    "subsurface_reflectance": f"subsurface_reflectance({WHITE}, 0.5, {SIDES}).x",
    "minnaert_reflectance": f"minnaert_reflectance({WHITE}, 1.5, {SIDES}).x",
    "coat_reflectance": f"coat_reflectance(0.3, {SIDES})",
}
FACETS = {
    "ggx_reflectance": f"ggx_reflectance({WHITE}, 0.4, {SIDES}).x",
    "beckmann_reflectance": f"beckmann_reflectance({WHITE}, 0.4, {SIDES}).x",
    "ward_reflectance": "ward_reflectance(vec2(0.3, 0.6), to_light, to_eye)",
    "ashikhmin_reflectance": f"ashikhmin_reflectance({WHITE}, vec2(8, 40), to_light, to_eye).x",
    "ashikhmin_matt": f"ashikhmin_matt({WHITE}, {WHITE} * 0.04, to_light.z, to_eye.z).x",
    "sheen_reflectance": f"sheen_reflectance({WHITE}, 0.5, {SIDES}).x",
}
BRIGHT = {"burley_reflectance": 1.02, "subsurface_reflectance": 1.35}
"""Those that are known to send out more, and by how much at most where they are tried."""


def of_all(test: Callable[[str], None]) -> Callable[[str], None]:
    """A test of all reflectances, each of which it knows something about."""
    names = [f"std.reflectances.{name}" for name in REFLECTANCES]
    names += [f"std.microfacets.{name}" for name in FACETS]
    every = pytest.mark.parametrize("name", [*REFLECTANCES, *FACETS])
    return truth(*names)(every(test))


@of_all
def test_light_and_eye_may_be_exchanged(name: str) -> None:
    one, other = directions(1, above=True), directions(2, above=True)
    call = (REFLECTANCES | FACETS)[name]
    there = values(MODULE, call, to_light=one, to_eye=other)
    assert np.allclose(there, values(MODULE, call, to_light=other, to_eye=one), rtol=1e-6)
    assert there.min() >= 0 and there.max() > 0.003


@of_all
def test_no_surface_sends_out_more_than_what_arrives(name: str) -> None:
    call = (REFLECTANCES | FACETS)[name]
    found = [albedo(MODULE, call, cosine) for cosine in (1.0, 0.7, 0.4, 0.15)]
    assert max(found) <= BRIGHT.get(name, 1 + 1e-3)


@truth("std.microfacets.light_to_half")
def test_light_and_eye_are_as_far_from_the_middle() -> None:
    """Half of the angle between both."""
    light, eye = directions(9), directions(10)
    found = values(MODULE, "light_to_half(l, normalize(l + e))", l=light, e=eye)
    assert np.allclose(found, np.cos(np.arccos(dots(light, eye)) / 2), rtol=1e-5)


@truth("std.reflectances.eon_reflectance")
@pytest.mark.parametrize("roughness", [0, 0.3, 1])
def test_a_white_rough_surface_loses_nothing(roughness: float) -> None:
    call = f"eon_reflectance({WHITE}, {roughness}, {SIDES}).x"
    for cosine in (1.0, 0.6, 0.2):
        assert albedo(MODULE, call, cosine) == pytest.approx(1, abs=1e-3)


@truth("std.reflectances.minnaert_reflectance", "std.reflectances.fujii_reflectance")
def test_lamberts_surface_is_among_them() -> None:
    """Without darkness at the edge, and without roughness."""
    given: dict[str, Any] = {
        "to_light": directions(3, above=True), "to_eye": directions(4, above=True)
    }  # fmt: skip
    for call in (
        f"minnaert_reflectance({WHITE}, 1, {SIDES})", f"eon_reflectance({WHITE}, 0, {SIDES})",
        f"oren_nayar_reflectance({WHITE}, 0, {SIDES})", f"fujii_reflectance({WHITE}, 0, {SIDES})",
    ):  # fmt: skip
        assert np.allclose(values(MODULE, f"{call}.x", **given), 1 / np.pi, rtol=1e-6), call


@truth(
    "std.microfacets.ggx", "std.microfacets.beckmann", "std.microfacets.ggx_lambda",
    "std.microfacets.beckmann_lambda", "std.microfacets.ggx_visibility",
    "std.microfacets.ggx_reflectance",
)  # fmt: skip
@pytest.mark.parametrize(
    ("stretched", "round_one"),
    [
        ("ggx(to_eye, vec2(0.4))", "ggx(to_eye.z, 0.4)"),
        ("beckmann(to_eye, vec2(0.4))", "beckmann(to_eye.z, 0.4)"),
        ("ggx_lambda(to_eye, vec2(0.4))", "ggx_lambda(to_eye.z, 0.4)"),
        ("beckmann_lambda(to_eye, vec2(0.4))", "beckmann_lambda(to_eye.z, 0.4)"),
        (
            "ggx_visibility(to_light, to_eye, vec2(0.4))",
            "ggx_visibility(to_light.z, to_eye.z, 0.4)",
        ),
        (
            f"ggx_reflectance({WHITE}, vec2(0.4), to_light, to_eye).x",
            f"ggx_reflectance({WHITE}, 0.4, {SIDES}).x",
        ),
    ],
)
def test_equal_widths_are_one_width(stretched: str, round_one: str) -> None:
    given = {"to_light": directions(5, above=True), "to_eye": directions(6, above=True)}
    wanted = values(MODULE, round_one, **given)
    assert np.allclose(values(MODULE, stretched, **given), wanted, rtol=1e-5)


@truth("std.microfacets.ggx_reflectance", "std.microfacets.ward_reflectance",
       "std.microfacets.ashikhmin_reflectance")  # fmt: skip
@pytest.mark.parametrize(
    "call", ["ggx_reflectance(vec3(1), {}, to_light, to_eye).x",
             "ward_reflectance({}, to_light, to_eye)",
             "ashikhmin_reflectance(vec3(1), 30 * {}, to_light, to_eye).x"],
)  # fmt: skip
def test_mirrored_and_turned_surfaces(call: str) -> None:
    """Mirrored along u nothing changes; turned by a right angle both widths change places."""
    light, eye = directions(7, above=True), directions(8, above=True)

    def found(widths: str, *turned: Any) -> Any:
        light, eye = (singles(each) for each in turned)
        return values(MODULE, call.format(widths), to_light=light, to_eye=eye)

    there, mirror = found("vec2(0.3, 0.7)", light, eye), np.array((-1, 1, 1))
    assert np.allclose(there, found("vec2(0.3, 0.7)", light * mirror, eye * mirror), rtol=1e-6)
    turned = found("vec2(0.7, 0.3)", light[:, [1, 0, 2]], eye[:, [1, 0, 2]])
    assert np.allclose(there, turned, rtol=1e-6)
