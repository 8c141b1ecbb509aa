"""What a material comes to: its texts, and what drivers are told, as digests."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from hashlib import blake2b
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from burnish.api import CompiledMaterial

DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga", "llvmpipe:gl330")
"""The fastest route of each language, in the order in which they draw."""
DEFECTIVE = {"gathered: Varying"}
"""Materials that show a driver's bug."""

Name = tuple[str, str]
"""A file, and one of its passes."""


def label(name: Name) -> str:
    """``operations: Limits`` for a file and one of its passes."""
    path, pass_ = name
    return f"{Path(path).stem}: {pass_}"


def names(folders: Iterable[str]) -> Iterator[Name]:
    """All materials of some folders."""
    from burnish import api

    for folder in folders:
        for path in sorted(Path(folder).glob("*.burnish")):
            for _rig, pass_ in api.variants(path):
                if pass_ is not None and f"{path.stem}: {pass_}" not in DEFECTIVE:
                    yield str(path), pass_


def compiled(name: Name) -> CompiledMaterial:
    """A material, compiled for the profiles of all routes that draw."""
    import burnish
    from burnish.targets.runner.routes import ROUTES

    path, pass_ = name
    profiles = [ROUTES[route].profile for route in DRAWN]
    (material,) = burnish.compile(path, profiles, pass_=pass_, partial=True).materials
    return material


def behaviour(name: Name, *, told: bool) -> Iterator[tuple[str, str]]:
    """Digests of a material's texts on each route and, if ``told``, of what its driver is told."""
    material = compiled(name)
    for route, text in texts(material):
        yield f"{label(name)}, {route}: text", digest(text)
    if told:
        for route, data in told_to_drivers(material):
            yield f"{label(name)}, {route}: told", digest(data)


def texts(material: CompiledMaterial) -> Iterator[tuple[str, object]]:
    from burnish.targets.runner.routes import ROUTES

    for name in DRAWN:
        profile = ROUTES[name].profile
        if profile not in material.lacking:
            files = [file for file in material.files if f"{file.target}:{file.profile}" == profile]
            texts = [(file.text, sorted(file.entry_points.items())) for file in files]
            yield name, (texts, material.reflection)


def told_to_drivers(material: CompiledMaterial) -> Iterator[tuple[str, object]]:
    """For each route what its driver is told, without the code."""
    from burnish.targets.conformance.cases import series_of
    from burnish.targets.runner.binding import pipeline
    from burnish.targets.runner.codes import Codes
    from burnish.targets.runner.drivers.draw_job import Job
    from burnish.targets.runner.drivers.pipeline import Code
    from burnish.targets.runner.drivers.wire import to_json
    from burnish.targets.runner.routes import ROUTES

    work = [
        (series.exact, [to_json(case.state.draw()) for case in series.cases])
        for series in series_of(material.reflection)
    ]
    for name in DRAWN:
        route = ROUTES[name]
        if route.profile not in material.lacking:
            entries = {
                stage: Code(entry, "")
                for file in material.files
                if f"{file.target}:{file.profile}" == route.profile
                for stage, entry in file.entry_points.items()
            }
            jobs = [
                to_json(Job(pipeline(material.reflection, route, Codes(entries), exact=exact), ()))
                for exact, _ in work
            ]
            yield name, (jobs, work)


def digest(data: object) -> str:
    text = json.dumps(data, sort_keys=True, default=str)
    return blake2b(text.encode(), digest_size=8).hexdigest()
