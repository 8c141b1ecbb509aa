"""The memory of ``burnish view`` keeps to a limit, whatever pages send and files become."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import pytest

from burnish.commands.view.documents import Documents
from burnish.commands.view.keeping import Keeping, Shelf
from burnish.commands.view.pictures import Pictures, Wanted
from burnish.compiler.budget import allowed, raised
from burnish.targets.runner.textures.kinds import PictureError

from .kit import Viewer, viewing
from .test_pictures import PAINTED, png

QUERY = "/picture?name=a.gif&dimension=2d&sample=float"
SLACK = 200
"""MB that a server may take more than after its first request."""


def gif(side: int) -> bytes:
    """35 bytes that say to be a picture of so many pixels a side, of which they hold one."""
    screen = struct.pack("<HH", side, side) + b"\x80\0\0" + b"\0\0\0\xff\xff\xff"
    return b"GIF89a" + screen + b",\0\0\0\0\x01\0\x01\0\0" + b"\x02\x02D\x01\0;"


def memory(viewer: Viewer, what: str) -> int:
    """MB that a server has now (``VmRSS``), or has had at its peak (``VmHWM``)."""
    status = Path(f"/proc/{viewer.program.pid}/status").read_text()
    found = re.search(rf"{what}:\s+(\d+) kB", status)
    assert found
    return int(found[1]) >> 10


def test_refused_pictures_leave_nothing(tmp_path: Path) -> None:
    """A check takes no memory, as the first bytes of a picture suffice to refuse it."""
    file = tmp_path / "m.burnish"
    file.write_text(PAINTED)
    with viewing(file) as viewer:
        assert viewer.ask("/document").status == 200
        viewer.ask(QUERY, "POST", png())
        before = memory(viewer, "VmRSS")
        for _ in range(30):
            answer = viewer.ask(QUERY, "POST", gif(8192))
            assert (answer.status, answer.body.decode()) == (
                422, "a.gif makes a texture of 341 MB, and the page takes 96",
            )  # fmt: skip
        for size in range(1, 30):
            assert viewer.ask(QUERY, "POST", png(size=(64, 64))[:-size]).status in (200, 422)
        assert memory(viewer, "VmHWM") < before + SLACK


def test_pictures_are_kept_within_the_limit(tmp_path: Path) -> None:
    """Documents with pictures are dropped when there are too many, and so are the textures."""
    file = tmp_path / "m.burnish"
    file.write_text(PAINTED)
    with viewing(file, "--budget", "memory=240M") as viewer:
        viewer.ask("/document")
        before = memory(viewer, "VmRSS")
        for shade in range(24):
            word = viewer.ask(QUERY, "POST", png((shade, 0, 0), (1024, 1024))).body.decode()
            document = viewer.ask(f"/document?picture.paint={word}")
            assert len(document.body) > 5 << 20
        assert memory(viewer, "VmRSS") < before + SLACK


def test_more_pictures_than_a_page_can_have(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PAINTED)
    with viewing(file, "--budget", "memory=28M") as viewer:
        word = viewer.ask(QUERY, "POST", png(size=(1024, 1024))).body.decode()
        found = viewer.ask(f"/document?picture.paint={word}").json()
        assert "a page that draws Painted needs 28" in found["error"]
        assert "`--budget memory=" in found["error"]
        assert "error" not in viewer.ask("/document").json()


def test_what_is_dropped_first() -> None:
    """The entries used longest ago go first: those of the first shelf before all others."""
    keeping = Keeping()
    easy, hard = (Shelf[str, bytes](keeping, len) for _ in range(2))
    key = len(repr("a"))
    with raised({"memory": 4 * (30 + 3 * key)}):
        assert all(shelf.put(name, bytes(10)) for shelf, name in ((hard, "a"), (easy, "b")))
        assert easy.put("c", bytes(10))
        assert easy.get("b") is not None
        assert keeping.size == keeping.most == 30 + 3 * key
        assert easy.put("d", bytes(10))
        assert [easy.get(name) is not None for name in "bcd"] == [True, False, True]
        assert hard.put("e", bytes(20))
        assert (easy.get("b"), easy.get("d")) == (None, None)
        assert hard.get("a") is not None
        assert not hard.put("f", bytes(1000))
        assert not easy.put("g", bytes(30))  # There is no room beside what cannot be made again.
        hard.forget(lambda name: name != "a")
        assert keeping.size == 10 + key


def test_all_that_is_kept_has_one_limit() -> None:
    keeping = Keeping()
    made, pictures = Documents.shelf(keeping), Pictures(keeping)
    assert keeping.most == allowed("memory") // 4
    pictures.keep("a.png", png(), Wanted("2d", "float"))
    assert keeping.size > 0
    assert made.size == 0
    with pytest.raises(PictureError, match=r"a\.gif makes a texture of 183 MB"):
        pictures.keep("a.gif", gif(6000), Wanted("2d", "float"))
