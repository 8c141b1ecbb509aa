"""The share of light that smooth surfaces mirror, against optics with complex numbers."""

from __future__ import annotations

import numpy as np
import pytest

from .many import Array, numbers, values
from .truth import truth

MODULE = "std.microfacets"
COSINES = numbers(0.02, 1, 1)
SHARES, TINTS = numbers(0, 0.95, 2, 3), numbers(0, 1, 3, 3)


def wide(lanes: Array) -> Array:
    """Numbers beside vectors."""
    return np.asarray(lanes[:, None])


def after_schlick(f0: Array, f90: Array | float, cosine: Array | float) -> Array:
    return np.asarray(f0 * (1 - (1 - cosine) ** 5) + f90 * (1 - cosine) ** 5)


@truth("std.microfacets.schlick")
def test_schlick() -> None:
    given = {"f0": SHARES, "f90": TINTS, "lh": COSINES}
    found = values(MODULE, "schlick(f0, lh)", "vec3", **given)
    assert np.allclose(found, after_schlick(SHARES, 1, wide(COSINES)), rtol=1e-9)
    found = values(MODULE, "schlick(f0, f90, lh)", "vec3", **given)
    assert np.allclose(found, after_schlick(SHARES, TINTS, wide(COSINES)), rtol=1e-9)
    assert values(MODULE, "schlick(0.04, lh)", lh=[1.0, 0.0]) == pytest.approx([0.04, 1])


@truth("std.microfacets.schlick_f82")
def test_a_tinted_edge() -> None:
    """Schlick's share, less a multiple of c (1 - c)^6, so that it is tinted at a cosine of 1/7."""
    cosine, edge = wide(COSINES), 1 / 7
    factor = after_schlick(SHARES, 1, edge) * (1 - TINTS) / (edge * (1 - edge) ** 6)
    wanted = after_schlick(SHARES, 1, cosine) - factor * cosine * (1 - cosine) ** 6
    found = values(MODULE, "schlick_f82(f0, tint, lh)", "vec3", f0=SHARES, tint=TINTS, lh=COSINES)
    assert np.allclose(found, wanted, rtol=1e-9)
    found = values(MODULE, "schlick_f82(f0, tint, 1.0 / 7)", "vec3", f0=SHARES, tint=TINTS)
    assert np.allclose(found, TINTS * after_schlick(SHARES, 1, edge), rtol=1e-9)


@truth("std.microfacets.dielectric", "std.microfacets.change")
def test_clear_media() -> None:
    """Fresnel's sines and tangents; beyond the critical angle everything is mirrored."""
    ior = numbers(0.4, 2.6, 4)
    outside = np.arccos(COSINES)
    sine = np.sin(outside) / ior
    inside = np.arcsin(np.minimum(sine, 1))
    upright = (np.sin(outside - inside) / np.sin(outside + inside)) ** 2
    lying = (np.tan(outside - inside) / np.tan(outside + inside)) ** 2
    wanted = np.where(sine < 1, (upright + lying) / 2, 1)
    assert (sine >= 1).sum() == 5
    assert np.allclose(
        values(MODULE, "dielectric(ior, lh)", ior=ior, lh=COSINES), wanted, rtol=1e-7
    )


@truth("std.microfacets.dielectric", "std.microfacets.f0_of_ior", "std.microfacets.change")
def test_glass_mirrors_four_percent() -> None:
    found = values(
        MODULE, "vec3(dielectric(1.5, x), f0_of_ior(1.5), f0_of_ior(1.333))", "vec3", x=1.0
    )
    assert found[0] == pytest.approx([0.04, 0.04, 0.0204], abs=1e-4)


@truth("std.microfacets.ior_of_f0", "std.microfacets.f0_of_ior")
def test_indices_and_shares() -> None:
    assert values(MODULE, "ior_of_f0(x)", x=0.04) == pytest.approx([1.5], rel=1e-6)
    ior = numbers(1, 3, 5)
    assert np.allclose(values(MODULE, "ior_of_f0(f0_of_ior(x))", x=ior), ior, rtol=1e-9)


def of_metal(index: Array, extinction: Array, cosine: Array) -> Array:
    """Fresnel's amplitudes with a complex index."""
    m = index + 1j * extinction
    inside = np.sqrt(1 - (1 - cosine**2) / m**2)
    upright = (cosine - m * inside) / (cosine + m * inside)
    lying = (m * cosine - inside) / (m * cosine + inside)
    return np.asarray((np.abs(upright) ** 2 + np.abs(lying) ** 2) / 2)


INDICES, EXTINCTIONS = numbers(0.1, 3, 6, 3), numbers(0, 5, 7, 3)


@truth("std.microfacets.conductor")
def test_metals() -> None:
    found = values(MODULE, "conductor(n, k, lh)", "vec3", n=INDICES, k=EXTINCTIONS, lh=COSINES)
    assert np.allclose(found, of_metal(INDICES, EXTINCTIONS, wide(COSINES)), rtol=1e-9)


@truth("std.microfacets.conductor", "std.microfacets.lazanyi")
@pytest.mark.parametrize("function", ["conductor", "lazanyi"])
def test_gold_is_yellow(function: str) -> None:
    """The index of P. Johnson and R. Christy, "Optical Constants of the Noble Metals", 1972, and
    the colour of N. Hoffman's table in "Physics and Math of Shading", 2013, within the gamut.
    """
    gold = {"n": [[0.143, 0.375, 1.442]], "k": [[3.983, 2.386, 1.603]]}
    found = values(MODULE, f"{function}(n, k, 1)", "vec3", **gold)
    assert found[0] == pytest.approx([1, 0.766, 0.336], abs=0.08)
    assert np.allclose(values(MODULE, f"{function}(n, k, 0)", "vec3", **gold), 1)


@truth("std.microfacets.lazanyi")
def test_metals_after_lazanyi() -> None:
    """Schlick's form between the share at a right angle and 1."""
    f0 = ((INDICES - 1) ** 2 + EXTINCTIONS**2) / ((INDICES + 1) ** 2 + EXTINCTIONS**2)
    found = values(MODULE, "lazanyi(n, k, lh)", "vec3", n=INDICES, k=EXTINCTIONS, lh=COSINES)
    assert np.allclose(found, after_schlick(f0, 1, wide(COSINES)), rtol=1e-9)


@truth("std.microfacets.metal_index", "std.microfacets.metal_extinction")
def test_metals_by_their_colours() -> None:
    """The index lies between its bounds, and the extinction gives the colour, as Fresnel says."""
    index = values(MODULE, "metal_index(f0, tint)", "vec3", f0=SHARES, tint=TINTS)
    root = np.sqrt(SHARES)
    low, high = (1 - SHARES) / (1 + SHARES), (1 + root) / (1 - root)
    assert np.allclose(index, high + TINTS * (low - high), rtol=1e-9)
    given = {"f0": SHARES, "n": index}
    extinction = values(MODULE, "metal_extinction(f0, n)", "vec3", **given)
    assert np.allclose(of_metal(index, extinction, np.ones((1, 1))), SHARES, atol=1e-6)


def of_film(film: Array, ior: Array, thickness: Array, length: Array, cosine: Array) -> Array:
    """The share that a film mirrors, by matrices that take the fields from border to border."""
    above, below = np.sqrt(1 - (1 - cosine**2) / film**2), np.sqrt(1 - (1 - cosine**2) / ior**2)
    phase = 2 * np.pi * film * thickness * above / length
    shares = []
    for air, inner, outer in (
        (cosine, film * above, ior * below), (1 / cosine, film / above, ior / below)
    ):  # fmt: skip
        electric = np.cos(phase) - 1j * np.sin(phase) * outer / inner
        magnetic = -1j * inner * np.sin(phase) + np.cos(phase) * outer
        shares.append(np.abs((air * electric - magnetic) / (air * electric + magnetic)) ** 2)
    return np.asarray(sum(shares) / 2)


@truth("std.microfacets.thin_film", "std.microfacets.interference", "std.microfacets.change")
def test_thin_films() -> None:
    """M. Born and E. Wolf, section 1.6: the characteristic matrix of a film."""
    film, ior, thickness = numbers(1.1, 2.2, 8), numbers(1, 2.5, 9), numbers(50, 900, 10)
    lengths = np.array([[650.0, 532.0, 450.0]])
    found = values(
        MODULE, "thin_film(film, ior, thickness, lengths, lh)", "vec3", film=film, ior=ior,
        thickness=thickness, lengths=lengths, lh=COSINES,
    )  # fmt: skip
    wanted = of_film(wide(film), wide(ior), wide(thickness), lengths, wide(COSINES))
    assert np.allclose(found, wanted, rtol=1e-7)


@truth("std.microfacets.thin_film")
def test_a_film_as_thick_as_nothing_is_not_seen() -> None:
    found = values(MODULE, "thin_film(1.3, 1.7, 0, vec3(1, 2, 3), lh)", "vec3", lh=COSINES)
    wanted = values(MODULE, "dielectric(1.7, lh)", lh=COSINES)
    assert np.allclose(found, wide(wanted), rtol=1e-9)
