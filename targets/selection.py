"""Finds the languages and profiles that a user asks for, by names such as ``glsl:es300``.

``api.compile`` calls ``select_targets`` before it compiles anything. The registry knows the
languages that exist; this module has the names by which a user may call them, and the messages
about unknown names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Report
from ..compiler.diagnostics.nearest import suggestion
from . import registry
from .availability import way_out
from .description.capabilities import SINGLE_FILE
from .description.profile import Profile
from .description.shading_language import Language

DEFAULT = "default"
"""The name of the first profile of every target that is not marked as unproven."""

ALL = "all"
"""The name of every profile of every target, besides those that have to be named."""


def select_targets(
    wanted: Iterable[str], report: Report, *, single_file: bool = False
) -> list[tuple[Language, Profile]]:
    """The targets and profiles that ``wanted`` names; unknown names are reported."""
    chosen: dict[tuple[str, str], tuple[Language, Profile]] = {}
    known = registry.names()
    for text in chain.from_iterable(_named(text.strip(), known) for text in wanted):
        name, _, profile_name = text.partition(":")
        if name not in known:
            hint = suggestion(name, (*known, ALL)) or f"there are {', '.join(_listed())}, and {ALL}"
            report.add(rules.UNKNOWN_TARGET, None, name=name, hint=hint)
            continue
        target = registry.load(name)
        try:
            profile = target.profile(profile_name)
        except KeyError:
            profiles = [profile.name for profile in target.profiles]
            hint = suggestion(profile_name, profiles) or f"there are {', '.join(profiles)}"
            report.add(rules.UNKNOWN_PROFILE, None, target=name, name=profile_name, hint=hint)
            continue
        if single_file and not profile.single_file:
            feature, name = SINGLE_FILE.feature, full_name(target, profile)
            hint = way_out(feature, profile)
            report.add(rules.UNSUPPORTED, None, target=name, feature=feature, hint=hint)
        chosen[name, profile.name] = target, profile
    return list(chosen.values())


def _listed() -> Iterator[str]:
    """The names of all targets, with a remark for those that are not proven."""
    for target in map(registry.load, registry.names()):
        yield f"{target.name} ({target.unproven})" if target.unproven else target.name


def _named(name: str, known: Iterable[str]) -> Iterable[str]:
    """The names that ``all`` and ``default`` mean; any other name means itself."""
    if name == DEFAULT:
        return registry.defaults()
    if name != ALL:
        return (name,)
    languages = map(registry.load, known)
    return [full_name(each, p) for each in languages for p in each.profiles if not p.on_request]


def full_name(target: Language, profile: Profile) -> str:
    """The name that means this profile alone, as reflections and messages have it."""
    return f"{target.name}:{profile.name}"
