"""Every route that has kernels writes what the reference computes."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest

import burnish
from burnish.targets import registry
from burnish.targets.availability import standings
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.emit import stage
from burnish.targets.runner import kernels as running
from burnish.targets.runner.drivers.draw import Dispatch
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

FILE = Path(__file__).with_name("kernels.burnish")
ROUTES_WITHOUT = {
    name
    for name, route in ROUTES.items()
    if standings(registry.select(route.profile)[1])["kernels over buffers"].kind == "absent"
}
NAMES = ("Structures", "Numbers", "Vectors", "Sums", "Fixed")


@lru_cache(maxsize=1)
def compiled() -> burnish.CompileResult:
    profiles = sorted({route.profile for route in ROUTES.values()})
    return burnish.compile(FILE, profiles, partial=True)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", ROUTES)
def test_it_agrees(studio: Studio, route: str, name: str) -> None:
    kernel = compiled()[name]
    (row,) = conform([(name, kernel)], [ROUTES[route]], studio.runner, studio.toolchain)
    if route in ROUTES_WITHOUT:
        assert row.status == "not run"
        assert "has no compute stage" in row.problem
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.covered > 100 or name == "Structures"


def test_all_kernels_are_run() -> None:
    assert {kernel.name for kernel in compiled()} == set(NAMES)


def _one_less(instance: Instance) -> Dispatch:
    made = running.dispatch_of(instance)
    blocks = tuple(bytes(len(block)) for block in made.blocks)
    return Dispatch(made.extent, blocks, made.textures, made.buffers)


def test_missing_values_are_noticed(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """A planted error in the runtime: blocks without values."""
    monkeypatch.setattr("burnish.targets.conformance.kernels.dispatch_of", _one_less)
    kernel = burnish.compile(FILE, ("glsl:vulkan",), material="Structures")["Structures"]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "differs"


def test_a_wrong_column_is_noticed(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """A planted error in emission: the columns of a matrix in one place."""
    stored: Any = stage.StagePrinter._store

    def first(self: Any, expressions: Any, store: Any, value: Any) -> Any:
        return stored(self, expressions, burnish.frozen.changed(store, offset=0), value)

    monkeypatch.setattr(stage.StagePrinter, "_store", first)
    kernel = burnish.compile(FILE, ("glsl:vulkan",), material="Vectors")["Vectors"]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "differs"
