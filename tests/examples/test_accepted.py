"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

import burnish
from burnish import CompileResult
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.codes import modules
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Job, Toolchain, Verdict

from ..frames.kit import EXAMPLES as FRAMES
from ..frames.kit import LACKING as LACKING_OF_FRAMES
from ..suite.verdicts import refused
from ..targets.standings import PROFILES
from .kit import EXAMPLES, VARIANTS, Variant, jobs_of

OF_ROUTES = {route.compiler for route in ROUTES.values()}
"""The checkers that compile for routes, by which every example is drawn as well."""


AT_ONCE = 16
"""Subjects whose texts the front ends get together. A process of glslang reads the declarations of
all functions that a language has, which takes longer than the texts of one example."""


@dataclass(frozen=True, slots=True)
class Compiled:
    """An example, or a variant of one, and all that it comes to."""

    result: CompileResult
    asked: frozenset[Job]
    """All texts that the front ends had to take."""
    refused: tuple[Verdict, ...]
    """Their verdicts on those that they do not take."""


Subject = Variant | Path
"""A variant of an example, or an example of a frame."""
Find = Callable[[Subject], Compiled]


def in_groups(subjects: Sequence[Subject]) -> list[ParameterSet]:
    """The subjects as parameters of tests, those together for which the front ends start once."""
    return [
        pytest.param(
            subject,
            id=subject.stem if isinstance(subject, Path) else f"{subject}",
            marks=pytest.mark.xdist_group(f"accepted {type(subject).__name__} {at // AT_ONCE}"),
        )
        for at, subject in enumerate(subjects)
    ]


def neighbours(subject: Subject) -> Sequence[Subject]:
    """A subject, and the others of its group."""
    everyone: Sequence[Subject] = FRAMES if isinstance(subject, Path) else VARIANTS
    first = everyone.index(subject) // AT_ONCE * AT_ONCE
    return everyone[first : first + AT_ONCE]


def compiled_together(subjects: Sequence[Subject], toolchain: Toolchain) -> dict[Subject, Compiled]:
    """Compile some subjects, and have the front ends read the texts of all."""
    results = {
        each: burnish.compile(each, PROFILES, partial=True)
        if isinstance(each, Path)
        else each.compile()
        for each in subjects
    }
    asked = {each: frozenset(jobs(result)) for each, result in results.items()}
    together = list(dict.fromkeys(job for result in results.values() for job in jobs(result)))
    made = modules([job for job in together if job.checker in OF_ROUTES], toolchain)
    found = refused([job for job in together if job.checker not in OF_ROUTES], toolchain)
    found += [each for each in made.values() if isinstance(each, Verdict)]
    return {
        each: Compiled(result, asked[each], tuple(v for v in found if v.job in asked[each]))
        for each, result in results.items()
    }


def subjects_of(session: pytest.Session) -> frozenset[object]:
    """The parameters of all tests here that a run has: a few of them ask about few texts."""
    ours = [item for item in session.items if item.path == Path(__file__)]
    found = (getattr(item, "callspec", None) for item in ours)
    return frozenset(value for each in found if each for value in each.params.values())


@pytest.fixture(scope="module")
def find(request: pytest.FixtureRequest, toolchain: Toolchain) -> Find:
    """Finds what a subject comes to; tests of a group follow each other, so that it is kept."""
    kept: dict[Subject, Compiled] = {}
    wanted = subjects_of(request.session)

    def found(subject: Subject) -> Compiled:
        if subject not in kept:
            kept.clear()
            together = [each for each in neighbours(subject) if each in wanted]
            kept.update(compiled_together(together, toolchain))
        return kept[subject]

    return found


@pytest.fixture(scope="module", params=in_groups(VARIANTS))
def variant(request: pytest.FixtureRequest) -> Variant:
    """Each variant; tests of one follow each other, also where one process runs all."""
    found: Variant = request.param
    return found


def jobs(result: CompileResult) -> Iterator[Job]:
    for material in result.materials:
        yield from jobs_of(material)


def check_accepted(compiled: Compiled) -> None:
    result = compiled.result
    assert not result.diagnostics
    assert result.materials
    assert not compiled.refused, "\n".join(verdict.report() for verdict in compiled.refused)
    wanted = sum(
        len(material.staged.program.stages) * (len(PROFILES) - len(material.lacking))
        for material in result.materials
    )
    assert sum(1 for _ in jobs(result)) >= wanted


@cache
def shared_layouts() -> Mapping[str, str]:
    """The ids of the layout of set 0 in one material, by profile."""
    plastic = next(variant for variant in VARIANTS if variant.path.stem == "plastic")
    (material,) = plastic.compile().materials
    return layouts(material, 0)


def layouts(material: CompiledMaterial, group: int) -> Mapping[str, str]:
    """The ids of a material's layouts of one group, by profile."""
    return {
        name: row.layout_id
        for name, backend in material.reflection.backends.items()
        for row in backend.layouts
        if row.group == group
    }


def check_layouts(material: CompiledMaterial) -> None:
    """All examples have one layout of set 0, in each profile."""
    assert layouts(material, 0).items() <= shared_layouts().items(), material.name


def test_accepted(variant: Variant, find: Find) -> None:
    check_accepted(find(variant))


def test_one_layout_for_the_view_and_one_for_a_rig(variant: Variant, find: Find) -> None:
    """A host binds these once, and then draws all materials."""
    materials = find(variant).result.materials
    for material in materials:
        check_layouts(material)
    lit = [material for material in materials if material.reflection.extent is None]
    of_rig = [layouts(material, 1) for material in lit]
    every = {name: layout for found in of_rig for name, layout in found.items()}
    assert every or not lit
    for found in of_rig:
        assert found.items() <= every.items()


def test_only_profiles_that_lack_something_are_left_out(variant: Variant, find: Find) -> None:
    for material in find(variant).result:
        assert material.lacking.keys() == variant.lacking(material.name), material.name


@pytest.mark.parametrize("path", in_groups(FRAMES))
def test_frames_are_accepted(path: Path, find: Find) -> None:
    """Each frame, for all profiles that can do what it shows."""
    compiled = find(path)
    lacking = {name for material in compiled.result.materials for name in material.lacking}
    assert lacking == LACKING_OF_FRAMES.get(path.stem, frozenset())
    check_accepted(compiled)
    for material in compiled.result.materials:
        check_layouts(material)


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)
