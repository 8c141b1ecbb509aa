"""No pass changes the value of an example, or of a light or term of the library."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.compiler.passes.pipeline import Options

from .agreement import disagreements
from .kit import World, shaders

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.burnish"))
WORLDS = [World(seed, traps=seed % 2 == 1) for seed in range(4)]


@pytest.mark.parametrize("hoist", [True, False], ids=["hoisted", "plain"])
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_keep_their_value(path: Path, hoist: bool) -> None:
    for shader in shaders(path, RIGS.get(path.stem)):
        assert not disagreements(shader, WORLDS, Options(hoist)), shader.name


RIGS = {"rigs": "Noon"}
"""The rigs of the examples that have several."""

LIGHTS = ("Directional", "Point", "Spot", "FocusedSpot")
COUNTS = ("", "[1]", "[2]", "[3]", "[<= 3]")


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("light", LIGHTS)
def test_lights_and_terms_keep_their_value(light: str, count: str) -> None:
    text = f"""
    import std.lights.{{{light}}}
    import std.terms
    material All {{
        color = ambient(vec3(1, 0.5, 0.25)) + lambert(vec3(0.5)) + phong(vec3(0.75), 7.0)
              + blinn_phong(vec3(0.25), 5.0)
    }}
    rig Some {{ one : {light}{count}; other : {light}; }}
    """
    for shader in shaders(text):
        assert not disagreements(shader, WORLDS), light
