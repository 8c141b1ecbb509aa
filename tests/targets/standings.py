"""The profiles and routes that have a capability, for tests that expect it of these alone."""

from __future__ import annotations

from burnish.targets import registry
from burnish.targets.availability import standings
from burnish.targets.description.capability import Kind
from burnish.targets.runner.routes import ROUTES

PROFILES = tuple(
    f"{target.name}:{profile.name}"
    for target in map(registry.load, registry.names())
    for profile in target.profiles
    if not profile.on_request
)
"""The full names of the profiles that ``all`` means."""


def profiles(kind: Kind, *capabilities: str) -> frozenset[str]:
    """The profiles of which the table of capabilities says this of one of these, or of several."""
    return frozenset(
        name
        for name in PROFILES
        for cells in (standings(registry.select(name)[1]),)
        if any(cells[each].kind == kind for each in capabilities)
    )


def routes(kind: Kind, *capabilities: str) -> frozenset[str]:
    """The routes that draw these profiles."""
    found = profiles(kind, *capabilities)
    return frozenset(name for name, route in ROUTES.items() if route.profile in found)
