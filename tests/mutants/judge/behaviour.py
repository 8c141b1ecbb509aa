"""The behaviour of a material or a frame: its texts, and what drivers are told, as digests."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from hashlib import blake2b
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burnish.api.entry_points import CompiledFrame, CompiledMaterial
    from burnish.targets.runner.codes import Codes
    from burnish.targets.runner.routes import Route

    Judged = CompiledMaterial | CompiledFrame

DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga", "llvmpipe:gl330")
"""The fastest route of each language, in the order in which they draw."""
DEFECTIVE = {"gathered: Varying"}
"""Materials that show a driver's bug."""
_FRAMES = re.compile(r"^frame (\w+)", re.MULTILINE)
_FRAME_SIZE = (36, 28)
"""The size of the frames that drivers are told to draw."""
_FRAME_COUNT = 2
"""The number of frames that it takes to show the results kept for the next frame."""

Name = tuple[str, str]
"""A file, and one of its passes or frames."""


def label(name: Name) -> str:
    """``operations: Limits`` for a file and one of its passes."""
    path, what = name
    return f"{Path(path).stem}: {what}"


def names(folders: Iterable[str]) -> Iterator[Name]:
    """All materials of some folders; of files with frames, these."""
    from burnish.api import entry_points as api

    for folder in folders:
        for path in sorted(Path(folder).glob("*.burnish")):
            if frames := _FRAMES.findall(path.read_text("utf-8")):
                yield from ((str(path), frame) for frame in frames)
                continue
            for _rig, pass_ in api.variants(path):
                if pass_ is not None and f"{path.stem}: {pass_}" not in DEFECTIVE:
                    yield str(path), pass_


def compiled(name: Name) -> Judged:
    """A material or a frame, compiled for the profiles of all routes that draw."""
    import burnish
    from burnish.targets.runner.routes import ROUTES

    path, what = name
    profiles = [ROUTES[route].profile for route in DRAWN]
    if what in _FRAMES.findall(Path(path).read_text("utf-8")):
        frames = burnish.compile(path, profiles, partial=True).frames
        return next(frame for frame in frames if frame.name == what)
    (material,) = burnish.compile(path, profiles, pass_=what, partial=True).materials
    return material


def shaders_of(subject: Judged) -> Sequence[CompiledMaterial]:
    """The shaders of a frame; of a material, itself."""
    from burnish.api.entry_points import CompiledFrame

    return subject.shaders if isinstance(subject, CompiledFrame) else (subject,)


def description(subject: Judged) -> object:
    """The host's description of a subject: the reflection, or the plan and the reference's plan."""
    from burnish.api.entry_points import CompiledFrame

    if isinstance(subject, CompiledFrame):
        return subject.plan, subject.plan_of_reference, [s.reflection for s in subject.shaders]
    return subject.reflection


def lacks(subject: Judged, route: Route) -> str | None:
    """The feature that a route lacks to draw a subject, or ``None``."""
    every = (shader.lacking.get(route.profile) for shader in shaders_of(subject))
    return next(filter(None, every), None)


def behaviour(name: Name, *, told: bool) -> Iterator[tuple[str, str]]:
    """Digests of the texts on each route and, if ``told``, of what its driver is told."""
    subject = compiled(name)
    for route, text in texts(subject):
        yield f"{label(name)}, {route}: text", digest(text)
    if told:
        for route, data in told_to_drivers(subject):
            yield f"{label(name)}, {route}: told", digest(data)


def texts(subject: Judged) -> Iterator[tuple[str, object]]:
    from burnish.targets.runner.routes import ROUTES

    for name in DRAWN:
        if lacks(subject, ROUTES[name]) is None:
            texts = [
                (file.text, sorted(file.entry_points.items()))
                for shader in shaders_of(subject)
                for file in shader.files
                if f"{file.target}:{file.profile}" == ROUTES[name].profile
            ]
            yield name, (texts, description(subject))


def told_to_drivers(subject: Judged) -> Iterator[tuple[str, object]]:
    """The data that each route's driver is told, without the code."""
    from burnish.api.entry_points import CompiledFrame

    if isinstance(subject, CompiledFrame):
        return _told_of_frame(subject)
    return _told_of_material(subject)


def _told_of_material(material: CompiledMaterial) -> Iterator[tuple[str, object]]:
    from burnish.targets.conformance.cases import series_of
    from burnish.targets.runner.binding import pipeline
    from burnish.targets.runner.drivers.wire import to_json
    from burnish.targets.runner.exact import Exact
    from burnish.targets.runner.frames.states import states_job

    work = [
        (Exact.of(material) if series.exact else material, [case.state for case in series.cases])
        for series in series_of(material.reflection)
    ]
    for route, (codes,) in _codes(material):
        yield (
            route.name,
            [
                to_json(states_job(form, states, pipeline(form.reflection, route, codes)))
                for form, states in work
            ],
        )


def _told_of_frame(frame: CompiledFrame) -> Iterator[tuple[str, object]]:
    from burnish.targets.conformance.judged_frames import host_of
    from burnish.targets.runner.drivers.wire import to_json
    from burnish.targets.runner.frames.by_route import frame_job

    outputs = [row.name for row in frame.plan.outputs if row.texture is not None]
    for route, codes in _codes(frame):
        host = host_of(frame, _FRAME_SIZE)
        yield route.name, to_json(frame_job(host, route, codes, outputs, _FRAME_COUNT))


def _codes(subject: Judged) -> Iterator[tuple[Route, Sequence[Codes]]]:
    """The routes that draw it, each with the entry points of all shaders, without any code."""
    from burnish.targets.runner.codes import Codes
    from burnish.targets.runner.drivers.pipeline import Code
    from burnish.targets.runner.routes import ROUTES

    for route in map(ROUTES.__getitem__, DRAWN):
        if lacks(subject, route) is None:
            yield route, [
                Codes({
                    stage: Code(entry, "")
                    for file in shader.files
                    if f"{file.target}:{file.profile}" == route.profile
                    for stage, entry in file.entry_points.items()
                })
                for shader in shaders_of(subject)
            ]  # fmt: skip


def digest(data: Any) -> str:
    text = json.dumps(data, sort_keys=True, default=str)
    return blake2b(text.encode(), digest_size=8).hexdigest()
