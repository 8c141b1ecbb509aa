"""Compares imported materials with MaterialX's own pictures, for ``burnish import --check``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from .console import Styled, say
from .progress import Progress

if TYPE_CHECKING:
    from ..materialx.fidelity.checking import Checked, Claim
    from ..materialx.importing import Imported

COLORS = {"alike": "green", "different": "red", "not run": "yellow"}
HEADINGS = ("verdict  ", "pixels apart", "largest difference")


def is_faithful(
    found: Imported, main: Path, document: Path, image_folders: tuple[Path, ...]
) -> bool:
    """Draw the materials of a file that was just written beside those of its document, and print a
    table; false if any of them differs, or if nothing could be compared."""
    from ..materialx.fidelity.claims import claims_of

    claims = list(claims_of(document, main, found.materials, image_folders))
    width = max(len("material"), *(len(claim.material) for claim in claims))
    say(f"{'material':{width}}  {'  '.join(HEADINGS)}")
    verdicts: Counter[str] = Counter()
    with Progress("comparing") as progress:
        for number, (claim, row) in enumerate(_checked(claims), start=1):
            verdicts[row.verdict] += 1
            progress.aside(partial(_say_row, claim.material, width, row))
            progress.tell(number / len(claims))
    counts = [f"{verdicts[verdict]} {verdict}" for verdict in COLORS if verdicts[verdict]]
    say(f"beside MaterialX's own pictures: {', '.join(counts)}")
    displaced = [claim.material for claim in claims if claim.is_displaced]
    if displaced:
        names = ", ".join(displaced)
        say(f"compared without displacement, which MaterialX's GLSL leaves out: {names}")
    return not verdicts["different"] and bool(verdicts["alike"])


def _checked(claims: Sequence[Claim]) -> Iterator[tuple[Claim, Checked]]:
    from ..materialx.fidelity.checker import Checker
    from ..materialx.fidelity.checking import check

    with Checker() as checker:
        for claim in claims:
            yield claim, check(checker, claim)


def _say_row(name: str, width: int, row: Checked) -> None:
    """Print a line of the table, and why a material is not alike."""
    verdict = Styled(f"{row.verdict:{len(HEADINGS[0])}}", COLORS[row.verdict])
    likeness = row.likeness
    if likeness is None:
        say(f"{name:{width}}  ", verdict, f"  {row.reason}")
        return
    pixels = f"{likeness.beyond} of {likeness.drawn}"
    say(
        f"{name:{width}}  ", verdict,
        f"  {pixels:{len(HEADINGS[1])}}  {likeness.largest:.3g}",
    )  # fmt: skip
