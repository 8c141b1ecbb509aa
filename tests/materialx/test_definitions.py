"""A node of each definition of MaterialX's library, with nothing but its defaults."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.frontend import Frontend
from burnish.materialx.importing import imported
from burnish.materialx.library import library
from burnish.materialx.values import TYPES

EACH = 200
"""How many nodes a document has: a file has no more than 256 materials."""


def shown() -> Iterator[str]:
    """Each output of each definition, as a node and an output of a document."""
    for definition in library().getNodeDefs():
        outputs = definition.getActiveOutputs()
        for output in outputs:
            if output.getType() in TYPES:
                yield _shown(definition, output, is_one_of_many=len(outputs) > 1)


def _shown(definition: Any, output: Any, *, is_one_of_many: bool) -> str:
    name = f"{definition.getName()}_{output.getName()}"
    kind = "multioutput" if is_one_of_many else output.getType()
    link = f' output="{output.getName()}"' if is_one_of_many else ""
    # A file and the name of a value of the mesh have no defaults.
    needed = {"filename": "a.png", "string": "paint"}
    inputs = "".join(
        f'<input name="{port.getName()}" type="{port.getType()}" value="{needed[port.getType()]}"/>'
        for port in definition.getActiveInputs()
        if port.getType() in needed and not port.getValueString()
    )
    tag = definition.getNodeString()
    return (
        f'<{tag} name="{name}" type="{kind}" nodedef="{definition.getName()}">{inputs}</{tag}>'
        f'<output name="o_{name}" type="{output.getType()}" nodename="{name}"{link}/>'
    )


@pytest.mark.parametrize("part", range(5))
def test_all_nodes_are_right_with_their_defaults(part: int, tmp_path: Path) -> None:
    rows = list(islice(shown(), part * EACH, (part + 1) * EACH))
    assert rows
    path = tmp_path / "nodes.mtlx"
    path.write_text(f'<materialx version="1.39">{"".join(rows)}</materialx>')
    found = imported(path)
    assert not [str(problem) for problem in found.problems if problem.is_error]
    for name, content in found.files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(content)
    report = Report()
    frontend = Frontend(report)
    module = frontend.open_file(tmp_path / found.main)
    assert module is not None
    frontend.check(module, None, None)
    errors = [found for found in report.diagnostics if found.severity == "error"]
    assert not errors, render_all(errors)


def test_no_node_is_left_out() -> None:
    assert len(list(shown())) <= 5 * EACH


PLASTIC = """<materialx version="1.39">
<nodedef name="ND_plastic" node="plastic"><input name="size" type="float" value="2"/>
<output name="out" type="surfaceshader"/></nodedef>
<nodegraph name="NG_plastic" nodedef="ND_plastic">
<oren_nayar_diffuse_bsdf name="b" type="BSDF"/>
<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/>
<input name="opacity" type="float" interfacename="size"/></surface>
<output name="out" type="surfaceshader" nodename="s"/></nodegraph>
<plastic name="a" type="surfaceshader"/>
<mix name="c" type="surfaceshader"><input name="fg" type="surfaceshader" nodename="a"/></mix>
<surfacematerial name="M" type="material">
<input name="surfaceshader" type="surfaceshader" nodename="c"/></surfacematerial>
</materialx>
"""


def test_closures_of_a_mixed_model_have_the_arguments_that_they_read(tmp_path: Path) -> None:
    """Here there are none: the one input is for the opacity alone."""
    path = tmp_path / "plastic.mtlx"
    path.write_text(PLASTIC)
    text = imported(path).files["plastic.burnish"].decode()
    assert "term plastic(size: float = 2) =" in text
    assert "term plastic_bsdf(asked: Asked) =" in text
    assert "term plastic_lit() per light =" in text
