"""The process that holds imported documents against their bounds, for ``suite.py --bounds``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import burnish
from burnish.api.entry_points import CompiledMaterial, variants
from burnish.materialx.importing import imported
from burnish.targets.conformance.cases import SIZE, Size
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import cells, details
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.toolchain.pipe import Packet, serve

from ..conformance.kit import PROFILES, Studio
from .suite_worker import ORPHAN_LIMIT, not_run, told, write_import


def judged(
    studio: Studio, document: Path, image_folders: tuple[Path, ...] = ()
) -> Iterator[Mapping[str, Any]]:
    """A row for each material of a document, drawn under each of its rigs, and each route."""
    with TemporaryDirectory(prefix="burnish-") as folder:
        try:
            source, names = written(document, Path(folder), image_folders)
        except Exception as error:  # a converter that fails is a result, too
            yield not_run("", f"not imported: {told(error)}")
            return
        for name in names:
            try:
                materials = _compiled(source, name)
            except Exception as error:  # so is a compiler that fails
                yield not_run(name, f"not compiled: {told(error)}")
                continue
            for label, material in materials:
                for row in rows_of(studio, material, list(ROUTES.values())):
                    yield {"renderable": label, "route": row.route.name, **_numbers(row)}


def written(
    document: Path, folder: Path, image_folders: tuple[Path, ...] = ()
) -> tuple[Path, Sequence[str]]:
    """The file with the materials of a document, and their names; it is written to the folder.

    Raises ``DocumentError``.
    """
    found = imported(document, image_folders=image_folders)
    write_import(folder, found)
    return folder / found.main, [material.name for material in found.materials]


def _compiled(source: Path, name: str) -> list[tuple[str, CompiledMaterial]]:
    """A material under each rig of its file, compiled for all routes, with labels."""
    found = []
    for rig, pass_ in variants(source):
        result = burnish.compile(
            source, PROFILES, material=name, rig=rig, pass_=pass_, partial=True
        )
        label = " × ".join(filter(None, (name, rig, pass_)))
        found += [(label, material) for material in result.materials]
    return found


def rows_of(
    studio: Studio, material: CompiledMaterial, routes: Sequence[Route], size: Size = SIZE
) -> list[Row]:
    """The rows of ``burnish conform`` about one material."""
    return conform(
        [(material.name, material)], routes, studio.runner, studio.toolchain, size=size, keep=False
    )


def _numbers(row: Row) -> Mapping[str, Any]:
    _route, _status, difference, of_bound, steps, unproven = cells(row)
    return {
        "verdict": row.status, "reason": "\n".join(details(row)), "difference": difference,
        "of_bound": of_bound, "steps": steps, "unproven": unproven,
    }  # fmt: skip


class _Worker:
    def __init__(self) -> None:
        self._studio = Studio()

    def answer(self, request: Packet) -> Packet:
        """The rows of a document."""
        document = Path(request.content["document"])
        folders = tuple(map(Path, request.content["image_folders"]))
        return Packet({"rows": list(judged(self._studio, document, folders))})


if __name__ == "__main__":
    serve(_Worker().answer, ORPHAN_LIMIT)
