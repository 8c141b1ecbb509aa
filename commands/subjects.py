"""Prepares the subjects of ``burnish render``: compiles what a file declares, and sets it up.

All are frames: a material or a kernel over images is one of a single step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import click

from .console import remark, show
from .failures import fail
from .hosts import (
    is_single,
    scenery_of,
    set_pictures,
    set_values,
    set_wished,
    tell_unmade,
    tell_unused_lamps,
)
from .kernels import feed, kernels_of
from .surroundings import surround, tell_surroundings

if TYPE_CHECKING:
    from ..api.entry_points import CompiledFrame, CompiledMaterial
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.subjects import PlannedFrame
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.kernel_results import Kernel
    from ..targets.runner.routes import Route

EVERYTHING = "all"
"""The name of all routes."""

LARGEST = 4096
"""The most pixels of a side. The reference needs 4 GB of memory for a square of this size."""

Color = tuple[float, float, float, float]
Titles = tuple[str, ...]
"""The lines of a caption."""


class RenderRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    file: Path
    output: Path
    on: tuple[str, ...]
    device: str
    mesh: str
    floor: bool
    """True if the mesh of a material stands on a floor."""
    scene: Path | None
    """A file whose objects are drawn."""
    variant: str | None
    """The variant of that file which is drawn."""
    environment: str
    """The light from all around: a word or a file."""
    eye: tuple[float, float, float] | None
    look_at: tuple[float, float, float] | None
    turn: tuple[float, float]
    """The angles by which the camera turns, in radians: to the right and upwards."""
    instances: int
    """The number of instances to draw if the material distinguishes them."""
    size: tuple[int, int]
    values: tuple[tuple[str, str], ...]
    background: Color
    """The colour behind the mesh, in linear light."""
    exposure: float
    """The stops by which the picture is brightened."""
    tone: str
    """The name of a tone mapping."""
    samples: int
    """The number of samples in each pixel of a material."""
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
    plain: bool
    """True if the comment of the file has no say."""
    wished: tuple[tuple[str, str], ...] = ()
    """The values that the comment of the file asks for."""

    @property
    def draws_everything(self) -> bool:
        """True if all routes that can draw shall draw, instead of named ones."""
        return EVERYTHING in self.on


class Subject(NamedTuple):
    """One frame with one rig, ready to draw; or one material with one rig and one pass."""

    titles: Titles
    """The subject's name, with the properties that tell it apart from others of this name."""
    host: FrameHost
    """The frame with a scene and all values."""
    outputs: Mapping[str, Titles]
    """The outputs that are shown, each with the caption of its picture."""
    size: tuple[int, int]
    """The size of its pictures, unless the frame states another one."""

    @property
    def label(self) -> str:
        """The titles on one line."""
        return ", ".join(self.titles)


T = TypeVar("T", bound="CompiledFrame | CompiledMaterial")
Frames = list[tuple[Titles, "PlannedFrame"]]
Materials = list[tuple[Titles, "CompiledMaterial"]]
"""Materials and kernels, each with its titles."""


def subjects(
    request: RenderRequest, routes: Iterable[Route], tell: Callable[[float], None]
) -> list[Subject]:
    """Compile everything that the command line asks for, for some routes, and set every value.

    Kernels over buffers are run, for the materials that read their results; ``tell`` is called with
    the finished part of their steps. Warnings and notes are printed. An error in a file, a value or
    a name is raised, or ends the command.
    """
    from ..targets.runner.frames.plan_files import told_contradictions

    profiles = sorted({route.profile for route in routes})
    frames, materials = _compiled(request, profiles)
    if request.floor:
        kernels: Sequence[Kernel] = ()
        frames = [*frames, *_standing_frames(materials, request, profiles)]
    else:
        kernels = kernels_of(_all_of_file(request, [material for _titles, material in materials]))
        frames = [*frames, *_single_frames(materials, request)]
    outputs = [_outputs(titles, frame, request.target) for titles, frame in frames]
    with ExitStack() as stack:
        for _titles, frame in frames:
            stack.enter_context(told_contradictions(frame))
        hosts = [_host(frame, request) for _titles, frame in frames]
        _set_all(hosts, kernels, request, tell)
    return [
        Subject(titles, host, shown, _size(host))
        for (titles, _frame), host, shown in zip(frames, hosts, outputs, strict=True)
    ]


# --- compiling -----------------------------------------------------------------------------------


def _compiled(request: RenderRequest, profiles: Sequence[str]) -> tuple[Frames, Materials]:
    """The frame of a plan; or the frames of a file; or else its materials and kernels: each with
    each rig and pass that the command line does not exclude."""
    from ..api import entry_points as api
    from ..targets.runner.frames.plan_files import is_plan
    from ..targets.runner.job_sizes import check_work

    if is_plan(request.file):
        return _stored(request, profiles), []
    variants = api.variants(request.file, search_path=request.search_path)
    rigs = [request.rig] if request.rig else list(dict.fromkeys(rig for rig, _ in variants))
    ties = api.declared(request.file, search_path=request.search_path).ties
    passes = [request.pass_] if request.pass_ else _own_passes(variants, has_ties=bool(ties))
    if api.has_frames(request.file, material=request.material, search_path=request.search_path):
        passes = passes[:1]  # A frame says by itself which passes it draws.
    results = [
        api.compile(
            request.file, profiles, material=request.material, rig=rig, pass_=pass_,
            search_path=request.search_path, hoist=request.hoist, partial=request.draws_everything,
            native_stages=request.native_stages, keep_graphs=True,
        )
        for rig, pass_ in product(rigs, passes)
    ]  # fmt: skip
    show(dict.fromkeys(found for result in results for found in result.diagnostics))
    for shader in (each for result in results for each in result.materials):
        check_work(shader.shader)
    of_rigs = [(f"rig {rig}",) if len(rigs) > 1 else () for rig in rigs]
    titles = ["own pass" if pass_ is None else f"pass {pass_}" for pass_ in passes]
    of_passes = [(title,) if len(passes) > 1 else () for title in titles]
    further = [(*of_rig, *of_pass) for of_rig, of_pass in product(of_rigs, of_passes)]
    frames = _titled([result.frames for result in results], further)
    return [*frames], [] if frames else _titled([each.materials for each in results], further)


def _titled(results: Sequence[Sequence[T]], further: Sequence[Titles]) -> list[tuple[Titles, T]]:
    """Each declaration of several results with its titles; those of one name are together."""
    return [
        ((each.name, *own), each)
        for alike in zip(*results, strict=True)
        for each, own in zip(alike, further, strict=True)
    ]


def _stored(request: RenderRequest, profiles: Sequence[str]) -> Frames:
    """The frame of a plan."""
    from ..targets.runner.frames.plan_files import read_frame

    if request.material or request.rig or request.pass_:
        raise click.UsageError("a plan is of one frame and one rig: there is nothing to choose")
    frame = read_frame(request.file, profiles)
    return [((frame.name,), frame)]


def _own_passes(
    variants: Iterable[tuple[str | None, str | None]], *, has_ties: bool
) -> list[str | None]:
    """The passes that a file declares, or ``None`` for the pass of each material.

    The latter is drawn with where a material names its pass, or the file declares none.
    """
    passes = list(dict.fromkeys(pass_ for _, pass_ in variants))
    return [pass_ for pass_ in passes if pass_ is not None or has_ties] or [None]


def _all_of_file(
    request: RenderRequest, compiled: Sequence[CompiledMaterial]
) -> Iterable[CompiledMaterial]:
    """The materials of the whole file. If one is named, the rest is only needed for its buffers."""
    from ..api import entry_points as api

    if request.material is None or not any(each.reflection.buffers for each in compiled):
        return compiled
    return api.compile(
        request.file, (), rig=request.rig, search_path=request.search_path, keep_graphs=True
    )


# --- frames --------------------------------------------------------------------------------------


def _single_frames(materials: Materials, request: RenderRequest) -> Frames:
    """The materials and kernels that have a picture, as frames. Kernels over buffers have none.

    Ends the command if there are only passes that capture vertices.
    """
    from ..targets.runner.frames.single import single_frame
    from ..targets.runner.kernels import is_drawn, is_over_buffers

    pictures = [pair for pair in materials if not is_over_buffers(pair[1].reflection)]
    drawn = [pair for pair in pictures if is_drawn(pair[1].reflection)]
    if pictures and not drawn:
        label = ", ".join(pictures[0][0])
        fail(f"{label} captures vertices, so its pass draws nothing: `burnish conform` runs it")
    return [
        (titles, single_frame(material, request.background, exact=True, samples=request.samples))
        for titles, material in drawn
    ]


def _standing_frames(
    materials: Materials, request: RenderRequest, profiles: Sequence[str]
) -> Frames:
    """The materials on a floor, each with each rig. Ends the command where there is no mesh."""
    from ..targets.runner.kernels import is_over_buffers
    from .standing import standing

    unrun = [m.name for _, m in materials if is_over_buffers(m.reflection)]
    drawn = {
        (material.name, material.reflection.rig): titles
        for titles, material in reversed(materials)
        if material.reflection.extent is None and material.name not in unrun
    }
    if request.scene is not None or not drawn:
        fail("--floor is for the mesh of a material: a frame, a kernel or a scene has none")
    passes = dict.fromkeys(material.reflection.pass_ for _, material in materials)
    if own := [name for name in passes if name not in ("", "Forward")]:
        remark("note", f"on a floor, materials are drawn by Forward, and not by {', '.join(own)}")
    if unrun:
        names = ", ".join(dict.fromkeys(unrun))
        remark("note", f"on a floor, no kernels run, so buffers have nothing of {names}")
    return [
        (
            titles,
            standing(
                request.file, name, rig or None, profiles, background=request.background,
                samples=request.samples, search_path=request.search_path, hoist=request.hoist,
            ),
        )
        for (name, rig), titles in reversed(drawn.items())
    ]  # fmt: skip


def _outputs(titles: Titles, frame: PlannedFrame, wanted: str | None) -> Mapping[str, Titles]:
    """The outputs to show with the captions of their pictures: the named one; or all of a frame,
    and the first of a material.

    Ends the command if there is none of this name.
    """
    names = [row.name for row in frame.plan.outputs if row.texture is not None]
    if is_single(frame):
        return {_chosen(f"{frame.name} has no render target", names, wanted)[0]: titles}
    name, *further = titles
    return {
        output: (f"{name}.{output}", *further)
        for output in _chosen(f"{frame.name} has no output", names, wanted)
    }


def _chosen(lack: str, names: Sequence[str], wanted: str | None) -> Sequence[str]:
    """The wanted name alone, or all names; ends the command with ``lack`` if there is none."""
    if wanted is None:
        if not names:
            fail(f"{lack} that is a picture")
        return names
    if wanted not in names:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(wanted, names) or f"there are {', '.join(names)}"
        fail(f"{lack} `{wanted}`: {hint}")
    return [wanted]


def _host(frame: PlannedFrame, request: RenderRequest) -> FrameHost:
    """The frame with a scene."""
    from ..targets.runner.frames.host import FrameHost

    host = FrameHost(frame, scenery_of(frame, request), request.size)
    tell_unused_lamps(host)
    return host


def _set_all(
    hosts: Sequence[FrameHost],
    kernels: Sequence[Kernel],
    request: RenderRequest,
    tell: Callable[[float], None],
) -> None:
    """Set all values, also those that nobody has named; ends the command if one is missing."""
    from ..targets.runner.frames.step_draws import StepDraws

    surround(hosts, request.environment)
    owners: list[FrameHost | Instance] = [*hosts, *(kernel.instance for kernel in kernels)]
    set_wished(owners, request.wished)
    set_values(owners, request.values)
    singles = [each for host in hosts if is_single(host.frame) for each in host.instances]
    tell_surroundings(hosts, request.environment,
                      (name for name, _ in (*request.wished, *request.values)))  # fmt: skip
    set_pictures(singles, request.size)
    tell_unmade(singles)
    feeding = feed(kernels, singles, dict(request.again))
    _insist_on_values([
        *(StepDraws(host).check_values for host in hosts),
        *(kernel.instance.values for kernel in feeding.kernels),
    ])  # fmt: skip
    feeding.run(request.steps, tell)


def _insist_on_values(checks: Iterable[Callable[[], object]]) -> None:
    """End the command if a check finds that values are missing, and say how to set them."""
    from ..targets.runner.instances.host_values import MissingValuesError

    said = {}
    for check in checks:
        try:
            check()
        except MissingValuesError as error:
            said[str(error)] = error.names[0]
    if not said:
        return
    first, *further = said
    text = "".join([first, *("\n  " + each.replace("\n", "\n  ") for each in further)])
    fail(f"{text}\n  = help: set each of them: --set '{said[first]}=…'")


def _size(host: FrameHost) -> tuple[int, int]:
    """The size of the pictures of a host, unless its frame states another one.

    Of a kernel over images, it follows from the kernel's values; ends the command if it is too
    large.
    """
    from ..targets.runner.kernels import EmptyImageError, full_screen_state, has_images

    (instance, *further) = host.instances
    if further or not is_single(host.frame) or not has_images(instance.reflection):
        return host.size
    try:
        state = full_screen_state(instance)
    except EmptyImageError as error:
        fail(str(error))
    size = state.width, state.height
    if max(size) > LARGEST:
        fail(f"the images of {host.frame.name} have {size[0]} x {size[1]} texels: a side has "
             f"{LARGEST} at most")  # fmt: skip
    return size
