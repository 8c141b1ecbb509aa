"""Records are as cheap to declare as they are because they do little: this much they do."""

from __future__ import annotations

import copy
import pickle
import re
from collections.abc import Callable

import pytest

from burnish.support.frozen import cached_property, fresh, frozen, record


@record
class Basket:
    owner: str
    things: list[str] = fresh(factory=list)
    weight: int = 0


@frozen
class Label:
    text: str
    marks: dict[str, int] = fresh(factory=dict)


@frozen
class Crate:
    length: int
    width: int = 2
    height: int = 3


@frozen(kw_only=True)
class Order:
    number: int = 1
    buyer: str
    labels: list[Label] = fresh(factory=list)


@frozen(key=True)
class Place:
    shelf: str
    row: int = 0


@frozen
class Nothing:
    pass


@frozen
class Pile:
    sizes: tuple[int, ...]

    @cached_property
    def parts(self) -> list[int]:
        return list(self.sizes)


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


def test_classes_with_as_many_fields_have_names_and_defaults_of_their_own() -> None:
    assert repr(Crate(1, height=5)) == "Crate(length=1, width=2, height=5)"
    assert repr(Order(buyer="a")) == "Order(number=1, buyer='a', labels=[])"
    assert Order(buyer="a").labels is not Order(buyer="a").labels
    assert repr(Nothing()) == "Nothing()"
    assert Crate.__match_args__ == ("length", "width", "height")


def test_what_an_initialiser_cannot_take_is_refused_by_name() -> None:
    refused: list[tuple[Callable[..., object], tuple[object, ...], dict[str, object], str]] = [
        (Crate, (), {}, "missing 1 required positional argument: 'length'"),
        (Crate, (1,), {"weight": 2}, "unexpected keyword argument 'weight'"),
        (Basket, ("a",), {"owner": "b"}, "multiple values for argument 'owner'"),
        (Order, ("a",), {}, "takes 1 positional argument but 2 were given"),
        (Order, (), {}, "missing 1 required keyword-only argument: 'buyer'"),
        (Nothing, (1,), {}, "takes 1 positional argument but 2 were given"),
    ]
    for kind, arguments, named, message in refused:
        with pytest.raises(TypeError, match=re.escape(message)):
            kind(*arguments, **named)


def test_frozen_records_are_equal_by_value_and_cannot_be_changed() -> None:
    for one, equal, other in (
        (Crate(1), Crate(1, 2), Crate(2)),
        (Place("a"), Place("a", 0), Place("b")),
    ):
        assert one == equal
        assert hash(one) == hash(equal)
        assert one != other
        with pytest.raises(AttributeError, match="cannot change"):
            setattr(one, one.__match_args__[0], 5)


def test_a_cached_property_is_computed_once_for_each_record() -> None:
    pile, other = Pile((1, 2)), Pile((1, 2))
    assert pile.parts == [1, 2]
    assert pile.parts is pile.parts
    assert pile.parts is not other.parts
    assert pile == other
    with pytest.raises(AttributeError, match="cannot change"):
        setattr(pile, "parts", [])  # noqa: B010


def test_records_that_are_made_by_name_are_copied_and_pickled() -> None:
    order = Order(buyer="Ada", number=3)
    for copied in (copy.deepcopy(order), pickle.loads(pickle.dumps(order))):
        assert copied == order and copied is not order
