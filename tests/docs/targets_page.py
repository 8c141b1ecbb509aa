"""The tables of capabilities and of limits on the page about targets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from burnish.targets import registry
from burnish.targets.description.capabilities import CAPABILITIES
from burnish.targets.description.capability import (
    Capability,
    Standing,
    is_only_on_request,
    standing,
)
from burnish.targets.description.profile import LIMITED, Profile

from .tables import DOCS, codes, spliced, table


def targets_page() -> str:
    """The page on targets with its tables of capabilities and of limits brought up to date."""
    page = (DOCS / "targets.md").read_text(encoding="utf-8")
    profiles = _profiles()
    heading = ("", *(f"`{name}`" for name in profiles))
    page = spliced(page, "capabilities", table(heading, _standings(profiles)))
    page = spliced(page, "rows", _paragraphs(profiles))
    return spliced(page, "limits", table(heading, _limits(profiles)))


def _profiles() -> dict[str, Profile]:
    """All profiles by their full names."""
    return {
        f"{language.name}:{profile.name}": profile
        for language in map(registry.load, registry.names())
        for profile in language.profiles
    }


def _standings(profiles: Mapping[str, Profile]) -> Iterator[tuple[str, ...]]:
    for row in CAPABILITIES:
        yield row.name, *(standing(row, profile).kind for profile in profiles.values())


def _paragraphs(profiles: Mapping[str, Profile]) -> str:
    """An entry for each capability: what it is, and where it is not native, why and what then."""
    return "".join(
        f"**{row.name}.** {row.doc}\n\n{''.join(_elsewhere_of(row, profiles))}"
        for row in CAPABILITIES
    )


def _elsewhere_of(row: Capability, profiles: Mapping[str, Profile]) -> Iterator[str]:
    found: dict[Standing, list[str]] = {}
    for name, profile in profiles.items():
        cell = standing(row, profile)
        if cell.kind != "native":
            found.setdefault(cell, []).append(name)
    for cell, names in found.items():
        then = cell.how or row.instead
        ending = f": {then}" if then else ""
        missing = " and no ".join(cell.missing)
        where = f"{codes(names)}, where there is no {missing}"
        yield f"- *{cell.kind.capitalize()}* in {where}{ending}.\n"
    asked = [name for name, profile in profiles.items() if is_only_on_request(row, profile)]
    if asked:
        yield f"- Only with `--native-stages` in {codes(asked)}, where nothing else does it.\n"
    if found or asked:
        yield "\n"


def _limits(profiles: Mapping[str, Profile]) -> Iterator[tuple[str, ...]]:
    for field, limited in LIMITED.items():
        yield limited.what, *(_limit(field, profile) for profile in profiles.values())


def _limit(field: str, profile: Profile) -> str:
    """A limit as people see it; a dash where there is none, or nothing that could have one."""
    number, stage = getattr(profile.limits, field), LIMITED[field].stage
    is_there = number is not None and (stage is None or stage in profile.stages)
    return str(number) if is_there else "–"
