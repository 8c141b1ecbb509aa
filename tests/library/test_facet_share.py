"""The share of even light that facets of GGX mirror, against integrals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .many import numbers, singles, values
from .truth import truth

MODULE = "std.microfacets"
NV, WIDTH = numbers(0.02, 1, 1), numbers(0.05, 1, 4)


def mirrored_once(cosine: float, width: float) -> Any:
    """The share of even light that facets mirror where none is absorbed, and the part of it that
    Schlick's power weighs: means over the facets that are seen (Dupuy and Benyoub 2023), of which
    others hide some from the light.
    """
    u, v = np.meshgrid(*[(np.arange(200) + 0.5) / 200] * 2)
    eye = np.array([np.sqrt(1 - cosine**2), 0, cosine])
    stretched = eye * (width, width, 1) / np.linalg.norm(eye * (width, width, 1))
    height = (1 - v) * (1 + stretched[2]) - stretched[2]
    ring = np.sqrt(1 - height**2)
    cap = (
        np.stack([ring * np.cos(2 * np.pi * u), ring * np.sin(2 * np.pi * u), height], -1)
        + stretched
    )
    half = cap * (width, width, 1)
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    lit = 2 * (half @ eye) * half[..., 2] - cosine

    def hidden(z: Any) -> Any:
        return (np.sqrt(1 + width**2 * (1 / z**2 - 1)) - 1) / 2

    seen = (1 + hidden(cosine)) / (1 + hidden(cosine) + hidden(np.maximum(lit, 1e-9)))
    seen = np.where(lit > 0, seen, 0)
    return seen.mean(), (seen * (1 - half @ eye) ** 5).mean()


@truth("std.microfacets.ggx_share", "std.microfacets.ggx_lost", "std.microfacets.powers")
def test_the_share_that_facets_mirror() -> None:
    """Integrals, from smooth to rough and from flat to upright."""
    cosines, roughness = np.meshgrid((0.02, 0.1, 0.3, 0.6, 1.0), (0.05, 0.12, 0.3, 0.6, 1.0))
    nv, width = singles(cosines.ravel()), singles(roughness.ravel() ** 2)
    found = values(MODULE, "ggx_share(nv, w)", "vec2", nv=nv, w=width)
    wanted = np.array([mirrored_once(*pair) for pair in zip(nv, width, strict=True)])
    assert found.sum(axis=1) == pytest.approx(wanted[:, 0], abs=0.01)
    assert found[:, 1] == pytest.approx(wanted[:, 1], abs=0.01)


@truth("std.microfacets.ggx_share", "std.microfacets.ggx_lost", "std.microfacets.powers")
def test_the_polynomials_of_the_share() -> None:
    """Each coefficient as it was fitted: small changes hide in what the integrals may be off."""
    flat = WIDTH / (WIDTH + NV)
    lost = sum(flat ** (i + 1) * np.polynomial.Polynomial(row)(WIDTH) for i, row in enumerate(LOST))
    rough = WIDTH**1.75 / (WIDTH + 0.7 * NV)
    level, tilt = (np.polynomial.Polynomial(row)(rough) for row in MIRROR)
    grazing = (1 - lost) * (1 - np.clip(level + tilt * NV, 0, 1)) ** 5
    wanted = np.stack([1 - lost - grazing, grazing], axis=1)
    found = values(MODULE, "ggx_share(nv, w)", "vec2", nv=NV, w=WIDTH)
    assert np.allclose(found, wanted, rtol=1e-5, atol=1e-7)


LOST = (
    (-0.0560996, -0.878457, 11.3874, -3.45921), (2.03451, 2.68522, -32.7055, 7.94792),
    (-3.95428, -2.58895, 35.7408, -6.85255), (1.98282, 0.769233, -14.4162, 2.3766),
)  # fmt: skip
MIRROR = ((-0.000887, 1.176, -1.261, 0.5568), (0.9911, -1.844, 3.602, -2.632))


@truth("std.microfacets.ggx_share")
def test_a_mirror_loses_nothing() -> None:
    """Nor does it mirror more than all, where the polynomials would."""
    cosines = singles(np.linspace(0.01, 1, 12))
    found = values(MODULE, "ggx_share(nv, w)", "vec2", nv=cosines, w=0 * cosines)
    assert found.sum(axis=1) == pytest.approx(np.ones(12), abs=1e-7)
    assert found[:, 1] == pytest.approx((1 - cosines) ** 5, abs=0.01)
    whole = values(MODULE, "ggx_share(nv, w)", "vec2", nv=[0.99, 0.9], w=[0.002, 0.002])
    assert whole.sum(axis=1).max() <= 1
