"""The documents of ``burnish view``'s pages: by choices, scenes and values of the command line."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.commands.view.documents import Documents, choice_of
from burnish.commands.view.keeping import Keeping
from burnish.commands.view.pictures import Pictures
from burnish.commands.view.request import ViewRequest

from ..scenes.kit import triangle

EXAMPLES = Path(__file__).parents[2] / "examples"


def document(file: Path, query: dict[str, str] | None = None, **options: Any) -> dict[str, Any]:
    """The document of a page that asks for something of a file."""
    request = ViewRequest(
        file=file,
        mesh="cube",
        scene=options.get("scene"),
        environment=options.get("environment", "studio"),
        eye=options.get("eye"),
        look_at=None,
        turn=(0.0, 0.0),
        instances=4,
        values=options.get("values", ()),
        material=options.get("material"),
        rig=options.get("rig"),
        pass_=options.get("pass_"),
        search_path=(),
        hoist=True,
        plain=options.get("plain", False),
    )
    keeping = Keeping()
    documents = Documents(request, file.name, Pictures(keeping), Documents.shelf(keeping))
    found: dict[str, Any] = json.loads(documents.get(choice_of(query or {})))
    return found


def controls(found: dict[str, Any]) -> dict[str, Any]:
    return {row["name"]: row["value"] for row in found["controls"]}


FILE = """
material First { param size : float = 0.25  color = vec3(size) }
material Second { color = vec3(0.5) }
pass Plain { target paint : rgba8 = vec4(color, 1) }
rig Dark {}
rig Darker {}
"""


def test_choices(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    found = document(file)
    assert [row["name"] for row in found["subjects"]] == ["First", "Second"]
    assert (found["rigs"], found["passes"]) == (["Dark", "Darker"], ["Plain"])
    chosen = {"subject": "First", "rig": "Dark", "pass": "Plain", "mesh": "cube"}
    assert found["chosen"] == chosen
    assert [row["name"] for row in found["package"]["plan"]["outputs"]] == ["paint"]

    asked = {"subject": "Second", "rig": "Darker", "mesh": "torus", "profile": "glsl:es300"}
    other = document(file, asked)
    assert other["chosen"] == {**chosen, "subject": "Second", "rig": "Darker", "mesh": "torus"}
    assert list(other["package"]["shaders"][0]["texts"]) == ["glsl:es300"]

    by_line = document(file, {"subject": "Renamed"}, material="Second", rig="Darker")
    assert by_line["chosen"]["subject"] == "Second"
    assert by_line["chosen"]["rig"] == "Darker"


def test_values_of_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    # The material's own `size`, and not that of the picture.
    assert controls(document(file, values=(("size", "0.75"),)))["size"] == 0.75
    wrong = document(file, values=(("sise", "1"),))
    assert "there is no parameter `sise`: did you mean `size`?" in wrong["error"]
    assert wrong["subjects"]
    assert "error: there is no parameter `sise`" in capsys.readouterr().err


def test_a_scene(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    scene = triangle().save(tmp_path)
    found = document(file, scene=scene)
    assert (found["chosen"]["mesh"], found["meshes"]) == (None, [])
    (model,) = found["package"]["models"]
    assert model["material"] == "First"
    assert document(file, scene=tmp_path / "none.gltf")["error"].endswith(
        "none.gltf: No such file or directory"
    )


def test_materials_read_what_kernels_write() -> None:
    """Particles are counted, and the living ones shown as a chart."""
    found = document(EXAMPLES / "compaction.burnish")
    (shader,) = found["package"]["shaders"]
    read = [row["name"] for row in shader["reflection"]["buffers"] if row["stages"]]
    for name in read:
        elements = np.frombuffer(base64.b64decode(shader["buffers"][name]), "<u4")
        assert len(elements) > 1, name
        assert elements.any(), name
    assert read


def test_kernels_over_images_have_a_picture(capsys: pytest.CaptureFixture[str]) -> None:
    found = document(EXAMPLES / "edges.burnish")
    assert found["meshes"] == []
    assert found["chosen"]["mesh"] is None
    (shader,) = found["package"]["shaders"]
    picture = found["package"]["pictures"][shader["textures"]["source"]]
    assert (picture["width"], picture["height"]) == (512, 512)
    assert "is a test chart" in capsys.readouterr().err


def test_kernels_read_what_others_of_the_file_write() -> None:
    """`Cloth` gets its knots of `Hung`, which is run here; the page runs `Cloth`."""
    found = document(EXAMPLES / "cloth.burnish", {"subject": "Cloth"})
    (shader,) = found["package"]["shaders"]
    knots = np.frombuffer(base64.b64decode(shader["buffers"]["now"]), "<f4").reshape(-1, 4)
    assert len(knots) == 32 * 16
    assert knots[0, :3] == pytest.approx((-0.775, 0.8, -0.4), abs=1e-6)
    assert [row["name"] for row in found["package"]["plan"]["outputs"]] == ["after"]
    lacking = document(EXAMPLES / "cloth.burnish", {"subject": "Cloth", "profile": "glsl:es300"})
    assert "glsl:es300 has no compute stage" in lacking["error"]


def test_cube_maps_show_the_environment(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { map around : texture_cube = black  color = around(normal).rgb }")
    sides = {
        asked: [row["width"] for row in document(file, environment=asked)["package"]["pictures"]]
        for asked in ("studio", "none")
    }
    assert sides == {"studio": [64], "none": [1]}


def test_the_camera_begins_where_it_was_asked_to_be(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = 0.5 + 0.5 * normal }")
    assert document(file, eye=(0.0, 0.0, 7.0))["orbit"]["eye"] == [0, 0, 7]
    assert document(file, values=(("eye", "0,7,0"),))["orbit"]["eye"] == [0, 7, 0]


def test_the_comment_of_the_file_is_followed(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(
        "//!     burnish render m.burnish --mesh plane --set size=0.75 --set other=1\n"
        "material M { param size : float = 0.25  color = vec3(size) }\n"
    )
    found = document(file)
    assert (found["chosen"]["mesh"], controls(found)["size"]) == ("plane", 0.75)
    assert controls(document(file, values=(("size", "0.5"),)))["size"] == 0.5
    found = document(file, plain=True)
    assert (found["chosen"]["mesh"], controls(found)["size"]) == ("cube", 0.25)
