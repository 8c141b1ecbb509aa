"""Runs in a process of its own, and imports a copy of the package: is its mutant noticed?

``python judge.py FOLDER BEHAVIOUR`` compiles the materials of a folder, and compares their texts
and what drivers are told with the file BEHAVIOUR, which the unchanged package has written (with
``--write``). Of what is different, it draws pictures until one is wrong. It prints one line of
JSON. It imports nothing of the tests, as the copy does not contain them.
"""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Iterator, Mapping
from hashlib import blake2b
from pathlib import Path
from typing import Any

import burnish
from burnish import api
from burnish.api import CompiledMaterial
from burnish.targets.conformance.cases import series_of
from burnish.targets.conformance.conform import conform
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.draw import Code, Job
from burnish.targets.runner.drivers.wire import to_json
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga", "llvmpipe:gl330")
"""The fastest route of each language, in the order in which they draw."""
PROFILES = tuple(ROUTES[name].profile for name in DRAWN)

NOTICED = ("differs", "failed")

DEFECTIVE = {"gathered: Varying"}
"""Materials that show a driver's bug."""

Behaviour = dict[str, str]
"""Digests of what each material comes to on each route, by ``material route``."""


def main(folder: Path, behaviour: Path, *options: str) -> dict[str, Any]:
    """The verdict as data."""
    compiled = dict(_compiled(folder))
    made = {
        f"{name} {route}": digest
        for name, material in compiled.items()
        for route, digest in _behaviours(material)
    }
    if "--write" in options:
        behaviour.write_text(json.dumps(made), encoding="utf-8")
        return {"verdict": "written"}
    known: Behaviour = json.loads(behaviour.read_text("utf-8"))
    different = [
        (name, route)
        for route in DRAWN
        for name in compiled
        if made.get(f"{name} {route}") != known.get(f"{name} {route}") or "--all" in options
    ]
    lost = sorted(known.keys() - made.keys())
    if lost:
        return {"verdict": "caught", "by": f"nothing for {lost[0]}"}
    if not different:
        return {"verdict": "same"}
    return _drawn(compiled, different)


def _compiled(folder: Path) -> Iterator[tuple[str, CompiledMaterial]]:
    for path in sorted(folder.glob("*.burnish")):
        for _rig, pass_ in api.variants(path):
            name = f"{path.stem}: {pass_}"
            if pass_ is None or name in DEFECTIVE:
                continue
            (material,) = burnish.compile(path, PROFILES, pass_=pass_, partial=True).materials
            yield name, material


def _behaviours(material: CompiledMaterial) -> Iterator[tuple[str, str]]:
    """For each route a digest of what its driver is told, with texts in place of code."""
    work = [
        (series.exact, tuple(to_json(case.state.draw()) for case in series.cases))
        for series in series_of(material.reflection)
    ]
    for name in DRAWN:
        route = ROUTES[name]
        if route.profile in material.lacking:
            continue
        texts = {
            stage: Code(entry, file.text)
            for file in material.files
            if f"{file.target}:{file.profile}" == route.profile
            for stage, entry in file.entry_points.items()
        }
        told = [
            to_json(Job(pipeline(material.reflection, route, Codes(texts), exact=exact), ()))
            for exact, _ in work
        ]
        data = json.dumps([told, work], sort_keys=True).encode()
        yield name, blake2b(data, digest_size=16).hexdigest()


def _drawn(
    compiled: Mapping[str, CompiledMaterial], different: list[tuple[str, str]]
) -> dict[str, Any]:
    """The first picture that is wrong."""
    with Runner([ROUTES[name] for name in DRAWN]) as runner, Toolchain() as toolchain:
        for name, route in different:
            rows = conform([(name, compiled[name])], [ROUTES[route]], runner, toolchain)
            if rows[0].status in NOTICED:
                return {"verdict": "caught", "by": f"{name}, {route}: {rows[0].status}"}
    return {"verdict": "survived", "different": [f"{name}, {route}" for name, route in different]}


if __name__ == "__main__":
    try:
        found = main(Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:])
    except Exception as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{Path(where.filename).name}:{where.lineno}"
        found = {"verdict": "caught", "by": f"{type(error).__name__} at {place}"}
    print(json.dumps(found))
