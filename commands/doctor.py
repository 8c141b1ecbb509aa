"""``burnish doctor``: lists the external tools, and the routes that can draw with them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import click

from .answering import collector
from .console import Styled, say
from .options import answer_option
from .terminal import FAILED

if TYPE_CHECKING:
    from ..compiler.documents.answer import DoctorAnswer
    from ..targets.runner.routes import Route
    from ..targets.toolchain.tools import ToolState

_INDENT = " " * 10
Line = Sequence[str | Styled]
"""The pieces of a line; one of them may have a colour."""


@click.command()
@answer_option
def doctor() -> None:
    """Look for external tools, and say what they are for.

    `compile --validate`, `render --on`, `conform` and the tests use them; compiling needs none. For
    each missing tool, the output has the command that installs it, and says what does not work
    without it; the exit code is then 1, unless nobody can promise that the tool can be installed
    today. A list of the routes follows, and whether each can draw.

    \b
    Example:
        burnish doctor
        burnish compile plastic.burnish --validate -o build/
    """
    from ..targets.toolchain.tools import inspect_all

    states = inspect_all()
    if (collected := collector()) is not None:
        collected.find(_found(states))
    else:
        for line in (*_tools(states), [], *_routes(states)):
            say(*line)
    if any(state.problem and not state.tool.may_be_missing for state in states.values()):
        click.get_current_context().exit(FAILED)


def _found(states: Mapping[str, ToolState]) -> DoctorAnswer:
    """The same as a record."""
    from ..compiler.documents.answer import DoctorAnswer, RouteRow, ToolRow
    from ..targets.runner.routes import EVERY_ROUTE

    tools = (
        ToolRow(
            name=name, purpose=state.tool.purpose, version=state.version,
            paths=tuple(map(str, state.paths)), problem=state.problem, install=state.tool.install,
        )
        for name, state in states.items()
    )  # fmt: skip
    routes = (
        RouteRow(name=name, title=route.title, lacks=_lacking(route, states))
        for name, route in EVERY_ROUTE.items()
    )
    return DoctorAnswer(tools=tuple(tools), routes=tuple(routes))


def _lacking(route: Route, states: Mapping[str, ToolState]) -> tuple[str, ...]:
    """The tools that a route needs, and that cannot be used."""
    return tuple(tool for tool in route.needs if states[tool].problem)


def _tools(states: Mapping[str, ToolState]) -> Iterator[Line]:
    from ..targets.toolchain.versions import refuses_sandbox

    width = max(map(len, states))
    versions = max(len(state.version or "") for state in states.values())
    for name, state in states.items():
        if state.problem is None:
            found = f"{state.version:<{versions}}  {state.paths[0]}"
            yield Styled(f"{'ok':<8}", "green"), f"  {name:<{width}}  {found}"
            if name == "chromium" and refuses_sandbox():
                yield [f"{_INDENT}it runs without its sandbox, which it refuses to use as root"]
        else:
            mark = "unusable" if state.paths else "missing"
            yield Styled(f"{mark:<8}", "red"), f"  {name:<{width}}  {state.tool.purpose}"
            yield from ([f"{_INDENT}{line}"] for line in _remedy(state))


def _remedy(state: ToolState) -> Iterator[str]:
    """Lines that say how to install a tool, and which features need it."""
    from ..targets.runner.routes import routes_needing
    from ..targets.toolchain.checkers import checkers_needing

    yield f"install it with: {state.tool.install}"
    if checkers := checkers_needing(state.tool.name):
        yield f"without it nothing is checked by {', '.join(checkers)}"
    if routes := routes_needing(state.tool.name):
        yield f"without it nothing is drawn by {', '.join(routes)}"


def _routes(states: Mapping[str, ToolState]) -> Iterator[Line]:
    from ..targets.runner.routes import EVERY_ROUTE

    width = max(map(len, EVERY_ROUTE))
    for name, route in EVERY_ROUTE.items():
        lacking = _lacking(route, states)
        mark = Styled(f"{'no':<8}", "red") if lacking else Styled(f"{'draws':<8}", "green")
        reason = f"  (needs {', '.join(lacking)})" if lacking else ""
        yield mark, f"  {name:<{width}}  {route.title}{reason}"
    yield ["Direct3D itself draws nothing here: its HLSL is drawn on Vulkan, and checked as DXIL."]
