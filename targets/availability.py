"""Capabilities of each profile, and the advice that is given where a profile lacks one.

``compiling.py`` and ``selection.py`` ask for the way out that is shown below an error, and
``burnish targets`` for the cells of the table of capabilities.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from . import registry
from .description.capabilities import CAPABILITIES, lacking, without_native_stages
from .description.capability import Capability, Standing, standing
from .description.profile import LIMITED, Profile


def standings(profile: Profile) -> Mapping[str, Standing]:
    """The cells of one profile, by the name of the capability, in the order of the table."""
    return {row.name: standing(row, profile) for row in CAPABILITIES}


def way_out(feature: str, profile: Profile, needed_for: Capability | None = None) -> str:
    """Advice for a user whose program uses a feature that a profile lacks; may be empty.

    ``needed_for`` is the capability that the program needs, if the feature alone does not say.
    """
    capability = needed_for or lacking(feature)
    if capability is None:
        return ""
    if here := without_native_stages(capability, profile):
        return here
    elsewhere = _compile_for(lambda other: standing(capability, other).kind != "absent")
    return ", or ".join(filter(None, (capability.instead, elsewhere)))


def with_as_many(limit_name: str, count: int) -> str:
    """The advice to make do with less, or to compile for profiles whose limit allows ``count``.

    It is empty if nothing is known.
    """

    def has_enough(profile: Profile) -> bool:
        limit = profile.limits.most(limit_name)
        return limit is None or limit >= count

    advice = LIMITED[limit_name].instead, _compile_for(has_enough)
    return ", or ".join(filter(None, advice))


def within(limit_name: str, count: int, profile: Profile) -> str:
    """The advice for a program that exceeds a limit of a profile, with the limit's name there."""
    advice, name = with_as_many(limit_name, count), profile.limit_names.get(limit_name)
    source = f"`{name}` is {profile.limits.most(limit_name)} on some devices"
    return f"{source}: {advice}" if advice and name else advice


def _compile_for(fits: Callable[[Profile], bool]) -> str:
    """The advice to choose one of the proven profiles that fit; empty if there is none."""
    names = [
        f"{language.name}:{profile.name}"
        for language in map(registry.load, registry.defaults())
        for profile in language.profiles
        if not profile.on_request and fits(profile)
    ]
    if not names:
        return ""
    *others, last = names
    return f"compile for {', '.join(others)} or {last}" if others else f"compile for {last}"
