"""The camera of the page, in node, beside the cameras that pictures are drawn with in Python."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.targets.runner.cameras import Camera, looking
from burnish.targets.runner.frames.scenery import Scenery, in_a_row
from burnish.targets.runner.scene import Scene
from burnish.targets.toolchain.tools import program
from burnish.targets.web_view.orbit import orbit

from ..suite.processes import run

MODULE = Path(__file__).parents[2] / "targets" / "web_view" / "orbit.js"


def moved(row: dict[str, Any], *moves: tuple[str, float, float]) -> tuple[Any, Any]:
    """The camera's matrix and its eye, after some movements."""
    node = program("node", "node")
    assert node is not None
    script = (
        f'import {{ Orbit }} from "{MODULE.as_uri()}";'
        f"const camera = new Orbit({json.dumps(row)});"
        f"for (const [name, a, b] of {json.dumps(moves)}) camera[name](a, b);"
        "console.log(JSON.stringify([camera.viewProjection(), camera.eye]));"
    )
    done = run([str(node), "--input-type=module", "--eval", script], check=True)
    matrix, eye = json.loads(done.stdout)
    return np.array(matrix).T, eye


def close(found: Any, wanted: Any) -> bool:
    return bool(np.allclose(found, wanted, atol=1e-9))


ALONG_Z = looking((1.0, 2.0, 8.0), (1.0, 2.0, 3.0), near=0.5, far=50)
ENDLESS = Camera(ALONG_Z.eye, ALONG_Z.world_to_camera, 0.5, math.inf, ALONG_Z.fov)
FLAT = Camera(ALONG_Z.eye, ALONG_Z.world_to_camera, 0.5, 50.0, None, height=3.0)


@pytest.mark.parametrize("camera", [looking(), ALONG_Z, ENDLESS, FLAT])
def test_it_begins_as_the_scene_says(camera: Camera) -> None:
    matrix, eye = moved(orbit(Scenery((), Scene(camera))))
    assert close(matrix, camera.world_to_clip(1))
    assert close(eye, camera.eye)


def test_it_turns_around_the_middle_of_the_models() -> None:
    row = orbit(in_a_row(["Clay"], {}, "sphere"))
    # The floor lies lower than the ball, so the middle of both is half as low, on the line of view.
    x, y, z = row["eye"]
    turned = {**row, "eye": [0.0, 0.0, 5.0], "target": [0.0, 0.0, 0.0]}
    matrix, eye = moved(turned, ("turn", math.pi / 2, 0.0))
    assert close(eye, (5, 0, 0))
    camera = looking((5, 0, 0), (0, 0, 0), row["fov"], row["near"], row["far"])
    assert close(matrix, camera.world_to_clip(1))
    _, eye = moved(turned, ("turn", 0.0, math.pi / 6))
    assert close(eye, (0, 2.5, 5 * math.cos(math.pi / 6)))
    # Nobody falls over the pole.
    _, (x, y, z) = moved(turned, ("turn", 0.0, 9.0))
    assert y == pytest.approx(5, abs=1e-4)
    assert math.hypot(x, z) == pytest.approx(0.005, rel=0.01)


def test_it_moves_sideways_and_closer() -> None:
    row = {**orbit(Scenery((), Scene(ALONG_Z))), "target": [1.0, 2.0, 3.0]}
    high = 2 * 5 * math.tan(ALONG_Z.fov / 2)  # type: ignore[operator]  # how much it sees there
    _, eye = moved(row, ("pan", 0.5, -0.25))
    assert close(eye, (1 + 0.5 * high, 2 - 0.25 * high, 8))
    matrix, eye = moved(row, ("zoom", 0.5, 0.0))
    assert close(eye, (1, 2, 5.5))
    nearer = looking((1.0, 2.0, 5.5), (1.0, 2.0, 3.0), near=0.25, far=50)
    assert close(matrix, nearer.world_to_clip(1))
    _, eye = moved(row, ("zoom", 2.0, 0.0), ("zoom", 2.0, 0.0))
    assert close(eye, (1, 2, 23))


def test_it_sees_all_of_the_models() -> None:
    """The target lies before the eye, also where a file's camera looks away from the models."""
    row = orbit(
        Scenery(in_a_row(["Clay"], {}, "sphere").models, Scene(looking((0, 0, 9), (0, 0, 20))))
    )
    assert row["target"][2] > row["eye"][2]
