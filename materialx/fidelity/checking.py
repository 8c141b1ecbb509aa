"""Checks a material of Burnish against the document that it was made of, by two pictures.

A check that cannot run is never one that has passed: its verdict is ``not run``, with the reason.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...compiler.diagnostics.diagnostic import CompileError
from .checker import Checker, Drawn
from .comparing import Likeness, Verdict, compare
from .images import NamedImage
from .records import FidelityError
from .settings import ONE_LIGHT, Setting


@dataclass(frozen=True, slots=True)
class Claim:
    """A material that claims to be what a renderable of a document is."""

    document: Path
    renderable: str
    source: Path | str
    """The file of Burnish, or its text."""
    material: str
    values: Mapping[str, Any] = field(default_factory=dict)
    """The values of parameters, and the textures, that are no defaults."""
    by_host: bool = True
    """True if textures are decoded from sRGB by the host, before filtering, on both sides."""
    image_folders: tuple[Path, ...] = ()
    """The folders in which the document's images may lie, besides its own."""
    is_displaced: bool = False
    """True if the material moves its surface. MaterialX's own GLSL moves nothing, so the picture is
    drawn without."""


@dataclass(frozen=True, slots=True)
class Checked:
    """The result of a check."""

    renderable: str
    verdict: Verdict
    reason: str
    """The likeness in words, or why the check did not run."""
    likeness: Likeness | None = None
    missing: tuple[str, ...] = ()
    """The files that are not there: both sides draw default colours in their place."""


def check(checker: Checker, claim: Claim, setting: Setting = ONE_LIGHT) -> Checked:
    """Draw both sides of a claim, and compare them."""
    try:
        theirs = checker.draw(
            claim.document,
            claim.renderable,
            setting,
            image_folders=claim.image_folders,
            by_host=claim.by_host,
        )
        values = _with_defaults(claim.values, theirs)
        ours = checker.ours(
            claim.source, claim.material, setting, values, is_still=claim.is_displaced
        )
    except FidelityError as error:
        return Checked(claim.renderable, "not run", str(error))
    except CompileError as error:
        return Checked(claim.renderable, "not run", f"the material does not compile: {error}")
    found = compare(ours.picture, theirs.picture)
    return Checked(claim.renderable, found.verdict, found.sentence(), found, tuple(theirs.missing))


def _with_defaults(values: Mapping[str, Any], theirs: Drawn) -> Mapping[str, Any]:
    """The same values, with MaterialX's colours in place of images that are not there."""
    return {
        name: value.with_default(theirs.missing) if isinstance(value, NamedImage) else value
        for name, value in values.items()
    }
