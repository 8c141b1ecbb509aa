"""The names of the rules of range analysis, by which proofs cite them and tests switch them off.

The rule of a builtin (the ``range`` column of its row) has the builtin's name. All other rules are
listed here, with the words that a proof uses for them.
"""

from __future__ import annotations

from collections.abc import Mapping

CONSTANT = "constant"
DECLARED = "declared range"
UNIT = "unit direction"
MEMBER = "light's parameter"
SAME = "same operands"
JOINED = "joined lanes"
FILLED = "filled lanes"
PICKED = "picked lanes"
ELEMENT = "element"
EITHER = "either side"
OWN_CONDITION = "own condition"
FLAT = "not interpolated"
SUM = "sum"
PRODUCT = "product"
EXTREME = "least or greatest"
STATE = "state"
IN_TURN = "state in a turn"
ELEMENTS = "elements"
INDEX = "fold index"
ARGUMENT = "argument"
BODY = "function body"
ABOVE = "condition: above"
BELOW = "condition: below"
EQUALS = "condition: equal"
DIFFERS = "condition: different"
BOTH = "condition: several"
NEGATION = "condition: negated"
AROUND = "condition around"

RULES: Mapping[str, str] = {
    CONSTANT: "the number itself",
    DECLARED: "a parameter keeps to its declared range",
    UNIT: "a direction has length one",
    MEMBER: "each light's parameter keeps to what is declared",
    SAME: "both operands are one value",
    JOINED: "between the least and the greatest of its lanes",
    FILLED: "the same number in every lane",
    PICKED: "lanes of a vector within these bounds",
    ELEMENT: "an element of an array or vector within these bounds",
    EITHER: "one of the two sides",
    OWN_CONDITION: "its own condition bounds the side",
    FLAT: "the value of one vertex, or of the whole instance",
    SUM: "so many terms at most, each within these bounds",
    PRODUCT: "no factor is negative",
    EXTREME: "the least or the greatest of some values, the start among them",
    STATE: "what it was at the start, or what a turn has made of it",
    IN_TURN: "neither the start nor any turn takes it further",
    ELEMENTS: "between the least and the greatest of its elements",
    INDEX: "the index counts from 0 to below the bound",
    ARGUMENT: "one of the arguments that are passed",
    BODY: "what the function returns",
    ABOVE: "the condition says that it is above",
    BELOW: "the condition says that it is below",
    EQUALS: "the condition says that it is equal",
    DIFFERS: "the condition says that it is different",
    BOTH: "a conjunction holds, or a disjunction does not: all of its parts tell something",
    NEGATION: "a negated condition tells the opposite",
    AROUND: "an `if` around the value",
}
