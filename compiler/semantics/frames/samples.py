"""Checks that steps with several samples for each pixel fit to what they draw over.

``steps.py`` asks for each target of a step, and who reads a result for the depths.
"""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Span
from ...ir.frame import Image


class SampleChecks:
    """What has been drawn over so far, in one frame."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._over: dict[Image, Image] = {}
        """Of each result with several samples, the one that is drawn over these."""

    def check(self, image: Image, samples: int, behind: Image | None, span: Span) -> None:
        """Report that a step of so many ``samples`` cannot draw to ``image``, or over what is
        ``behind`` it."""
        if image.samples != samples:
            self._add(
                span, image, f"this step draws with {samples}, another one with {image.samples}"
            )
        if behind is None:
            return
        if samples > 1 and behind.samples != samples:
            self._add(
                span, behind, f"this step draws with {samples}, and there is {behind.samples}"
            )
        elif behind.samples > 1 and samples == 1 and behind.is_depth:
            self._add(span, behind, f"this step draws with 1, and there are {behind.samples}")
        elif samples > 1 and self._over.setdefault(behind, image) is not image:
            other = self._over[behind]
            self._add(span, behind, f"`{other.name}` is drawn over them already")

    def _add(self, span: Span, image: Image, reason: str) -> None:
        self._report.add(rules.SAMPLES_DIFFER, span, name=image.name, reason=reason)


def check_readable(report: Report, left: object, span: Span) -> bool:
    """Whether others than passes that draw over it find something that a step leaves; reported if
    not."""
    if isinstance(left, Image) and left.is_depth and left.samples > 1:
        report.add(rules.DEPTHS_OF_SAMPLES, span, name=left.name, samples=left.samples)
        return False
    return True
