"""A conformance run finds planted errors: many, one at a time, and each has to show."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.targets.conformance.rows import CaseResult, Row

from .kit import Studio
from .planted import (
    in_compiler,
    in_last_places,
    in_library,
    in_reference,
    in_runtime,
    in_targets,
)
from .planted.planting import Planted
from .subjects import row

PLANTED = [
    *in_targets.PLANTED,
    *in_last_places.PLANTED,
    *in_compiler.PLANTED,
    *in_library.PLANTED,
    *in_runtime.PLANTED,
    *in_reference.PLANTED,
]


@pytest.mark.parametrize("planted", PLANTED, ids=str)
def test_it_is_found(
    studio: Studio, planted: Planted, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with monkeypatch.context() as patch:
        planted.plant(patch, tmp_path)
        found = row(studio, planted.material, planted.route)
    assert found.status == planted.status, _told(found)
    # Nothing is drawn when the error has been found.
    *before, last = [_differs(result) for result in found.results] or [False]
    assert not any(before)
    assert last == (planted.status == "differs")


def _differs(result: CaseResult) -> bool:
    return bool(result.comparison.wrong or result.comparison.changed)


def _told(found: Row) -> str:
    return found.problem or f"{found.proven} of {found.covered}, max: {found.max_difference:g}"
