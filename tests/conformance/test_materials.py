"""The materials by which planted errors are found agree on every route while nothing is planted."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import burnish
from burnish.stdlib.builtins import BUILTINS
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from . import test_work_groups
from .kit import Studio, all_of, keeping_the_last
from .subjects import DEFECTS, LACKING, MAY_PROVE_LITTLE, NAMES, called, compiled

CASES = [
    # One process draws a material by all routes, so that the reference draws it once.
    pytest.param(route, name, id=f"{route}-{name}", marks=pytest.mark.xdist_group(name))
    for name in NAMES
    for route in ROUTES
]


@pytest.fixture(scope="session")
def rows(studio: Studio) -> Callable[[str], dict[str, Row]]:
    """The rows of a run over one of ``NAMES``, by route."""

    @keeping_the_last
    def found(name: str) -> dict[str, Row]:
        lacking = LACKING.get(name, ())
        routes = {key: route for key, route in ROUTES.items() if route.profile not in lacking}
        material = compiled(name, *sorted({route.profile for route in routes.values()}))
        rows = conform([(name, material)], list(routes.values()), studio.runner, studio.toolchain)
        return dict(zip(routes, rows, strict=True))

    return found


@pytest.mark.parametrize(("route", "name"), CASES)
def test_it_agrees(rows: Callable[[str], dict[str, Row]], route: str, name: str) -> None:
    if ROUTES[route].profile in LACKING.get(name, ()):
        with pytest.raises(burnish.CompileError, match=f"{ROUTES[route].profile} has no"):
            compiled(name, ROUTES[route].profile)
        return
    found = rows(name)[route]
    if ROUTES[route].driver in DEFECTS.get(name, ()):
        assert found.status == "differs", "the defect is gone: take it off the list"
        return
    allowed = {"agrees"} | ({"proves little"} if name in MAY_PROVE_LITTLE else set())
    assert found.status in allowed, "\n".join(details(found)) or found.status


def test_every_builtin_is_called() -> None:
    """A material calls it, or a kernel whose groups join values, or the first pass replaces it."""
    subjects = [compiled(name) for name in NAMES] + [*all_of(test_work_groups.FILE)]
    assert not set(BUILTINS) - set().union(*map(called, subjects))
