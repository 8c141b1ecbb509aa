"""The list of actions as a document for other programs: ``burnish build --actions``."""

from __future__ import annotations

from collections.abc import Sequence

from ...compiler.documents.actions import BuildAction, BuildActions, InputFile, NamedText
from .actions import Batch, BuildError, digest_of
from .messages import Messages, messages_of
from .program import program

ENVIRONMENT: tuple[NamedText, ...] = ()
"""The variables that a compile needs: none. What it writes depends on no variable."""


def platform() -> tuple[NamedText, ...]:
    """What a machine needs to have, so that it makes the same outputs."""
    return (NamedText(name="burnish", value=program()),)


def document_of(batches: Sequence[Batch], called: Sequence[str]) -> BuildActions:
    """The document; ``called`` are the words by which other machines call Burnish.

    Raises ``BuildError`` if something lies where other machines cannot have it.
    """
    return BuildActions(
        build=1, platform=platform(), actions=tuple(_row(each, called) for each in batches)
    )


def _messages(batch: Batch, called: Sequence[str]) -> Messages:
    """The messages of an action. Raises ``BuildError``."""
    for output in batch.outputs:
        if output.startswith(("/", "../")):
            raise BuildError(
                f"outputs in `{output}` lie outside of this folder, and other machines have only "
                "what is in it: name a folder below it with -o"
            )
    return messages_of(
        [*called, *batch.words()], ENVIRONMENT, platform(), batch.outputs, batch.inputs,
        batch.folders,
    )  # fmt: skip


def _row(batch: Batch, called: Sequence[str]) -> BuildAction:
    made = _messages(batch, called)
    return BuildAction(
        name=batch.name,
        arguments=(*called, *batch.words()),
        environment=ENVIRONMENT,
        inputs=tuple(InputFile(path=path, digest=each) for path, each in batch.inputs.items()),
        input_folders=batch.folders,
        outputs=tuple(sorted(batch.outputs)),
        command_digest=digest_of(made.command),
        input_root_digest=digest_of(made.directories[-1]),
        digest=digest_of(made.action),
    )
