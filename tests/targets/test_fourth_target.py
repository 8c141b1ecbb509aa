"""A language can be added in a folder of its own, and nothing else changes."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish.targets
from burnish.targets import registry
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.legalise import legalise

from .programs import plastic

TARGET = """
from functools import partial
from pathlib import Path

from burnish.targets.emit.description import Profile, Target, TextureNames, TypeNames
from burnish.targets.emit.reserved import read_reserved

FOLDER = Path(__file__).parent
TARGET = Target(
    name="toy",
    title="Toy",
    folder=FOLDER,
    template="shader.toy.j2",
    extension="toy",
    types=TypeNames(
        scalars={"float": "num", "int": "whole", "uint": "count", "bool": "truth"},
        vectors={"float": "num{n}", "int": "whole{n}", "uint": "count{n}", "bool": "truth{n}"},
        matrix="grid{n}",
        tall_matrix="grid{n}x4",
    ),
    textures=TextureNames({"2d": ""}, {"float": "paper{dimension}"}, {"filtering": "pen"}),
    natives={"saturate": "sat", "sample": "{0}.read({sampler}, {1})"},
    profiles=(Profile(name="only", doc="The only one."),),
    reserved=partial(read_reserved, FOLDER / "reserved.txt"),
    global_fields=True,
)
"""

SKELETON = """{% for entry in file.entries %}
{{ entry.stage }} {{ entry.name }}:
{% for line in entry.lines %}
    {{ line }}
{% endfor %}
{% for store in entry.stores %}
    {{ store.name }} := {{ store.value }}
{% endfor %}
{% endfor %}
"""


def test_fourth_target(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "toy"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "target.py").write_text(TARGET)
    (folder / "shader.toy.j2").write_text(SKELETON)
    (folder / "reserved.txt").write_text("normal  # a keyword\n")
    folders = [*burnish.targets.__path__, str(tmp_path)]
    monkeypatch.setattr(burnish.targets, "__path__", folders)
    monkeypatch.setattr(registry, "folders", folders)

    assert "toy" in registry.names()
    target, profile = registry.select("toy")
    fragment = emit(legalise(plastic(), target, profile)).files[1].text
    assert "num3 normal_ = normalize(normal_2.xyz);" in fragment
    assert "albedo.read(albedo_sampler, uv_)" in fragment
