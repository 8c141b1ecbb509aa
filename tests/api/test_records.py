"""Records are as cheap to declare as they are because they do little: this much they do."""

from __future__ import annotations

import pickle

import pytest

from burnish.frozen import fresh, frozen, record


@record
class Basket:
    owner: str
    things: list[str] = fresh(factory=list)
    weight: int = 0


@frozen
class Label:
    text: str
    marks: dict[str, int] = fresh(factory=dict)


def test_a_record_can_be_changed_and_is_equal_to_itself_alone() -> None:
    one, other = Basket("a"), Basket("a")
    one.weight = 2
    assert (one.weight, other.weight) == (2, 0)
    assert one == one  # noqa: PLR0124
    assert one != other
    assert len({one, other}) == 2
    with pytest.raises(AttributeError):
        setattr(one, "price", 3)  # noqa: B010


def test_fresh_defaults_are_shared_by_no_two_records() -> None:
    one, other, given = Basket("a"), Basket("b"), Basket("c", ["d"])
    one.things.append("e")
    assert (one.things, other.things, given.things) == (["e"], [], ["d"])
    first, second = Label("a"), Label("a")
    assert first.marks is not second.marks
    assert first == second


def test_records_show_their_fields_and_can_be_pickled() -> None:
    basket = Basket("a", ["b"])
    assert repr(basket) == "Basket(owner='a', things=['b'], weight=0)"
    copy = pickle.loads(pickle.dumps(basket))
    assert (copy.owner, copy.things) == ("a", ["b"])
