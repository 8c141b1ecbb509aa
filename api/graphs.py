"""The graphs behind the results of a compile, which are dropped early and made again when asked.

``compiling.py`` makes a ``KeptGraphs`` for each result, and the records of ``compiled.py`` ask it.
With ranges and the evidence of proofs, graphs take some 25 bytes for each character of the texts
that were printed from them, and most of those who keep a result never ask for more than the texts.
So only the graphs of the results that were used last stay in memory. Those of another one are made
again from the same inputs, for whoever asks. That is also how a result is pickled: without graphs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from ..compiler.diagnostics.source import Span
from ..compiler.ir.shader import Shader
from ..compiler.passes.pipeline import Staged
from ..compiler.source_map import located
from ..support.frozen import frozen
from ..support.locks import lock
from ..targets.emit.emitter import Emission, EmittedFile
from ..targets.legalise.legal import Legal
from ..targets.selection import full_name

if TYPE_CHECKING:
    from ..compiler.ir.frame import Frame

MOST_CHARACTERS = 1 << 17
"""The number of characters of the texts of those results whose graphs stay: 3 MB or so of graphs.
The graphs of the result that was used last stay in any case."""
LEAST = 256
"""The least that a result counts."""


@frozen
class ShaderGraphs:
    """Everything that a compile has computed of one shader, besides its texts."""

    shader: Shader
    """The shader before any pass."""
    staged: Staged
    emissions: tuple[tuple[Legal, Emission], ...]
    """For each profile that has texts: the program in its form, and the texts."""
    flipped: frozenset[str]
    """The profiles whose texts flip the picture vertically."""

    def files(self) -> Iterator[tuple[Legal, EmittedFile]]:
        """All texts, each with the program that it was printed from."""
        return ((legal, file) for legal, made in self.emissions for file in made.files)

    def spans(self, profile: str, stage: str) -> dict[int, Span]:
        """The source map of a text for a profile (``glsl:es300``)."""
        (legal, file), = (
            (legal, file) for legal, file in self.files()
            if (full_name(legal.language, legal.profile), file.stage) == (profile, stage)
        )  # fmt: skip
        return located(self.shader, file.origins(), legal.program.shader.notes)


@frozen
class ResultGraphs:
    """Everything that a compile has computed, besides texts."""

    shaders: tuple[ShaderGraphs, ...]
    """The graphs of the materials of a result, in their order."""
    frames: tuple[Frame, ...]
    """The checked frames, in the order of the result's."""

    def characters(self) -> int:
        """The number of characters of all texts."""
        return sum(len(file.text) for each in self.shaders for _legal, file in each.files())


class KeptGraphs:
    """The graphs of one result, as long as they stay in memory, and the way to make them again."""

    def __init__(
        self, again: Callable[[], ResultGraphs], made: ResultGraphs | None = None, *, stay: bool
    ) -> None:
        """``again`` is called when they are asked for and are not there; it can be pickled.

        With ``stay``, they are never dropped. Otherwise ``made`` stays as long as few others are
        used.
        """
        self._again = again
        self._made = made
        self._stay = stay
        if made is not None and not stay:
            _RECENT.use(self, made)

    def graphs(self) -> ResultGraphs:
        """The graphs, which are the same as long as they stay."""
        made = self._made
        if made is None:
            made = self._again()
            if self._stay:
                self._made = made
        if not self._stay:
            _RECENT.use(self, made)
        return made

    def hold(self, made: ResultGraphs) -> None:
        """Have the graphs there until ``drop``."""
        self._made = made

    def drop(self) -> None:
        """Forget the graphs; ``graphs`` makes them again."""
        self._made = None

    def __reduce__(self) -> tuple[Any, ...]:
        return _without_graphs, (self._again, self._stay)


def _without_graphs(again: Callable[[], ResultGraphs], stay: bool) -> KeptGraphs:
    return KeptGraphs(again, stay=stay)


@frozen
class PlaceOfGraphs:
    """The place of one shader's graphs among those of a result."""

    kept: KeptGraphs
    number: int

    def graphs(self) -> ShaderGraphs:
        """The graphs of the shader."""
        return self.kept.graphs().shaders[self.number]


@frozen
class SpansOfText:
    """Finds the source map of a text, when somebody asks for it."""

    place: PlaceOfGraphs
    profile: str
    stage: str

    def __call__(self) -> dict[int, Span]:
        """The place in Burnish text of each line that has one."""
        return self.place.graphs().spans(self.profile, self.stage)


class Recent:
    """The results whose graphs stay, by the number of the characters of their texts."""

    def __init__(self, characters: int = MOST_CHARACTERS) -> None:
        self._most = characters
        self._sizes: WeakKeyDictionary[KeptGraphs, int] = WeakKeyDictionary()
        """The characters of each that somebody still has, the one that was used last at the end.

        Results without texts have graphs, too, and count as if they had some.
        """
        self._lock = lock()

    def use(self, used: KeptGraphs, made: ResultGraphs) -> None:
        """Note that somebody uses these graphs, and drop those not used for the longest time."""
        with self._lock:
            size = self._sizes.pop(used, None)
            used.hold(made)
            self._sizes[used] = max(LEAST, made.characters()) if size is None else size
            while len(self._sizes) > 1 and sum(self._sizes.values()) > self._most:
                oldest = next(self._sizes.keys())
                del self._sizes[oldest]
                oldest.drop()


_RECENT = Recent()
