"""Every route that has kernels joins the values of work groups as the reference does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.reference import in_groups
from burnish.stdlib.builtins.row import OfGroup
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.explaining import with_reasons
from burnish.targets.conformance.summary import details
from burnish.targets.emit import group_functions, stage
from burnish.targets.runner.routes import ROUTES

from ..targets.standings import routes
from .kit import Studio, all_of
from .test_kernels import JOBS, _one_group_less

FILE = Path(__file__).with_name("work_groups.burnish")
ROUTES_WITHOUT = routes("absent", "joined work groups")
NAMES = ("Joined", "Before", "Odd", "Alone", "Chosen", "Blocks")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", ROUTES)
def test_it_agrees(studio: Studio, route: str, name: str) -> None:
    row = studio.judged(route, name, all_of(FILE)[name])
    if route in ROUTES_WITHOUT:
        assert row.status == "not run"
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.problem


def test_all_kernels_are_run() -> None:
    assert {kernel.name for kernel in all_of(FILE)} == set(NAMES)


# --- planted errors ------------------------------------------------------------------------------


def _edited(old: str, new: str, method: Callable[..., Any]) -> Callable[..., Any]:
    """A method that makes lines, with a mistake in those that have some words in them."""

    def edited(*given: Any, **named: Any) -> list[str]:
        return [line.replace(old, new) for line in method(*given, **named)]

    return edited


def _nothing(*_: Any, **__: Any) -> list[str]:
    return []


def _always_adds(builtin: str) -> OfGroup | None:
    row = ROW(builtin)
    return row and changed(row, joins="add")


def _unshifted(_self: Any, x: Any, _first: Any) -> Any:
    return x


def _of_all(self: Any, errors: Any, count: int, size: int) -> None:
    """The reference joins as many as a whole group has, also in the last one."""
    INIT(self, errors, count, size)
    self._present = np.full(count, size)


PRINTER = group_functions.GroupFunctions
ROW, INIT = group_functions._row, in_groups.InGroups.__init__
FUNCTIONS = "burnish.targets.emit.group_functions."
REFERENCE = "burnish.compiler.reference.in_groups."
WRITTEN = "burnish.targets.emit.stage.StagePrinter._all_written"
PLANTED: Mapping[str, tuple[str, str, Any]] = {
    "no barrier before values are read": (
        "Joined",
        FUNCTIONS + "GroupFunctions._put",
        _edited("memoryBarrierShared(); barrier();", "", PRINTER._put),
    ),
    "no barrier between two steps": (
        "Before",
        FUNCTIONS + "GroupFunctions._scan",
        _edited("memoryBarrierShared(); barrier();", "", PRINTER._scan),
    ),
    "the wrong neighbour": (
        "Joined",
        FUNCTIONS + "GroupFunctions._all",
        _edited("[place + reach]", "[place + 1u]", PRINTER._all),
    ),
    "half of the group": (
        "Odd",
        FUNCTIONS + "GroupFunctions._all",
        _edited("reach = 32u", "reach = 16u", PRINTER._all),
    ),
    "a scan that reaches too far": (
        "Before",
        FUNCTIONS + "GroupFunctions._scan",
        _edited("place - reach", "place - reach + 1u", PRINTER._scan),
    ),
    "a scan that ends too early": (
        "Before",
        FUNCTIONS + "GroupFunctions._scan",
        _edited("reach < 64u", "reach < 32u", PRINTER._scan),
    ),
    "its own element is before it": ("Before", FUNCTIONS + "GroupFunctions._shifted", _nothing),
    "the last group is taken for a whole one": (
        "Joined",
        FUNCTIONS + "GroupFunctions._all",
        _edited("< present", "< 64u", PRINTER._all),
    ),
    "all is added": ("Blocks", FUNCTIONS + "_row", _always_adds),
    "the second element of a group is written": (
        "Blocks",
        WRITTEN,
        _edited("% 32 == 0", "% 32 == 1", stage.StagePrinter._all_written),
    ),
    "groups are counted as elements": (
        "Blocks",
        WRITTEN,
        _edited("index / 32", "index", stage.StagePrinter._all_written),
    ),
    "one work group less": ("Joined", JOBS + "dispatch_of", _one_group_less),
    "the reference takes the last group for a whole one": (
        "Joined",
        REFERENCE + "InGroups.__init__",
        _of_all,
    ),
    "the reference has nothing before an element": (
        "Before",
        REFERENCE + "InGroups.at_the_one_before",
        _unshifted,
    ),
    "the reference joins half of a group": (
        "Odd",
        REFERENCE + "_power_of_two",
        lambda number: 1 << (number - 1).bit_length() - 1,
    ),
}
"""Deliberate mistakes: the kernel that shows each, what is replaced, and by what."""


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_error_is_noticed(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    shows, where, wrong = PLANTED[name]
    monkeypatch.setattr(where, wrong)
    kernel = burnish.compile(FILE, ("glsl:vulkan",), material=shows)[shows]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "differs", row.problem


@pytest.mark.parametrize("name", sorted({shows for shows, _, _ in PLANTED.values()}))
def test_without_a_planted_error_all_agrees(studio: Studio, name: str) -> None:
    kernel = burnish.compile(FILE, ("glsl:vulkan",), material=name)[name]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "agrees"


def test_a_kernel_that_differs_has_no_pixels_to_explain(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, where, wrong = PLANTED["its own element is before it"]
    monkeypatch.setattr(where, wrong)
    kernel = burnish.compile(FILE, ("glsl:vulkan",), material="Before")["Before"]
    (row,) = conform([("k", kernel)], [ROUTES["lavapipe:glsl"]], studio.runner, studio.toolchain)
    assert row.status == "differs"
    assert with_reasons(kernel, [row], 0) == [row]
