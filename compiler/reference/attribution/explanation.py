"""Explains the error of a pixel by expressions of the source; ``explain`` is what others call.

Where several operations come from one expression, such as those of a function's body in several
calls, they count together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT
from ...diagnostics.source import Span
from ...formula import Formulas
from ...ir.node import Node, Op, reachable
from ...ir.operations import BUILTIN_OPS
from ...ir.shader import Shader
from ...ir.stages import TARGET
from ...ir.types import width
from ..bounds import Errors
from ..namespace import Lanes
from ..picture.scene import Geometry, RasterRules, Texels
from .influences import Influences, Site, influences, slopes
from .local_errors import LocalErrors
from .pixel import PixelShader

LOSS = 16.0
"""An expression loses precision if it magnifies errors at least this many times."""
NOTABLE = 0.25
"""The part of the picture's error that has to pass through an expression that loses precision."""
FAINT = 0.1
"""An expression that hands on a smaller part of the error than this is not shown."""
LONGEST_TEXT = 60
"""The most characters of an expression that are shown."""


Kind = Literal["operation", "read", "interpolation", "constant", "input"]
"""The kind of an expression: ``read`` is that of a texture, ``input`` a value of the pipeline."""
_KINDS: Mapping[Op, Kind] = {"cross": "interpolation", "constant": "constant", "input": "input"}


@dataclass(frozen=True, eq=False, slots=True)
class Expression:
    """An expression of the source, as it is in one pixel."""

    text: str
    kind: Kind
    span: Span | None
    value: tuple[float, ...]
    """The lanes of its value."""
    error: float
    """The possible error of its worst lane, with everything that it depends on."""
    own: float
    """The possible error if its operands were exact."""
    contribution: float
    """The error of the picture because of ``own``, over all evaluations of it."""
    magnification: float
    """The relative change of the picture for each relative change of this value."""


@dataclass(frozen=True, eq=False, slots=True)
class Loss:
    """An expression that magnifies the errors of its operands."""

    expression: Expression
    times: float
    """The factor by which it magnifies them."""


@dataclass(frozen=True, eq=False, slots=True)
class Tipping:
    """An operation that may jump, because its operands are too close to where it does."""

    expression: Expression
    words: str
    """The operand at which it jumps, in words: ``a whole number``."""
    repeats: bool
    """True if it jumps again and again, so that it is never farther away than 0.5."""
    distance: float
    error: float
    """The distance to the jump, and the possible error of the operand."""
    effect: float
    """The change of the picture if nothing else jumps; infinite if the pixel is discarded."""


@dataclass(frozen=True, eq=False, slots=True)
class Explanation:
    """An explanation of the error of a pixel."""

    x: int
    y: int
    target: int
    """The render target with the worst lane."""
    lane: int
    value: tuple[float, ...]
    """The exact lanes of the target."""
    error: float
    """The possible error of the lane: the sum of all contributions, to first order."""
    contributions: tuple[Expression, ...]
    """The expressions that make the error, the largest contribution first."""
    losses: tuple[Loss, ...]
    """The places where precision is lost, the worst first."""
    tippings: tuple[Tipping, ...]
    """Jumps that rounding may tip, the one that matters most first."""
    way: tuple[Expression, ...]
    """The way from the picture down to the operation that contributes most."""
    overflows: tuple[Expression, ...] = ()
    """Operations whose results are too large for float32, although their operands are not."""


def explain(
    shader: Shader,
    values: Mapping[str, Lanes],
    textures: Mapping[str, Texels],
    geometry: Geometry,
    rules: RasterRules,
    errors: Errors,
    x: int,
    y: int,
) -> Explanation:
    """Explain the pixel (x, y) of the picture that ``draw`` would draw of the same arguments.

    ``errors`` are those that a platform allows its functions. Raises ``UncoveredError`` if nothing
    is drawn there.
    """
    with np.errstate(all="ignore"):
        pixel = PixelShader(shader, values, textures, geometry, rules, errors, x, y)
        found = influences(pixel, LocalErrors(errors, pixel.place, rules.derivatives))
        return _Explaining(shader, pixel, found).explanation(x, y)


class _Explaining:
    def __init__(self, shader: Shader, pixel: PixelShader, found: Influences) -> None:
        self._shader = shader
        self._pixel = pixel
        self._found = found
        self._formulas = Formulas(shader.notes)
        total = sum((site.contribution for site in found.sites), np.zeros(len(found.picture)))
        self._worst = int(total.argmax())
        """The lane of the picture that is explained."""
        self._total = float(total[self._worst])
        self._of_node: dict[int, Site] = {}
        """For each node, the evaluation whose error matters most."""
        for site in found.sites:
            best = self._of_node.get(site.node.id)
            if best is None or self._passing(site) > self._passing(best):
                self._of_node[site.node.id] = site

    def explanation(self, x: int, y: int) -> Explanation:
        target, lane, lanes = self._place()
        sites = sorted(self._by_expression(), key=self._contributed, reverse=True)
        contributions = tuple(map(self._expression, sites))
        return Explanation(
            x, y, target, lane, lanes, self._total,
            contributions=tuple(one for one in contributions if one.contribution > 0),
            losses=tuple(self._losses()),
            tippings=tuple(self._tippings()),
            way=tuple(self._way(sites[0][0].node)) if sites else (),
            overflows=tuple(self._expression([site]) for site in self._overflowing()),
        )  # fmt: skip

    def _place(self) -> tuple[int, int, tuple[float, ...]]:
        """The target and the lane of the worst lane, and all lanes of this target."""
        begin = 0
        for number, result in enumerate(self._shader.results_of(TARGET)):
            lanes = width(result.value.type)
            if self._worst < begin + lanes:
                whole = self._found.picture[begin : begin + lanes].tolist()
                return number, self._worst - begin, tuple(whole)
            begin += lanes
        raise AssertionError("every lane belongs to a target")

    # --- expressions ------------------------------------------------------------------------------

    def _by_expression(self) -> list[list[Site]]:
        """The sites of each expression, the one whose error matters most first."""
        groups: dict[object, list[Site]] = {}
        for site in self._found.sites:
            span = self._shader.notes.spans.get(site.node.id)
            key = (id(span.source), span.start, span.end) if span else site.node.id
            groups.setdefault(key, []).append(site)
        return [sorted(sites, key=self._passing, reverse=True) for sites in groups.values()]

    def _passing(self, site: Site) -> float:
        return float(site.passing[self._worst])

    def _contributed(self, sites: Iterable[Site]) -> float:
        return float(sum(site.contribution[self._worst] for site in sites))

    def _expression(self, sites: list[Site]) -> Expression:
        site = sites[0]
        return Expression(
            self._text(site.node),
            "read" if site.reads else _KINDS.get(site.node.op, "operation"),
            self._shader.notes.spans.get(site.node.id),
            tuple(site.value),
            error=max(site.error, default=0.0),
            own=max(site.local, default=0.0),
            contribution=self._contributed(sites),
            magnification=self._magnification(site),
        )

    def _text(self, node: Node) -> str:
        """The text in the source, in one line; or a formula for a node without a place in it."""
        span = self._shader.notes.spans.get(node.id)
        name = self._formulas.name(node) if node.op == "cross" else None
        text = name or (" ".join(span.text.split()) if span else self._formulas.text(node))
        return text if len(text) <= LONGEST_TEXT else f"{text[: LONGEST_TEXT - 1]}…"

    def _magnification(self, site: Site) -> float:
        """The magnification of the lane whose relative errors matter most."""
        return max((self._by(site, lane) for lane in range(len(site.value))), default=0.0)

    def _by(self, site: Site, lane: int) -> float:
        """The relative change of the picture for each relative change of one lane."""
        picture = abs(float(self._found.picture[self._worst]))
        change = float(site.rates(lane)[self._worst]) * abs(site.value[lane])
        return change / max(picture, _TINY)

    # --- where precision is lost ------------------------------------------------------------------

    def _losses(self) -> Iterator[Loss]:
        found = []
        for sites in self._by_expression():
            if self._passing(sites[0]) >= NOTABLE * self._total > 0:
                gain = max(map(self._gain, sites))
                if gain >= LOSS:
                    times = max(gain, *map(self._slope, sites))
                    found.append(Loss(self._expression(sites), times))
        yield from sorted(found, key=lambda loss: loss.times, reverse=True)

    def _slope(self, site: Site) -> float:
        """The factor by which an operation would magnify a tiny error of its worst operand."""
        if site.reads:
            return 0.0
        return max(
            (
                max(change / max(abs(value), _TINY) * min(self._by(site, lane), 1.0),
                    change / max(abs(value), 1.0) * max(abs(operand), 1.0) / abs(operand))
                for operand, changes in slopes(site, self._pixel)
                for lane, (change, value) in enumerate(zip(changes, site.value, strict=True))
            ),
            default=0.0,
        )  # fmt: skip

    def _gain(self, site: Site) -> float:
        """The factor by which an operation visibly magnifies the errors of its operands.

        Errors count relative to the values, which shows where digits cancel out, or relative to 1
        where values are smaller, which shows where a function is steep. Invisible errors do not
        count: they are no more than the roundings that the picture's error amounts to. A value that
        is zero by chance, of which nothing but its magnitude matters, has no relative error.
        """
        if site.node.op not in BUILTIN_OPS or not site.operands:
            return 0.0
        step = 2.0**-24 * max(abs(float(self._found.picture[self._worst])), 1.0)
        relative = max(_relative(value, error) for value, error in site.operands)
        mixed = max(_mixed(value, error) for value, error in site.operands)
        gains = []
        for lane, (value, error, own) in enumerate(
            zip(site.value, site.error, site.local, strict=True)
        ):
            carried = max(error - own, 0.0)
            cancelled = _ratio(_relative(value, carried), relative) * min(self._by(site, lane), 1.0)
            steep = _ratio(_mixed(value, carried), mixed)
            seen = error * float(site.rates(lane)[self._worst]) / step
            gains.append(min(max(cancelled, steep), seen))
        return max(gains)

    def _overflowing(self) -> Iterator[Site]:
        """The first of the operations that overflow, in the order of evaluation."""
        for site in self._found.sites:
            is_whole = all(abs(value) <= LARGEST_FLOAT for value, _ in site.operands)
            if is_whole and not all(abs(value) <= LARGEST_FLOAT for value in site.value):
                yield site
                return

    # --- jumps ------------------------------------------------------------------------------------

    def _tippings(self) -> Iterator[Tipping]:
        found = [
            Tipping(
                self._expression([site]), jump.words, jump.repeats, jump.distance, jump.error,
                float(jump.effect[self._worst]),
            )
            for site in self._found.sites
            for jump in site.jumps
            if jump.effect is not None
        ]  # fmt: skip
        seen = set()
        for tipping in sorted(found, key=lambda tipping: -tipping.effect):
            key = str(tipping.expression.span), tipping.expression.text
            if key not in seen:
                seen.add(key)
                yield tipping

    # --- the way of the error ---------------------------------------------------------------------

    def _way(self, source: Node) -> Iterator[Expression]:
        """The expressions from the picture down to one node, each once."""
        shown = None
        least = FAINT * self._contributed([self._of_node[source.id]])
        for node in self._nodes_down_to(source):
            site = self._of_node.get(node.id)
            if site is None or self._passing(site) < least:
                continue
            expression = self._expression([site])
            if shown is None or (expression.text, str(expression.span)) != shown:
                shown = expression.text, str(expression.span)
                yield expression

    def _nodes_down_to(self, source: Node) -> Iterator[Node]:
        """The nodes from the result to ``source``, along the operands whose errors matter most."""
        target, _, _ = self._place()
        node = self._shader.results_of(TARGET)[target].value
        leads = {source.id}
        for other in reachable((node,)):
            if any(operand.id in leads for operand in other.operands):
                leads.add(other.id)
        while node is not source and node.id in leads:
            yield node
            node = max(
                (operand for operand in node.operands if operand.id in leads), key=self._weight
            )
        yield node

    def _weight(self, node: Node) -> float:
        """The weight of the errors that a node hands on."""
        site = self._of_node.get(node.id)
        return 0.0 if site is None else self._passing(site)


_TINY = float(np.finfo(np.float32).tiny)


def _relative(value: float, error: float) -> float:
    """An error relative to a value; no more than all of its digits can be lost."""
    return min(error / max(abs(value), _TINY), 1.0)


def _mixed(value: float, error: float) -> float:
    """An error relative to a value, or to 1 if that is larger."""
    return error / max(abs(value), 1.0)


def _ratio(after: float, before: float) -> float:
    return after / before if before > 0 else 0.0
