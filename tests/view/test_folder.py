"""``burnish view FOLDER``: the list of its files, and what no name of a file leads to."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import quote

import pytest
from playwright.sync_api import Browser

from burnish.commands.view.folder import Folder

from ..cli.kit import invoke
from ..suite.processes import LIMIT, until
from .kit import Viewer, viewing
from .pages import SIZE, opened, shows

pytestmark = pytest.mark.xdist_group("view of a folder")  # One server and browser serve all.

PLAIN = "material {} {{ color = {} }}\n"
README = """
# Colours

## Warm

| what | where |
|---|---|
| the colour of `blood` | [red.burnish](red.burnish) |
"""
SECRET = "material Secret { color = vec3(1) }\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    outside = tmp_path_factory.mktemp("folder")
    folder = outside / "colours"
    (folder / "cold").mkdir(parents=True)
    (outside / "secret.burnish").write_text(SECRET)
    (folder / "README.md").write_text(README)
    (folder / "red.burnish").write_text(PLAIN.format("Red", "#ff0000"))
    (folder / "cold" / "blue.burnish").write_text(PLAIN.format("Blue", "#0000ff"))
    (folder / "half.burnish").write_text("fn half(x: float) -> float = 0.5 * x\n")
    (folder / "broken.burnish").write_text("material Broken {\n")
    (folder / "link.burnish").symlink_to(outside / "secret.burnish")
    (folder / "up").symlink_to(outside)
    return folder


@pytest.fixture(scope="module")
def viewer(folder: Path) -> Iterator[Viewer]:
    with viewing(folder) as viewer:
        yield viewer


def test_the_list(viewer: Viewer) -> None:
    """The list has the README's words; files that draw nothing, or lie elsewhere, are left out."""
    assert viewer.ask("/files").json() == [
        {
            "title": "Warm",
            "files": [
                {"name": "red.burnish", "what": "the colour of `blood`", "subjects": ["Red"]}
            ],
        },
        {
            "title": "Others",
            "files": [
                {"name": "broken.burnish", "what": "", "subjects": []},
                {"name": "cold/blue.burnish", "what": "", "subjects": ["Blue"]},
            ],
        },
    ]


def test_only_files_of_the_list_are_shown(viewer: Viewer, folder: Path) -> None:
    """Any other name is as if none was given: the page shows the first file."""
    found = viewer.ask("/document?file=cold/blue.burnish").json()
    assert (found["file"], found["chosen"]["subject"]) == ("cold/blue.burnish", "Blue")
    secret = folder.parent / "secret.burnish"
    for name in (
        "../secret.burnish", "link.burnish", "up/secret.burnish", str(secret),
        "cold/../red.burnish", "./red.burnish", "none.burnish", "README.md", "cold", "", "\0",
    ):  # fmt: skip
        found = viewer.ask(f"/document?file={quote(name)}").json()
        assert found["file"] == "red.burnish", name
        assert "Secret" not in str(found), name


HIDDEN_BELOW = 10
"""The pixels below the search field that hide what is scrolled there."""


def test_a_file_is_chosen(browser: Browser, viewer: Viewer, folder: Path) -> None:
    with browser.new_context(viewport=SIZE) as context:
        context.set_default_timeout(1000 * LIMIT)
        page = opened(context.new_page(), viewer)
        shows(page, (255, 0, 0))
        links = page.locator("#file-list a")
        links.first.wait_for()
        assert links.all_inner_texts() == [
            "The colour of blood\nred.burnish · Red",
            "broken.burnish",
            "cold/blue.burnish\nBlue",
        ]
        field, entry = (each.bounding_box() for each in (page.locator("#file-search"), links.first))
        assert field and entry
        assert entry["y"] >= field["y"] + field["height"] + HIDDEN_BELOW, "it is covered"
        page.locator("#file-search").fill("BLUE")
        assert links.filter(visible=True).all_inner_texts() == ["cold/blue.burnish\nBlue"]
        links.filter(visible=True).click()
        shows(page, (0, 0, 255))
        assert page.locator("#file").inner_text() == "cold/blue.burnish"
        assert page.url.startswith(f"{viewer.address}?file=cold%2Fblue.burnish")
        assert page.locator("[aria-current]").get_attribute("data-name") == "cold/blue.burnish"

        # Only the file that is shown is drawn again.
        (folder / "red.burnish").write_text(PLAIN.format("Red", "#ffff00"))
        (folder / "cold" / "blue.burnish").write_text(PLAIN.format("Blue", "#00ffff"))
        shows(page, (0, 255, 255))
        page.locator("#file-search").fill("")
        links.first.click()
        shows(page, (255, 255, 0))


def test_the_list_lies_over_narrow_pages(browser: Browser, viewer: Viewer) -> None:
    with browser.new_context(viewport={"width": 390, "height": 700}) as context:
        context.set_default_timeout(1000 * LIMIT)
        page = opened(context.new_page(), viewer)
        page.locator("#open-files").click()
        page.locator("#file-list a").last.click()
        page.wait_for_selector("h2:has-text('Blue')")
        assert page.locator("#files").is_hidden()


def test_a_file_that_becomes_a_link(tmp_path: Path) -> None:
    """The path was found as a file; the file that the link leads to is not shown."""
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.burnish").write_text(SECRET)
    file = tmp_path / "in" / "plain.burnish"
    file.write_text(PLAIN.format("Plain", "#ffffff"))
    folder = Folder(tmp_path / "in", ())
    assert folder.path("plain.burnish") == file
    file.unlink()
    file.symlink_to(tmp_path / "secret.burnish")
    assert folder.path("plain.burnish") is None
    assert folder.listing() == []


def test_folders_without_anything_to_show(tmp_path: Path) -> None:
    (tmp_path / "half.burnish").write_text("fn half(x: float) -> float = 0.5 * x\n")
    result = invoke("view", tmp_path, "--no-browser")
    assert result.exit_code == 1
    assert result.stderr == (
        f"error: there is nothing in the folder `{tmp_path}` that could be drawn\n"
    )


def test_names_that_are_no_unicode(tmp_path: Path) -> None:
    """Such a file is listed, shown and watched like others; its odd bytes are written out."""
    folder = tmp_path / os.fsdecode(b"\xfe")
    (folder / os.fsdecode(b"deep\xff")).mkdir(parents=True)
    file = folder / os.fsdecode(b"deep\xff/\xffred.burnish")
    file.write_text(PLAIN.format("Red", "#ff0000"))
    for name in ("a#b?c%d&e=f.burnish", "two\nlines.burnish", "x" * 200 + ".burnish"):
        (folder / name).write_text(PLAIN.format("Odd", "#00ff00"))
    with viewing(folder) as viewer:
        names = [each["name"] for group in viewer.ask("/files").json() for each in group["files"]]
        assert sorted(names) == sorted((
            r"deep\xff/\xffred.burnish", "a#b?c%d&e=f.burnish", "two\nlines.burnish",
            "x" * 200 + ".burnish",
        ))  # fmt: skip
        for name in names:
            found = viewer.ask(f"/document?file={quote(name, safe='')}").json()
            assert (found["file"], found.get("error")) == (name, None)
        asked = f"/document?file={quote(names[-1], safe='')}"
        before = viewer.ask(asked).json()["version"]
        path = file if names[-1].startswith("deep") else folder / names[-1]
        path.write_text(PLAIN.format("Other", "#ffffff"))
        until(lambda: viewer.ask(asked).json()["version"] != before, "the change is seen")
        assert viewer.said.read_text() == ""


def test_what_is_no_file_of_the_folder(tmp_path: Path) -> None:
    """A README that is a link elsewhere is not read, and a pipe is never waited for."""
    folder = tmp_path / "shown"
    folder.mkdir()
    (folder / "plain.burnish").write_text(PLAIN.format("Plain", "#ffffff"))
    (tmp_path / "private.md").write_text(README.replace("red.", "plain."))
    (folder / "README.md").symlink_to(tmp_path / "private.md")
    os.mkfifo(folder / "pipe.burnish")
    (folder / "null.burnish").symlink_to("/dev/zero")
    (folder / "circle.burnish").symlink_to(folder / "circle.burnish")
    (folder / "folder.burnish").mkdir()
    plain = [{"name": "plain.burnish", "what": "", "subjects": ["Plain"]}]
    assert Folder(folder, ()).listing() == [{"title": "", "files": plain}]
    (folder / "README.md").unlink()
    os.mkfifo(folder / "README.md")
    assert Folder(folder, ()).listing() == [{"title": "", "files": plain}]


def test_a_folder_that_is_deleted(tmp_path: Path) -> None:
    folder = tmp_path / "shown"
    folder.mkdir()
    file = folder / "plain.burnish"
    file.write_text(PLAIN.format("Plain", "#ffffff"))
    with viewing(folder) as viewer:
        assert viewer.ask("/document").status == 200
        file.unlink()
        folder.rmdir()
        until(lambda: viewer.ask("/document").status == 404, "there is nothing to show")
        assert viewer.ask("/files").json() == []
        folder.mkdir()
        file.write_text(PLAIN.format("Again", "#ffffff"))
        assert viewer.ask("/files").json()[0]["files"][0]["subjects"] == ["Again"]
        until(lambda: b'"subject":"Again"' in viewer.ask("/document").body, "it is shown again")


def test_lists_of_many_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files that there is no time to read are listed all the same, and read for the next list."""
    for number in range(5):
        (tmp_path / f"{number}.burnish").write_text(PLAIN.format("Plain", "#ffffff"))
    monkeypatch.setattr("burnish.commands.view.folder._PATIENCE", -1.0)
    folder = Folder(tmp_path, ())

    def subjects() -> list[list[str]]:
        (group,) = folder.listing()
        return [each["subjects"] for each in group["files"]]

    assert subjects() == [["Plain"], [], [], [], []]
    assert folder.path("4.burnish") == tmp_path / "4.burnish"
    monkeypatch.setattr("burnish.commands.view.folder._PATIENCE", 60.0)
    assert subjects() == 5 * [["Plain"]]
