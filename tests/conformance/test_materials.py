"""The materials by which planted errors are found agree on every route while nothing is planted."""

from __future__ import annotations

import pytest

import burnish
from burnish.stdlib.builtins import BUILTINS
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from .kit import Studio
from .subjects import DEFECTS, LACKING, NAMES, called, compiled, row


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", ROUTES)
def test_it_agrees(studio: Studio, route: str, name: str) -> None:
    if ROUTES[route].profile in LACKING.get(name, ()):
        with pytest.raises(burnish.CompileError, match=f"{ROUTES[route].profile} has no"):
            compiled(name, ROUTES[route].profile)
        return
    found = row(studio, name, route)
    if DEFECTS.get(name) == ROUTES[route].driver:
        assert found.status == "differs", "the defect is gone: take it off the list"
        return
    assert found.status == "agrees", "\n".join(details(found)) or found.status


def test_every_builtin_is_called() -> None:
    """Or is an operator that the first pass has replaced."""
    assert not set(BUILTINS) - set().union(*map(called, NAMES))
