"""Films in colours, against the formulas of glTF's ``KHR_materials_iridescence``, and waves."""

from __future__ import annotations

import numpy as np

from .many import Array, numbers, singles, values
from .truth import truth

MODULE = "std.iridescence"
COSINES = numbers(0.05, 1, 1)
F0 = numbers(0.01, 0.95, 2, 3)
FILMS, THICKNESS = numbers(1.05, 2.4, 3), numbers(0, 900, 4)
XYZ_TO_REC709 = np.array(
    [[3.2404542, -1.5371385, -0.4985314], [-0.969266, 1.8760108, 0.041556],
     [0.0556434, -0.2040259, 1.0572252]]
)  # fmt: skip


def sensitivity(way: Array, shift: Array) -> Array:
    """`evalSensitivity` of the extension's appendix, in metres."""
    phase = (2 * np.pi * way * 1e-9)[:, None]
    val = np.array((5.4856e-13, 4.4201e-13, 5.2481e-13))
    pos = np.array((1.6810e06, 1.7953e06, 2.2084e06))
    var = np.array((4.3278e09, 9.3046e09, 6.6121e09))
    xyz = val * np.sqrt(2 * np.pi * var) * np.cos(pos * phase + shift) * np.exp(-(phase**2) * var)
    xyz[:, 0] += (
        9.7470e-14 * np.sqrt(2 * np.pi * 4.5282e09)
        * np.cos(2.2399e06 * phase[:, 0] + shift[:, 0]) * np.exp(-4.5282e09 * phase[:, 0] ** 2)
    )  # fmt: skip
    return np.asarray((xyz / 1.0685e-7) @ XYZ_TO_REC709.T)


def iridescence(f0: Array, film: Array, thickness: Array, cosine: Array) -> Array:
    """`evalIridescence` of the appendix, in air."""
    x = np.clip(thickness / 30, 0, 1)
    eta = 1 + (film - 1) * x * x * (3 - 2 * x)
    inside = np.sqrt(1 - (1 - cosine**2) / eta**2)
    r0 = ((eta - 1) / (eta + 1)) ** 2
    r12 = (r0 + (1 - r0) * (1 - cosine) ** 5)[:, None]
    t121 = 1 - r12
    root = np.sqrt(np.clip(f0, 0, 0.9999))
    base = (1 + root) / (1 - root)
    r1 = ((base - eta[:, None]) / (base + eta[:, None])) ** 2
    r23 = r1 + (1 - r1) * (1 - inside[:, None]) ** 5
    phi = np.pi + np.where(base < eta[:, None], np.pi, 0)
    way = 2 * eta * thickness * inside
    r123 = np.clip(r12 * r23, 1e-5, 0.9999)
    rs = t121**2 * r23 / (1 - r123)
    found, factor = r12 + rs, rs - t121
    for m in (1, 2):
        factor = factor * np.sqrt(r123)
        found = found + factor * 2 * sensitivity(m * way, m * phi)
    return np.asarray(np.maximum(found, 0))


def film(f0: Array, film: Array, thickness: Array, cosine: Array) -> Array:
    """The library's share for many films."""
    call = "vec3(iridescent_fresnel(rgb(f0.x, f0.y, f0.z), film, thickness, lh))"
    return values(MODULE, call, "vec3", f0=f0, film=film, thickness=thickness, lh=cosine)


@truth("std.iridescence.iridescent_fresnel")
def test_films_are_those_of_gltf() -> None:
    found = film(F0, FILMS, THICKNESS, COSINES)
    assert np.allclose(found, iridescence(F0, FILMS, THICKNESS, COSINES), rtol=1e-5, atol=1e-7)
    assert np.ptp(found, axis=1).max() > 0.3


@truth("std.iridescence.iridescent_fresnel")
def test_films_at_their_limits() -> None:
    """Nearly all is mirrored at a grazing angle; a film that is thick, thin, or on a mirror."""
    cosine, index = np.array([1.0, 0.4, 0.02, 0.0]), np.array([1.3, 1.8, 1.5, 1.4])
    f0 = np.array([[1, 0.999, 0.9999], [0.04, 1, 1], [0.9, 1, 0.04], [0.3, 0.5, 0.7]])
    for thickness in (0.0, 15.0, 30.0, 31.0, 5000.0):
        thick = np.full(4, thickness)
        found = film(f0, index, thick, cosine)
        wanted = iridescence(singles(f0), singles(index), thick, singles(cosine))
        assert np.allclose(found, wanted, rtol=1e-5, atol=1e-7)
    assert np.allclose(found[3], 1, atol=2e-4)


@truth("std.iridescence.film_colors", "std.iridescence.bells", "std.iridescence.rec709_of_xyz")
def test_colours_of_waves() -> None:
    way, turn = numbers(0, 3000, 5), numbers(0, 6, 6, 3)
    found = values(MODULE, "film_colors(way, turn)", "vec3", way=way, turn=turn)
    assert np.allclose(found, 2 * sensitivity(way, turn), rtol=1e-5, atol=1e-7)


@truth("std.iridescence.film_colors")
def test_a_wave_without_a_way_is_white() -> None:
    """All colours are in step: the matrix has sRGB's white, seen by a light of equal energy."""
    found = values(MODULE, "film_colors(0 * x, vec3(0))", "vec3", x=[1.0])
    assert np.allclose(found / 2, [[1.205, 0.948, 0.909]], atol=0.01)
