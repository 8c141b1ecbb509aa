"""``burnish gallery``: what its pages show, in a real browser, from disk; and what is made anew."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image, ImageSequence
from playwright.sync_api import Browser, Page

from burnish.commands.catalogue import catalogue, title_of
from burnish.compiler.syntax.highlighting import pieces

from ..suite import browsers
from ..suite.processes import until
from .kit import invoke, tree

pytestmark = pytest.mark.xdist_group("gallery")  # One process makes the gallery, for all tests.

UP = """//! A colour for each direction.
//!
//!     burnish render up.burnish -o up.png --mesh cube

import tints.{tint}

material Up {
    param base : rgb = #b5651d /// Of <all> sides
    color = tint(base) * (0.5 + 0.5 * normal)
}
"""
TINTS = "fn tint(c: rgb) -> rgb = 0.5 * c\n"
FRAME = """
import std.frames.{FullScreen}

material Clay { color = #b5651d }

pass Shown : FullScreen {
    map drawn : texture2d
    target color : rgba8 = drawn(uv)
}

frame Twice {
    models scene
    lit   = Forward(scene)
    shown = Shown(screen) with { drawn = lit.color }
    output picture = shown.color
}
"""
README = """# Samples

Begin with [up.burnish](up.burnish): a colour for each *direction*.

## Whole frames

Drawn by `burnish render`.

| what | where |
|---|---|
| two passes: `Forward` and another | [frames/twice.burnish](frames/twice.burnish) |
| what is not there | [lost.burnish](lost.burnish) |
"""
OPTIONS = ("--size", 24, "--jobs", 1, "--on", "llvmpipe:gl330", "--routes", "llvmpipe:gl330")


def write(folder: Path) -> None:
    (folder / "frames").mkdir(parents=True)
    (folder / "up.burnish").write_text(UP)
    (folder / "tints.burnish").write_text(TINTS)
    (folder / "frames" / "twice.burnish").write_text(FRAME)
    (folder / "README.md").write_text(README)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, str]]:
    """The folder of a gallery, and what the command has printed."""
    folder = tmp_path_factory.mktemp("gallery")
    write(folder / "samples")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BURNISH_CACHE", str(folder / "cache"))
        result = invoke("gallery", folder / "samples", "-o", folder / "out", *OPTIONS)
        assert (result.exit_code, result.stderr) == (0, "")
        yield folder, result.stdout


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with browsers.browser() as browser:
        yield browser


@pytest.fixture
def page(made: tuple[Path, str], browser: Browser) -> Iterator[Page]:
    """A browser's page that may ask for local files only, and has nothing to complain about."""
    shown = browser.new_page(viewport={"width": 500, "height": 700})
    said: list[str] = []
    asked: list[str] = []
    shown.on("console", lambda message: said.append(message.text))
    shown.on("pageerror", lambda error: said.append(str(error)))
    shown.on("request", lambda request: asked.append(request.url))
    shown.goto((made[0] / "out" / "index.html").as_uri())
    yield shown
    shown.close()
    assert said == []
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []


def cards(page: Page) -> list[str]:
    """The titles of the files that can be seen."""
    return page.locator(".cards > li:visible strong").all_inner_texts()


def test_what_is_told_and_written(made: tuple[Path, str]) -> None:
    folder, told = made
    *steps, last = told.splitlines()
    assert sorted(re.sub(r"^\[\d/3\] ", "", step) for step in steps) == [
        "frames/twice.burnish: 1 agrees", "tints.burnish: nothing to draw",
        "up.burnish: 1 agrees",
    ]  # fmt: skip
    assert re.fullmatch(r"3 files, 3 of them made anew, in \d+ s: .*index\.html", last)
    assert tree(folder / "out") == {
        "index.html", "tints.html",
        "up.html", "up-0-reference.png", "up-1-llvmpipe-gl330.png", "frames-twice.html",
        "frames-twice-0-reference.png", "frames-twice-1-llvmpipe-gl330.png",
    }  # fmt: skip


def test_the_first_page_shows_all_files_as_the_readme_groups_them(page: Page) -> None:
    assert page.locator("h1").inner_text() == "Samples"
    assert page.locator(".group h2").all_inner_texts() == ["Samples", "Whole frames", "Others"]
    titles = ["A colour for each direction", "Two passes: Forward and another", "tints.burnish"]
    assert cards(page) == titles
    pictures = [each.get_attribute("src") for each in page.locator(".cards img").all()]
    assert pictures[0] == pictures[2], "what draws nothing itself is seen in what imports it"
    assert page.locator(".cards img").last.get_attribute("alt") == "as up.burnish uses it"
    # Images are loaded when they are seen. The page's policy lets nothing in it wait for them.
    loaded = "[...document.images].every(image => image.naturalWidth)"
    until(lambda: page.evaluate(loaded), "the images", pause=0.1)
    assert page.evaluate("document.documentElement.scrollWidth") <= 500
    assert page.locator(".routes tbody tr").all_inner_texts()[0].startswith("llvmpipe:gl330\t")


def test_the_filter(page: Page) -> None:
    page.fill("#search", "TWICE forward")
    assert cards(page) == ["Two passes: Forward and another"]
    assert page.locator("#found").inner_text() == "1 of 3"
    page.reload()
    assert cards(page) == ["Two passes: Forward and another"], "the address remembers the words"
    page.fill("#search", "nonsense")
    assert page.locator("#nothing").is_visible()
    page.fill("#search", "")
    page.click("[data-kind=material]")
    assert cards(page) == ["A colour for each direction"]


def test_the_page_of_a_material(page: Page) -> None:
    page.click(".card:has-text('A colour for each')")
    assert page.locator("#pictures figcaption").all_inner_texts()[0].startswith("reference")
    assert page.evaluate("[...document.images].map(i => i.naturalWidth)") == [24, 24]
    assert page.locator("#pictures .command").inner_text() == (
        "burnish render up.burnish -o up.png --mesh cube"
    )
    source = page.locator("#source pre").inner_text()
    assert source.strip() == UP.strip()
    assert page.locator("#source .swatch").count() == 1
    assert page.locator("#shaders figcaption:visible b").all_inner_texts() == [
        "GLSL", "HLSL", "WGSL",
    ]  # fmt: skip
    assert "gl_Position" not in page.locator("#shaders").inner_text()
    page.click("#shaders >> text=vertex")
    assert "gl_Position" in page.locator("#shaders").inner_text()
    assert page.locator("#graph svg title").first.text_content() == (
        "Up, pass Forward, rig Daylight"
    )
    columns = page.locator("#verdicts thead th").all_inner_texts()
    assert page.locator("#verdicts .columns dt").all_inner_texts() == columns
    row = page.locator("#verdicts tbody tr").inner_text()
    assert row.startswith("llvmpipe:gl330\tagrees\t")
    assert page.evaluate("document.documentElement.scrollWidth") <= 500
    page.set_viewport_size({"width": 1280, "height": 700})
    fits = "graph => graph.scrollWidth <= graph.clientWidth"
    assert page.locator("#graph .graph").first.evaluate(fits), "the graph is seen as a whole"


def test_the_page_of_a_frame(page: Page) -> None:
    page.click(".card:has-text('Two passes')")
    assert page.locator("#shaders option").all_inner_texts() == [
        "Twice.Forward.Clay", "Twice.Shown",
    ]  # fmt: skip
    page.select_option("#shaders select", "Twice.Shown")
    assert "Twice.Shown.frag.wgsl" in page.locator("#shaders").inner_text()
    assert page.locator("#graph svg title").first.text_content() == "Twice, rig Daylight"
    page.click("#after")
    assert page.locator("h1").inner_text() == "tints.burnish"
    page.click("#used-by .card")
    assert page.locator("h1").inner_text() == "A colour for each direction"


def test_only_what_has_changed_is_made_anew(made: tuple[Path, str]) -> None:
    folder, _told = made
    line = ("gallery", folder / "samples", "-o", folder / "again", *OPTIONS)
    assert invoke(*line).stdout.count(": unchanged\n") == 3
    page = (folder / "out" / "up.html").read_bytes()
    assert (folder / "again" / "up.html").read_bytes() == page
    (folder / "samples" / "tints.burnish").write_text(TINTS.replace("0.5", "0.25"))
    told = invoke(*line).stdout
    assert "frames/twice.burnish: unchanged\n" in told
    assert "up.burnish: 1 agrees\n" in told, "it imports what has changed"
    assert "3 files, 2 of them made anew" in told


GROWN = """
import std.frames.{FullScreen}

pass Grown : FullScreen {
    map before : texture2d with { filter = nearest, mip = none }
    target color : rgba8 = vec4(before(uv).rgb + 1 / 51.0, 1)
}

frame Brighter {
    grown = Grown(screen) with { before = previous(grown.color) }
    output picture = grown.color
}
"""


def test_what_evolves_moves(tmp_path: Path) -> None:
    """A still shows the last frame, for the first page and for those who want no movement."""
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "brighter.burnish").write_text(GROWN)
    result = invoke("gallery", tmp_path / "in", "-o", tmp_path / "out", *OPTIONS)
    assert (result.exit_code, result.stderr) == (0, "")
    page = (tmp_path / "out" / "brighter.html").read_text("utf-8")
    assert "burnish render brighter.burnish -o brighter.webp --frames 24" in page
    for number, route in enumerate(("reference", "llvmpipe-gl330")):
        name = f"brighter-{number}-{route}"
        assert f'srcset="./{name}.webp"' in page
        with Image.open(tmp_path / "out" / f"{name}.png") as still:
            # 24 / 51 in linear light.
            assert still.convert("RGB").getpixel((8, 8)) == (182, 182, 182)
        with Image.open(tmp_path / "out" / f"{name}.webp") as moving:
            shades = [each.convert("L").tobytes()[0] for each in ImageSequence.Iterator(moving)]
            assert moving.size == (24, 24)
        assert len(shades) > 12, "frames that look alike are one"
        assert shades == sorted(shades)
    assert "brighter-0-reference.png" in (tmp_path / "out" / "index.html").read_text("utf-8")


def test_a_file_with_errors_has_a_page_that_says_so(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "broken.burnish").write_text("material Broken { color = <tnt> }\n")
    result = invoke("gallery", tmp_path / "in", "-o", tmp_path / "out", *OPTIONS)
    assert result.exit_code == 1
    assert "[1/1] broken.burnish: error\n" in result.stdout
    assert result.stderr == (
        "error: something is wrong with broken.burnish: the pages of these files say what\n"
    )
    page = (tmp_path / "out" / "broken.html").read_text("utf-8")
    assert "broken.burnish:1:27" in page
    assert "&lt;tnt" in page and "<tnt" not in page
    assert 'href="./broken.html"' in (tmp_path / "out" / "index.html").read_text("utf-8")


def test_missing_tools_are_told_as_such(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "up.burnish").write_text("material Up { color = 0.5 + 0.5 * normal }\n")
    (tmp_path / "empty").mkdir()
    monkeypatch.setenv("PATH", str(tmp_path / "empty"))
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    routes = ("--on", "lavapipe:glsl", "--routes", "lavapipe:glsl")
    line = ("gallery", tmp_path / "in", "-o", tmp_path / "out", "--size", 16, "-j", 1, *routes)
    result = invoke(*line)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "up.burnish: 1 not run\n" in result.stdout
    page = (tmp_path / "out" / "up.html").read_text("utf-8")
    assert 'class="not-run">not run</td>' in page
    assert page.count("glslang is missing") == 2, "of the picture, and of the verdict"
    assert (tmp_path / "out" / "up-0-reference.png").exists()


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("empty", "-o", "out"), 1, "there is no .burnish file in `empty`"),
        (("nowhere", "-o", "out"), 2, "'nowhere' does not exist"),
        (("in", "-o", "out", "--routes", "lavapip"), 2, "there is no route `lavapip`"),
        (("in", "-o", "in/a.burnish"), 1, "`in/a.burnish` is a file, not a folder"),
        (("in",), 2, "Missing option '-o'"),
    ],
)
def test_bad_command_lines(
    words: tuple[str, ...], code: int, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("empty").mkdir()
    Path("in").mkdir()
    Path("in/a.burnish").write_text("material A { color = 0.5 + 0.5 * normal }\n")
    before = tree(tmp_path)
    result = invoke("gallery", *words)
    assert result.exit_code == code
    assert said in result.stderr
    assert tree(tmp_path) == before


def test_the_catalogue_without_a_readme(tmp_path: Path) -> None:
    write(tmp_path / "plain")
    (tmp_path / "plain" / "README.md").unlink()
    (tmp_path / "plain" / ".hidden").mkdir()
    (tmp_path / "plain" / ".hidden" / "a.burnish").write_text(UP)
    (group,) = catalogue(tmp_path / "plain")
    assert group.title == ""
    assert [file.name for file in group.files] == [
        "frames/twice.burnish", "tints.burnish", "up.burnish",
    ]  # fmt: skip
    assert title_of(tmp_path / "plain") == "plain"


def test_every_example_stands_in_a_table() -> None:
    examples = Path(__file__).parents[2] / "examples"
    groups = catalogue(examples)
    assert "Others" not in [group.title for group in groups]
    assert all(file.what for group in groups for file in group.files)


def test_pieces_of_a_text_are_the_text() -> None:
    text = 'pass P { color.in = 0x1f "é" /* no */ $ 1.5f #b5651d } // end\n/// doc'
    found = list(pieces(text))
    assert "".join(piece for _kind, piece in found) == text
    assert ("word", "pass") in found
    assert ("name", "in") in found, "behind a point, a word is a name"
    assert ("color", "#b5651d") in found
    assert found[-1] == ("doc", "/// doc")
    comments = [piece for kind, piece in found if kind == "comment"]
    assert comments == ["/* no */", "// end"]
