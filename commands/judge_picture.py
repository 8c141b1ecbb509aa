"""``burnish judge``: compares pictures with the bounds of a golden folder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .answering import collector
from .console import Styled, say
from .failures import fail, needed
from .options import answer_option
from .terminal import FAILED, print_output

if TYPE_CHECKING:
    from ..targets.conformance.golden.within import Encoding, Output, Verdict

LANGUAGES = ("c++", "python", "rust", "typescript")
"""The languages that have comparers. Help names them, and loads no table of them for that."""


class _Request(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    folder: Path
    picture: Path
    case: str | None
    output: str | None
    encoding: Encoding
    flip: bool
    diff: Path | None


def _print_comparer(ctx: click.Context, _param: click.Parameter, language: str | None) -> None:
    """Print the comparer of a language and exit, if one is wanted."""
    if language is not None:
        from ..targets.conformance.comparers import comparer

        print_output(comparer(language))
        ctx.exit()


@click.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.argument("picture", type=click.Path(path_type=Path))
@click.option(
    "--case", metavar="NAME",
    help="The case that the picture shows, such as `Plastic/defaults`, or `defaults` if only one "
    "subject has it.",
)  # fmt: skip
@click.option(
    "--output", metavar="NAME",
    help="The output that the picture shows, such as `color`, if the case has several.",
)  # fmt: skip
@click.option(
    "--encoding", type=click.Choice(["linear", "srgb"]), default="linear", show_default=True,
    help="How whole numbers are meant: pictures that were drawn to an sRGB target, or encoded for "
    "a screen, are `srgb`. Floats are linear.",
)  # fmt: skip
@click.option(
    "--flip", is_flag=True, help="The bottom row comes first, as `glReadPixels` reads it.",
)  # fmt: skip
@click.option(
    "--diff", metavar="FILE.png", type=click.Path(path_type=Path),
    help="Write a picture of what is outside (red), and of what is not compared (blue).",
)  # fmt: skip
@answer_option
@click.option(
    "--comparer", type=click.Choice(LANGUAGES), callback=_print_comparer,
    is_eager=True, expose_value=False,
    help="Print a file that does the same in another language, to copy into a test suite, and "
    "compare nothing.",
)  # fmt: skip
def judge(**chosen: Any) -> None:
    """Compare a PICTURE with the bounds of a golden FOLDER.

    `burnish conform plastic.burnish --golden golden/` writes such a folder. It has, for each pixel,
    between which numbers every device's value lies that keeps its promises, and what to draw. So a
    picture is not compared with another one by a tolerance, which would be too wide at one pixel
    and too narrow at the next.

    A PICTURE is .npy (floats, or whole numbers of 8 or 16 bits), .png or .exr. It may also be a
    folder, with pictures that are called as in the golden folder, such as
    `Plastic/defaults/color.exr`: then all of them are compared, and none may be missing.

    The exit code is 1 if any pixel is outside of its bounds, or if something cannot be compared.

    \b
    Example:
        burnish judge golden/ mine.npy --case Plastic/defaults
        burnish judge golden/ screen.png --case defaults --encoding srgb --diff outside.png
        burnish judge golden/ pictures/
        burnish judge --comparer rust > tests/burnish_judge.rs
    """
    request = _Request(**chosen)
    try:
        from ..targets.conformance.golden.within import GoldenError
    except ModuleNotFoundError as error:
        needed(error)
    try:
        _judge(request)
    except GoldenError as error:
        fail(str(error))
    except ModuleNotFoundError as error:
        needed(error)
    except MemoryError:
        fail("there is not enough memory for this picture")


def _judge(request: _Request) -> None:
    """Judge one picture or a folder of them, and end with 1 if anything is outside."""
    from ..targets.conformance.golden.within import GoldenError, chosen, only, outputs_of

    _check_diff(request)
    outputs = outputs_of(request.folder)
    if not request.picture.is_dir():
        output = only(outputs, request.case, request.output)
        pairs = [(output, request.picture)]
    else:
        if request.diff is not None:
            raise click.UsageError("--diff shows one picture: name the PICTURE, not a folder")
        wanted = chosen(outputs, request.case, request.output)
        pairs = [(output, _file_of(output, request.picture)) for output in wanted]
    found: list[tuple[Output, Path, Verdict]] = []
    unjudged: list[str] = []
    for output, path in pairs:
        try:
            found.append((output, path, _verdict(output, path, request)))
        except GoldenError as error:
            unjudged.append(str(error))
    if (collected := collector()) is not None:
        from ..compiler.documents.answer import JudgeAnswer

        collected.find(JudgeAnswer(pictures=tuple(_row(*each) for each in found)))
    else:
        _tell(found)
    if unjudged:
        fail("\nerror: ".join(unjudged))
    if not all(verdict.is_good for _, _, verdict in found):
        click.get_current_context().exit(FAILED)


def _check_diff(request: _Request) -> None:
    """Raise ``UsageError`` for a file of --diff that is no PNG file, or the picture itself."""
    if request.diff is None:
        return
    if request.diff.suffix.lower() != ".png":
        raise click.UsageError(f"--diff writes a .png file: `{request.diff}` has another ending")
    if request.diff.resolve() == request.picture.resolve():
        raise click.UsageError("--diff would replace the PICTURE: give it another name")


def _file_of(output: Output, pictures: Path) -> Path:
    """The picture of an output in a folder. Raises ``GoldenError`` if there is none."""
    from ..targets.conformance.golden.pictures import READERS
    from ..targets.conformance.golden.within import GoldenError

    names = [pictures / output.folder / f"{output.name}{ending}" for ending in READERS]
    found = next(filter(Path.is_file, names), None)
    if found is None:
        endings = ", ".join(READERS)
        raise GoldenError(f"there is no picture {pictures / output.title} with {endings}")
    return found


def _verdict(output: Output, path: Path, request: _Request) -> Verdict:
    from ..targets.conformance.golden.pictures import read_picture
    from ..targets.conformance.golden.within import judged

    picture = read_picture(path, output)
    verdict = judged(picture[::-1] if request.flip else picture, output, request.encoding)
    if request.diff is not None:
        _write_diff(request.diff, output, verdict)
    return verdict


def _write_diff(path: Path, output: Output, verdict: Verdict) -> None:
    from ..targets.conformance.golden.viewable import marked
    from ..targets.conformance.golden.within import bounds_of, reference_of
    from .output import write_file

    undecided = bounds_of(output)[2]
    try:
        write_file(path, marked(reference_of(output), verdict.outside, undecided))
    except OSError as error:
        fail(f"cannot write `{path}`: {error.strerror or error}")


def _tell(found: Sequence[tuple[Output, Path, Verdict]]) -> None:
    from ..targets.conformance.golden.within import sentence

    for output, path, verdict in found:
        first, *more = sentence(verdict).split("\n")
        word = "agrees" if verdict.is_good else "differs"
        color = "green" if verdict.is_good else "red"
        say(Styled(word, color), f"  {output.title}, {path}: {first}")
        for line in more:
            say(line)
    if len(found) > 1:
        bad = sum(not verdict.is_good for _, _, verdict in found)
        say(f"{len(found)} pictures, {bad} of them outside of their bounds")


def _row(output: Output, path: Path, verdict: Verdict) -> dict[str, Any]:
    """A verdict as data for JSON."""
    worst = verdict.worst
    return {
        "case": output.folder,
        "output": output.name,
        "picture": str(path),
        "good": verdict.is_good,
        "compared": verdict.compared,
        "undecided": verdict.undecided,
        "outside": int(verdict.outside.sum()),
        "worst": None if worst is None else dict(_shown(worst)),
    }


def _shown(worst: Any) -> Iterator[tuple[str, Any]]:
    """The fields of the worst pixel; numbers that JSON has no words for are texts."""
    from math import isfinite

    for name in ("x", "y", "lane", "value", "lower", "upper"):
        found = getattr(worst, name)
        yield name, found if isfinite(found) else str(found)
