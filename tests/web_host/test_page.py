"""The page of docs/hosts.md, as a reader copies it."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from contextlib import chdir
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Page

import burnish
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import Scenery
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.web_host.package import frame_package

from ..docs.kit import ROOT, blocks
from ..suite import browsers
from ..suite.processes import until

pytestmark = pytest.mark.xdist_group("page of the manual")  # One process writes the site.

DOCUMENT = ROOT / "docs" / "hosts.md"
ADDRESS = "https://burnish.invalid/"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files that the page's Python writes, and with the page."""
    folder = tmp_path_factory.mktemp("site")
    (folder / "frames").symlink_to(ROOT / "examples" / "frames")
    with chdir(folder):
        for block in blocks(DOCUMENT, "python"):
            exec(compile(block.text, str(block), "exec"), {})
    (page,) = blocks(DOCUMENT, "html")
    (folder / "site" / "index.html").write_text(page.text, encoding="utf-8")
    return folder / "site"


@pytest.fixture
def page(site: Path) -> Iterator[Page]:
    with browsers.browser() as browser:
        opened = browser.new_page()
        browsers.serve(opened, site)
        yield opened


def colors(page: Page) -> int:
    """The number of colours on the canvas."""
    picture = Image.open(io.BytesIO(page.locator("canvas").screenshot()))
    return len(picture.convert("RGB").getcolors(picture.width * picture.height) or ())


def test_the_page_draws_and_its_slider_works(page: Page) -> None:
    page.goto(ADDRESS)
    until(lambda: colors(page) > 100, "a picture on the canvas")
    soft = page.locator("canvas").screenshot()
    page.locator("input").fill("0")
    until(lambda: page.locator("canvas").screenshot() != soft, "another picture")
    assert page.locator("[role=alert]").inner_text() == ""


def test_an_error_is_told_on_the_page(page: Page, site: Path) -> None:
    whole = (site / "Shadows.json").read_text(encoding="utf-8")
    page.route(
        "**/Shadows.json",
        lambda route: route.fulfill(body=whole.replace('"package": 2', '"package": 9')),
    )
    page.goto(ADDRESS)
    alert = page.locator("[role=alert]:not(:empty)")
    assert alert.inner_text() == (
        "this host knows packages of version 2, and this one is of version 9: "
        "make the package again with `frame_package`"
    )


CALLS = """async () => {
  const { openFrame } = await import("./host/host.js");
  const frame = await openFrame(null, await (await fetch("Shadows.json")).json());
  const told = async (call) => {
    try {
      await call();
      return null;
    } catch (error) {
      return error.message;
    }
  };
  const sum = async () => {
    frame.draw();
    const { width, height, texels } = await frame.read("picture");
    return [width, height, texels.reduce((all, lane) => all + lane, 0)];
  };
  const early = await told(() => frame.read("picture"));
  frame.resize(16, 8);
  const first = await sum();
  const again = await sum();
  frame.set("Clay.base", [0, 0, 0]);
  const one = await sum();
  frame.set("Slate.base", [0, 0, 0]);
  const both = await sum();
  frame.set("base", [1, 1, 1]);
  frame.set("base", [0, 0, 0]);
  const black = await sum();
  frame.setCamera({ eye: [0, 50, 0] });
  frame.resize(8, 8);
  const small = await sum();
  const errors = [
    await told(() => frame.set("spread", 9)),
    await told(() => frame.set("speed", 1)),
    await told(() => frame.set("Mud.base", [0, 0, 0])),
    await told(() => frame.resize(0, 8)),
    await told(() => frame.read("other")),
    await told(() => frame.show()),
  ];
  frame.dispose();
  return { early, first, again, one, both, black, small, errors };
}"""


def test_what_a_frame_can_be_told(page: Page) -> None:
    page.goto(ADDRESS)
    found = page.evaluate(CALLS)
    assert found["early"] == "`picture` of Shadows is no picture, or was not drawn yet"
    assert found["first"][:2] == [16, 8]
    assert found["again"] == found["first"]
    # One material is dark, and then the other one, too.
    assert found["black"][2] < found["one"][2] < found["first"][2]
    assert found["both"] == found["black"]
    assert found["small"][:2] == [8, 8]
    assert found["errors"] == [
        "`spread` is declared in 0..8: 9 is not",
        "Shadows has no parameter `speed`",
        "Shadows has no parameter `Mud.base`",
        "a frame cannot have 0 x 8 pixels",
        "Shadows has no output `other`",
        "this frame was opened without a canvas",
    ]


COUNTED = """
kernel Squares {
    param count : int in 0..8 = 3
    result squares : vec2[count] = vec2(float(index), float(index * index))
}
kernel Sum {
    buffer squares : vec2[]
    result sum : int[2] = squares.count
}
frame Counted {
    param count : int in 0..8 = 3
    made  = Squares() with { count = count }
    added = Sum() with { squares = made.squares }
    output squares = made.squares
    output sum     = added.sum
}
"""
READ = """async () => {
  const { openFrame } = await import("./host/host.js");
  const frame = await openFrame(null, await (await fetch("Counted.json")).json());
  const elements = async (count) => {
    frame.set("count", count);
    frame.draw();
    const squares = await frame.readElements("squares");
    const sum = await frame.readElements("sum");
    return [[...new Float32Array(squares.buffer, 0, squares.length / 4)],
            [...new Int32Array(sum.buffer, 0, sum.length / 4)]];
  };
  const found = [await elements(3), await elements(0), await elements(2)];
  const wrong = await frame.readElements("none").catch((error) => error.message);
  frame.dispose();
  return { found, wrong };
}"""


def test_the_elements_of_buffers(page: Page, site: Path) -> None:
    """A buffer may be empty, too, and its reader is told so."""
    file = site / "counted.burnish"
    file.write_text(COUNTED)
    (frame,) = burnish.compile(file, targets=("wgsl:webgpu",)).frames
    package = to_json(frame_package(FrameHost(frame, Scenery(()), (8, 8))))
    (site / "Counted.json").write_text(json.dumps(package))
    page.goto(ADDRESS)
    told = page.evaluate(READ)
    assert told["found"] == [
        [[0, 0, 1, 1, 2, 4], [3, 3]],
        [[], [0, 0]],
        [[0, 0, 1, 1], [2, 2]],
    ]
    assert told["wrong"] == "`none` of Counted is no buffer, or was not written yet"


ROWS = """async (api) => {
  const { openFrame } = await import("./host/host.js");
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2, 3];
  const frame = await openFrame(canvas, await (await fetch("Rows.json")).json(), api);
  frame.resize(2, 3);
  frame.draw();
  frame.show();
  const context = new OffscreenCanvas(2, 3).getContext("2d");
  context.drawImage(canvas, 0, 0);
  const shown = [...context.getImageData(0, 0, 2, 3).data].filter((_, at) => at % 8 === 0);
  const { texels } = await frame.read("color");
  frame.dispose();
  return { shown, read: [...texels].filter((_, at) => at % 8 === 0) };
}"""


@pytest.mark.parametrize("api", ["webgpu", "webgl2"])
def test_the_top_row_of_a_material_comes_first(page: Page, site: Path, api: str) -> None:
    file = site / "rows.burnish"
    file.write_text(
        "material Rows {\n"
        "    clip_position = vec4(position.xy * 4, 0, 1)\n"
        "    color = vec3(floor(frag_coord.y) / 2)\n"
        "}\n"
    )
    (material,) = burnish.compile(file, targets=("wgsl:webgpu", "glsl:es300")).materials
    frame = single_frame(material)
    host = FrameHost(frame, single_scenery(frame, "plane", 1), (2, 3))
    package = frame_package(host, ["wgsl:webgpu", "glsl:es300"])
    (site / "Rows.json").write_text(json.dumps(to_json(package)))
    page.goto(ADDRESS)
    found = page.evaluate(ROWS, api)
    assert found["read"] == pytest.approx([0.0, 0.5, 1.0], abs=1 / 255)
    assert found["shown"] == [0, 188, 255]
