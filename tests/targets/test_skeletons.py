"""Skeletons are filled in by plain Python as Jinja would fill them in."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets import registry
from burnish.targets.description.forms import Forms
from burnish.targets.description.profile import Profile
from burnish.targets.emit import emitter, templates
from burnish.targets.emit.templates import by_jinja, renderer
from burnish.targets.emit.views import FileView

from .kit import PROFILES, Selected

EXAMPLES = Path(__file__).parents[2] / "examples"
EMPTY = FileView([], ["first", "second"], [], [], [], [], [], [], [], [])
PROFILE = Profile(name="any", doc="")


def filled(path: Path) -> str:
    return renderer(path)(EMPTY, Forms(), PROFILE, False)


def written(folder: Path, text: str) -> Path:
    path = folder / "shader.any.j2"
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    "example", ["plastic", "cutout", "indexed", "host_block", "confetti", "lanterns"]
)
@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_jinja_writes_the_same(
    example: str, selected: Selected, monkeypatch: pytest.MonkeyPatch
) -> None:
    def texts() -> list[str]:
        source = EXAMPLES / f"{example}.burnish"
        result = burnish.compile(source, str(selected), flip_y=True, partial=True)
        return [file.text for material in result for file in material.files]

    plain = texts()
    monkeypatch.setattr(emitter, "renderer", by_jinja)
    assert texts() == plain


@pytest.mark.parametrize("name", registry.defaults())
def test_skeletons_are_compiled(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(templates, "by_jinja", None)
    language = registry.load(name)
    renderer.__wrapped__(language.skeleton)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{% for line in file.header %}{{ loop.index }} {{ line }}\n{% endfor %}",
         "1 first\n2 second\n"),
        ("{{ file.header | join('+') }}", "first+second"),
        ("{% set a = 1 %}{% for x in file.header %}{% set a = 2 %}{% endfor %}{{ a }}", "1"),
        ("{% for a in [1] %}{% for a in [2] %}{{ a }}{% endfor %}{{ a }}{% endfor %}", "21"),
        ("{% set a = 1 %}{% for a in [2] %}{{ a }}{% endfor %}{{ a }}", "21"),
        ("{% for x in file.header if x != 'first' %}{{ x }}{% endfor %}", "second"),
    ],
)  # fmt: skip
def test_what_is_not_compiled_is_left_to_jinja(text: str, said: str, tmp_path: Path) -> None:
    assert filled(written(tmp_path, text)) == said


def test_a_block_sees_the_loop_around_it(tmp_path: Path) -> None:
    (tmp_path / "base.j2").write_text(
        "{% for line in file.header %}{% block each %}-{% endblock %}{% endfor %}"
    )
    text = '{% extends "base.j2" %}\n{% block each %}{{ line }};{% endblock %}\n'
    assert filled(written(tmp_path, text)) == "first;second;"


def test_what_there_is_not_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(AttributeError, match="heather"):
        filled(written(tmp_path, "{{ file.heather }}"))
