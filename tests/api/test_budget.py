"""The limits of what received data may take, and how they are raised."""

from __future__ import annotations

import click
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st

from burnish.commands.options import budget_option
from burnish.compiler import budget
from burnish.compiler.budget import LIMITS, BudgetError, allowed, amount_of, check, raised


def test_what_is_within_its_limit_passes() -> None:
    check("nodes", LIMITS["nodes"].most, "`a.glb` has")


def test_what_is_more_is_told_with_the_option_that_allows_it() -> None:
    with pytest.raises(BudgetError) as told:
        check("nodes", 5_000_001, "`a.glb` has")
    assert str(told.value) == (
        "`a.glb` has 5,000,001 nodes, and the limit is 100,000 nodes: "
        "`--budget nodes=5001k` raises it"
    )


def test_bytes_are_told_in_larger_units() -> None:
    with pytest.raises(BudgetError) as told:
        check("memory", 12_884_901_888, "the frame needs")
    assert str(told.value) == (
        "the frame needs 12.9 GB, and the limit is 1 GB: `--budget memory=13G` raises it"
    )


def test_limits_are_raised_for_a_while() -> None:
    with raised({"nodes": 10**7}):
        check("nodes", 5_000_001, "`a.glb` has")
        with raised({"memory": 2 * 10**9}):
            assert budget.current() == {"nodes": 10**7, "memory": 2 * 10**9}
        assert budget.current() == {"nodes": 10**7}
    assert allowed("nodes") == LIMITS["nodes"].most


@given(st.integers(0, 10**15))
def test_what_a_message_proposes_is_enough_and_not_much_more(amount: int) -> None:
    proposed = amount_of(budget.rounded_up(amount))
    assert amount <= proposed <= amount * 1.1 + 1


@pytest.mark.parametrize("text", ["", "-1", "1.5G", "4T", "1e9", "4 G", "9" * 16, "4G\n"])
def test_what_is_no_amount(text: str) -> None:
    with pytest.raises(ValueError, match="is no amount, which would be like 500k, 20M or 4G"):
        amount_of(text)


@click.command()
@budget_option
def _tell() -> None:
    click.echo(f"{allowed('memory')} {allowed('nodes')}")


def test_a_command_raises_limits_until_it_ends() -> None:
    done = CliRunner().invoke(_tell, ["--budget", "memory=4G", "--budget", "nodes=7"])
    assert done.output == "4000000000 7\n"
    assert budget.current() == {}


@pytest.mark.parametrize(
    ("given_", "told"),
    [
        ("memry=4G", "there is no limit 'memry': did you mean `memory`?"),
        ("memory", "'memory' is not NAME=VALUE"),
        ("memory=much", "'much' is no amount, which would be like 500k, 20M or 4G"),
    ],
)
def test_mistakes_are_told(given_: str, told: str) -> None:
    done = CliRunner().invoke(_tell, ["--budget", given_])
    assert done.exit_code == 2
    assert told in " ".join(done.output.split())
