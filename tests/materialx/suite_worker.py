"""The process that imports and compares documents for ``suite.py``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from burnish.materialx.fidelity.checker import Checker
from burnish.materialx.fidelity.checking import Checked, check
from burnish.materialx.fidelity.claims import claims_of
from burnish.materialx.fidelity.records import FidelityError
from burnish.materialx.importing import Imported, imported
from burnish.targets.toolchain.pipe import Packet, serve

ORPHAN_LIMIT = 1800.0


def compared(
    checker: Checker, document: Path, image_folders: tuple[Path, ...] = ()
) -> Iterator[Mapping[str, Any]]:
    """A row for each renderable of a document, those that were not converted included."""
    try:
        found = imported(document, image_folders=image_folders)
        names = checker.renderables(document)
    except Exception as error:  # a converter that fails is a result, too
        yield not_run("", f"not imported: {told(error)}")
        return
    with TemporaryDirectory(prefix="burnish-") as folder:
        write_import(Path(folder), found)
        rows = _rows(checker, document, found, Path(folder), image_folders)
        for name in names:
            yield rows.pop(name) if name in rows else not_run(name, _problem(found, name))
        yield from rows.values()


def _rows(
    checker: Checker,
    document: Path,
    found: Imported,
    folder: Path,
    image_folders: tuple[Path, ...],
) -> dict[str, Mapping[str, Any]]:
    rows = {}
    try:
        source = folder / found.main
        for claim in claims_of(document, source, found.materials, image_folders):
            try:
                rows[claim.renderable] = _row(check(checker, claim))
            except Exception as error:  # so is a compiler that fails
                rows[claim.renderable] = not_run(claim.renderable, f"failed: {told(error)}")
    except FidelityError as error:
        rows[""] = not_run("", str(error))
    return rows


def _row(checked: Checked) -> Mapping[str, Any]:
    row: dict[str, Any] = {
        "renderable": checked.renderable, "verdict": checked.verdict, "reason": checked.reason,
        "missing": list(checked.missing),
    }  # fmt: skip
    likeness = checked.likeness
    if likeness is not None:
        row |= {
            "drawn": likeness.drawn, "beyond": likeness.beyond, "largest": likeness.largest,
            "percentiles": list(likeness.percentiles),
        }  # fmt: skip
    return row


def not_run(name: str, reason: str) -> Mapping[str, Any]:
    """The row of a renderable that nothing has drawn."""
    return {"renderable": name, "verdict": "not run", "reason": reason}


def told(error: Exception) -> str:
    """The kind and the words of an error."""
    return f"{type(error).__name__}: {error}"


def _problem(found: Imported, name: str) -> str:
    """What the import says of a renderable for which it has no material."""
    texts = [each.text for each in found.problems if each.path.startswith(name.partition("/")[0])]
    texts += [each.text for each in found.problems]
    return f"not converted: {texts[0] if texts else 'nothing is said of it'}"


def write_import(folder: Path, found: Imported) -> None:
    """Write the files of an import into a folder."""
    for name, content in found.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


class _Worker:
    def __init__(self) -> None:
        self._checker = Checker()

    def answer(self, request: Packet) -> Packet:
        """The rows of a document."""
        document = Path(request.content["document"])
        folders = tuple(map(Path, request.content["image_folders"]))
        return Packet({"rows": list(compared(self._checker, document, folders))})


if __name__ == "__main__":
    serve(_Worker().answer, ORPHAN_LIMIT)
