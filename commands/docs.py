"""The command ``burnish docs``: the pages that come with Burnish."""

from __future__ import annotations

import click

from .console import say
from .options import answer_option
from .shipped import DOCS, chosen, groups, say_groups


@click.command()
@click.argument("name", required=False, metavar="[PAGE]")
@click.option("--path", "as_path", is_flag=True, help="Print where the page is, or all of them.")
@answer_option
def docs(name: str | None, as_path: bool) -> None:
    """List the pages of the documentation, or print one PAGE.

    The pages are texts in Markdown, which come with Burnish and need no network. `--path` tells
    where they are, to open them in an editor or a browser.

    \b
    Example:
        burnish docs
        burnish docs tutorial
        burnish docs language --path
    """
    listed = groups(DOCS)
    if name is None:
        _list(as_path)
        return
    pages = [page for rows in listed.values() for page in rows]
    page = DOCS / f"{chosen('docs', name.removeprefix('docs/'), pages, '.md')}.md"
    if as_path:
        say(str(page))
        return
    for line in page.read_text(encoding="utf-8").splitlines():
        say(line)


def _list(as_path: bool) -> None:
    if as_path:
        say(str(DOCS))
        return
    say("Pages, each printed by `burnish docs PAGE`. Begin with `tutorial`.")
    say_groups(groups(DOCS))
