"""Draws the picture of a shader, from values and geometry to pixels; ``draw`` runs all steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ...budget import holding
from ...ir.node import reachable
from ...ir.shader import RenderTarget, Shader
from ...ir.stages import DISCARD
from ...ir.types import Type, numbers, width
from ..bounds import Errors, as_bounded
from ..cost import check_operations
from ..kept_numbers import KeptNumbers
from ..namespace import Lanes
from .alpha_coverage import covered_by_alpha
from .assembly import faces_of
from .canvas import BLACK, NOWHERE, Canvas, Shades, check_layers, nearest, size_of, with_missing
from .coverage import Coverage, Fragments, coverage_within, has_level_edges, joined
from .faces import Faces
from .hulls import Hulls
from .lines import LineFaces
from .narrowing import CasesOf, Colours, narrow
from .placing import placing_of
from .quads import Barycentric, Quads, depths_of, out_of_range, quads_of
from .resolve import depths_on, expected_on
from .scene import (
    LEVEL_EDGES,
    LINES,
    ROWS,
    Bools,
    Expected,
    Floats,
    Geometry,
    Ints,
    RasterRules,
    Texels,
)
from .stage_evaluation import PIXELS_AT_ONCE, StageEvaluator, Vertices
from .stencil import StencilTest
from .tiles import Tile, tiles

_OF_A_FACE = 1200
"""Bytes for each face: its corners, their errors, and all of that again for a tile."""
_OF_A_POSITION = 4
"""The lanes of a position."""
_OF_A_LANE = 32
"""Bytes for each number of a vertex, with its ends."""

Tell = Callable[[float], None]
"""Called with the part of the work that is done, from 0 to 1."""


def draw(
    shader: Shader,
    values: Mapping[str, Lanes],
    textures: Mapping[str, Texels],
    geometry: Geometry,
    rules: RasterRules,
    clear: Sequence[Sequence[float]],
    errors: Errors | None = None,
    blend_constant: Sequence[float] = BLACK,
) -> Expected:
    """The picture that every implementation must draw, with the bounds of a device's rounding.

    ``errors`` are those that a platform allows its functions; without them, only the values are
    computed, as with numbers that are not rounded at all.

    ``values`` are by parameter name, in the evaluator's form: a tuple of lanes, of a matrix's
    columns, of an array's elements, or of a struct's members. ``clear`` has four lanes for each
    target, and depths are at first what the pass says.

    Raises ``ValueError`` for a parameter, texture or vertex attribute without a value, or with one
    that does not fit. Values that are not finite only affect the triangles and pixels that they
    belong to.
    """
    written = written_by(shader)
    rules = replace(rules, samples=shader.render_state.samples)
    size = size_of(rules.sample_count, len(written))
    with holding(size, f"the picture of `{shader.name}` needs"):
        canvas = Canvas(
            rules.sample_count, clear, written, rounds=errors is not None,
            depth=shader.render_state.depth.clear, blend_constant=blend_constant,
        )  # fmt: skip
        draw_onto(canvas, shader, values, textures, geometry, rules, errors)
        return expected_on(canvas, rules) if written else depths_on(canvas, rules)


def draw_onto(
    canvas: Canvas,
    shader: Shader,
    values: Mapping[str, Lanes],
    textures: Mapping[str, Texels],
    geometry: Geometry,
    rules: RasterRules,
    errors: Errors | None = None,
    progress: Tell | None = None,
    hulls: Hulls | None = None,
    kept: KeptNumbers | None = None,
) -> frozenset[int]:
    """Draws over the content of a canvas, as ``draw`` does on an empty one.

    The errors are the same. The canvas has as many samples as ``rules`` say, which are those of the
    pass. ``progress`` is called with the part that is done, and ``hulls`` gets the possible values
    of undecided samples. ``kept`` keeps numbers for other draws with the same errors. Returns the
    ids of the promises that were broken: of calls of ``nonzero`` whose operand was zero at some
    vertex or pixel, as far as float32 can tell.
    """
    size = _size_of(shader, geometry)
    with holding(size, f"what `{shader.name}` draws needs"), np.errstate(all="ignore"):
        drawing = _Drawing(canvas, shader, values, textures, geometry, rules, errors, kept)
        drawing.draw(progress, hulls)
    return drawing.broken


def _size_of(shader: Shader, geometry: Geometry) -> int:
    """About how many bytes the vertices and the faces of a draw take."""
    lanes = sum(numbers(node.type) for node in reachable(shader.roots) if node.op == "cross")
    vertices = geometry.vertex_count * (_OF_A_POSITION + lanes) * _OF_A_LANE
    return vertices + len(geometry.triangles) * _OF_A_FACE


def written_by(shader: Shader) -> list[tuple[RenderTarget, Type]]:
    """The render targets of a shader, with the types of the values that it writes to them."""
    return [(r.state, r.value.type) for r in shader.results if r.state is not None]


class _Drawing:
    """One draw while it is drawn."""

    def __init__(
        self,
        canvas: Canvas,
        shader: Shader,
        values: Mapping[str, Lanes],
        textures: Mapping[str, Texels],
        geometry: Geometry,
        rules: RasterRules,
        errors: Errors | None,
        kept: KeptNumbers | None,
    ) -> None:
        self._rules = rules
        check_operations([result.value for result in shader.results], PIXELS_AT_ONCE, shader.name)
        self._stages = StageEvaluator(shader, values, textures, rules, errors, kept)
        self._vertices: Vertices = self._stages.vertices(geometry)
        self._faces: Faces = faces_of(
            self._vertices.positions,
            geometry.triangles,
            rules,
            self._vertices.off,
            shader.render_state,
        )
        placing = placing_of(shader, values, textures, geometry, rules)
        self._places = canvas.places.numbers(shader, geometry, self._faces, placing)
        self._lanes = [width(type_) for _, type_ in written_by(shader)]
        self._depth = shader.render_state.depth
        self._stencil = shader.render_state.stencil
        self._covers_by_alpha = shader.render_state.alpha_to_coverage
        self._nearest_wins = (
            not shader.results_of(DISCARD)
            and not self._covers_by_alpha
            and not self._stages.has_own_depths
            and canvas.is_opaque
            and canvas.has_depth
            and self._depth.keeps_nearest
            and not self._stencil.writes
        )
        """True if of several fragments at a sample only the nearest one counts."""
        self._canvas = canvas
        canvas.counted |= rules.counted(self._rare())

    def _rare(self) -> Iterator[str]:
        """The names of the rare rules on which this draw hangs."""
        if isinstance(self._faces, LineFaces):
            yield from LINES
        if has_level_edges(self._faces, self._rules):
            yield from LEVEL_EDGES
        if self._stages.side > 1 or self._rules.samples > 1:
            yield from ROWS

    @property
    def broken(self) -> frozenset[int]:
        """The ids of the promises that were broken."""
        return frozenset(self._stages.found.broken)

    def draw(self, progress: Tell | None, hulls: Hulls | None) -> None:
        """Draw all fragments on the canvas, those of one tile after those of another."""
        done, whole = 0, Tile.of(self._rules)
        for tile, faces in tiles(self._faces, whole, self._rules):
            begin, share = done / whole.pixels, tile.pixels / whole.pixels
            tell = None if progress is None else _within(progress, begin, share)
            self._draw_tile(tile.within(self._rules), faces, tell, hulls)
            done += tile.pixels
            if progress is not None:
                progress(done / whole.pixels)

    def _draw_tile(
        self, rules: RasterRules, faces: Ints, progress: Tell | None, hulls: Hulls | None
    ) -> None:
        """Draws the fragments of some faces in a part of the picture, these rules' scissor."""
        canvas = self._canvas
        coverage = coverage_within(self._faces, faces, rules, len(self._lanes))
        fragments, sure = coverage.fragments, coverage.certain
        seen = self._let_through(fragments)
        fragments, sure = fragments.only(seen), sure[seen]
        doubtful = self._not_behind(coverage.doubtful.only(self._let_through(coverage.doubtful)))
        has_own = self._stages.has_own_depths
        if self._depth.is_biased and not has_own:
            # APIs leave the depths open that a bias moves out of their range.
            beyond = sure & out_of_range(self._faces, fragments, self._rules)
            doubtful, sure = joined([doubtful, fragments.only(beyond)]), sure & ~beyond
        doubtful = self._not_discarded(doubtful)
        every, certain = Coverage(fragments, sure, doubtful).in_order()
        depth, off = depths_of(self._faces, fragments, self._rules)
        if self._nearest_wins:
            doubtful = self._not_hidden(doubtful, fragments.only(sure), (depth + off)[sure])
            winners, close = nearest(fragments, depth, off, self._places[fragments.face])
            canvas.undecided[close] = True
            fragments = fragments.only(winners)
            depth, off = depth[winners], off[winners]
        place = self._places[fragments.face]
        check_layers(fragments.sample)
        shades = self._shaded(fragments, progress)
        if has_own:
            depth, off = shades.own_depths()
            place = np.full_like(place, NOWHERE)
        canvas.doubt(doubtful.sample, self._depth, self._stencil)
        canvas.draw(
            fragments.sample, depth, off, place, shades, self._depth, self._test_of(fragments)
        )
        canvas.doubt(doubtful.sample, self._depth, self._stencil)
        if hulls is not None:
            hulls.extend(
                every,
                certain & (not self._may_hide),
                self._depths_of,
                lambda some: self._shaded(some, None),
            )

    def _depths_of(self, fragments: Fragments) -> tuple[Floats, Floats]:
        """The depths of fragments, and by how much those of a device may differ."""
        if self._stages.has_own_depths:
            return self._shaded(fragments, None).own_depths()
        return depths_of(self._faces, fragments, self._rules)

    @property
    def _may_hide(self) -> bool:
        """True if some test may keep fragments from being drawn."""
        is_tested = self._canvas.has_depth and self._depth.compare != "always"
        return is_tested or self._stencil.tests

    def _test_of(self, fragments: Fragments) -> StencilTest:
        return StencilTest(self._stencil, self._faces.front[fragments.face])

    def _let_through(self, fragments: Fragments) -> Bools:
        """The fragments that the stencil does not hide, as far as that is known beforehand.

        A draw that writes values may still change them.
        """
        if self._stencil.writes:
            return np.ones(len(fragments.sample), np.bool_)
        test = self._test_of(fragments)
        return self._canvas.stencil.tested(test, fragments.sample).may_hold

    def _not_behind(self, doubtful: Fragments) -> Fragments:
        """The doubtful fragments that may be seen in front of the content before the draw.

        This holds as long as that content is still there. Hidden fragments may change stencil
        values, too.
        """
        is_changed = self._depth.write and self._depth.compare != "equal"
        if is_changed or self._stencil.writes:
            return doubtful
        depth, off = self._depths_of(doubtful)
        return doubtful.only(self._canvas.may_pass(self._depth, doubtful.sample, depth, off))

    def _not_hidden(self, doubtful: Fragments, certain: Fragments, farthest: Floats) -> Fragments:
        """The doubtful fragments that are not behind others which every device draws.

        ``farthest`` is how far away a device may have each of these.
        """
        depth, off = depths_of(self._faces, doubtful, self._rules)
        behind = np.full(self._rules.sample_count, np.inf)
        np.minimum.at(behind, certain.sample, farthest)
        return doubtful.only(~(depth - off > behind[doubtful.sample]))

    def _not_discarded(self, doubtful: Fragments) -> Fragments:
        """The doubtful fragments that some device does not discard, if it draws them."""
        may_be = self._stages.discards or self._covers_by_alpha
        if not may_be or not len(doubtful.sample):
            return doubtful
        shades = self._shaded(doubtful, None).only(np.arange(len(doubtful.sample)))
        return doubtful.only(~shades.discarded | shades.undecided)

    def _shaded(self, fragments: Fragments, progress: Tell | None) -> Shades:
        """The fragments' colours, computed for a limited number of quads at a time."""
        quads, lane = quads_of(fragments, self._rules, self._stages.side)
        # The samples of a pixel that a face covers have one lane in common.
        lanes, of_sample = np.unique(lane, return_inverse=True)
        count = len(lanes)
        colours = [np.empty((3, count, 4)) for _ in self._lanes]
        depth = np.empty((3, count)) if self._stages.has_own_depths else None
        discarded, undecided = np.empty(count, dtype=np.bool_), np.empty(count, dtype=np.bool_)
        shades = Shades(colours, depth, discarded, undecided, np.asarray(of_sample.ravel()))
        step = max(self._stages.pixels_at_once // quads.side**2, 1)
        for begin in range(0, len(quads), step):
            limits = np.array([begin, begin + step]) * quads.side**2
            first, last = np.searchsorted(lanes, limits)
            part = quads.part(begin, begin + step)
            self._shade(part, lanes[first:last] - limits[0], slice(first, last), shades)
            if progress is not None:
                progress(float(last / count))
        if self._covers_by_alpha:
            return covered_by_alpha(shades, fragments.sample % self._rules.samples, self._rules)
        return shades

    def _shade(self, quads: Quads, lane: Ints, members: slice, into: Shades) -> None:
        """Shade quads, and store some of their lanes as these members of all fragments."""
        place = Barycentric(self._faces, quads, self._rules)
        shaded = self._stages.fragments(place, self._faces.front[quads.face], self._vertices)
        shape = (len(quads), quads.side, quads.side)

        def chosen(array: Any) -> Any:
            return np.broadcast_to(array, shape).ravel()[lane]

        discarded = as_bounded(shaded.discarded)
        corners = self._vertices.undecided[self._faces.corners[quads.face]].any(axis=1)
        unsure = corners.reshape(-1, 1, 1) | shaded.undecided
        # A fragment that is certainly discarded has no colour that could be undecided.
        doubtful = discarded.low != discarded.high
        into.undecided[members] = chosen(np.where(discarded.low, False, unsure) | doubtful)
        into.discarded[members] = chosen(discarded.value)
        if into.depth is not None:
            own = as_bounded(shaded.depth)
            ends = (own.value, own.low, own.high)
            into.depth[:, members] = np.stack([chosen(end) for end in ends])
        for colours, lanes in zip(into.colours, shaded.targets, strict=True):
            for i, values in enumerate(with_missing(lanes, len(lanes))):
                bounded = as_bounded(values)
                ends = (bounded.value, bounded.low, bounded.high)
                colours[:, members, i] = np.stack([chosen(end) for end in ends])
        if self._stages.has_bounds:
            found = Colours([colours[:, members] for colours in into.colours], lane, quads.side)
            narrow(found, self._cases_of(quads))

    def _cases_of(self, quads: Quads) -> CasesOf:
        """Evaluates some of these quads in one case of their decisions."""

        def evaluated(numbers: Ints, some: Ints) -> tuple[list[Lanes], Ints]:
            part = quads.only(some)
            place = Barycentric(self._faces, part, self._rules)
            return self._stages.cases(numbers, place, self._faces.front[part.face], self._vertices)

        return evaluated


def _within(progress: Tell, begin: float, share: float) -> Tell:
    """The progress of a part of the work, reported as progress of all of it."""
    return lambda done: progress(begin + share * done)
