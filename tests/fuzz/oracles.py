"""The properties that every random program must have, as questions that are asked about it.

``__main__.py`` asks them for a given time, and asks one of them again while a program is shrunk.
``test_fuzz.py`` asks them about a few programs and about all regressions.
"""

from __future__ import annotations

import re
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import burnish
from burnish.api import entry_points as api
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.shader import Shader
from burnish.compiler.passes.pipeline import Options
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.namespace import Lanes
from burnish.support.frozen import cached_property
from burnish.targets.closing import Closing
from burnish.targets.conformance.cases import SIZE, Size
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import Route
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..passes.agreement import disagreements
from ..passes.hardware import flat
from ..passes.kit import Alike, World, shaders
from ..passes.positions import differing
from ..passes.value_ranges import LARGEST, broken
from ..targets.standings import PROFILES
from .equivalence import differences
from .tree import Node as Tree

ALLOWED = {
    each.code
    for each in (
        rules.ZERO_DIVISOR, rules.OUT_OF_BOUNDS, rules.NUMBER_TOO_LARGE, rules.NO_STRIPS,
        rules.NEVER_POSITIVE, rules.NO_SUCH_ELEMENT,
    )
}  # fmt: skip
"""The mistakes in some programs: their constants are random, and their values can be computed."""


SIZES: tuple[Size, ...] = (
    (25, 19), (31, 7), (13, 29), (17, 17), (40, 15), (5, 37), (1, 23), (22, 1), (33, 21),
)  # fmt: skip
"""The sizes in which programs are drawn: small, so that many can be drawn, and most of them odd."""

_OF_SWIFTSHADER = ("degrees(", ": depth_cube")
KNOWN_BUGS: Mapping[str, tuple[str, ...]] = {
    "swiftshader": _OF_SWIFTSHADER, "webgpu": _OF_SWIFTSHADER, "webgl2": _OF_SWIFTSHADER,
}  # fmt: skip
"""Texts of what is wrong on a driver (``docs/drivers.md``), which does not draw their programs."""


@dataclass(frozen=True)
class Finding:
    """An answer that should not be given."""

    oracle: str
    """A name in ``ORACLES``."""
    place: str
    """The tool, route, pass or rewriting that gives it; shrinking asks only this one again."""
    sort: str
    """The message without names and numbers, which stays the same while the program is shrunk."""
    detail: str
    """The whole message, for people."""

    def is_like(self, other: Finding) -> bool:
        """True if both are probably the same defect."""
        return (self.oracle, self.place, self.sort) == (other.oracle, other.place, other.sort)


class Tools(Closing):
    """The processes that compile and draw. Use it as a context manager, for many programs."""

    def __init__(self, routes: Sequence[Route] = ()) -> None:
        self.routes = routes
        self.toolchain = Toolchain(parallel=1)
        self.runner = Runner(routes, parallel=1, reuse=False)
        self.statuses: Counter[tuple[str, str]] = Counter()
        """The number of rows of each route and status; programs that are shrunk do not count."""

    def close(self) -> None:
        """End all processes."""
        self.toolchain.close()
        self.runner.close()


@dataclass(frozen=True)
class Case:
    """A program with the seed of the values that it is evaluated with."""

    text: str
    seed: int
    tools: Tools
    tree: Tree | None = None
    """The program as it was made, if it is to be rewritten."""
    only: str = ""
    """The place of the finding that is looked for; all places are asked if this is empty."""

    @cached_property
    def variant(self) -> tuple[str | None, str | None]:
        """The program's own rig and pass. Raises ``CompileError``."""
        return api.variants(self.text)[-1]

    @cached_property
    def shader(self) -> Shader:
        """The shader of its material, before all passes. Raises ``CompileError``."""
        return shaders(self.text, *self.variant)[-1]

    @cached_property
    def material(self) -> CompiledMaterial:
        """The shader's material, compiled for all profiles. Raises ``CompileError``."""
        rig, pass_ = self.variant
        found = burnish.compile(
            self.text, PROFILES, material=self.shader.name, rig=rig, pass_=pass_, partial=True
        )
        return found.materials[-1]

    @property
    def size(self) -> Size:
        """The size of its pictures. Its seed chooses it, unless the program is that of a file."""
        return SIZES[self.seed % len(SIZES)] if self.tree else SIZE

    def asks(self, place: str) -> bool:
        """True if the question has to be asked at a place."""
        return self.only in ("", place)


# --- the questions -------------------------------------------------------------------------------


def _compiles(case: Case) -> Iterator[Finding]:
    """The program is compiled for every profile, or is refused for an allowed reason."""
    try:
        assert case.material.reflection
        if api.has_frames(case.text):
            for each in burnish.compile(case.text, PROFILES, partial=True).frames:
                assert each.plan
    except CompileError as error:
        yield from _refusals(error)


def _refusals(error: CompileError) -> Iterator[Finding]:
    """The errors that must not be reported, as the program is correct by construction."""
    for each in error.diagnostics:
        if each.severity == "error" and each.rule.code not in ALLOWED:
            yield Finding("compiles", each.rule.code, _sort(each.message), str(error))


def _facts(case: Case) -> Iterator[Finding]:
    """Every value lies within what range analysis knows about it."""
    for traps in (False, True):
        for single in (False, True):
            for each in broken(case.shader, World(case.seed, traps), single=single)[:1]:
                yield Finding("facts", "float32" if single else "float64", "", each)


def _passes(case: Case) -> Iterator[Finding]:
    """The changes of the value by passes; none should change it."""
    for traps, hoist in ((False, True), (True, False)):
        world = World(case.seed, traps)
        if not is_defined(case, world):
            continue
        for each in disagreements(case.shader, [world], Options(hoist))[:1]:
            yield Finding("passes", each.partition(",")[0], "", f"hoist={hoist}: {each}")


def _placed(case: Case) -> Iterator[Finding]:
    """Several passes compute a position by the same operations."""
    if api.has_frames(case.text):
        return
    try:
        for each in differing(case.text, PLACED):
            yield Finding("placed", "", "", each)
    except CompileError as error:
        yield from _refusals(error)


PLACED = ("glsl:vulkan", "wgsl:webgpu")
"""The profiles for which positions are compared: one needs fewer guards than the other."""


def _rewritten(case: Case) -> Iterator[Finding]:
    """Another program that means the same has the same value."""
    if case.tree is None:
        return
    for traps in (False, True):
        world = World(case.seed, traps)
        if not is_defined(case, world):
            continue
        for turn in range(SEARCHED if case.only else 1):
            seed = f"{case.seed} {traps} {turn}"
            for name, sort, story in differences(
                case.tree, case.shader, case.variant, world, seed, case.only
            ):
                yield Finding("rewritten", name, sort, story)


SEARCHED = 6
"""The number of places at which a rewriting is tried again in a program that was shrunk."""


def is_defined(case: Case, world: World) -> bool:
    """True if the program has a value: its values fit in float32, and none is left to hardware."""
    if "unguarded(" in case.text:
        return False
    largest = 0.0

    def look(_node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
        nonlocal largest
        largest = max(largest, *(abs(lane) for lane in flat(value)))
        return value

    evaluator = Evaluator(world, Alike(), look)
    for root in case.shader.roots:
        evaluator.value(root)
    return largest <= LARGEST


def _accepted(case: Case) -> Iterator[Finding]:
    """Every downstream compiler takes the texts of its profiles."""
    made = jobs_of(case.material)
    asked = [job for job in made if case.asks(f"{job.checker} {job.stage}")]
    for verdict in case.tools.toolchain.check(asked):
        if verdict.status != "accepted":
            errors = [message.text for message in verdict.messages if message.severity == "error"]
            place = f"{verdict.job.checker} {verdict.job.stage}"
            sort = f"{verdict.status} {_sort(errors[0]) if errors else ''}"
            yield Finding("accepted", place, sort, f"{verdict.report()}\n{verdict.job.text}")


def _drawn(case: Case) -> Iterator[Finding]:
    """Every route draws what the reference draws."""
    tools = case.tools
    routes = [
        route
        for route in tools.routes
        if case.asks(route.name)
        and not any(text in case.text for text in KNOWN_BUGS.get(route.driver, ()))
    ]
    rows = conform(
        [("random", case.material)], routes, tools.runner, tools.toolchain,
        seed=case.seed, size=case.size, keep=False,
    )  # fmt: skip
    for row in rows:
        if not case.only:
            tools.statuses[row.route.name, row.status] += 1
        if row.status in ("differs", "failed"):
            wrong = [result.case for result in row.results if result.comparison.wrong]
            sort = f"{row.status} {wrong[0] if wrong else _sort(row.problem)}"
            yield Finding("drawn", row.route.name, sort, "\n".join(_story(row)))


def _story(row: Row) -> Iterator[str]:
    yield f"{row.route.name}: {row.status}"
    yield from details(row)


Question = Callable[[Case], Iterator[Finding]]

ORACLES: Mapping[str, Question] = {
    "compiles": _compiles,
    "facts": _facts,
    "passes": _passes,
    "placed": _placed,
    "rewritten": _rewritten,
    "accepted": _accepted,
    "drawn": _drawn,
}
"""All questions, cheap ones first. Those after ``compiles`` are about programs that compile."""


@dataclass
class Answers:
    """The answers to a question about one program."""

    findings: list[Finding] = field(default_factory=list)
    refused: bool = False
    """True if the program is refused for an allowed reason, so that no question could be asked."""


def ask(case: Case, oracle: str) -> Answers:
    """Ask one question about a program."""
    try:
        _ = case.shader
    except CompileError as error:
        return Answers(list(_refusals(error)), refused=True)
    except Exception as error:
        return Answers([_crash("compiles", error)])
    try:
        return Answers(list(ORACLES[oracle](case)))
    except Exception as error:
        return Answers([_crash(oracle, error)])


def _crash(oracle: str, error: Exception) -> Finding:
    """An exception, which is a defect wherever it comes from."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    sort = f"{type(error).__name__} in {last.name}"
    return Finding(oracle, "", sort, "".join(traceback.format_exception(error)))


def _sort(message: str) -> str:
    """A message without the names and numbers in it."""
    return re.sub(r"`[^`]*`|'[^']*'|\"[^\"]*\"|\w*\d\w*", "…", message)[:120]
