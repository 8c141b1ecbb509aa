"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path

import click

file_argument = click.argument("file", type=click.Path(path_type=Path))

rig_option = click.option(
    "--rig", metavar="NAME", help="The rig to use, if the file declares several."
)
pass_option = click.option(
    "--pass", "pass_", metavar="NAME", help="The pass that draws, if not the library's Forward."
)
search_option = click.option(
    "-I",
    "--include",
    "search_path",
    metavar="FOLDER",
    multiple=True,
    type=click.Path(path_type=Path),
    help="A folder in which to look for imported files; may be given several times.",
)
hoist_option = click.option(
    "--hoist/--no-hoist",
    default=True,
    help="Leave values that depend only on parameters to the host, or compute them in the shader.",
    show_default=True,
)
format_option = click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="Text for people or JSON for programs.",
)
