"""Pictures that people give textures on the page of ``burnish view``: chosen or dropped files."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Page

from burnish.commands.view.keeping import Keeping
from burnish.commands.view.pictures import Pictures, Wanted
from burnish.commands.view.uploads import MOST_BYTES
from burnish.targets.runner.textures.kinds import PictureError

from .kit import Viewer
from .pages import Color, shows, srgb, write

pytestmark = pytest.mark.xdist_group("pictures of view")  # One server and browser serve all.

EXAMPLES = Path(__file__).parents[2] / "examples"
PAINTED = """
material Painted {
    map paint : texture2d = black               /// What is seen
    map bumps : texture2d = flat_normal
    color = paint(uv).rgb * ceil(bumps(uv).b)
}
"""
GRAY = 0x80
MEANT: Color = (GRAY, GRAY, GRAY)
"""Colours that are sRGB are seen as they are in the file."""
AS_NUMBERS: Color = (srgb(GRAY / 255),) * 3
FLAT = Wanted("2d", "float")


def png(color: Color = MEANT, size: tuple[int, int] = (4, 4)) -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", size, color).save(stream, "PNG")
    return stream.getvalue()


def choose(page: Page, name: str, file: str, content: bytes) -> None:
    row = page.locator(f"[data-name={name}]")
    row.locator("[type=file]").set_input_files(
        {"name": file, "mimeType": "image/png", "buffer": content}
    )


def test_a_texture_is_given_a_picture(page: Page, viewer: Viewer) -> None:
    """The picture stays when the file changes, and when the page is loaded again."""
    write(viewer, PAINTED)
    row = page.locator("[data-name=paint]")
    row.wait_for()
    shows(page, (0, 0, 0))
    assert row.locator(".file").inner_text() == "All black"
    choose(page, "paint", "gray.png", png())
    shows(page, MEANT)
    assert row.locator(".file").inner_text() == "gray.png"
    box = row.locator("[type=checkbox]")
    assert box.is_checked()
    box.uncheck()
    shows(page, AS_NUMBERS)

    write(viewer, PAINTED.replace("paint(uv).rgb *", "1 - paint(uv).rgb *"))
    shows(page, (srgb(1 - GRAY / 255),) * 3)
    page.reload()
    shows(page, (srgb(1 - GRAY / 255),) * 3)
    row.locator(".reset").click()
    shows(page, (255, 255, 255))
    assert row.locator(".file").inner_text() == "All black"


WORN = """
material Worn {
    map paint  : texture2d = flat_normal
    map wear   : texture2d
    map stains : texture2d with { intent = data }
    color = paint(uv).rgb * wear(uv).r * stains(uv).rgb
}
"""


@pytest.mark.parametrize(("name", "is_srgb"), [("paint", True), ("wear", False), ("stains", False)])
def test_the_intent_says_whether_colours_are_meant(
    page: Page, viewer: Viewer, name: str, is_srgb: bool
) -> None:
    """It is that of the reflection, whichever texture is read without a picture."""
    write(viewer, WORN)
    choose(page, name, "gray.png", png())
    box = page.locator(f"[data-name={name}] [type=checkbox]")
    box.wait_for()
    assert box.is_checked() == is_srgb


def test_files_that_are_no_pictures(page: Page, viewer: Viewer) -> None:
    """The error stands below the texture, which keeps its earlier picture."""
    write(viewer, PAINTED)
    choose(page, "paint", "gray.png", png())
    shows(page, MEANT)
    choose(page, "paint", "text.png", b"not a picture")
    wrong = page.locator("[data-name=paint] .wrong")
    wrong.wait_for()
    assert wrong.inner_text() == (
        "text.png is not a picture of a known format: PNG, JPEG, WEBP, GIF, BMP, TGA or TIFF"
    )
    shows(page, MEANT)
    assert page.locator("#problem").is_hidden()
    choose(page, "paint", "white.png", png((255, 255, 255)))
    shows(page, (255, 255, 255))
    assert wrong.count() == 0


DROP = """([selector, bytes]) => {
  const dropped = new DataTransfer();
  const content = new Uint8Array(bytes);
  dropped.items.add(new File([content], "gray.png", { type: "image/png" }));
  const place = document.querySelector(selector);
  for (const name of ["dragover", "drop"]) {
    place.dispatchEvent(new DragEvent(name, { dataTransfer: dropped, bubbles: true }));
  }
}"""


def test_files_are_dropped(page: Page, viewer: Viewer) -> None:
    """On one of several textures; and anywhere, if there is one only."""
    write(viewer, PAINTED)
    page.locator("[data-name=paint]").wait_for()
    content = list(png())
    page.evaluate(DROP, ["#picture", content])
    assert page.locator("#notice").inner_text() == "Drop it on one of these: paint, bumps."
    page.evaluate(DROP, ["[data-name=paint] .doc", content])
    shows(page, MEANT)
    write(viewer, "material Alone { map paint : texture2d  color = paint(uv).rgb }")
    page.wait_for_selector("h2:has-text('Alone')")
    shows(page, (255, 255, 255))
    page.evaluate(DROP, ["#picture", content])
    shows(page, MEANT)


def test_the_server_takes_pictures_only(viewer: Viewer) -> None:
    def send(body: bytes, query: str = "name=a.png&dimension=2d&sample=float") -> tuple[int, str]:
        answer = viewer.ask(f"/picture?{query}", "POST", body)
        return answer.status, answer.body.decode()

    status, word = send(png())
    assert (status, len(word)) == (200, 32)
    assert send(png()) == (200, word)
    assert send(b"") == (
        422,
        "a.png is not a picture of a known format: PNG, JPEG, WEBP, GIF, BMP, TGA or TIFF",
    )
    assert send(png(), "name=a.png&dimension=4d&sample=float")[0] == 400
    assert send(png(), "name=a.png")[0] == 400
    cube = send(png(), "name=a.png&dimension=cube&sample=float")
    assert cube == (422, "a cube takes six pictures, or a panorama of floats, and not a.png")
    assert viewer.ask("/picture").status == 405
    assert viewer.ask("/picture", "POST", png(), Origin="http://evil.example").status == 403
    # Nobody has given these, so nothing is given.
    found = viewer.ask("/document?picture.paint=0123&picture.none=srgb:..%2F..").json()
    assert all(row["picture"] is None for row in found["controls"])


def test_how_large_pictures_may_be(viewer: Viewer, monkeypatch: pytest.MonkeyPatch) -> None:
    query = "/picture?name=a.png&dimension=2d&sample=float"
    answer = viewer.ask(query, "POST", bytes(MOST_BYTES + 1))
    assert (answer.status, answer.body) == (413, b"the file is larger than 64 MB")
    pictures = Pictures(Keeping())
    with pytest.raises(PictureError, match=r"wide\.png has 9000 x 1 texels, and no side may have"):
        pictures.keep("wide.png", png(size=(9000, 1)), FLAT)
    monkeypatch.setattr("burnish.commands.view.pictures.MOST_TEXELS", 1 << 20)
    with pytest.raises(PictureError, match=r"a\.png makes a texture of 5 MB, and the page takes 1"):
        pictures.keep("a.png", png(size=(1024, 1024)), FLAT)


def test_files_that_were_asked_for_longest_ago_go(monkeypatch: pytest.MonkeyPatch) -> None:
    """Old files go if there is no room for all; a file that is too large by itself is refused."""
    pictures = Pictures(Keeping())
    files = [png((shade, 0, 0)) for shade in (10, 20, 30)]
    first, second = (pictures.keep("a.png", file, FLAT) for file in files[:2])
    monkeypatch.setattr(Keeping, "most", 2 * (len(files[0]) + len(repr(first))))
    assert pictures.get(first)
    third = pictures.keep("a.png", files[2], FLAT)
    found = [pictures.get(word) is not None for word in (first, second, third)]
    assert found == [True, False, True]
    assert pictures.texture(second, FLAT) is None
    monkeypatch.setattr(Keeping, "most", 1)
    with pytest.raises(PictureError, match=r"no room to keep b\.png: a "):
        pictures.keep("b.png", files[0], FLAT)


def test_panoramas_are_cubes_of_floats() -> None:
    """The numbers of a panorama are linear, even if sRGB is asked for."""
    file = EXAMPLES / "pictures" / "garden.hdr"
    pictures, wanted = Pictures(Keeping()), Wanted("cube", "float")
    word = pictures.keep("sky.HDR", file.read_bytes(), wanted)
    texture = pictures.texture(f"srgb:{word}", wanted)
    assert texture is not None
    assert (texture.dimension, texture.format, texture.depth) == ("cube", "rgba32float", 6)
    assert not pictures.is_srgb(f"srgb:{word}", wanted)
    with pytest.raises(PictureError, match=r"sky\.hdr is no file of the format that its name says"):
        pictures.keep("sky.hdr", png(), wanted)
