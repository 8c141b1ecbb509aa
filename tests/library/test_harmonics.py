"""Spherical harmonics against Legendre's polynomials and integrals over the sphere."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import called, directions
from .kit import Floats
from .truth import truth

ALL = "import std.harmonics"
COEFFICIENTS = np.random.default_rng(2).uniform(0, 1, (9, 3))
LIGHT = "[" + ", ".join(f"rgb({r}, {g}, {b})" for r, g, b in COEFFICIENTS) + "]"


def near(expected: Any, within: float = 1e-9) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), abs=within)


def legendre(degree: int, order: int, z: Floats) -> Floats:
    """The associated polynomial, as the derivative of a power, without Condon and Shortley's sign.

    It is divided by sin(theta) to the power of the order.
    """
    power = np.polynomial.Polynomial([-1.0, 0, 1]) ** degree
    derivative = power.deriv(degree + order)
    return np.asarray(derivative(z) / (2**degree * math.factorial(degree)), np.float64)


def harmonic(degree: int, order: int, d: Floats) -> Floats:
    """A real harmonic: the polynomial times the cosine or the sine of turns around z."""
    x, y, z = d.T
    m = abs(order)
    around = (x + 1j * y) ** m
    scale = math.sqrt(
        (2 * degree + 1) / (4 * math.pi) * math.factorial(degree - m) / math.factorial(degree + m)
    )
    turns = around.real if order >= 0 else around.imag
    return np.asarray(scale * (math.sqrt(2) if m else 1) * legendre(degree, m, z) * turns)


@truth("std.harmonics.harmonics", "std.harmonics.cubic_harmonics")
def test_harmonics_are_those_of_legendre() -> None:
    d = directions(50)
    expected = [harmonic(n, m, d) for n in range(4) for m in range(-n, n + 1)]
    found = [called(ALL, f"harmonics(d)[{i}]", 1, d=d) for i in range(9)]
    found += [called(ALL, f"cubic_harmonics(d)[{i}]", 1, d=d) for i in range(7)]
    assert np.array(found) == near(expected)


def sphere() -> tuple[Floats, Floats]:
    """Directions and weights with which integrals of low degrees over the sphere are exact."""
    z, weights = np.polynomial.legendre.leggauss(12)
    turns = 2 * np.pi * np.arange(24) / 24
    height, around = np.meshgrid(z, turns, indexing="ij")
    flat = np.sqrt(1 - height**2)
    d = np.stack([flat * np.cos(around), flat * np.sin(around), height], axis=-1).reshape(-1, 3)
    return d, np.repeat(weights, 24) * 2 * np.pi / 24


@truth("std.harmonics.harmonics", "std.harmonics.cubic_harmonics")
def test_harmonics_are_orthonormal() -> None:
    d, weights = sphere()
    names = [f"harmonics(d)[{i}]" for i in range(9)]
    names += [f"cubic_harmonics(d)[{i}]" for i in range(7)]
    values = np.array([called(ALL, name, 1, d=d) for name in names])
    assert (values * weights) @ values.T == near(np.eye(16))


def bands(d: Floats) -> Floats:
    return np.array([harmonic(n, m, d) for n in range(3) for m in range(-n, n + 1)])


@truth("std.harmonics.radiance", "std.harmonics.projected")
def test_light_is_found_again_by_its_coefficients() -> None:
    d = directions(30)
    found = called(ALL, f"radiance({LIGHT}, d)", 3, d=d)
    assert found == near(bands(d).T @ COEFFICIENTS)
    toward = np.array([[0.48, 0.6, 0.64]])
    for i in range(9):
        found = called(ALL, f"projected(rgb(1, 2, 3), d)[{i}]", 3, d=toward)
        assert found == near(bands(toward)[i][:, None] * [1, 2, 3])


@truth("std.harmonics.irradiance", "std.harmonics.cosine_convolved")
def test_irradiance_is_an_integral_over_what_lies_before() -> None:
    """Gauss and Legendre over the half sphere around a normal, on which the cosine is no crease."""
    normal = np.array([0.48, 0.6, 0.64])
    z, weights = np.polynomial.legendre.leggauss(12)
    z, weights = (z + 1) / 2, weights / 2
    turns = 2 * np.pi * np.arange(24) / 24
    right = np.cross(normal, (1, 0, 0))
    right /= np.linalg.norm(right)
    total = np.zeros(3)
    for cosine, weight in zip(z, weights, strict=True):
        flat = math.sqrt(1 - cosine**2)
        ring = np.outer(np.cos(turns), right) + np.outer(np.sin(turns), np.cross(normal, right))
        light = bands(cosine * normal + flat * ring).T @ COEFFICIENTS
        total += cosine * weight * 2 * np.pi * light.mean(axis=0)
    found = called(ALL, f"irradiance({LIGHT}, n)", 3, n=normal[None])
    assert found == near(total[None], 1e-9)


@truth("std.harmonics.irradiance", "std.harmonics.cosine_convolved")
def test_even_light_is_pi_times_as_much_and_none_is_negative() -> None:
    even = "projected(rgb(1, 0.5, 2), vec3(0, 0, 1))"
    # The first coefficient alone: 1 / (4 pi) from everywhere.
    first = f"[{even}[0]" + ", rgb(0, 0, 0)" * 8 + "]"
    found = called(ALL, f"irradiance({first}, n)", 3, n=directions(5))
    assert found == near(np.tile(np.array([1, 0.5, 2]) / 4, (5, 1)))
    # Behind a strong light, the series rings below zero.
    n = np.array([[math.sqrt(0.75), 0, -0.5]])
    assert called(ALL, f"irradiance({even}, n)", 3, n=n) == near([[0, 0, 0]])
