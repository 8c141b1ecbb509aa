"""The pages that are made from tables are those that the tables make."""

from __future__ import annotations

import pytest

from .generate import PAGES
from .tables import DOCS


@pytest.mark.parametrize("name", PAGES)
def test_up_to_date(name: str) -> None:
    page = (DOCS / name).read_text(encoding="utf-8")
    assert page == PAGES[name](), "run `python -m tests.docs.generate`"
