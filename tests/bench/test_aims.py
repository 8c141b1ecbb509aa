"""The table of aims has a row for everything at tiny sizes, with other compilers and without."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

import pytest

import burnish

from .aims import PRINCIPLED, Effort, measure
from .checkout import Checkout
from .edits import long_edit, principled_edit
from .peers import materialx, slang
from .peers.found import Peer, found_peers
from .peers.peer import MissingPeerError, Texts
from .table import Section

ROOT = Path(__file__).parents[2]
TINY = Effort(rounds=1, runs=1, layers=2, lines=30, files=2, chain=10)


def tables() -> dict[str, Section]:
    return {section.name: section for section in measure([Checkout("ms", ROOT)], TINY)}


def test_every_row_is_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    """Peers that are missing are said to be; nobody invents a number for them."""

    def missing() -> dict[str, Texts]:
        raise MissingPeerError("No module named 'MaterialX'")

    monkeypatch.setattr(materialx, "ways", missing)
    monkeypatch.setattr(slang, "ways", lambda: {slang.SLANG: lambda number: [str(number)]})
    found = tables()
    rows = found["aims"].rows
    assert len(rows) == 17
    for row in rows:
        ms = row["ms"]
        assert isinstance(ms, float) and isfinite(ms), row["what"]
        assert row["/ MaterialX, fresh"] == row["/ MaterialX, kept"] == "not run"
    beside = {row["what"]: row["/ Slang"] for row in rows if row["/ Slang"] is not None}
    assert [*beside] == ["surface, three targets, warm"]
    assert "No module named 'MaterialX'" in found["peers"].text()
    assert "not run" in found["aims"].text()


@pytest.mark.parametrize("peer", found_peers(), ids=lambda peer: peer.name)
def test_a_peer_makes_all_texts(peer: Peer) -> None:
    """Each time of another material."""
    if not peer.is_there:
        assert peer.problem
        return
    first, second = peer.texts(), peer.texts()
    assert len(first) == len(second) == 6 and all(first)
    assert all(text.count("\n") > 20 for text in first)


def test_an_edit_changes_one_declaration(tmp_path: Path) -> None:
    for edit in principled_edit(PRINCIPLED, tmp_path / "p"), long_edit(tmp_path / "l", 200):
        edit.make()
        before = edit.path.read_text().splitlines()
        edit.make()
        after = edit.path.read_text().splitlines()
        assert sum(one != other for one, other in zip(before, after, strict=True)) == 1
        assert not burnish.check(edit.path)
    assert 200 <= len(after) < 220
