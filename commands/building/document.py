"""The list of actions as a document for other programs: ``burnish build --actions``."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from ...compiler.documents.actions import BuildAction, BuildActions, InputFile, NamedText
from .actions import Batch, BuildError, digest_of
from .messages import Messages, messages_of
from .program import program

ENVIRONMENT: tuple[NamedText, ...] = ()
"""The variables that a compile needs: none. What it writes depends on no variable."""


def _platform(batch: Batch) -> tuple[NamedText, ...]:
    """What a machine needs to have, so that it makes the same outputs; in the order of names."""
    own = NamedText(name="burnish", value=program())
    if not batch.actions[0].request.uses_tools:
        return (own,)
    return (own, NamedText(name="compilers", value=_compilers()))


@cache
def _compilers() -> str:
    """The compilers of other makers on this machine, with their versions."""
    from ...targets.toolchain.checkers import CHECKERS
    from ...targets.toolchain.tools import inspect_all, tool_named

    names = sorted({name for each in CHECKERS.values() for name in each.needs})
    states = inspect_all(map(tool_named, names)).values()
    return ", ".join(f"{each.tool.name} {each.version}" for each in states if each.version)


def document_of(batches: Sequence[Batch], called: Sequence[str]) -> BuildActions:
    """The document; ``called`` are the words by which other machines call Burnish.

    Raises ``BuildError`` if something lies where other machines cannot have it.
    """
    return BuildActions(build=1, actions=tuple(_row(each, called) for each in batches))


def _messages(batch: Batch, called: Sequence[str]) -> Messages:
    """The messages of an action. Raises ``BuildError``."""
    for output in batch.outputs:
        if output.startswith(("/", "../")):
            raise BuildError(
                f"outputs in `{output}` lie outside of this folder, and other machines have only "
                "what is in it: name a folder below it with -o"
            )
    return messages_of(
        [*called, *batch.words()], ENVIRONMENT, _platform(batch), batch.outputs, batch.inputs,
        batch.folders,
    )  # fmt: skip


def _row(batch: Batch, called: Sequence[str]) -> BuildAction:
    made = _messages(batch, called)
    return BuildAction(
        name=batch.name,
        arguments=(*called, *batch.words()),
        environment=ENVIRONMENT,
        platform=_platform(batch),
        inputs=tuple(InputFile(path=path, digest=each) for path, each in batch.inputs.items()),
        input_folders=batch.folders,
        outputs=tuple(sorted(batch.outputs)),
        command_digest=digest_of(made.command),
        input_root_digest=digest_of(made.directories[-1]),
        digest=digest_of(made.action),
    )
