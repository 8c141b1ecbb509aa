"""Every route that has kernels writes what the reference computes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import burnish
from burnish.compiler.documents.values import ResultRow
from burnish.compiler.ir.node import Graph
from burnish.compiler.ir.types import BOOL
from burnish.support.frozen import changed
from burnish.targets.conformance.cases import series_of
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.emit import stage
from burnish.targets.runner import kernels as running
from burnish.targets.runner.drivers.draws import Dispatch, Sides
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.routes import ROUTES

from ..targets.standings import routes
from .kit import Studio, all_of

FILE = Path(__file__).with_name("kernels.burnish")
ROUTES_WITHOUT = routes("absent", "kernels over buffers")
NAMES = ("Structures", "Numbers", "Vectors", "Sums", "Fixed", "Scattered", "Bits")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", ROUTES)
def test_it_agrees(studio: Studio, route: str, name: str) -> None:
    row = studio.judged(route, name, all_of(FILE)[name])
    if route in ROUTES_WITHOUT:
        assert row.status == "not run"
        assert "has no compute stage" in row.problem
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.covered > 100 or name == "Structures"


def test_all_kernels_are_run() -> None:
    assert {kernel.name for kernel in all_of(FILE)} == set(NAMES)


# --- planted errors ------------------------------------------------------------------------------


def _without_values(instance: Instance) -> Dispatch:
    made = DISPATCH(instance)
    return replace(made, blocks=tuple(bytes(len(block)) for block in made.blocks))


def _empty_before(instance: Instance) -> Dispatch:
    made = DISPATCH(instance)
    return replace(made, buffers=tuple(bytes(len(data)) for data in made.buffers))


def _zeroed(row: ResultRow, count: int) -> bytes:
    return bytes(max(count, 1) * row.stride)


def _one_group_less(instance: Instance) -> Dispatch:
    made = DISPATCH(instance)
    return replace(made, extent=(made.extent[0] - GROUP, 1, 1))


def _half_the_groups(dispatch: Dispatch, work_group: Sides) -> Sides:
    x, y, z = work_group
    return GROUPS(dispatch, (2 * x, y, z))


def _first_column(self: Any, expressions: Any, store: Any, value: Any) -> Any:
    return STORE(self, expressions, burnish.support.frozen.changed(store, offset=0), value)


def _joined_as(**others: Any) -> Any:
    """Scatters something else than the program says."""

    def scattered(self: Any, expressions: Any, each: Any) -> Any:
        store = changed(each.store, operator=others.get("operator", each.store.operator))
        place = each.value if others.get("place") else each.place
        always = changed(each, store=store, place=place)
        if others.get("always"):
            always = changed(always, condition=Graph().node("constant", BOOL, (), True))
        return SCATTER(self, expressions, always)

    return scattered


def _last_is_left_out(self: Any, expressions: Any, extent: Any) -> str:
    text: str = GUARD(self, expressions, extent)
    return text.replace("index >=", "index + 1 >=")


GROUP = 64
"""The invocations in a work group of ``Fixed``."""
DISPATCH, GROUPS = running.dispatch_of, Dispatch.groups
STORE = stage.StagePrinter._store
SCATTER, GUARD = stage.StagePrinter._scattered, stage.StagePrinter._guard
PRINTER = "burnish.targets.emit.stage.StagePrinter."
JOBS = "burnish.targets.runner.frames.by_route."
DRAWS = "burnish.targets.runner.drivers.draws."
REFERENCE = "burnish.compiler.reference.scattering."
PLANTED: Mapping[str, tuple[str, str, Any]] = {
    "blocks without values": ("Structures", JOBS + "dispatch_of", _without_values),
    "buffers without contents": ("Vectors", JOBS + "dispatch_of", _empty_before),
    "one work group less": ("Fixed", JOBS + "dispatch_of", _one_group_less),
    "half the work groups": ("Fixed", DRAWS + "Dispatch.groups", _half_the_groups),
    "columns in one place": ("Vectors", PRINTER + "_store", _first_column),
    "the last element is left out": ("Fixed", PRINTER + "_guard", _last_is_left_out),
    "elements begin with zeros": ("Bits", "burnish.targets.runner.kernels._before", _zeroed),
    "all is added": ("Bits", PRINTER + "_scattered", _joined_as(operator="add")),
    "min instead of all others": ("Scattered", PRINTER + "_scattered", _joined_as(operator="min")),
    "no condition": ("Inside", PRINTER + "_scattered", _joined_as(always=True)),
    "the value as its place": ("Inside", PRINTER + "_scattered", _joined_as(place=True)),
    "the reference begins with zeros": ("Bits", REFERENCE + "neutral", lambda *_, **__: 0),
    "sums without an end": ("Scattered", REFERENCE + "_wrapped", lambda values, **_: values),
}
"""Deliberate mistakes: the kernel that shows each, what is replaced, and by what."""

INSIDE = """
kernel Inside {
    runs over 100
    scatter few : int[128] add index mod 7 at index where index mod 3 == 0
}
"""


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_error_is_noticed(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    shows, where, wrong = PLANTED[name]
    monkeypatch.setattr(where, wrong)
    source: str | Path = INSIDE if shows == "Inside" else FILE
    kernel = burnish.compile(source, ("glsl:vulkan",), material=shows)[shows]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "differs", row.problem


def test_without_a_planted_error_all_agrees(studio: Studio) -> None:
    kernel = burnish.compile(INSIDE, ("glsl:vulkan",))["Inside"]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "agrees"


CANCELLED = """
kernel Cancelled { result steps : int[200] = int(float(index) / 7 * 7) }
"""
"""A kernel whose text does not compute the division, whose rounding tips some elements."""


def test_what_tips_in_double_precision_is_no_change_of_the_meaning(studio: Studio) -> None:
    kernel = burnish.compile(CANCELLED, ("glsl:vulkan",))["Cancelled"]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem


def test_some_case_of_a_kernel_has_elements() -> None:
    """A name may draw no element in all cases that allow for none."""
    for name in "abcdefgh":
        text = f"kernel K {{ buffer {name} : float[]  result r : float[{name}.count] = 1 }}"
        kernel = burnish.compile(text, ("glsl:vulkan",))["K"]
        (series,) = series_of(kernel.reflection)
        sizes = [case.state.instance.extent() for case in series.cases]
        assert max(sizes) > 1
