"""Writes a conformance run as JUnit's XML, which continuous integration shows as tests.

``burnish conform --report`` puts it beside the page. A test case is one material drawn by one
route. Rows that differ, fail or overflow are failures; rows that were not run are skipped. A run
that was ended early has one more test case, an error, so that nobody takes it for a success.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from .rows import Row
from .summary import Unfinished, by_material, details, is_failure

_NO_XML = re.compile("[^\\t\\n\\r\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")
"""Characters that XML 1.0 cannot contain, not even escaped."""


def as_junit(rows: Sequence[Row], unfinished: Unfinished | None = None, *, strict: bool) -> str:
    """The whole run, or what is known of it; with ``strict``, rows that prove little are failures,
    too."""
    whole = _counts(rows, strict=strict, unfinished=unfinished is not None)
    root = Element("testsuites", {"name": "burnish conform", **whole})
    for material, own in by_material(rows).items():
        counts = _counts(own, strict=strict)
        suite = SubElement(root, "testsuite", {"name": _clean(material), **counts})
        for row in own:
            _add(suite, row, strict=strict)
    if unfinished is not None:
        counts = _counts((), strict=strict, unfinished=True)
        suite = SubElement(root, "testsuite", {"name": "burnish conform", **counts})
        case = SubElement(suite, "testcase", classname="burnish conform", name="all rows")
        SubElement(case, "error", message=unfinished.text)
    indent(root)
    declaration = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return declaration + tostring(root, encoding="unicode") + "\n"


def _counts(rows: Sequence[Row], *, strict: bool, unfinished: bool = False) -> dict[str, str]:
    """The numbers of test cases; an ``unfinished`` run has one that is an error."""
    failures = sum(is_failure(row, strict=strict) for row in rows)
    skipped = sum(row.status == "not run" for row in rows)
    errors = int(unfinished)
    numbers = {
        "tests": len(rows) + errors, "failures": failures, "errors": errors, "skipped": skipped,
    }  # fmt: skip
    return {name: str(number) for name, number in numbers.items()}


def _add(suite: Element, row: Row, *, strict: bool) -> None:
    case = SubElement(suite, "testcase", classname=_clean(row.material), name=row.route.name)
    text = _clean("\n".join(details(row)))
    if row.status == "not run":
        SubElement(case, "skipped", message=text)
    elif is_failure(row, strict=strict):
        failure = SubElement(case, "failure", type=row.status, message=_clean(_first(row)))
        failure.text = text
    elif text:
        SubElement(case, "system-out").text = f"{row.status}\n{text}"


def _first(row: Row) -> str:
    """A short message: the first line of the details."""
    return next(details(row), row.status)


def _clean(text: str) -> str:
    return _NO_XML.sub("\N{REPLACEMENT CHARACTER}", text)
