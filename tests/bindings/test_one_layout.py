"""All examples have one layout of the set of the view in the tables of each language.

So a host binds the view once, and draws with all materials of a project.
"""

from __future__ import annotations

import re
from types import ModuleType
from typing import Any

from burnish.bindings import registry
from burnish.bindings.writing import written

from .kit import everything


def _text(language: str) -> str:
    return written(everything(), registry.load(language))


def _squeezed(text: str) -> str:
    """A text without blanks, however it is folded."""
    return "".join(text.split()).replace(",]", "]").replace(",)", ")").replace(",}", "}")


def test_python() -> None:
    module: Any = ModuleType("examples_binding")
    exec(compile(_text("python"), "examples_binding.py", "exec"), module.__dict__)
    found = [module.bind_group_layouts(each)[0] for each in module.MATERIALS]
    assert len(found) > 100
    every = {"visibility": 7, "buffer": {"type": "uniform"}}
    expected = [{"binding": 0, **every}, {"binding": 1, **every}]
    assert [each for each in found if each != expected] == []


def test_typescript() -> None:
    found = re.findall(r"bindGroupLayouts:\[(\{entries:\[.*?\]\}),", _squeezed(_text("typescript")))
    assert len(found) == len(everything().materials)
    entry = '{binding:%d,visibility:7,buffer:{type:"uniform"}}'
    assert set(found) == {f"{{entries:[{entry % 0},{entry % 1}]}}"}


def test_rust() -> None:
    text = _squeezed(_text("rust"))
    found = re.findall(r"groups:&\[&\[(.*?)\][,\]]", text)
    assert len(found) == len(everything().materials)
    stages = "ShaderStages::VERTEX.union(ShaderStages::FRAGMENT.union(ShaderStages::COMPUTE))"
    entry = f"entry(%d,{stages},uniform(0))"
    assert set(found) == {f"{entry % 0},{entry % 1}"}


def test_cpp() -> None:
    tables = re.findall(r"_bindings\[\]=\{(.*?)\};", _squeezed(_text("cpp")))
    found = {tuple(re.findall(r"Kind::(\w+),0,(\d+),(\d+)", each)) for each in tables}
    assert len(tables) == len(everything().materials)
    assert found == {(("uniform", "0", "7"), ("uniform", "1", "7"))}
