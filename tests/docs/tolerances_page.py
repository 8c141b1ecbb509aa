"""The page on tolerances, with the numbers of the experiment that were kept last."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..tolerances.experiment import BOUNDS
from ..tolerances.rules import RULES
from ..tolerances.summary import kept
from .tables import DOCS, cell, spliced, table

HEADING = (
    "rule", "used by", "errors found", "worst missed", "false alarms", "by another driver",
    "larger",
)  # fmt: skip
COLUMNS: Mapping[str, str] = {
    "bounds": BOUNDS[0],
    "all routes": BOUNDS[2],
    "2 % floats": "floats: no lane off by more than 2 %",
    "2 %": "8 bits: no lane off by more than 2 %",
    "0.1 % by 2 %": "8 bits: at most 0.1 % of the pixels off by more than 2 %",
    "40 dB": "PSNR of at least 40 dB",
    "SSIM 0.99": "SSIM of at least 0.99",
    "three.js": "pixelmatch 0.1, at most 0.1 % of the pixels",
}
"""The rules that the table of kinds of errors has, by the heading of their columns."""

LAST_PLACES = "constant"
KINDS: Mapping[str, str] = {
    LAST_PLACES: "constant off by four steps of a float32",
    "arguments": "arguments exchanged",
    "binding": "another binding",
    "function": "another function, or none",
    "guard": "guard left out",
    "index": "another index",
    "lanes": "other lanes",
    "location": "another location",
    "members": "members of a block exchanged",
    "operand order": "operands exchanged",
    "operator": "another operator",
    "qualifier": "another qualifier",
}
"""Kinds of errors whose names say too little, in words."""


def tolerances_page() -> str:
    """The page with its tables brought up to date."""
    found = kept()
    page = (DOCS / "tolerances.md").read_text(encoding="utf-8")
    page = spliced(page, "tried", _tried(found))
    page = spliced(page, "rules", table(HEADING, _rules(found)))
    best = ("measure", "first without false alarms", "errors found")
    page = spliced(page, "best", table(best, _best(found)))
    page = spliced(page, "kinds", table(("error", "planted", *COLUMNS), _kinds(found["kinds"])))
    return spliced(page, "missed", _missed(found))


def _tried(found: Mapping[str, Any]) -> str:
    drawn = (
        f"{found['subjects']} materials by {found['routes']} routes are {found['tests']} tests "
        f"with {found['pictures']} pictures. {found['planted']} planted errors change a picture. "
        f"{found['unseen']} others change none, and {found['refused_by_tools']} are refused by a "
        "compiler or a driver: nobody needs a picture to find these, so they are left out.\n"
    )
    return drawn + _without_last_places(found) + _alarms(found)


def _without_last_places(found: Mapping[str, Any]) -> str:
    """A sentence about the errors that somebody could see."""
    tiny = found["kinds"].get(LAST_PLACES, {})
    others = found["planted"] - tiny.get("planted", 0)
    sums = {row["rule"]: row["found"] - tiny.get(row["rule"], 0) for row in found["rules"]}
    return (
        f"\n{tiny.get('planted', 0)} of the errors are constants that are off by four steps of a "
        f"float32, which nobody sees. Of the other {others}, the bounds of a route find "
        f"{sums[BOUNDS[0]]}, those of all routes together {sums[BOUNDS[2]]}, 2 % in 8 bits "
        f"{sums[COLUMNS['2 %']]}, a thousandth of the pixels by 2 % {sums[COLUMNS['0.1 % by 2 %']]}"
        f", and 40 dB {sums[COLUMNS['40 dB']]}.\n"
    )


def _alarms(found: Mapping[str, Any]) -> str:
    alarms = ", ".join(found["alarms_of_bounds"])
    return f"\nBounds refuse correct pictures of: {alarms}.\n" if alarms else ""


def _rules(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    used_by = {rule.name: rule for rule in RULES}
    tests, beside, larger = (found[name] for name in ("tests", "tests_beside_kept", "tests_larger"))
    for row in found["rules"]:
        rule = used_by.get(row["rule"])
        user = f"[{rule.used_by}]({rule.source})" if rule is not None and rule.used_by else ""
        name = row["rule"] if rule is not None else f"**{row['rule']}**"
        yield (
            cell(name), user or ("Burnish" if rule is None else ""),
            _share(row["found"], found["planted"]), f"{row['worst_missed']:.0f}",
            _share(row["alarms"], tests),
            _known(row["alarms_beside_kept"], beside), _known(row["alarms_larger"], larger),
        )  # fmt: skip


def _known(part: int | None, whole: int) -> str:
    return "–" if part is None else _share(part, whole)


def _share(part: int, whole: int) -> str:
    """A number and what part of all it is; nothing is rounded to nothing, or to all."""
    percent = 100 * part / whole
    digits = 1 if 0 < percent < 1 or 99 < percent < 100 else 0
    return f"{part} ({percent:.{digits}f} %)"


def _best(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    for row in found["best"]:
        yield row["measure"], _least(row), _share(row["found"], found["planted"])


def _least(row: Mapping[str, Any]) -> str:
    """A threshold as people write it."""
    name, least = row["measure"], row["least"]
    if name == "PSNR":
        return f"{-least:.1f} dB"
    if name == "SSIM":
        return f"{1 - least:.4f}"
    return f"{100 * least:.2g} %" if name.startswith("share") else f"{least:.3g}"


def _kinds(kinds: Mapping[str, Mapping[str, int]]) -> Iterator[tuple[str, ...]]:
    for kind, counts in kinds.items():
        found = (str(counts.get(rule, 0)) for rule in COLUMNS.values())
        yield KINDS.get(kind, kind), str(counts["planted"]), *found


def _missed(found: Mapping[str, Any]) -> str:
    """What bounds miss: in numbers, and each that is no constant off in its last places."""
    rows: Sequence[Mapping[str, Any]] = found["missed_by_bounds"]
    others = [row for row in rows if row["kind"] != LAST_PLACES]
    said = (
        f"Of {len(rows)} errors that the bounds of a route miss, {len(rows) - len(others)} are "
        "constants that are off by four steps of a float32. The others:\n\n"
    )
    lines = (
        (cell(row["kind"]), _changed(row), f"{row['subject']}, `{row['route']}`", _codes(row))
        for row in others
    )  # fmt: skip
    return said + table(("error", "what", "where", "changes a lane by"), lines)


def _changed(row: Mapping[str, Any]) -> str:
    """The text that is replaced, and by what; nothing of an error of a host, whose kind says it."""
    _place, _kind, change = row["what"].rpartition(f"{row['kind']}: ")
    return "" if change == row["kind"] else f"`{cell(change)}`"


def _codes(row: Mapping[str, Any]) -> str:
    return f"{row['apart']:.0f} of 255" if row["apart"] else "less than a step of 8 bits"
