"""Every example under each of its rigs and passes, on every route, against the reference."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.api import entry_points as api
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse
from burnish.targets.conformance.cases import ELEMENT_CASES, IMAGE_CASES, SIZE
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from ..examples.kit import EXAMPLES, VARIANTS, Variant
from .kit import PROFILES, Studio, keeping_the_last

HALF = (51, 40)
"""Half as many pixels as ``burnish conform`` draws, since the reference takes most of the time."""
WHOLE = {"normals", "particles", "threads"}
"""Examples that are drawn in its usual size: in half of the pixels, some picture proves little."""
LEAST_COVERED = 0.1
"""The least share of the pixels of all cases together that an object covers."""
LEAST_CASES = 4
"""The least number of cases of a material."""
KERNELS_CASES = (IMAGE_CASES, ELEMENT_CASES)
"""The numbers of cases of a kernel over images, and of one over buffers."""

Key = tuple[Variant, str, str]
"""A variant, a material and a route."""


@cache
def _materials(path: Path) -> tuple[str, ...]:
    """The materials and kernels of a file, which is parsed once for all its variants."""
    text, kinds = path.read_text("utf-8"), ("material", "kernel")
    return tuple(
        declared.name.text
        for declared in parse(Source(path.name, text), Report()).declarations
        if isinstance(declared, ast.Record) and declared.kind in kinds and not declared.abstract
    )


ROUGH_SINES = {"swiftshader", "webgpu", "webgl2"}
"""Drivers on SwiftShader, whose sines are off by up to 2e-4; 2^-11 is allowed."""
HANGS_ON_SINES = {"mixins"}
"""Examples whose vertices are where a sine is: it hangs on the sine's error which side of an edge
many pixels are on."""

CROWDED = {"particles"}
"""Examples of many small triangles, one before the other: WebGL 2 tells so little of how it rounds
that which of them is seen is undecided at most pixels."""

CASES = [
    pytest.param(
        (variant, material, route),
        id=f"{variant}-{material}-{route}",
        # One process draws all of a file, if processes are given groups.
        marks=pytest.mark.xdist_group(variant.path.stem),
    )
    for variant in VARIANTS
    for material in _materials(variant.path)
    for route in ROUTES
]


@pytest.fixture(scope="session")
def rows(studio: Studio) -> Callable[[Path], dict[Key, Row]]:
    """The rows of a run over a file, with all its rigs, passes and materials."""

    @keeping_the_last
    def found(path: Path) -> dict[Key, Row]:
        compiled = [
            (variant, material)
            for variant in VARIANTS
            if variant.path == path
            for material in burnish.compile(
                path, PROFILES, rig=variant.rig, pass_=variant.pass_, partial=True
            )
        ]
        subjects = [(f"{variant}", material) for variant, material in compiled]
        size = SIZE if path.stem in WHOLE else HALF
        routes = list(ROUTES.values())
        rows = conform(subjects, routes, studio.runner, studio.toolchain, size=size)
        keys = [(variant, m.name, route) for variant, m in compiled for route in ROUTES]
        return dict(zip(keys, rows, strict=True))

    return found


@pytest.mark.parametrize("key", CASES)
def test_it_agrees(rows: Callable[[Path], dict[Key, Row]], key: Key) -> None:
    row = rows(key[0].path)[key]
    if ROUTES[key[2]].profile in key[0].lacking(key[1]):
        assert row.status == "not run", row.status
        return
    stem, driver = key[0].path.stem, ROUTES[key[2]].driver
    is_crowded = stem in CROWDED and driver == "webgl2"
    if is_crowded or (stem in HANGS_ON_SINES and driver in ROUGH_SINES):
        assert row.status in {"agrees", "proves little"}, "\n".join(details(row)) or row.status
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.status
    assert row.covered > LEAST_COVERED * sum(r.comparison.pixels for r in row.results)
    assert all(np.isfinite(target).all() for result in row.results for target in result.got)
    cases = {result.case for result in row.results}
    wanted = next((len(names) for names in KERNELS_CASES if cases == {*names}), LEAST_CASES)
    assert len(cases) == len(row.results) >= wanted


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_variants_are_those_of_the_command(path: Path) -> None:
    ours = [(variant.rig, variant.pass_) for variant in VARIANTS if variant.path == path]
    assert sorted(api.variants(path), key=str) == sorted(ours, key=str)
