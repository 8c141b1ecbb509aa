"""A folder that came from anybody: its gallery shows nothing of others, runs nothing, and has pages
that work."""

from __future__ import annotations

import math
import os
import re
import sys
import unicodedata
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Dialog

from burnish.commands.catalogue import catalogue, title_of
from burnish.commands.comments import FOLLOWED, asked
from burnish.commands.gallery.pages import FOLDER
from burnish.commands.render import render
from burnish.targets.toolchain import workers
from burnish.targets.toolchain.workers import Worker

from ..suite import browsers
from .hostile_folder import COMMENTS, MODULE, OWN_COLOR, SECRET, SECRET_COLOR, Reader, fill
from .kit import invoke, tree

pytestmark = pytest.mark.xdist_group("hostile gallery")  # One process makes the gallery.

ROOT = Path(__file__).parents[2]
OPTIONS = ("--size", 16, "--jobs", 2, "--on", "llvmpipe:gl330", "--routes", "llvmpipe:gl330")


class Made(NamedTuple):
    """A gallery of the folder."""

    outside: Path
    folder: Path
    output: Path
    printed: str
    pages: dict[str, str]

    def page_of(self, name: str) -> str:
        """The page of a file whose name is a plain word."""
        return self.pages[f"{name}.html"]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Made]:
    outside = tmp_path_factory.mktemp("hostile")
    folder, output = fill(outside), outside / "out"
    before = tree(outside)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BURNISH_CACHE", str(tmp_path_factory.mktemp("cache")))
        result = invoke("gallery", folder, "-o", output, *OPTIONS)
    assert result.exit_code == 1, "two files have errors"
    written = {name for name in tree(outside) - before if not name.startswith("out")}
    assert written == set()
    pages = {path.name: path.read_text("utf-8") for path in output.glob("*.html")}
    yield Made(outside, folder, output, result.output, pages)


def test_the_terminal_gets_nothing_that_it_obeys(made: Made) -> None:
    obeyed = {each for each in made.printed if unicodedata.category(each) in ("Cc", "Cf", "Cs")}
    assert obeyed == {"\n"}
    assert "Traceback" not in made.printed
    assert "names/<U+000A>.burnish: nothing to draw" in made.printed
    assert "names/<U+001B>[2J.burnish: nothing to draw" in made.printed
    assert r"names/caf\xe9.burnish: nothing to draw" in made.printed


def test_each_file_has_a_page_of_its_own(made: Made) -> None:
    names = [each.name for group in catalogue(made.folder) for each in group.files]
    assert len(made.pages) == len(names) + 1
    assert len({page.casefold() for page in made.pages}) == len(made.pages)
    for page in tree(made.output):
        assert len(page.encode()) < 150
        assert re.fullmatch(r"[\w.-]+", page) and page[0] not in "-."
    left_out = {"link", "git", "text", "circle", "gone", "zero", "pipe", "folder", "secret"}
    assert not {f"{name}.burnish" for name in left_out} & set(names)


def test_links_lead_to_files_of_the_gallery(made: Made) -> None:
    for name, text in made.pages.items():
        for file in Reader(text).files():
            assert (made.output / file).is_file(), (name, file)
    index = Reader(made.pages["index.html"])
    assert {file for file in index.files() if file.endswith(".html")} | {"index.html"} == set(
        made.pages
    )


def test_pages_have_one_script_and_a_policy(made: Made) -> None:
    script = (FOLDER / "gallery.js").read_text("utf-8")
    for name, text in made.pages.items():
        page = Reader(text)
        assert page.tags.count("script") == page.tags.count("style") == 1, name
        assert text.count(f"<script>{script}</script>") == 1
        assert not {each for each in page.attributes if each.startswith("on")}, name
        assert not {"iframe", "object", "embed", "base", "form"} & set(page.tags), name
        assert page.policy.startswith("default-src 'none'; "), name
        assert "unsafe" not in page.policy and "*" not in page.policy
        assert not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", text), name


def test_nothing_private_is_shown(made: Made) -> None:
    for name, text in made.pages.items():
        assert SECRET not in text, name
        assert "Traceback" not in text and str(made.outside) not in Reader(text).text.replace(
            f"{made.outside}/private.png", ""
        ).replace(f"{made.outside}/written.png", "").replace(f"-I {made.outside}", ""), name
    for path in made.output.glob("*.png"):
        with Image.open(path) as picture:
            texels = np.asarray(picture.convert("RGB"), np.int32)
        assert np.abs(texels - SECRET_COLOR).sum(axis=2).min() > 9, path.name
    with Image.open(made.output / "own-0-reference.png") as picture:
        assert picture.convert("RGB").getpixel((8, 8)) == OWN_COLOR


NOTES = {
    "outside": "files are taken by relative paths",
    "above": "only files of its own folder are taken",
    "by-link": "only files of its own folder are taken",
    "by-link-srgb": "only files of its own folder are taken",
    "link-that-is-a-number": "only files of its own folder are taken",
    "in-hidden": "only files of its own folder are taken",
    "endless": "files are taken by relative paths",
    "no-file": "only files of its own folder are taken",
    "scene": "`--scene`, which is not followed",
    "search": "`-I`, which is not followed",
    "device": "`--device`, which is not followed",
    "route": "`--on`, which is not followed",
    "written": "a picture is written beside the file",
    "many-frames": "up to 60 are taken",
    "budget": "`--budget`, which is not followed",
    "no-value": "has a command with a mistake ('' is not one of 'sphere', ",
    "nonsense": "has a command with a mistake ('nonsense' is not one of 'sphere', ",
    "apostrophe": "has a command that cannot be read (no closing quotation)",
    "help": "`--help`, which is not followed",
}


@pytest.mark.parametrize("name", COMMENTS)
def test_what_a_comment_asks_for_in_vain(name: str, made: Made) -> None:
    """The page says so, and has plain pictures wherever these can be drawn."""
    text = Reader(made.page_of(name)).text
    assert NOTES[name] in text
    assert f"{name}-0-reference.png" in tree(made.output) or "needs values for" in text


def test_what_a_comment_asks_for(made: Made) -> None:
    text = Reader(made.page_of("own")).text
    command = "burnish render own.burnish -o own.png --set t=srgb:own.png --mesh plane"
    assert text.count(command) == 3, "of the comment, the pictures, and the source"
    assert "asks for" not in text and "asks for" not in made.page_of("prose")
    assert "burnish render ./-o.burnish -o ./-o.png" in made.page_of("o")


def test_what_cannot_be_shown_is_told(made: Made) -> None:
    assert "the file has 10 GB, and the limit is 256 MB" in made.page_of("holes")
    assert "a gallery shows files of up to 256 kB" in made.page_of("large")
    assert "the file imports `.git/config`" in made.page_of("quotes-it")


def test_nothing_is_run_in_a_browser(made: Made) -> None:
    """Each card leads to its page, and the policy has nothing to refuse."""
    root = made.output.as_uri()
    with browsers.browser() as browser:
        page = browser.new_page()
        said: list[str] = []
        asked_for: list[str] = []
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))

        def refuse(dialog: Dialog) -> None:
            said.append(dialog.message)
            dialog.dismiss()

        page.on("dialog", refuse)
        page.on("request", lambda request: asked_for.append(request.url))
        page.goto(f"{root}/index.html")
        for name in ("javascript:alert(1)", "a#b?c%d", "-o", "markup", "names/\u202e"):
            shown = name.replace("\u202e", "<U+202E>")
            card = page.locator(".card").filter(has=page.get_by_text(shown, exact=True)).first
            card.click()
            assert page.locator("header .file").inner_text().startswith(f"{shown}.burnish")
            assert page.evaluate("[...document.images].every(each => each.naturalWidth)")
            page.locator(".bar .brand").click()
            assert page.url == f"{root}/index.html"
    assert said == []
    assert [url for url in asked_for if not url.startswith((f"{root}/", "data:,"))] == []


def test_the_policy_refuses_what_gets_into_a_page(made: Made, tmp_path: Path) -> None:
    """A mistake in a template would let markup through; then nothing of it runs or loads."""
    text = made.page_of("markup")
    act = "document.title='run'"
    evil = f'<script>{act}</script><img src="https://x.test/a.png" onerror="{act}">'
    (tmp_path / "evil.html").write_text(text.replace("<main", f"{evil}<main", 1), "utf-8")
    with browsers.browser() as browser:
        page = browser.new_page()
        said: list[str] = []
        page.on("console", lambda message: said.append(message.text))
        page.goto((tmp_path / "evil.html").as_uri())
        assert page.title() != "run"
    assert len([each for each in said if "Content Security Policy" in each]) >= 2


def test_limits_are_those_of_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "a.burnish").write_text(MODULE)
    line = ("gallery", "--no-cache", tmp_path / "in", "-o", tmp_path / "out", *OPTIONS)
    size = len(MODULE)
    assert invoke(*line, "--budget", "file=9").exit_code == 1
    told = f"the file has {size} bytes, and the limit is 9 bytes: `--budget file={size}` raises it"
    assert told in (tmp_path / "out" / "a.html").read_text("utf-8")
    assert invoke(*line, "--budget", f"file={size}").exit_code == 0


DYING = f"""
import json, sys
from burnish.commands.gallery.entry import failed
for line in sys.stdin:
    if json.loads(line)["file"] == "bad.burnish":
        raise SystemError("{SECRET}")
    print(json.dumps({{"entry": {{**failed("fine", ""), "errors": []}}}}), flush=True)
"""


def test_a_process_that_dies_is_told_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The process's output describes this machine, so it is on no page; other files are shown."""
    (tmp_path / "in").mkdir()
    for name in ("a", "bad", "c"):
        (tmp_path / "in" / f"{name}.burnish").write_text(MODULE)
    command = [sys.executable, "-c", DYING]
    monkeypatch.setattr(workers, "Worker", lambda *_given: Worker(lambda: command))
    result = invoke("gallery", "--no-cache", tmp_path / "in", "-o", tmp_path / "out", *OPTIONS)
    assert result.exit_code == 1
    assert "bad.burnish: error\n" in result.stdout and "c.burnish: nothing" in result.stdout
    page = Reader((tmp_path / "out" / "bad.html").read_text("utf-8")).text
    assert (
        "nothing could be made of this file: the process that tried was ended with exit code 1"
    ) in page
    assert MODULE.strip() in page, "its source is shown all the same"
    assert SECRET not in page + result.output and "Traceback" not in page + result.output


def test_a_readme_takes_no_time(tmp_path: Path) -> None:
    """Lines that patterns with two loops would take hours for."""
    (tmp_path / "plain.burnish").write_text("material Plain { color = vec3(1) }\n")
    long = 50_000
    lines = ("# x" + " " * long + "y", "| " + " " * long, "[" * long, "[](" * long, "[a]: " * long)
    (tmp_path / "README.md").write_text("\n\n".join([*lines, "# z", "[b](plain.burnish): it"]))
    assert title_of(tmp_path).startswith("x ")
    (group,) = catalogue(tmp_path)
    assert [(each.name, each.what) for each in group.files] == [("plain.burnish", "it")]


def test_folders_may_be_nested_as_deep_as_the_system_allows(tmp_path: Path) -> None:
    """Deeper than functions may call each other."""
    deep = tmp_path
    try:
        while len(os.fsencode(deep)) < 3900:
            deep /= "d"
            deep.mkdir()
        file = deep / "x.burnish"
        file.write_text("material Plain { color = vec3(1) }\n")
        assert [each.path for (group,) in [catalogue(tmp_path)] for each in group.files] == [file]
    finally:  # What removes folders of tests calls itself for each level.
        (deep / "x.burnish").unlink(missing_ok=True)
        while deep != tmp_path:
            deep.rmdir()
            deep = deep.parent


def test_every_option_that_is_followed_is_one_of_render(tmp_path: Path) -> None:
    values = {
        "-o": "x.png", "--output": "x.png", "--mesh": "knot", "--instances": "3",
        "--set": "a=1", "--steps": "2", "--again": "a=b", "--background": "#fff",
        "--frames": "2", "--target": "t", "--material": "M", "--rig": "R", "--pass": "P",
        "--environment": "sky", "--eye": "1,2,3", "--look-at": "0,1,0", "--turn": "180",
        "--exposure": "1.5", "--tone": "aces", "--samples": "4",
    }  # fmt: skip
    assert values.keys() == FOLLOWED.keys()
    words = " ".join(f"{name} {value}" for name, value in values.items())
    found = asked(f"//!     burnish render x.burnish {words}\n", "x.burnish", tmp_path, 256, render)
    assert found.note == ""
    assert found.options == {
        "mesh": "knot", "instances": 3, "values": (("a", "1"),), "steps": 2,
        "again": (("a", "b"),), "background": (1.0, 1.0, 1.0, 1.0), "frames": 2, "target": "t",
        "material": "M", "rig": "R", "pass_": "P",
        "environment": "sky", "eye": (1.0, 2.0, 3.0), "look_at": (0.0, 1.0, 0.0),
        "turn": (math.pi, 0.0), "exposure": 1.5, "tone": "aces", "samples": 4,
    }  # fmt: skip


def test_the_manual_lists_what_is_followed() -> None:
    manual = (ROOT / "docs" / "gallery.md").read_text("utf-8")
    rows = [line.split("|")[1] for line in manual.splitlines() if line.startswith("| `-")]
    listed = {name for row in rows for name in re.findall("`(-[^`]+)`", row)}
    assert listed == FOLLOWED.keys() - {"--output"}


def test_comments_of_examples_are_followed() -> None:
    examples = ROOT / "examples"
    followed = 0
    for path in examples.rglob("*.burnish"):
        found = asked(path.read_text("utf-8"), path.name, examples, 1024, render)
        assert found.note == "", path
        followed += bool(found.options)
    assert followed > 20


@pytest.mark.parametrize(
    ("size", "words", "note"),
    [
        (256, "--frames 16 --steps 64", ""),
        (16, "--frames 16 --steps 64", ""),
        (1024, "--frames 60", ""),
        (16, "--frames 60 --steps 1000", "60 frames of 1000 steps: .* up to 1024 steps in all"),
        (1024, "--frames 13 --steps 5", "13 frames of 5 steps: .* up to 64 steps in all"),
    ],
)
def test_frames_steps_and_pixels_are_counted_together(
    size: int, words: str, note: str, tmp_path: Path
) -> None:
    found = asked(
        f"//!     burnish render x.burnish {words}\n", "x.burnish", tmp_path, size, render
    )
    assert re.search(note, found.note) if note else not found.note
    assert bool(found.words) == bool(found.options) == (not note)
