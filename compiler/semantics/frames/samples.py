"""Checks that steps with several samples for each pixel fit to the results that they draw over.

``steps.py`` asks for each step, and who reads a result for the depths.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Span
from ...ir.frame import Attachment, StepTexture


class SampleChecks:
    """The results that have been drawn over so far, in one frame."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._over: dict[StepTexture, StepTexture] = {}
        """For each result with several samples, the one that is drawn over these."""

    def check(self, drawn_to: Iterable[Attachment], samples: int, span: Span) -> None:
        """Report the first of its targets to which a step of so many ``samples`` cannot draw."""
        for attachment in drawn_to:
            image, over = attachment.image, attachment.over
            reason = self._misfit(image, over, samples)
            if reason:
                name = image.name if over is None else over.name
                self._report.add(rules.SAMPLES_DIFFER, span, name=name, reason=reason)
                return

    def _misfit(self, image: StepTexture, over: StepTexture | None, samples: int) -> str:
        """The reason why a step cannot draw to ``image``, or ``over`` the result of another one."""
        if image.samples != samples:
            return f"this step draws with {samples}, another one with {image.samples}"
        if over is None:
            return ""
        if (samples > 1 and over.samples == 1) or (samples == 1 and _has_samples_only(over)):
            return f"this step draws with {samples}, and there {_counted(over.samples)}"
        if samples > 1 and self._over.setdefault(over, image) is not image:
            return f"`{self._over[over].name}` is drawn over them already"
        return ""


def _counted(samples: int) -> str:
    return "is 1" if samples == 1 else f"are {samples}"


def _has_samples_only(image: StepTexture) -> bool:
    """True if nobody joins the samples of a result to one value, which others can read."""
    return image.is_depth and image.samples > 1


def check_readable(report: Report, left: object, span: Span) -> bool:
    """True if others than passes that draw over it can read a result of a step.

    If not, this is reported.
    """
    if isinstance(left, StepTexture) and _has_samples_only(left):
        report.add(rules.DEPTHS_OF_SAMPLES, span, name=left.name, samples=left.samples)
        return False
    return True
