"""A language is added in a folder of its own, and nothing else changes.

The one that is added here, Ledger, is made up to be as little like C as can be said: words instead
of braces, no semicolons, other letters for lanes, entry points of many names, textures that have
their samplers in them, and bindings without sets. What it has is a row, and so is what it lacks.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import burnish
import burnish.targets
from burnish.api import entry_points as api
from burnish.targets import registry

from ..cli.kit import invoke

LANGUAGE = '''
"""Ledger."""

from functools import partial
from pathlib import Path

from burnish.compiler.ir.types import BOOL, UINT, VEC4
from burnish.targets.description.shading_language import Language
from burnish.targets.description.profile import Profile, Samplers
from burnish.targets.description.spellings import (
    PipelineInput, Read, Spelling, TextureNames, TypeNames,
)
from burnish.targets.description.forms import Forms
from burnish.targets.description.reserved import read_reserved

FOLDER = Path(__file__).parent

LANGUAGE = Language(
    name="ledger",
    title="Ledger",
    unproven="made up",
    skeleton=FOLDER / "shader.ledger.j2",
    extension="ledger",
    entry_point="the_{entry}",
    types=TypeNames(
        scalars={"float": "num", "int": "whole", "uint": "count", "bool": "truth"},
        vectors={"float": "num{n}", "int": "whole{n}", "uint": "count{n}", "bool": "truth{n}"},
        matrix="grid{n}",
        rectangular_matrix="grid{columns}x{rows}",
        array="row({count} of {element})",
        declaration="{name} is {type}",
        stored={"vec3": "tight3"},
    ),
    textures=TextureNames(
        dimensions={
            "2d": "flat", "2d_array": "stack", "3d": "solid", "cube": "box", "cube_array": "boxes",
        },
        textures={}, samplers={"filtering": "", "comparison": ""},
        combined=dict.fromkeys(("float", "depth", "int", "uint"), "{dimension}_picture"),
        compared="{dimension}_shadow",
    ),
    forms=Forms(
        let="let {typed} be {value}",
        constant_array="fixed {typed} be {value}",
        variable="set aside {typed}",
        variable_set="keep {typed} at {value}",
        assign="{name} := {value}",
        accumulate={},
        if_="when {condition} do",
        else_="otherwise",
        else_if="otherwise when {condition} do",
        end="done",
        loop="for each {index} from {zero} below {count} do",
        loop_while="for each {index} from {zero} below {count} as long as {going} do",
        leave="unless {going} stop",
        return_="give {value}",
        discard="forget",
        function="work {name}({parameters}) gives {type}",
        member_end="",
        struct_end="done",
        select="either({then}, {otherwise}, {condition})",
        at_most="least({value}, {bound})",
        constructor="{type} of ({parts})",
        swizzle="pick {lanes} of ({vector})",
        element="nth({aggregate}, {position})",
        array="list({elements})",
        member="{block}.{name}",
        stored="loose({value})",
        texture="{texture}",
        input="given.{name}",
        block_argument="{name} is paper {type}",
        lanes="abcd",
    ),
    natives={
        "saturate": "within({0}, 0.0, 1.0)",
        "mul": Spelling(matrix="times"),
        "sample": Read("{0}.at({1})", "{0}.at({1}, {2})"),
    },
    inputs={
        "frag_coord": PipelineInput(VEC4, "given.{name}", "pixel"),
        "front_facing": PipelineInput(BOOL, "given.{name}", "front"),
        "vertex_index": PipelineInput(UINT, "given.{name}", "number"),
        "instance_index": PipelineInput(UINT, "given.{name}", "copy"),
    },
    profiles=(
        Profile(
            name="only", doc="The only one.", numbering="kind", single_file=True,
            samplers=Samplers(combined=True), lacks=frozenset({"count_bits"}),
            without_inputs=frozenset({"view_index"}),
        ),
    ),
    registers={"block": "paper {binding}", "texture": "picture {binding}"},
    resource_arguments=True,
    global_members=False,
    reserved=partial(read_reserved, FOLDER / "reserved.txt", "the_"),
    fixed_names=("given", "taken"),
)
'''

SKELETON = """{% extends "skeleton.j2" %}
{% block interface %}
{% for way, list in (("given", entry.inputs), ("taken", entry.outputs)) %}

struct {{ entry.name }}_{{ way }}
{% for field in list %}
    {{ field.typed }} at {{ field.location }}
{% endfor %}
done
{% endfor %}
{% endblock %}
{% block struct_head %}
struct {{ struct.name }}
{% endblock %}
{% block uniform_block %}
struct {{ block.name }}
{% endblock %}
{% block entry_head %}
{% set comma = joiner(", ") %}
work {{ entry.name }}(
{%- for block in entry.blocks %}{{ comma() }}{{ block.argument }} ({{ block.register }}){% endfor %}
{%- for texture in entry.textures %}
{{- comma() }}{{ texture.name }} is {{ texture.type }} ({{ texture.register }})
{%- endfor %}
)
{% endblock %}
{% block results %}
{% for store in entry.stores %}
    taken.{{ store.name }} := {{ store.value }}
{% endfor %}
{% if entry.position %}
    place := {{ entry.position }}
{% if flip_y %}
    place.b := -place.b
{% endif %}
{% endif %}
{% for line in entry.discard %}
    {{ line }}
{% endfor %}
{% endblock %}
"""

EXAMPLES = Path(__file__).parents[2] / "examples"


def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, language: str, skeleton: str) -> str:
    """The language's name; its folder is beside the others for the time of a test."""
    folder = tmp_path / "languages" / "ledger"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "language.py").write_text(language)
    (folder / "shader.ledger.j2").write_text(skeleton)
    (folder / "reserved.txt").write_text("normal position  # keywords\n")
    folders = [*burnish.targets.__path__, str(folder.parent)]
    monkeypatch.setattr(burnish.targets, "__path__", folders)
    monkeypatch.setattr(registry, "folders", folders)
    registry.load.cache_clear()
    monkeypatch.delitem(sys.modules, "burnish.targets.ledger.language", raising=False)
    monkeypatch.delitem(sys.modules, "burnish.targets.ledger", raising=False)
    return "ledger"


@pytest.fixture
def ledger(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The language, beside the others."""
    return installed(tmp_path, monkeypatch, LANGUAGE, SKELETON)


WRITTEN = """
struct Point
    diffuse_color is tight3
    pad_0 is num
...
    eye is tight3  /// Where the viewer stands
done
...
struct the_fs_main_given
    position_ is num3 at 0
...
work lambert_phong(
...
    tint is num3, to_eye is num3
) gives num3
...
work the_fs_main(
...
    derived_from_rig is paper DerivedFromRig (paper 7), material is paper Material (paper 3),
    albedo is flat_picture (picture 0)
)
    let tint is num3 be loose(material.base) * pick abc of (albedo.at(given.uv))
...
    keep color_total is num3 at num3 of (0.0)
    for each i from 0 below least(rig.lamps_count, 8) do
...
        ) + color_total
    done
...
    taken.color := num4 of (color, 1.0)
done
"""
"""Parts of a text, each of whole lines."""


def test_a_material_is_written_in_it(ledger: str) -> None:
    (compiled,) = burnish.compile(EXAMPLES / "plastic.burnish", ledger)
    text = compiled.text(ledger, "fragment")
    for part in WRITTEN.strip("\n").split("\n...\n"):
        assert f"\n{part}\n" in text
    assert not set("{};") & set(text)
    backend = compiled.reflection.backends["ledger:only"]
    assert backend.blocks["Material"].register == "paper 3"
    assert {row.entry_point for row in backend.files} == {"the_vs_main", "the_fs_main"}


def test_every_statement_has_its_place_in_the_material(ledger: str) -> None:
    begun: set[str] = set()
    for pass_ in (None, "Forward"):
        (compiled,) = burnish.compile(EXAMPLES / "cutout.burnish", ledger, pass_=pass_)
        for file in compiled.files:
            lines = dict(enumerate(file.text.split("\n"), start=1))
            begun |= {lines[number].split()[0] for number in file.spans}
    assert begun >= {"let", "place", "taken.color", "when", "forget"}
    assert not begun & {"done", "otherwise", "struct", "work", "//"}


def test_it_is_listed_and_can_be_chosen(ledger: str, tmp_path: Path) -> None:
    assert "unproven: made up" in invoke("targets").output
    invoke("compile", EXAMPLES / "plastic.burnish", "-t", ledger, "-o", tmp_path / "out")
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"Plastic.json", "Plastic.vert.ledger", "Plastic.frag.ledger"}
    assert ledger not in registry.defaults()


def test_both_stages_stand_in_one_text(ledger: str) -> None:
    (compiled,) = burnish.compile(EXAMPLES / "plastic.burnish", ledger, single_file=True)
    (file,) = compiled.files
    assert file.entry_points == {"vertex": "vs_main", "fragment": "fs_main"}
    assert "work vs_main(" in file.text and "work fs_main(" in file.text


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.burnish")), ids=lambda path: path.stem)
def test_every_example_is_written_in_it(ledger: str, example: Path) -> None:
    for rig, pass_ in api.variants(example):
        assert burnish.compile(example, ledger, rig=rig, pass_=pass_, partial=True).materials
