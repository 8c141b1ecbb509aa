"""What cannot be drawn is told, and is never a verdict."""

from __future__ import annotations

import shutil
from pathlib import Path
from unittest.mock import patch

import pytest

from burnish.materialx.fidelity import worker
from burnish.materialx.fidelity.checker import Checker
from burnish.materialx.fidelity.checking import Claim, check
from burnish.materialx.fidelity.comparing import drawn
from burnish.materialx.fidelity.images import Images
from burnish.materialx.fidelity.records import FidelityError
from burnish.targets.toolchain.pipe import Packet

from .kit import BY_HAND, DOCUMENTS, document

pytestmark = pytest.mark.xdist_group("materialx")

LAMP = Claim(document("unlit_constant"), "Lamp", BY_HAND / "unlit_constant.burnish", "Lamp")


def test_what_a_document_renders_is_named(checker: Checker) -> None:
    assert checker.renderables(document("looks")) == ["Red", "Place"]
    assert "seen/uv" in checker.renderables(document("spaces"))


def test_an_unknown_renderable_is_told(checker: Checker) -> None:
    with pytest.raises(FidelityError, match="there is no `Lam` to render; there is Lamp"):
        checker.draw(document("unlit_constant"), "Lam")


def test_any_element_is_drawn(checker: Checker) -> None:
    assert checker.renderables(document("upgraded_1_38")) == ["Before"]
    assert drawn(checker.draw(document("upgraded_1_38"), "before/out").picture).sum() > 100


def test_a_file_that_is_no_document_is_told(checker: Checker, tmp_path: Path) -> None:
    file = tmp_path / "wrong.mtlx"
    file.write_text("<materialx version='1.39'><unclosed></materialx>", "utf-8")
    with pytest.raises(FidelityError, match=r"MaterialX cannot read .*wrong\.mtlx"):
        checker.renderables(file)


def test_a_material_that_does_not_compile_is_not_run(checker: Checker) -> None:
    found = check(checker, Claim(LAMP.document, "Lamp", "burnish 1\nmaterial M { color = x }", "M"))
    assert found.verdict == "not run"
    assert "does not compile" in found.reason


def test_a_picture_that_takes_too_long_is_not_run() -> None:
    with Checker(reuse=False, draw_limit=0.001) as impatient:
        found = check(impatient, LAMP)
    assert found.verdict == "not run"
    assert "no answer within 0.001 s" in found.reason


def test_a_route_that_lacks_a_tool_is_not_run() -> None:
    with Checker() as lacking, patch.object(lacking._runner, "problem", lambda _route: "no tool"):
        found = check(lacking, LAMP)
    assert (found.verdict, found.likeness) == ("not run", None)
    assert found.reason == "nothing can be drawn by llvmpipe:gl330: no tool"


def test_a_missing_package_is_told_with_its_command() -> None:
    with patch.object(worker, "Generator", side_effect=ImportError("No module named 'MaterialX'")):
        answer = worker._Worker().answer(Packet({"renderables": "x.mtlx"}))
    assert answer.content["error"].startswith("No module named 'MaterialX'; to install it: ")
    assert answer.content["error"].endswith("-m pip install 'burnish[materialx]'")


def test_images_outside_of_the_folder_are_not_read(tmp_path: Path) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    shutil.copy(DOCUMENTS / "images" / "tiles.png", tmp_path)
    (inside / "linked.png").symlink_to(tmp_path / "tiles.png")
    images = Images(inside / "any.mtlx")
    assert images.found("../tiles.png") is None
    assert images.found("linked.png") is None
    wider = Images(inside / "any.mtlx", (tmp_path,)).found("../tiles.png")
    assert wider is not None
    assert wider.content == (tmp_path / "tiles.png").read_bytes()


def test_the_first_file_of_a_set_is_drawn() -> None:
    found = Images(document("image_set")).found("images/set.<UDIM>.png")
    assert found is not None
    assert found.content == (DOCUMENTS / "images" / "set.1001.png").read_bytes()
