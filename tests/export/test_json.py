"""``burnish export`` as JSON: the graph of a material's equations, as its schema describes it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from ..cli.kit import PLAIN, invoke, tree

SOURCE = """
/// Two colours.
material Striped {
    param width : float in 1..9 = 4    /// Of a stripe
    map   paint : texture2d of rgb = white

    part  = fract(uv.x * width)
    color = mix(paint(uv).rgb, rgb(1, 0, 0), part)
}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "striped.burnish"
    path.write_text(SOURCE)
    return path


def exported(*arguments: object) -> Any:
    result = invoke("export", *arguments, "--format", "json")
    assert (result.exit_code, result.stderr) == (0, "")
    return json.loads(result.stdout)


def test_the_document_has_the_equations_as_nodes(file: Path) -> None:
    (graph,) = exported(file)["materials"]
    assert (graph["material"], graph["doc"]) == ("Striped", "Two colours.")
    nodes = {node["name"]: node for node in graph["nodes"]}
    width = nodes["width"]
    assert (width["kind"], width["type"], width["text"]) == ("parameter", "float", "4")
    assert width["doc"] == "Of a stripe"
    assert (width["place"]["line"], width["place"]["column"]) == (4, 11)
    part = nodes["part"]
    assert (part["kind"], part["operation"]) == ("equation", "fract")
    read = [graph["nodes"][row["node"]]["name"] for row in part["inputs"]]
    assert [graph["nodes"][row["node"]]["name"] for row in nodes[read[0]]["inputs"]] == [
        "uv", "width",
    ]  # fmt: skip
    assert [row["label"] for row in nodes["color"]["inputs"]] == ["x", "y", "z"]
    assert nodes["uv"]["owner"] == "Surface"


@pytest.mark.parametrize("name", ["plastic", "glass", "normal_map"])
def test_documents_follow_the_printed_schema(name: str) -> None:
    schema = json.loads(invoke("schema", "graph").stdout)
    examples = Path(__file__).parents[2] / "examples"
    document = exported(examples / f"{name}.burnish")
    assert [each.message for each in Draft202012Validator(schema).iter_errors(document)] == []
    for graph in document["materials"]:
        for number, node in enumerate(graph["nodes"]):
            assert all(row["node"] is None or row["node"] < number for row in node["inputs"])


def test_the_ending_says_the_format(file: Path, tmp_path: Path) -> None:
    assert invoke("export", file, "-o", tmp_path / "out.json").exit_code == 0
    assert json.loads((tmp_path / "out.json").read_text()) == exported(file)


def test_a_file_with_errors_is_told_and_nothing_is_written(tmp_path: Path) -> None:
    (tmp_path / "wrong.burnish").write_text(PLAIN.replace("#ffffff", "nowhere"))
    before = tree(tmp_path)
    result = invoke("export", tmp_path / "wrong.burnish", "-o", tmp_path / "out.json")
    assert result.exit_code == 1
    assert "B0201" in result.stderr
    assert tree(tmp_path) == before


def test_the_file_itself_is_no_output(file: Path) -> None:
    result = invoke("export", file, "-o", file, "--format", "json")
    assert result.exit_code == 2
    assert "it is FILE itself" in result.stderr
    assert file.read_text() == SOURCE
