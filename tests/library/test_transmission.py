"""Light that passes through surfaces, in `std.transmission`, against glTF's specification."""

from __future__ import annotations

import numpy as np
import pytest

from .many import Array, directions, dots, half_sphere, numbers, singles, values
from .surfaces import half_through, through_wall
from .truth import truth

MODULE = "std.transmission"
UP = np.array((0.0, 0.0, 1.0))


@truth("std.transmission.dispersed")
def test_colours_have_indices_of_their_own() -> None:
    """Abbe's number is what the index of green exceeds 1 by over the difference of blue and red,
    as `KHR_materials_dispersion` has it; only half of that lies on each side of green."""
    ior, dispersion = numbers(1.2, 2.5, 1), numbers(0.1, 1.5, 2)
    red, green, blue = values(MODULE, "dispersed(n, d)", "vec3", n=ior, d=dispersion).T
    abbe = 20 / dispersion
    assert np.allclose(blue - red, (ior - 1) / abbe, rtol=1e-5)
    assert np.allclose(green, ior) and np.allclose(green - red, blue - green, rtol=1e-4)
    assert values(MODULE, "dispersed(n, 100.0)", "vec3", n=ior).min() == 1
    assert np.array_equal(
        values(MODULE, "dispersed(n, 0.0)", "vec3", n=ior), np.stack([singles(ior)] * 3, 1)
    )


@truth("std.transmission.seen_along")
def test_ways_are_bent_by_the_law_of_snell() -> None:
    normal, eye, ior = directions(3), directions(4), numbers(1.0, 2.5, 5)
    eye = np.where(dots(normal, eye)[:, None] < 0, -eye, eye)
    found = values(MODULE, "seen_along(n, e, i)", "vec3", n=normal, e=eye, i=ior)
    assert np.allclose(np.linalg.norm(found, axis=1), 1, atol=1e-5)
    assert (dots(found, normal) < 0).all()
    outer, inner = np.cross(normal, -eye), np.cross(normal, found)
    assert np.allclose(outer, ior[:, None] * inner, atol=1e-5)
    straight = values(MODULE, "seen_along(n, e, 1.0)", "vec3", n=normal, e=eye)
    assert np.allclose(straight, -eye, atol=1e-6)


@truth("std.transmission.left_of_light")
def test_a_medium_absorbs_light_by_beers_law() -> None:
    color, distance, way = numbers(0.1, 1, 6, 3), numbers(0.5, 3, 7), numbers(0, 2, 8)
    found = values(MODULE, "left_of_light(rgb(c), d, w)", "vec3", c=color, d=distance, w=way)
    extinction = -np.log(color) / distance[:, None]
    assert np.allclose(found, np.exp(-extinction * way[:, None]), rtol=1e-5)
    endless = values(MODULE, "left_of_light(rgb(c), 0.0, w)", "vec3", c=color, w=way)
    assert (endless == 1).all()
    black = values(MODULE, "left_of_light(rgb(0, 0, 0), d, w + 0.1)", "vec3", d=distance, w=way)
    assert (black == 0).all()


@truth("std.transmission.seen_roughness")
def test_facets_blur_by_the_index() -> None:
    """As those that mirror at the index of glass, and not at all at that of air."""
    found = values(MODULE, "seen_roughness(0.6, n)", n=np.array((1.0, 1.25, 1.5, 2.0, 0.5)))
    assert np.allclose(found, (0, 0.3, 0.6, 0.6, 0))


def sides(seed: int) -> tuple[Array, Array]:
    """Lights behind a wall that faces up, and eyes before it."""
    return directions(seed, above=True) * (1, 1, -1), directions(seed + 1, above=True)


@truth("std.transmission.half_through", "std.transmission.through_reflectance")
@pytest.mark.parametrize("width", [0.05, 0.4, 1.0])
def test_facets_of_a_wall_send_light_through_it(width: float) -> None:
    light, eye = sides(9)
    half = values(MODULE, "half_through(n, l, e)", "vec3", n=UP[None], l=light, e=eye)
    wanted = [half_through(UP, *each) for each in zip(light, eye, strict=True)]
    assert np.allclose(half, wanted, atol=1e-6)
    call = f"through_reflectance(n, l, e, {width})"
    found = values(MODULE, call, n=UP[None], l=light, e=eye)
    sent = [through_wall(UP, *each, width) for each in zip(light, eye, strict=True)]
    assert np.allclose(found, sent, rtol=1e-4)


@truth("std.transmission.through_reflectance")
def test_light_and_eye_may_be_exchanged_through_a_wall() -> None:
    light, eye = sides(11)
    call = "through_reflectance(n, l, e, 0.4)"
    there = values(MODULE, call, n=UP[None], l=light, e=eye)
    back = values(MODULE, call, n=-UP[None], l=eye, e=light)
    assert np.allclose(there, back, rtol=1e-4)


@truth("std.transmission.through_reflectance")
def test_no_more_light_leaves_a_wall_than_what_arrives() -> None:
    """All of it, but for what facets hide."""
    arrows, angles = half_sphere()
    for cosine, least in ((1.0, 0.85), (0.5, 0.75)):
        eye = np.array([(np.sqrt(1 - cosine**2), 0, cosine)])
        call = "through_reflectance(n, l, e, 0.3)"
        found = values(MODULE, call, n=UP[None], l=arrows * (1, 1, -1), e=eye)
        assert least < (found * arrows[:, 2] * angles).sum() < 1
