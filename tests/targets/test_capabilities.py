"""Each cell of the table of capabilities is what it says, and so is what messages take from it."""

from __future__ import annotations

import pytest
from _pytest.mark import ParameterSet

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.targets.availability import way_out, with_as_many
from burnish.targets.description.capabilities import (
    CAPABILITIES,
    feature_of_builtin,
    lacking,
)
from burnish.targets.description.capability import (
    Capability,
    feature_of_stage,
    is_only_on_request,
    standing,
)
from burnish.targets.description.profile import LIMITED, Limits, Profile
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..suite import verdicts
from .capability_probes import PROBES, Probe
from .kit import BY_NAME

CELLS = [(row, name) for row in CAPABILITIES for name in BY_NAME]


def cells(*kinds: str) -> list[ParameterSet]:
    """The cells that say one of these."""
    return [
        pytest.param(row, name, id=f"{row.name}-{name}")
        for row, name in CELLS
        if standing(row, profile_of(name)).kind in kinds
    ]


def profile_of(name: str) -> Profile:
    return BY_NAME[name].profile


def compiled(row: Capability, name: str) -> CompiledMaterial:
    """The probe of a row as the profile carries it out: by its own means, if it has them."""
    is_native = standing(row, profile_of(name)).kind == "native"
    return PROBES[row.name].compile(name, native=is_native)


def refused(probe: Probe, profile: str, *, native: bool = False) -> tuple[Diagnostic, ...]:
    """The errors about a probe that cannot be compiled for a profile."""
    with pytest.raises(burnish.CompileError) as caught:
        probe.compile(profile, native=native)
    return tuple(caught.value.diagnostics)


def test_every_row_has_a_probe_and_a_name_of_its_own() -> None:
    assert list(PROBES) == [row.name for row in CAPABILITIES]


@pytest.mark.parametrize(("row", "name"), cells("native"))
def test_what_is_native_uses_the_profiles_own_means(row: Capability, name: str) -> None:
    probe = PROBES[row.name]
    assert probe.is_native(probe.compile(name, native=True))


@pytest.mark.parametrize(("row", "name"), cells("lowered"))
def test_what_is_lowered_does_without_them(row: Capability, name: str) -> None:
    probe = PROBES[row.name]
    assert not probe.is_native(probe.compile(name))
    if probe.native:
        (found,) = refused(probe, name, native=True)
        assert (found.rule.code, found.hint) == (
            "B0701", f"without `--native-stages`, {standing(row, profile_of(name)).how}",
        )  # fmt: skip


@pytest.mark.parametrize(("row", "name"), cells("absent"))
def test_what_is_absent_is_refused_with_a_way_out(row: Capability, name: str) -> None:
    missing, *_ = standing(row, profile_of(name)).missing
    probe = PROBES[row.name]
    (found,) = refused(probe, name, native=bool(probe.native))
    assert found.message == f"{name} has no {missing}"
    assert found.rule.code == "B0701"
    advice, _, others = found.hint.rpartition("compile for ")
    assert advice.removesuffix(", or ") == row.instead
    others_found = {word.strip(",") for word in others.split()} & BY_NAME.keys()
    assert others_found
    for other in others_found:
        assert compiled(row, other)


@pytest.fixture(scope="module")
def refusals() -> dict[tuple[str, str], list[str]]:
    """The compilers' errors about the texts, by probe and profile."""
    jobs = [
        (row.name, name, job)
        for row, name in CELLS
        if standing(row, profile_of(name)).kind != "absent"
        for job in jobs_of(compiled(row, name))
    ]
    with Toolchain() as toolchain:
        wrong = verdicts.refused([job for *_, job in jobs], toolchain)
    reports = {verdict.job: verdict.report() for verdict in wrong}
    found: dict[tuple[str, str], list[str]] = {}
    for row_name, name, job in jobs:
        of_cell = found.setdefault((row_name, name), [])
        if job in reports:
            of_cell.append(reports[job])
    return found


@pytest.mark.xdist_group("refusals")  # One process has the texts checked, for all cells.
@pytest.mark.parametrize(("row", "name"), cells("native", "lowered"))
def test_compilers_take_the_texts(
    refusals: dict[tuple[str, str], list[str]], row: Capability, name: str
) -> None:
    assert refusals[row.name, name] == []


ON_REQUEST = [
    pytest.param(row, name, id=f"{row.name}-{name}")
    for row, name in CELLS
    if is_only_on_request(row, profile_of(name))
]


@pytest.mark.parametrize(("row", "name"), ON_REQUEST)
def test_what_is_there_on_request_is_refused_without_it(row: Capability, name: str) -> None:
    (found,) = refused(PROBES[row.name], name)
    assert found.hint.startswith("compile with `--native-stages`")


def test_only_captures_have_to_be_requested() -> None:
    """All else is lowered where a profile's own stages are not asked for."""
    assert {param.id for param in ON_REQUEST} == {
        "captures-glsl:gl330", "captures-glsl:es300", "captures of expansions-glsl:gl330",
        "numbers of captured vertices-glsl:gl330",
    }  # fmt: skip


def test_all_stages_of_profiles_and_all_missing_builtins_are_in_the_table() -> None:
    for stage in {row for each in BY_NAME.values() for row in each.profile.stages}:
        assert lacking(feature_of_stage(stage)), stage.name
    for builtin in set().union(*(each.profile.cannot for each in BY_NAME.values())):
        assert lacking(feature_of_builtin(builtin)), builtin


def test_what_is_in_no_row_has_no_way_out() -> None:
    assert feature_of_builtin("sin") == "`sin`"
    assert way_out("`sin`", profile_of("wgsl:webgpu")) == ""


def test_unproven_languages_are_no_way_out() -> None:
    assert way_out("compute stage", profile_of("glsl:es300")) == (
        "compile for glsl:vulkan, glsl:gl450, glsl:es310, hlsl:sm6 or wgsl:webgpu"
    )


def test_every_limit_has_its_words() -> None:
    # Numbers run out nowhere: then only what is read has one.
    assert LIMITED.keys() == Limits.__annotations__.keys() - {"numbers"}


def test_profiles_with_higher_limits_are_a_way_out() -> None:
    assert with_as_many("varyings", 31) == "compile for hlsl:sm6"
    assert with_as_many("bindings", 1001).startswith("compile for glsl:vulkan, ")
    assert with_as_many("work_group", 10_000) == ""
    assert with_as_many("textures", 1000).endswith("beside each other in one `texture2d`")
