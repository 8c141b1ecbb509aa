"""``burnish same`` and ``burnish.same``: answers, exit codes, and messages about bad input."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import burnish

from ..cli.kit import invoke

PLAIN = """burnish 1
material Plain {
    param base   : rgb = #804020
    param weight : float in 0..1 = 0.5
    tint  = base * weight
    color = tint
}
"""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.burnish").write_text(PLAIN)
    Path("b.burnish").write_text(PLAIN.replace("base * weight", "base - base * (1 - weight)"))
    Path("c.burnish").write_text(PLAIN.replace("base * weight", "base * (weight * 1.001)"))
    Path("two.burnish").write_text(
        PLAIN + PLAIN.replace("burnish 1\n", "").replace("Plain", "Other")
    )
    Path("wrong.burnish").write_text("burnish 1\nmaterial Wrong { color = missing }\n")


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("a.burnish", "a.burnish"), 0, "same  Plain: proven, as both are the same expression"),
        (("a.burnish", "b.burnish"), 0, "same  Plain: proven for all values, by algebra"),
        (("a.burnish", "c.burnish"), 1, "differs  Plain: color."),
        (("a.burnish", "c.burnish", "--epsilon", "0.01"), 0, "the difference is at most 0.001"),
        (("a.burnish", "c.burnish", "--set", "weight=0"), 0, "same  Plain"),
        (("a.burnish", "a.burnish", "--set-b", "weight=1"), 1, "differs  Plain"),
        (("a.burnish", "a.burnish", "--set-a", "base=#ffffff", "--set-b", "base=1,1,1"), 0, "same"),
        (("a.burnish", "c.burnish", "--range", "weight=0..0.05"), 0, "difference is at most 5e-05"),
        (("a.burnish", "c.burnish", "--set", "weight=0..0.05"), 0, "difference is at most 5e-05"),
        (("two.burnish#Plain", "two.burnish#Other"), 0, "same  Plain, Other"),
        (("two.burnish", "a.burnish"), 0, "note: only one of both files has Other"),
    ],
)
def test_an_answer_has_an_exit_code(words: tuple[str, ...], code: int, said: str) -> None:
    result = invoke("same", *words)
    assert said in result.output
    assert result.exit_code == code


def test_a_difference_is_told_with_values_and_the_place_where_it_begins() -> None:
    result = invoke("same", "a.burnish", "c.burnish")
    assert "where weight = 0.5, base.x = 0.2" in result.stdout
    assert "first in `tint`: " in result.stdout
    assert "A: a.burnish:5:13" in result.stdout
    assert "B: c.burnish:5:13" in result.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("a.burnish", "none.burnish"), "none.burnish"),
        (("a.burnish", "wrong.burnish"), "missing"),
        (("a.burnish#Plane", "a.burnish"), "did you mean `Plain`?"),
        (("a.burnish", "a.burnish", "--set", "wieght=1"), "did you mean `weight`?"),
        (("a.burnish", "a.burnish", "--set", "base=1,2"), "`base` has 3 numbers, and not 2"),
        (("a.burnish", "a.burnish", "--set", "weight=much"), "'weight=much' is no value"),
        (("a.burnish", "a.burnish", "--range", "weight=2"), "'weight=2' is no range"),
        (("a.burnish", "a.burnish", "--range", "weight=2..1"), "`weight`: 2..1 is no range"),
        (("a.burnish", "a.burnish", "--epsilon", "0"), "has to be more than 0"),
        (("a.burnish", "a.burnish", "--pass", "Depth"), "Depth"),
    ],
)
def test_what_cannot_be_compared_ends_with_two(words: tuple[str, ...], said: str) -> None:
    result = invoke("same", *words)
    assert said in result.output
    assert result.exit_code == 2


def test_a_parameter_is_one_in_both_whatever_its_default_and_range() -> None:
    Path("f.burnish").write_text(PLAIN.replace("0..1 = 0.5", "0..2 = 0.75"))
    result = invoke("same", "a.burnish", "f.burnish")
    assert "note: `weight` is in 0..1 in A and in 0..2 in B: both ranges count" in result.output
    assert result.exit_code == 0
    Path("f.burnish").write_text(
        PLAIN.replace("float in 0..1 = 0.5", "int in 0..1 = 1").replace(
            "base * weight", "base * float(weight)"
        )
    )
    result = invoke("same", "a.burnish", "f.burnish")
    assert "`weight` is float in A and int in B" in result.output
    assert result.exit_code == 2


def test_kernels_are_compared_but_not_work_groups() -> None:
    kernels = """kernel Doubled { result twice : float[64] = 2 * float(index) }\n"""
    Path("k.burnish").write_text(kernels)
    Path("l.burnish").write_text(kernels.replace("2 * float(index)", "float(index + index)"))
    assert invoke("same", "k.burnish", "l.burnish").exit_code == 0
    Path("g.burnish").write_text(
        "kernel Doubled { result twice : float[64] = group_sum(float(index)) }\n"
    )
    result = invoke("same", "k.burnish", "g.burnish")
    assert "Doubled joins the values of a work group, which is not compared" in result.output
    assert result.exit_code == 2


def test_what_is_not_decided_is_told_with_its_share() -> None:
    text = PLAIN.replace("base * weight", "base * exp(sin(weight * 3) + cos(base.x * base.y))")
    Path("d.burnish").write_text(text)
    Path("e.burnish").write_text(
        text.replace("exp(sin(weight * 3)", "exp(2 * sin(weight * 1.5) * cos(weight * 1.5)")
    )
    result = invoke("same", "d.burnish", "e.burnish", "--boxes", "20")
    assert "% of the space" in result.stdout
    assert "open, among others: " in result.stdout
    assert result.exit_code == 3


def test_json_has_all_of_it() -> None:
    result = invoke("same", "a.burnish", "c.burnish", "--format", "json")
    (row,) = json.loads(result.stdout)["result"]["comparisons"]
    assert row["verdict"] == "different"
    assert row["witness"]["first_difference"]["name"] == "tint"
    assert row["domain"]["weight"] == [0.0, 1.0]


def test_python_returns_a_record() -> None:
    assert burnish.same(PLAIN, Path("b.burnish")).means == "algebra"
    found = burnish.same(Path("a.burnish"), Path("a.burnish"), second_values={"weight": 0.25})
    assert found.verdict == "different"
    with pytest.raises(burnish.SameError, match="there is no parameter or input `wait`"):
        burnish.same(PLAIN, PLAIN, values={"wait": 1})
