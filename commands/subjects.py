"""What ``burnish render`` draws: the materials of a file, each in its rigs, set up in a scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .console import remark, show
from .failures import fail

if TYPE_CHECKING:
    from ..api import CompiledMaterial
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.meshes import Mesh
    from ..targets.runner.routes import Route
    from ..targets.runner.shots import Shot

EVERYTHING = "all"
"""Stands for every route."""

Color = tuple[float, float, float, float]


class Request(NamedTuple):
    """What the command line of ``burnish render`` asks for."""

    file: Path
    output: Path
    on: tuple[str, ...]
    mesh: str
    instances: int
    """How many there are of what tells instances apart."""
    size: tuple[int, int]
    values: tuple[tuple[str, str], ...]
    background: Color
    """Linear light."""
    target: str | None
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool

    @property
    def draws_everything(self) -> bool:
        """Whether routes are to draw that can, and not those that are named."""
        return EVERYTHING in self.on


class Subject(NamedTuple):
    """One material in one rig."""

    titles: tuple[str, ...]
    """Lines that say what it is."""
    material: CompiledMaterial
    shot: Shot

    @property
    def label(self) -> str:
        """The same on one line."""
        return ", ".join(self.titles)


def subjects(request: Request, routes: Iterable[Route]) -> list[Subject]:
    """All that the command line asks for, compiled for some routes and with every value set.

    Warnings and notes are told. What is wrong with a material, a value or a name is raised, or ends
    the command.
    """
    found = [
        Subject(titles, material, _shot(material, request))
        for titles, material in _compiled(request, routes)
    ]
    instances = [subject.shot.instance for subject in found]
    _set_values(instances, request.values)
    _insist_on_values(instances)
    return found


def target_number(reflection: Mapping[str, Any], wanted: str | None) -> int:
    """Which render target is shown; ends the command if there is none of that name."""
    names = [row["name"] for row in reflection["targets"]]
    if wanted is None:
        return 0
    if wanted not in names:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(wanted, names) or f"there are {', '.join(names)}"
        fail(f"{reflection['material']} has no render target `{wanted}`: {hint}")
    return names.index(wanted)


def _compiled(
    request: Request, routes: Iterable[Route]
) -> Iterator[tuple[tuple[str, ...], CompiledMaterial]]:
    """Each material in each rig that the command line leaves a choice of, with its titles."""
    from .. import api

    variants = api.variants(request.file, search_path=request.search_path)
    rigs = [request.rig] if request.rig else list(dict.fromkeys(rig for rig, _ in variants))
    profiles = sorted({route.profile for route in routes})
    results = {
        rig: api.compile(
            request.file, profiles, material=request.material, rig=rig, pass_=request.pass_,
            search_path=request.search_path, hoist=request.hoist, partial=request.draws_everything,
        )
        for rig in rigs
    }  # fmt: skip
    show(found for result in results.values() for found in result.diagnostics)
    for materials in zip(*results.values(), strict=True):
        for rig, material in zip(rigs, materials, strict=True):
            yield (material.name, f"rig {rig}") if len(rigs) > 1 else (material.name,), material


def _shot(material: CompiledMaterial, request: Request) -> Shot:
    from ..targets.runner.scene import Scene
    from ..targets.runner.shots import take

    reflection, scene = material.reflection, Scene()
    target_number(reflection, request.target)
    mesh = _mesh(reflection, request, scene.eye)
    return take(material.instance(), mesh, scene, request.size, request.background)


def _mesh(reflection: Mapping[str, Any], request: Request, eye: Sequence[float]) -> Mesh:
    """The mesh of that name with all that the material reads, ordered for blending if it blends."""
    from ..targets.runner.meshes import farthest_first, mesh
    from ..targets.runner.scene import with_inputs

    plain = mesh(request.mesh)
    whole = with_inputs(reflection, plain, request.instances)
    made_up = [f"`{channel}`" for channel in whole.channels if channel not in plain.channels]
    if made_up:
        remark("note", (
            f"no mesh here has {', '.join(made_up)}: {reflection['material']} is drawn with "
            "smooth waves in place of them"
        ))  # fmt: skip
    blends = any(row["blend"] != "none" for row in reflection["targets"])
    return farthest_first(whole, eye) if blends else whole


def _set_values(instances: Sequence[Instance], values: Iterable[tuple[str, str]]) -> None:
    """Sets each value wherever there is something of its name.

    Raises ``UnknownParameterError`` if there is nothing.
    """
    from ..targets.runner.instances.values import UnknownParameterError

    for name, text in values:
        unknown = []
        for instance in instances:
            try:
                instance.set_text(name, text)
            except UnknownParameterError as error:
                unknown.append(error)
        if len(unknown) == len(instances):
            # The shortest one names what is near; the others list all there is.
            raise min(unknown, key=lambda error: len(str(error)))


def _insist_on_values(instances: Sequence[Instance]) -> None:
    """Ends the command if anything has no value, and says how to set it."""
    lacking = [instance for instance in instances if instance.missing]
    if not lacking:
        return
    from ..targets.runner.instances.instance import MissingValuesError

    said = {}
    for instance in lacking:
        try:
            instance.values()
        except MissingValuesError as error:
            said[str(error)] = error.names[0]
    fail("\n".join(said) + f"\n  = help: set each of them: --set '{next(iter(said.values()))}=…'")
