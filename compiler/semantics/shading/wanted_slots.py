"""Which slots of a material functions return: those asked for, an engine's, or the usual ones.

``functions.py`` asks for them, and makes functions of their values.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.nearest import suggestion
from ...ir.functions import FunctionsAsked, Offer, OwnPass
from ...ir.node import Node, bare
from ...ir.stages import FRAGMENT, RASTERISED, STAGES, VERTEX, StageRow
from ...ir.types import Vector
from ...syntax import ast
from ..checking.slots import slot
from ..declarations.parameters import library_name
from ..inheritance.records import Record
from .assembly import Setting

HIDDEN = "is_hidden"
"""The engines' word for the slot that says where nothing is drawn."""
_SAME = 1e-6
"""The difference of two numbers that are meant to be the same."""


@frozen
class WantedSlot:
    """A slot that was asked for, or that the material has."""

    name: str
    stage: StageRow
    is_needed: bool
    """True if what is wrong with it is an error, and not a reason to leave it out.

    Somebody asked for it by name, or it says where the surface is.
    """
    is_changed: bool = False
    """True if it is left out where it is the constant that it is as it was declared."""
    beside: tuple[str, ...] = ()
    """The engines' words for the slots without which it is left out as well."""


def wanted_slots(
    setting: Setting, own: OwnPass | None, asked: FunctionsAsked
) -> Iterator[WantedSlot]:
    """The slots that are asked for; else those that an engine takes, or the usual ones."""
    record, report = setting.surface.record, setting.ctx.report
    span = record.symbol.declaration.name.span
    if asked.offers:
        yield from _offered(setting, own, asked)
    elif not asked.slots:
        for name in dict.fromkeys(_usual(setting, asked)):
            stage = _usual_stage(record, name, asked)
            wanted = WantedSlot(name, stage, _is_needed(record, name, asked))
            yield _unless_left(setting, asked, wanted)
    for text in dict.fromkeys(asked.slots):
        name, _, place = (part.strip() for part in text.partition("@"))
        if place and STAGES.get(place) not in RASTERISED:
            report.add(rules.UNKNOWN_STAGE_OF_SLOT, span, text=text)
        elif name not in slots_of(record):
            hint = suggestion(name, list(slots_of(record)))
            report.add(rules.NO_SUCH_SLOT, span, name=record.name, slot=name, hint=hint)
        else:
            stage = STAGES[place] if place else _usual_stage(record, name, asked)
            yield WantedSlot(name, stage, is_needed=True)


def _usual(setting: Setting, asked: FunctionsAsked) -> Iterator[str]:
    """The slots of the user's own records, those of a model, and what follows from these."""
    record = setting.surface.record
    moved = moved_words(record, asked, only_parts=True)
    for name in slots_of(record):
        owner, word = record.definitions[name][0].owner, word_of(record, name, asked)
        is_model = bool(word) and owner is not record.root and _is_given(setting, asked, name)
        is_moved = bool(word) and asked.of_surface.get(library_slot(record, name)) in moved
        is_hidden = word == HIDDEN and _hides(setting)
        if is_model or is_moved or is_hidden or not owner.module.is_standard:
            yield name


def _is_given(setting: Setting, asked: FunctionsAsked, name: str) -> bool:
    """False for a slot of a model of which nothing is said, if the engine has its value itself."""
    left = _left(setting, asked, name)
    return left is None or _differs(setting, left) or _is_said(setting, asked, left)


def _unless_left(setting: Setting, asked: FunctionsAsked, wanted: WantedSlot) -> WantedSlot:
    """A usual slot, which is left out if it is a constant that the engine has itself."""
    left = _left(setting, asked, wanted.name)
    if left is None:
        return wanted
    differs = _differs(setting, left)
    return changed(wanted, is_changed=not differs, beside=left.beside if differs else ())


def _left(setting: Setting, asked: FunctionsAsked, name: str) -> Offer | None:
    """What is known of a slot that may be left to the engine."""
    record = setting.surface.record
    found = (each for each in asked.left if each.name == name and _is_meant(record, each))
    return next(found, None)


def _offered(setting: Setting, own: OwnPass | None, asked: FunctionsAsked) -> Iterator[WantedSlot]:
    """The offered slots that the material has."""
    record = setting.surface.record
    is_opaque = own is not None and own.blend == "none" and not own.covers
    seen = set[tuple[str, bool]]()
    for offer in asked.offers:
        place = offer.name, offer.at_vertices
        if (offer.blended and is_opaque) or place in seen:
            continue
        if not _is_meant(record, offer):
            continue
        differs = _differs(setting, offer)
        if differs or _is_said(setting, asked, offer):
            seen.add(place)
            stage = VERTEX if offer.at_vertices else FRAGMENT
            is_needed = offer.owner is None or _is_needed(record, offer.name, asked)
            beside = offer.beside if differs else ()
            yield WantedSlot(offer.name, stage, is_needed, offer.changed and not differs, beside)


def _differs(setting: Setting, offer: Offer) -> bool:
    """True if the engine itself has another value than the one of the declaration."""
    if offer.usual is None or isinstance(offer.usual, str):
        return offer.usual is not None
    declared = setting.surface.record.declaration(offer.name)
    span = declared.member.name.span
    usual = slot(setting.ctx, setting.surface, offer.name, span, declared.level)
    lanes = constant_lanes(usual) if isinstance(usual, Node) else None
    return lanes is None or any(abs(lane - offer.usual) > _SAME for lane in lanes)


def constant_lanes(tree: Node) -> tuple[float, ...] | None:
    """The numbers of a constant, or of a vector of constants; ``None`` for all other values."""
    node = bare(tree)
    if node.op == "constant":
        return tuple(_numbers(node.data))
    if node.op not in ("vector", "splat"):
        return None
    found = tuple(map(constant_lanes, node.operands))
    if None in found:
        return None
    lanes = tuple(lane for each in found for lane in each or ())
    return lanes * node.type.size if node.op == "splat" and isinstance(node.type, Vector) else lanes


def _numbers(value: object) -> Iterator[float]:
    if isinstance(value, tuple):
        for each in value:
            yield from _numbers(each)
    else:
        assert isinstance(value, int | float)
        yield value


def _is_meant(record: Record, offer: Offer) -> bool:
    """True if a slot is an offered one, or a parameter that stands in the place of one.

    A parameter of the library is no slot: the library's slots say what it is for.
    """
    found = record.definitions.get(offer.name)
    if found is None:
        return False
    nearest, declared = found[0], record.declaration(offer.name)
    if isinstance(nearest.member, ast.Param):
        is_slot = isinstance(declared.member, ast.Slot) or not declared.owner.module.is_standard
    else:
        is_slot = isinstance(nearest.member, ast.Slot) and nearest.member.value is not None
    is_owned = offer.owner is None or offer.owner == library_name(declared.owner)
    return is_slot and is_owned


def _is_said(setting: Setting, asked: FunctionsAsked, offer: Offer) -> bool:
    """True if the material or its pass says something of a slot, where that is what counts."""
    record = setting.surface.record
    is_changed = any(_changes(record, name) for name in (offer.name, *offer.made_of))
    hides = word_of(record, offer.name, asked) == HIDDEN and _hides(setting)
    return is_changed or hides or not offer.changed


def _changes(record: Record, name: str) -> bool:
    """True if a slot is something else than where it is declared."""
    found = record.definitions.get(name)
    return found is not None and found[0] is not record.declaration(name)


def moved_words(record: Record, asked: FunctionsAsked, *, only_parts: bool = False) -> Set[str]:
    """The engines' words for values that the material moves, so that the mesh has others.

    ``only_parts`` leaves out the slots that are asked for themselves.
    """
    found = set[str]()
    for full, words in asked.moving.items():
        name = full.rpartition(".")[2]
        nearest = record.definitions.get(name, (None,))[0]
        is_as_given = nearest is None or f"{library_name(nearest.owner)}.{name}" == full
        is_mesh = nearest is not None and nearest is record.declaration(name)
        is_asked = only_parts and library_slot(record, name) in asked.at_vertices
        if not (is_as_given or is_mesh or is_asked):
            found.update(words.split())
    return found


def _hides(setting: Setting) -> bool:
    """True if the pass that the material is tied to draws nothing at some pixels."""
    drawn = setting.passing.record.every(ast.Discard)
    root = setting.passing.record.root
    return any(owner is not root or not owner.module.is_standard for _, owner, _ in drawn)


def slots_of(record: Record) -> Sequence[str]:
    found = record.definitions.items()
    return [name for name, of in found if isinstance(of[0].member, ast.Slot)]


def _usual_stage(record: Record, name: str, asked: FunctionsAsked) -> StageRow:
    return VERTEX if library_slot(record, name) in asked.at_vertices else FRAGMENT


def _is_needed(record: Record, name: str, asked: FunctionsAsked) -> bool:
    """True for a slot that says where the surface is, or where it has holes."""
    is_placed = library_slot(record, name) in asked.at_vertices
    return is_placed or word_of(record, name, asked) == HIDDEN


def word_of(record: Record, name: str, asked: FunctionsAsked) -> str:
    return asked.words.get(library_slot(record, name), "")


def library_slot(record: Record, name: str) -> str:
    """The slot as the library declares it: ``std.file.Record.name``."""
    return f"{library_name(record.declaration(name).owner)}.{name}"
