"""The plugin for Vite, in the project of the page: built, served and checked by TypeScript."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from subprocess import PIPE
from typing import Any

import pytest

import burnish

from ..docs.kit import ROOT
from ..suite.processes import Program, run, started
from .kit import BROKEN, INTEGRATIONS, WARNED, environment, project, tool, without_burnish

SOURCE = "materials/plastic.burnish"
TINTS = "materials/shared/tints.burnish"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The project, with what npm would have installed."""
    made = project("vite", tmp_path / "with blank")
    modules = made / "node_modules"
    modules.mkdir()
    package = Path(tool("vite", "package.json")).parent
    (modules / "vite").symlink_to(package)
    shutil.copytree(INTEGRATIONS / "vite", modules / "vite-plugin-burnish")
    (made / "package.json").write_text('{"type": "module"}')
    return made


def built(folder: Path, env: Mapping[str, str] | None = None) -> dict[str, Any]:
    """What the driver tells of a build."""
    command = [tool("node", "node"), "driver.mjs", "build"]
    told: dict[str, Any] = json.loads(
        run(command, cwd=folder, env=env or environment(), check=True).stdout
    )
    return told


def texts(folder: Path) -> tuple[str, str]:
    (material,) = burnish.compile(folder / SOURCE, ("wgsl", "glsl:es300"))
    return material.text("wgsl", "fragment"), material.text("glsl:es300", "fragment")


def test_a_built_program_has_the_texts(folder: Path) -> None:
    found = built(folder)["exports"]
    assert (found["fragment"], found["webgl2"]) == texts(folder)
    assert "base" in found["parameters"]
    again = built(folder)["exports"]
    assert again == found


def test_a_frame_has_its_plan_and_its_shaders(folder: Path) -> None:
    source = folder / "materials" / "glow.burnish"
    shutil.copy(ROOT / "examples" / "frames" / "glow.burnish", source)
    (folder / "main.js").write_text(
        'import frames from "./materials/glow.burnish";\nexport const { Glow } = frames;\n'
    )
    (frame,) = burnish.compile(source, ("wgsl", "glsl:es300")).frames
    found = built(folder)["exports"]["Glow"]
    assert found["plan"] == json.loads(json.dumps(burnish.to_json(frame.plan)))
    assert [each["texts"]["wgsl"] for each in found["shaders"]] == [
        {file.stage: file.text for file in shader.files if file.target == "wgsl"}
        for shader in frame.shaders
    ]


BINDING = """
import { PlasticMaterial, plastic } from "./materials/plastic.burnish?binding";
import texts from "./materials/plastic.burnish";

export const bytes = [...new PlasticMaterial({ base: [0.25, 0.5, 1] }).bytes];
export const embedded = plastic.profiles["wgsl:webgpu"].texts.map((each) => each.text);
export const fragment = texts.Plastic.texts.wgsl.fragment;
"""


def test_a_binding_has_blocks_and_the_texts(folder: Path) -> None:
    (folder / "main.js").write_text(BINDING)
    found = built(folder)["exports"]
    assert found["embedded"][1] == found["fragment"] == texts(folder)[0]
    (material,) = burnish.compile(folder / SOURCE, "wgsl")
    instance = burnish.Instance(material.reflection)
    instance.set("base", (0.25, 0.5, 1.0))
    assert bytes(found["bytes"]) == instance.blocks()["Material"]


def test_a_mistake_ends_the_build_of_a_binding(folder: Path) -> None:
    (folder / "main.js").write_text(BINDING)
    (folder / SOURCE).write_text(BROKEN)
    error = built(folder)["error"]
    assert error["loc"] == {"file": str(folder / SOURCE), "line": 1, "column": 28}


def test_a_mistake_ends_a_build(folder: Path) -> None:
    (folder / SOURCE).write_text(f"{BROKEN}material Other {{ color = lost }}\n")
    error = built(folder)["error"]
    source = str(folder / SOURCE)
    assert error["loc"] == {"file": source, "line": 1, "column": 28}
    assert error["frame"] == f"1 | {BROKEN}  | {' ' * 27}^^^"
    first, second = error["message"].splitlines()[:2]
    assert "B0201: unknown function `tnt` (did you mean `tent`?" in first
    assert second.startswith(f"{source}:2:26: B0201: unknown name `lost`")
    assert not (folder / "dist").exists()


def test_a_warning_is_told(folder: Path) -> None:
    (folder / SOURCE).write_text(WARNED)
    (warning,) = built(folder)["warnings"]
    assert warning["loc"] == {"file": str(folder / SOURCE), "line": 1, "column": 20}
    assert "B0211: nothing reads `shade`, and `Plastic` sets no `color`" in warning["message"]


def test_burnish_is_not_there(folder: Path) -> None:
    message = built(folder, without_burnish())["error"]["message"]
    assert "cannot run `burnish` (ENOENT): start Vite where the Python environment" in message


def test_a_wrong_option(folder: Path) -> None:
    config = folder / "vite.config.js"
    config.write_text(config.read_text().replace("targets:", 'options: ["--rgi"], targets:'))
    assert "No such option '--rgi'" in built(folder)["error"]["message"]


@pytest.fixture
def served(folder: Path) -> Iterator[tuple[Path, Program]]:
    command = [tool("node", "node"), "driver.mjs", "serve"]
    with started(command, cwd=folder, env=environment(), stdin=PIPE) as program:
        yield folder, program


def test_while_it_serves(served: tuple[Path, Program]) -> None:
    """Changes of all files that were read reach the page, and so do mistakes and their end."""
    folder, program = served

    def has(fragment: str) -> bool:
        return json.dumps(fragment) in answer["text"]

    def edited(file: str, text: str) -> dict[str, Any]:
        program.write(f"{json.dumps({'file': file, 'text': text})}\n".encode())
        told: dict[str, Any] = json.loads(program.line())
        assert {each["type"] for each in told["told"]} & {"update", "full-reload"}
        return told

    answer = json.loads(program.line())
    assert has(texts(folder)[0])

    right = (folder / TINTS).read_text()
    answer = edited(TINTS, right.replace("0.5", "dot(color, color)"))
    assert has(texts(folder)[0])
    updates = [pair for each in answer["told"] for pair in each.get("updates") or ()]
    assert ["/accepting.js", f"/{SOURCE}"] in updates

    answer = edited(TINTS, right.replace("color *", "colr *"))
    assert answer["status"] == 500
    assert answer["error"]["loc"] == {"file": str(folder / TINTS), "line": 1, "column": 31}
    assert "B0201: unknown name `colr`" in answer["error"]["message"]
    assert "colr * 0.5\n" in answer["error"]["frame"]

    answer = edited(TINTS, right)
    assert answer["status"] == 200
    assert has(texts(folder)[0])

    source = (folder / SOURCE).read_text()
    answer = edited(SOURCE, BROKEN)
    assert answer["error"]["loc"] == {"file": str(folder / SOURCE), "line": 1, "column": 28}
    answer = edited(SOURCE, source)
    assert has(texts(folder)[0])
    program.close_input()
    assert program.exit_code() == 0


def test_its_types(folder: Path) -> None:
    compiler = [tool("node", "node"), tool("typescript", "tsc"), "--project", "tsconfig.json"]
    done = run(compiler, cwd=folder)
    assert done.returncode == 0, done.stdout
