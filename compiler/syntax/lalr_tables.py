"""The LALR tables of ``burnish.lark``, in the form that the machine uses.

Lark reads the grammar and computes the tables when the package is built: ``generate.py`` asks for
``tables_to_generate``. The lexer and the machine ask for ``load_tables``, which imports Lark only
if the grammar has changed since.
"""

# Annotations are evaluated in this module: a named tuple compiles those that are texts, and to load
# Python's compiler for them would take a hundredth of a short compile.

import pickle
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from ..precomputed import Precomputations, key, precomputed

END = "$END"

_GRAMMAR = Path(__file__).with_name("burnish.lark")


class Production(NamedTuple):
    """One rule of the grammar, as the machine reduces by it."""

    origin: str
    length: int
    method: str
    """The builder's method that makes the node; empty where the parts are handed on as they are."""
    plan: tuple[tuple[int, bool], ...]
    """The parts to hand over (-1: an absent option), and for each: is it unpacked?"""
    collapses: bool
    """True if a single part stands for the whole."""
    renames: bool
    """True if it has one part, which stands for the whole: only the state changes."""
    as_read: bool
    """True if the plan hands all parts over as they are."""


class Tables(NamedTuple):
    """All tables of the grammar for parsing."""

    actions: list[dict[str, int]]
    """The actions by state and token.

    ``n`` shifts to state ``n``, ``~n`` reduces by production ``n``.
    """
    gotos: list[dict[str, int]]
    """The next state, by state and origin of a finished production."""
    productions: list[Production]
    start: int
    literals: frozenset[str]
    """Words and punctuation, which stand for themselves as symbols."""
    patterns: dict[str, str]
    """Regular expressions of the other symbols."""
    collapsed: dict[tuple[int, int, str], int]
    """The machine's memory of chains of reductions that only change the state."""


@cache
def load_tables() -> Tables:
    """The tables of the language's grammar."""
    grammar = _GRAMMAR.read_text(encoding="utf-8")
    kept = precomputed("grammar", _key(grammar))
    found = _compute(grammar) if kept is None else pickle.loads(kept)
    actions, gotos, productions, start, accept, literals, patterns = found
    made = [_made(*production) for production in productions]
    actions[accept] = {END: accept}
    return Tables(actions, gotos, made, start, frozenset(literals), patterns, {})


def tables_to_generate() -> Precomputations:
    """The tables as a pickle, for which ``load_tables`` looks: it is loaded faster than code."""
    grammar = _GRAMMAR.read_text(encoding="utf-8")
    return {_key(grammar): lambda: _pickled(_compute(grammar))}


def _key(grammar: str) -> str:
    return key(grammar, Path(__file__).read_text(encoding="utf-8"))


def _pickled(tables: tuple[Any, ...]) -> bytes:
    """A pickle that has the same bytes whenever the tables are equal."""
    return pickle.dumps(_with_each_text_once(tables, {}), pickle.HIGHEST_PROTOCOL)


def _with_each_text_once(data: Any, texts: dict[str, str]) -> Any:
    """Equal data in which equal texts are one object: a pickle holds such a text once."""
    match data:
        case str():
            return texts.setdefault(data, data)
        case dict():
            pairs = _with_each_text_once(list(data.items()), texts)
            return dict(pairs)
        case list() | tuple():
            return type(data)([_with_each_text_once(each, texts) for each in data])
        case _:
            return data


def _made(
    origin: str, length: int, method: str, plan: tuple[tuple[int, bool], ...], collapses: bool
) -> Production:
    """A production, with the fields that follow from the rest of its row."""
    as_read = list(plan) == [(position, False) for position in range(length)]
    renames = collapses and length == 1
    return Production(origin, length, method, plan, collapses, renames, as_read)


def _compute(grammar: str) -> tuple[Any, ...]:
    """Have Lark analyse the grammar; its own saved form is the starting point."""
    from lark import Lark
    from lark.grammar import Rule
    from lark.lexer import TerminalDef

    parser = Lark(grammar, parser="lalr", lexer="basic", start="file", maybe_placeholders=True)
    data, memo = parser.memo_serialize([TerminalDef, Rule])
    table = data["parser"]["parser"]
    terminals = [memo[entry["@"]] for entry in data["parser"]["lexer_conf"]["terminals"]]
    literals = {t["name"]: t["pattern"]["value"] for t in terminals if _is_literal(t)}
    patterns = {t["name"]: t["pattern"]["value"] for t in terminals if not _is_literal(t)}
    origins = {memo[entry["@"]]["origin"]["name"] for entry in data["rules"]}
    symbols = {n: literals.get(name, name) for n, name in table["tokens"].items()}
    inner = {n for n, name in table["tokens"].items() if name in origins}
    numbers = {entry["@"]: n for n, entry in enumerate(data["rules"])}
    rows = [table["states"][state] for state in range(len(table["states"]))]
    actions = [_actions(row, inner, symbols, numbers) for row in rows]
    gotos = [{symbols[n]: row[n][1] for n in row.keys() & inner} for row in rows]
    places = _numbered(actions, gotos, table["start_states"]["file"])
    return (
        [_moved(actions[state], places) for state in places],
        [_moved(gotos[state], places) for state in places],
        [_production(memo[entry["@"]]) for entry in data["rules"]],
        places[table["start_states"]["file"]],
        places[table["end_states"]["file"]],
        list(literals.values()),
        patterns,
    )


def _numbered(
    actions: list[dict[str, int]], gotos: list[dict[str, int]], start: int
) -> dict[int, int]:
    """New numbers of all states, in the order in which they are reached from the first one.

    Lark's own numbers depend on the hashes of texts, which are different in each process. With
    these, building the package twice gives the same bytes.
    """
    places = {start: 0}
    reached = [start]
    for state in reached:
        for _, target in (*sorted(actions[state].items()), *sorted(gotos[state].items())):
            if target >= 0 and target not in places:
                places[target] = len(places)
                reached.append(target)
    return places


def _moved(row: dict[str, int], places: dict[int, int]) -> dict[str, int]:
    """A state's actions or gotos with the new numbers of states, in alphabetical order."""
    return {symbol: places.get(target, target) for symbol, target in sorted(row.items())}


def _is_literal(terminal: dict[str, Any]) -> bool:
    return bool(terminal["pattern"]["__type__"] == "PatternStr")


def _actions(
    row: dict[int, Any], inner: set[int], symbols: dict[int, str], numbers: dict[int, int]
) -> dict[str, int]:
    """One state's actions; Lark writes (0, state) for a shift and (1, rule) for a reduction."""
    return {
        symbols[n]: ~numbers[argument["@"]] if reduces else argument
        for n, (reduces, argument) in row.items()
        if n not in inner
    }


def _production(rule: dict[str, Any]) -> tuple[Any, ...]:
    options = rule["options"]
    origin = rule["origin"]["name"]
    name = rule["alias"] or options["template_source"] or origin
    return (
        origin,
        len(rule["expansion"]),
        "" if name.startswith("_") else name,
        _plan(rule["expansion"], options),
        bool(options["expand1"] and not rule["alias"]),
    )


def _plan(expansion: list[dict[str, Any]], options: dict[str, Any]) -> tuple[tuple[int, bool], ...]:
    """Lark's conventions: quoted symbols are dropped, ``_rules`` unpacked, ``[absent]`` is None."""
    absent_before = list(options["empty_indices"]) or [False] * len(expansion)
    plan: list[tuple[int, bool]] = []
    position = 0
    for absent in absent_before:
        if absent:
            plan.append((-1, False))
            continue
        symbol = expansion[position]
        terminal = symbol["__type__"] == "Terminal"
        if options["keep_all_tokens"] or not (terminal and symbol["filter_out"]):
            plan.append((position, not terminal and symbol["name"].startswith("_")))
        position += 1
    return tuple(plan)
