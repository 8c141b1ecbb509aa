"""Passes without targets: every route leaves the depths that the reference has."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledMaterial, OutputFile
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from .kit import PROFILES, Studio

FILE = Path(__file__).with_name("without_targets.burnish")
SIZE = (24, 20)
WITH_FRAGMENTS = {"glsl:es300", "glsl:es310"}
"""The profiles whose programs have a fragment shader in any case."""


@cache
def drawn_by(pass_: str) -> burnish.CompileResult:
    return burnish.compile(FILE, PROFILES, pass_=pass_)


def judged(route: str, subject: CompiledMaterial, studio: Studio) -> Row:
    subjects = [(subject.name, subject)]
    (row,) = conform(subjects, [ROUTES[route]], studio.runner, studio.toolchain, size=SIZE)
    return row


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("material", ["Whole", "Striped"])
def test_every_route_leaves_the_depths(studio: Studio, material: str, route: str) -> None:
    row = judged(route, drawn_by("Deep")[material], studio)
    assert row.status == "agrees", "\n".join(details(row))


@pytest.mark.parametrize("route", ["lavapipe:glsl", "llvmpipe:gl330", "chromium:webgpu"])
@pytest.mark.parametrize("pass_", ["Bulging", "Counting", "Sliced", "Seen"])
def test_whatever_else_a_pass_does(studio: Studio, pass_: str, route: str) -> None:
    row = judged(route, drawn_by(pass_)["Striped"], studio)
    assert row.status == "agrees", "\n".join(details(row))


def test_there_is_no_fragment_stage_where_it_does_nothing() -> None:
    whole, striped = (drawn_by("Deep")[name] for name in ("Whole", "Striped"))
    for profile in PROFILES:
        language, name = profile.split(":")
        stages = [
            [file.stage for file in each.files if (file.target, file.profile) == (language, name)]
            for each in (whole, striped)
        ]
        always = ["fragment"] if profile in WITH_FRAGMENTS else []
        assert stages == [["vertex", *always], ["vertex", "fragment"]]
    assert whole.reflection.targets == ()


def farther(file: OutputFile) -> OutputFile:
    if file.stage != "vertex":
        return file
    body = file.text.rstrip().removesuffix("}")
    return changed(file, text=f"{body}    gl_Position.z += 0.0001;\n}}\n")


def unhidden(file: OutputFile) -> OutputFile:
    return changed(file, text=file.text.replace("discard;", ""))


@pytest.mark.parametrize("mistake", [farther, unhidden])
@pytest.mark.parametrize("route", ["lavapipe:glsl", "llvmpipe:gl330"])
def test_a_mistake_in_the_depths_is_noticed(studio: Studio, route: str, mistake: object) -> None:
    assert callable(mistake)
    right = drawn_by("Deep")["Striped"]
    wrong = changed(right, files=tuple(map(mistake, right.files)))
    assert judged(route, wrong, studio).status == "differs"
