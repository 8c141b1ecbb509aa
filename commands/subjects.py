"""Prepares the subjects of ``burnish render``: compiles the materials and sets up their scenes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from ..compiler.documents.reflection import Reflection
from .console import remark, show
from .failures import fail
from .kernels import feed, kernels_of

if TYPE_CHECKING:
    from ..api.entry_points import CompiledMaterial
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.meshes import Mesh
    from ..targets.runner.routes import Route
    from ..targets.runner.scene_state import SceneState

EVERYTHING = "all"
"""The name of all routes."""

LARGEST = 4096
"""The most pixels of a side. The reference needs 4 GB of memory for a square of this size."""

Color = tuple[float, float, float, float]


class RenderRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    output: Path
    on: tuple[str, ...]
    device: str
    mesh: str
    scene: Path | None
    """A file whose objects frames draw."""
    instances: int
    """The number of instances to draw if the material distinguishes them."""
    size: tuple[int, int]
    values: tuple[tuple[str, str], ...]
    background: Color
    """The colour behind the mesh, in linear light."""
    target: str | None
    material: str | None
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool
    native_stages: bool
    steps: int
    """The number of times that kernels are run again, if a step changes their results."""
    again: tuple[tuple[str, str], ...]
    """Buffers, and the results that replace them from step to step."""
    frames: int
    """The number of times that a frame is drawn."""

    @property
    def draws_everything(self) -> bool:
        """True if all routes that can draw shall draw, instead of named ones."""
        return EVERYTHING in self.on


class Subject(NamedTuple):
    """One material with one rig and one pass, ready to draw."""

    titles: tuple[str, ...]
    """The lines above its picture."""
    material: CompiledMaterial
    state: SceneState

    @property
    def label(self) -> str:
        """The titles on one line."""
        return ", ".join(self.titles)


def subjects(
    request: RenderRequest, routes: Iterable[Route], tell: Callable[[float], None]
) -> list[Subject]:
    """Compile everything that the command line asks for, for some routes, and set every value.

    Kernels over buffers are run, for the materials that read their results; ``tell`` is called with
    the finished part of their steps. Warnings and notes are printed. An error in a material, a
    value or a name is raised, or ends the command.
    """
    from ..targets.runner.kernels import is_drawn, is_over_buffers

    compiled = list(_compiled(request, routes))
    kernels = kernels_of(_all_of_file(request, [material for _titles, material in compiled]))
    pictures = [pair for pair in compiled if not is_over_buffers(pair[1].reflection)]
    drawn_ones = [pair for pair in pictures if is_drawn(pair[1].reflection)]
    if pictures and not drawn_ones:
        _refuse_captures(pictures)
    found = [(titles, material, _scene_state(material, request)) for titles, material in drawn_ones]
    drawn = [state.instance for _titles, _material, state in found]
    _set_values([*drawn, *(kernel.instance for kernel in kernels)], request.values)
    set_pictures(drawn, request.size)
    tell_unmade(drawn)
    feeding = feed(kernels, drawn, dict(request.again))
    _insist_on_values([*drawn, *(kernel.instance for kernel in feeding.kernels)])
    feeding.run(request.steps, tell)
    return [Subject(titles, material, _sized(state)) for titles, material, state in found]


def target_number(reflection: Reflection, wanted: str | None) -> int:
    """The number of the render target to show; ends the command if there is none of this name."""
    names = [row.name for row in reflection.targets]
    if wanted is None:
        return 0
    if wanted not in names:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(wanted, names) or f"there are {', '.join(names)}"
        fail(f"{reflection.material} has no render target `{wanted}`: {hint}")
    return names.index(wanted)


def _compiled(
    request: RenderRequest, routes: Iterable[Route]
) -> Iterator[tuple[tuple[str, ...], CompiledMaterial]]:
    """Each material with each rig and pass that the command line does not exclude, and its titles;
    and the kernels."""
    from ..api import entry_points as api

    variants = api.variants(request.file, search_path=request.search_path)
    rigs = [request.rig] if request.rig else list(dict.fromkeys(rig for rig, _ in variants))
    passes = [request.pass_] if request.pass_ else _own_passes(variants)
    profiles = sorted({route.profile for route in routes})
    results = {
        (rig, pass_): api.compile(
            request.file, profiles, material=request.material, rig=rig, pass_=pass_,
            search_path=request.search_path, hoist=request.hoist, partial=request.draws_everything,
            native_stages=request.native_stages,
        )
        for rig, pass_ in product(rigs, passes)
    }  # fmt: skip
    show(dict.fromkeys(found for result in results.values() for found in result.diagnostics))
    for materials in zip(*results.values(), strict=True):
        for (rig, pass_), material in zip(results, materials, strict=True):
            titles = (f"rig {rig}",) if len(rigs) > 1 else ()
            drawn_by = (f"pass {pass_}",) if len(passes) > 1 else ()
            yield (material.name, *titles, *drawn_by), material


def _all_of_file(
    request: RenderRequest, compiled: Sequence[CompiledMaterial]
) -> Iterable[CompiledMaterial]:
    """The materials of the whole file. If one is named, the rest is only needed for its buffers."""
    from ..api import entry_points as api

    if request.material is None or not any(each.reflection.buffers for each in compiled):
        return compiled
    return api.compile(request.file, (), rig=request.rig, search_path=request.search_path)


def _refuse_captures(captured: Sequence[tuple[tuple[str, ...], CompiledMaterial]]) -> NoReturn:
    """End the command, as there is nothing that has a picture."""
    label = ", ".join(captured[0][0])
    fail(f"{label} captures vertices, so its pass draws nothing: `burnish conform` runs it")


def _own_passes(variants: Iterable[tuple[str | None, str | None]]) -> list[str | None]:
    """The passes that a file declares; the library's if it declares none."""
    passes = dict.fromkeys(pass_ for _, pass_ in variants)
    return [pass_ for pass_ in passes if pass_ is not None] or [None]


def _scene_state(material: CompiledMaterial, request: RenderRequest) -> SceneState:
    """A mesh in a scene.

    For a kernel over images, the size of these replaces the requested one; it follows from the
    kernel's values only.
    """
    from ..targets.runner.scene import Scene
    from ..targets.runner.scene_state import set_up

    reflection, scene = material.reflection, Scene()
    target_number(reflection, request.target)
    mesh = _mesh(reflection, request, scene.camera.eye)
    instance, background = material.instance(), request.background
    return set_up(instance, mesh, scene, request.size, background=background)


def _mesh(reflection: Reflection, request: RenderRequest, eye: Sequence[float]) -> Mesh:
    """The named mesh with all inputs that the material reads; sorted by depth if it blends."""
    from ..targets.runner.meshes import farthest_first, mesh
    from ..targets.runner.scene import with_inputs

    plain = mesh(request.mesh)
    whole = with_inputs(reflection, plain, request.instances)
    made_up = [f"`{channel}`" for channel in whole.channels if channel not in plain.channels]
    if made_up:
        remark("note", (
            f"no mesh here has {', '.join(made_up)}: {reflection.material} is drawn with "
            "smooth waves in place of them"
        ))  # fmt: skip
    blends = any(row.blend is not None for row in reflection.targets)
    return farthest_first(whole, eye) if blends else whole


def _set_values(instances: Sequence[Instance], values: Iterable[tuple[str, str]]) -> None:
    """Set each value in every instance that has a parameter or texture of this name.

    Raises ``UnknownParameterError`` if no instance has one.
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
            # The shortest message suggests a similar name; the others list all names.
            raise min(unknown, key=lambda error: len(str(error)))


def set_pictures(instances: Sequence[Instance], size: tuple[int, int]) -> None:
    """Give kernels over images a picture to work on for each texture that has none."""
    from ..targets.runner.kernels import has_images
    from ..targets.runner.textures.chart import chart

    for instance in instances:
        reflection = instance.reflection
        for row in reflection.textures if has_images(reflection) else ():
            is_picture = (row.dimension, row.sample) == ("2d", "float")
            if is_picture and instance.get(row.name) is None:
                instance.set(row.name, chart(size))
                remark("note", (
                    f"`{row.name}` of {reflection.material} is a test chart: "
                    f"--set {row.name}=PICTURE sets another"
                ))  # fmt: skip


def tell_unmade(instances: Sequence[Instance]) -> None:
    """Note textures that lights bring to frames, and that nobody has set here."""
    unmade = {
        row.name: row.default
        for instance in instances
        for row in instance.reflection.textures
        if row.brought and row.stages and instance.get(row.name) is None
    }
    for name, default in unmade.items():
        remark("note", (
            f"`{name}` is made by steps of its light, which only a frame draws; here it is "
            f"`{default}`: --set {name}=PICTURE sets another"
        ))  # fmt: skip


def _sized(state: SceneState) -> SceneState:
    """The state with the size that a kernel's images have; ends the command if it is too large."""
    from ..targets.runner.kernels import EmptyImageError, full_screen_state, has_images

    reflection = state.instance.reflection
    if not has_images(reflection):
        return state
    try:
        sized = full_screen_state(state.instance, state.clear[0])
    except EmptyImageError as error:
        fail(str(error))
    if max(sized.width, sized.height) > LARGEST:
        size = f"{sized.width} x {sized.height}"
        fail(f"the images of {reflection.material} have {size} texels: a side has {LARGEST} at "
             "most")  # fmt: skip
    return sized


def _insist_on_values(instances: Sequence[Instance]) -> None:
    """End the command if any parameter has no value, and say how to set it."""
    lacking = [instance for instance in instances if instance.missing]
    if not lacking:
        return
    from ..targets.runner.instances.host_values import MissingValuesError

    said = {}
    for instance in lacking:
        try:
            instance.values()
        except MissingValuesError as error:
            said[str(error)] = error.names[0]
    first, *further = said
    text = "".join([first, *("\n  " + each.replace("\n", "\n  ") for each in further)])
    fail(f"{text}\n  = help: set each of them: --set '{said[first]}=…'")
