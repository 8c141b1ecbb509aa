"""``burnish targets``: lists target languages and profiles, for people and for programs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from .answering import collector
from .console import Styled, say
from .options import answer_option

if TYPE_CHECKING:
    from ..engines.engine import Engine
    from ..targets.description.profile import Profile
    from ..targets.description.shading_language import Language


@click.command()
@answer_option
def targets() -> None:
    """List the targets, their profiles and what each can do, and the engines.

    A target is chosen by its name, which means its first profile, or as TARGET:PROFILE.

    \b
    Example:
        burnish targets
        burnish compile plastic.burnish --target wgsl,glsl:es300 -o build/
    """
    from ..engines import known as engines
    from ..targets import registry

    rows = [registry.load(name) for name in registry.names()]
    if (collected := collector()) is not None:
        from ..compiler.documents.answer import TargetsAnswer

        found = tuple(map(_engine_data, map(engines.load, engines.names())))
        collected.find(TargetsAnswer(targets=tuple(map(_data, rows)), engines=found))
        return
    for target in rows:
        say(Styled(target.name, is_bold=True), f"  {target.title}, *.{target.extension}")
        if target.unproven:
            say("  ", Styled("unproven", "yellow"), f": {target.unproven}")
        for line in _profiles(target):
            say(line)
    for engine in map(engines.load, engines.names()):
        say(Styled(f"--engine {engine.name}", is_bold=True), f"  {engine.title}")
        if engine.unproven:
            say("  ", Styled("unproven", "yellow"), f": {engine.unproven}")


def _profiles(target: Language) -> Iterator[str]:
    for profile in target.profiles:
        default = "" if profile is not target.profiles[0] else " (default)"
        yield f"  {target.name}:{profile.name}{default}"
        yield f"      {profile.doc}"
        yield f"      {'; '.join(_abilities(profile))}"
        yield from (f"      {line}" for line in _capabilities(profile))


def _abilities(profile: Profile) -> Iterator[str]:
    """The properties by which a host chooses a profile, in words."""
    yield "textures with their samplers" if profile.samplers.combined else "separate samplers"
    yield "bindings in the text" if profile.explicit_bindings else "bindings set by name"
    yield f"depth {profile.framebuffer.clip_depth}"
    if profile.framebuffer.clip_control:
        yield f"glClipControl({', '.join(profile.framebuffer.clip_control)})"
    yield f"rows count {'upwards' if profile.framebuffer.rows_up else 'downwards'}"
    if profile.on_request:
        yield "not among `all`"
    yield f"checked by {', '.join(profile.checkers) or 'nothing'}"


def _capabilities(profile: Profile) -> Iterator[str]:
    """The native, lowered and absent capabilities of a profile, a line each."""
    from ..targets.availability import standings
    from ..targets.description.capability import KINDS

    cells = standings(profile)
    for kind in KINDS:
        found: dict[str, list[str]] = {}
        for name, cell in cells.items():
            if cell.kind == kind:
                found.setdefault(cell.how, []).append(name)
        for how, names in found.items():
            yield f"{kind}: {', '.join(names)}{f' ({how})' if how else ''}"


def _data(target: Language) -> dict[str, Any]:
    return {
        "name": target.name,
        "title": target.title,
        "extension": target.extension,
        "unproven": target.unproven,
        "profiles": [_profile_data(profile) for profile in target.profiles],
    }


def _engine_data(engine: Engine) -> dict[str, Any]:
    return {
        "name": engine.name,
        "title": engine.title,
        "targets": list(engine.targets),
        "unproven": engine.unproven,
        "values": sorted(engine.taken),
    }


def _profile_data(profile: Profile) -> dict[str, Any]:
    from ..targets.availability import standings
    from ..targets.description.profile import LIMITED

    return {
        "name": profile.name,
        "doc": profile.doc,
        "stages": [row.name for row in profile.stages],
        "combined_samplers": profile.samplers.combined,
        "explicit_bindings": profile.explicit_bindings,
        "varyings_by_name": profile.varyings_by_name,
        "clip_depth": profile.framebuffer.clip_depth,
        "clip_control": list(profile.framebuffer.clip_control),
        "rows_up": profile.framebuffer.rows_up,
        "single_file": profile.single_file,
        "on_request": profile.on_request,
        "checkers": list(profile.checkers),
        "capabilities": {
            name: {"standing": cell.kind, "how": cell.how, "missing": list(cell.missing)}
            for name, cell in standings(profile).items()
        },
        "limits": {name: getattr(profile.limits, name) for name in LIMITED},
    }
