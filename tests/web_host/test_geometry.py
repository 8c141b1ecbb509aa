"""The host draws the same meshes, with the same values, as Python's runtime.

Materials that expand primitives or divide patches, and instances, are drawn as frames of one step.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.documents.plan import DrawStep
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.runner.frames.step_draws import StepDraws
from burnish.targets.web_host.package import frame_package

from .kit import in_node

EXAMPLES = Path(__file__).parents[2] / "examples"
INSTANCES = 3

_MESH = """({reflection, geometry}) => {
  const mesh = geometry instanceof Object ? call(geometry) : bareMesh(reflection, geometry);
  const { indices, count, instance_count, elements } = mesh;
  const streams = interleaved(reflection).map(({ step, stride, members }) => {
    const words = new Uint32Array((step === "vertex" ? mesh.vertices : mesh.instances).buffer);
    return members.map(({ input, lanes, offset }) => {
      const isOf = (_, at) => {
        const word = at % (stride / 4) - offset / 4;
        return word >= 0 && word < lanes;
      };
      return [input.name, [...words].filter(isOf)];
    });
  });
  return {
    attributes: Object.fromEntries(streams.flat()),
    indices: indices && [...new Uint32Array(indices.buffer)],
    elements: Object.fromEntries(elements.map(({ name, bytes }) => [name, [...bytes]])),
    count,
    instances: instance_count,
  };
}"""


def hosted(name: str) -> tuple[FrameHost, dict[str, Any]]:
    """The first material of an example on a mesh, and the package of its frame."""
    subject = burnish.compile(EXAMPLES / f"{name}.burnish", "wgsl").materials[0]
    frame = single_frame(subject)
    host = FrameHost(frame, single_scenery(frame, "cube", INSTANCES), (8, 8))
    return host, to_json(frame_package(host))


def seen(reflection: Reflection | Mapping[str, Any], geometry: Any) -> dict[str, Any]:
    """The host's mesh of a packaged geometry, or of a number of vertices without attributes."""
    further = [("geometry.js", "bareMesh"), ("webgl2/vertices.js", "interleaved")]
    given = {"reflection": reflection, "geometry": geometry}
    (found,) = in_node("geometry.js", "unpacked", _MESH, [given], *further)
    return dict(found)


@pytest.mark.parametrize(
    "name",
    ["clay", "instances", "sprites", "fins", "displacement", "splines", "thorns", "threads"],
)
def test_the_same_is_drawn_of_a_mesh(name: str) -> None:
    host, package = hosted(name)
    (step,) = host.plan.steps
    assert isinstance(step, DrawStep)
    (drawn,) = StepDraws(host).of(step, is_first=True)
    wanted, reflection = drawn.state.draw(), drawn.state.instance.reflection
    (model,) = package["models"]
    geometry = package["geometries"][model["geometries"]["0"]]
    found = seen(reflection, geometry)

    rows = [row for row in reflection.vertex_inputs if row.buffer is None]
    assert found["attributes"].keys() == {row.name for row in rows}
    for row, data in zip(rows, wanted.vertices, strict=True):
        assert found["attributes"][row.name] == np.frombuffer(data, "<u4").tolist(), row.name
    indices = np.frombuffer(wanted.indices, "<u4").tolist()
    assert found["count"] == len(indices)
    assert (found["indices"] or list(range(found["count"]))) == indices
    assert found["instances"] == wanted.instance_count
    buffers = [row.name for row in reflection.buffers if row.stages]
    of_mesh = {row.buffer.name for row in reflection.vertex_inputs if row.buffer}
    assert found["elements"].keys() == of_mesh
    for buffer, data in zip(buffers, wanted.buffers, strict=True):
        if buffer in of_mesh:
            assert bytes(found["elements"][buffer]) == data


def test_primitives_without_a_mesh_have_the_numbers_of_their_corners() -> None:
    inputs: list[dict[str, Any]] = [
        *({"corner": corner, "name": f"c{corner}"} for corner in range(3)),
        {"corner": None, "name": "primitive_index"},
        {"corner": None, "name": "instance_index"},
    ]
    rows = [
        {"name": row["name"], "representation": "int", "step": "instance", "buffer": None,
         "mesh": {"is_number": True, "is_of_pattern": False, **row}}
        for row in inputs
    ]  # fmt: skip
    draw = {"expanded_by": "instances", "corners": 3, "vertices": 6}
    found = seen({"vertex_inputs": rows, "draw": draw}, 8)
    assert found["attributes"] == {
        "c0": [0, 3], "c1": [1, 4], "c2": [2, 5],
        "primitive_index": [0, 1], "instance_index": [0, 0],
    }  # fmt: skip
    assert (found["count"], found["instances"], found["indices"]) == (6, 2, None)


def test_patches_of_other_levels_need_another_package() -> None:
    _, package = hosted("threads")
    shader = package["shaders"][0]
    body = """({shader, value, name}) => {
      const values = new Values(shader.reflection.material, shader.reflection);
      for (const [key, each] of Object.entries(shader.values)) values.set(key, each);
      if (name) values.set(name, value);
      try { call(shader, values); return null; } catch (error) { return error.message; }
    }"""
    other = shader["values"]["number"] + 1
    given = [{"shader": shader}, {"shader": shader, "name": "number", "value": other}]
    same, changed = in_node("geometry.js", "checkLevels", body, given, ("values.js", "Values"))
    assert same is None
    assert "was packaged with patches of the levels" in changed
    assert changed.endswith("make the package anew")
