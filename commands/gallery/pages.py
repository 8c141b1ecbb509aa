"""Writes the pages of a gallery: one that shows all files, and one for each of them.

``command.py`` calls ``pages``. The pages consist of local files only and ask for nothing else, so a
browser shows them from disk.
"""

from __future__ import annotations

import base64
import re
import unicodedata
from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

from markupsafe import Markup

from ...compiler.diagnostics.display import harmless_lines
from ...compiler.diagnostics.file_names import DEVICES
from ...targets.conformance.html_pages import Embedded, environment
from ...targets.conformance.rows import STATUSES
from ...targets.conformance.summary import MEANINGS
from ...targets.runner.routes import Route
from ..catalogue import ENDING, Group, Listed
from ..comments import paragraphs
from .entry import Entry, Figure, Verdict
from .highlighting import burnish_text, shader_text

FOLDER = Path(__file__).parent
LONGEST_NAME = 100
"""The most bytes of the name of a page, without its ending."""
MOST_WORDS = 2000
"""The most letters of a file's comment that the search looks at."""
_WORDS = {"agrees": "agree", "differs": "differ", "proves little": "prove little",
          "overflows": "overflow"}  # fmt: skip
"""The plural of each verdict's word."""
_KINDS = {"material": "materials", "kernel": "kernels", "frame": "frames", "module": "modules"}


class _Page(NamedTuple):
    """A file of the gallery with its page."""

    listed: Listed
    entry: Entry
    slug: str

    @property
    def title(self) -> str:
        """The file's description, or its name."""
        what = self.listed.what
        return what[:1].upper() + what[1:] if what else self.listed.name

    @property
    def file(self) -> str:
        """The name of the page."""
        return f"{self.slug}.html"

    def picture(self, name: str) -> str:
        """The name of the file of one of its pictures."""
        return f"{self.slug}-{name}"


def pages(
    title: str, groups: Sequence[Group], entries: Mapping[str, Entry], routes: Sequence[Route]
) -> dict[str, bytes]:
    """All files of the gallery, by their names."""
    templates = environment(FOLDER)
    templates.filters |= {
        "words": _marked, "shader": shader_text, "address": _address, "drawing": Markup,
    }  # fmt: skip
    embedded = Embedded(FOLDER / "gallery.css", FOLDER / "gallery.js", has_files=True)
    templates.globals["embedded"] = embedded
    found: dict[str, bytes] = {}
    shown = _named([file for group in groups for file in group.files], entries)
    users = _users(shown)
    for number, page in enumerate(shown):
        before, after = shown[number - 1], shown[(number + 1) % len(shown)]
        text = templates.get_template("page.html.j2").render(
            gallery=title, page=page, entry=page.entry, before=before, after=after,
            source=burnish_text(page.entry["source"]),
            doc=paragraphs(page.entry["source"]),
            figures=_by_label(page.entry["figures"]),
            verdicts=_by_label(page.entry["verdicts"]), columns=MEANINGS,
            summary=in_short(page.entry), state=_state(page.entry),
            used_by=[_card(user, {}) for user in users.get(page.listed.name, ())],
        )  # fmt: skip
        found[page.file] = text.encode()
        for name, content in page.entry["pictures"].items():
            found[page.picture(name)] = base64.b64decode(content)
    by_name = {page.listed.name: page for page in shown}
    index = templates.get_template("index.html.j2").render(
        title=title,
        groups=[
            {
                "title": group.title,
                "intro": group.intro,
                "cards": [_card(by_name[file.name], users) for file in group.files],
            }
            for group in groups
        ],
        kinds=_counted_kinds(shown),
        total=len(shown),
        summary=_counted([v for page in shown for v in page.entry["verdicts"]]),
        routes=_routes(routes, shown),
        wrong=[page for page in shown if page.entry["errors"]],
    )
    found["index.html"] = index.encode()
    return found


def in_short(entry: Entry) -> str:
    """The verdicts on a file, in a few words."""
    if entry["errors"] and not entry["verdicts"]:
        return "error"
    return _counted(entry["verdicts"]) or "nothing to draw"


def _named(files: Sequence[Listed], entries: Mapping[str, Entry]) -> list[_Page]:
    """Each file with a name of its own for its page; all pages lie in one folder.

    Such a name is valid on every system and server: it has only letters of words, is short, and
    differs from others by more than small and capital letters.
    """
    taken = {"index", *DEVICES}
    numbers: Counter[str] = Counter()
    found = []
    for file in files:
        plain = slug = _plain(file.name.removesuffix(ENDING))
        while (key := unicodedata.normalize("NFKD", slug).casefold()) in taken:
            numbers[plain] += 1
            slug = f"{plain}-{numbers[plain] + 1}"
        taken.add(key)
        found.append(_Page(file, entries[file.name], slug))
    return found


def _plain(name: str) -> str:
    """The words of a name, with dashes between them."""
    words = re.sub(r"[^\w.]+", "-", unicodedata.normalize("NFC", name)).strip(".-")
    return words.encode()[:LONGEST_NAME].decode(errors="ignore") or "file"


def _address(file: str) -> str:
    """The relative address of a file beside a page; the dot says that no scheme begins it."""
    return f"./{quote(file)}"


def _users(shown: Sequence[_Page]) -> dict[str, list[_Page]]:
    """The files with pictures that import a file which draws nothing itself, by its name."""
    return {
        page.listed.name: [
            user
            for user in shown
            if str(page.listed.path.resolve()) in user.entry["inputs"] and _picture(user)
        ]
        for page in shown
        if page.entry["kinds"] == ["module"]
    }


def _picture(page: _Page) -> str:
    """The name of the first picture of a file; empty if there is none."""
    figures = page.entry["figures"]
    shown = next((each["picture"] for each in figures if each["picture"]), "")
    return page.picture(shown) if shown else ""


def _card(page: _Page, users: Mapping[str, Sequence[_Page]]) -> dict[str, Any]:
    """The card of a file on the page of all files.

    A file that draws nothing itself has a picture of the first file that imports it.
    """
    entry = page.entry
    user = next(iter(users.get(page.listed.name, ())), None)
    comment = " ".join(each.text for each in paragraphs(entry["source"]))[:MOST_WORDS]
    words = [page.listed.name, page.listed.what, *entry["names"], comment]
    return {
        "page": page, "picture": _picture(user or page), "kinds": entry["kinds"],
        "drawn_by": user.listed.name if user else "",
        "words": " ".join(words).lower(), "state": _state(entry), "summary": in_short(entry),
    }  # fmt: skip


def _state(entry: Entry) -> str:
    """The state of a file: ``wrong``, ``weak`` or ``fine``, or ``none`` if nothing was compared."""
    statuses = {verdict["status"] for verdict in entry["verdicts"]}
    if entry["errors"]:
        return "wrong"
    if "proves little" in statuses:
        return "weak"
    return "fine" if "agrees" in statuses else "none"


def _counted(verdicts: Sequence[Verdict]) -> str:
    """The number of verdicts of each kind: ``12 agree, 1 not run``."""
    counts = Counter(verdict["status"] for verdict in verdicts)
    return ", ".join(
        f"{counts[status]} {status if counts[status] == 1 else _WORDS.get(status, status)}"
        for status in STATUSES
        if counts[status]
    )


def _counted_kinds(shown: Sequence[_Page]) -> list[dict[str, Any]]:
    counts = Counter(kind for page in shown for kind in page.entry["kinds"])
    return [{"kind": kind, "words": words, "count": counts[kind]}
            for kind, words in _KINDS.items() if counts[kind]]  # fmt: skip


def _routes(routes: Sequence[Route], shown: Sequence[_Page]) -> list[dict[str, Any]]:
    """Each route with its verdicts, its device, and the reason why it was not run."""
    verdicts = [verdict for page in shown for verdict in page.entry["verdicts"]]
    found = []
    for route in routes:
        own = [verdict for verdict in verdicts if verdict["route"] == route.name]
        devices = dict.fromkeys(v["device"] for v in own if v["device"])
        reasons = Counter(v["problem"] for v in own if v["status"] == "not run")
        found.append({
            "name": route.name, "title": route.title, "summary": _counted(own),
            "device": "; ".join(devices), "reasons": reasons.most_common(),
        })  # fmt: skip
    return found


def _by_label(rows: Sequence[Figure] | Sequence[Verdict]) -> dict[str, list[Any]]:
    """Figures or verdicts of the same thing, side by side."""
    found: dict[str, list[Any]] = {}
    for row in rows:
        found.setdefault(row["label"], []).append(row)
    return found


def _marked(text: str) -> Markup:
    """A line of Markdown with code and emphasis; links become their words."""
    plain = re.sub(r"\[([^\[\]]+)\]\([^()]*\)", r"\1", harmless_lines(text))
    pieces = re.split(r"(`[^`]+`|\*\*?[^*`\s][^*`]*\*\*?)", escape(plain))
    return Markup("".join(map(_styled, pieces)))


def _styled(piece: str) -> str:
    if piece.startswith("`"):
        return f"<code>{piece[1:-1]}</code>"
    if piece.startswith("*") and piece.endswith("*") and piece.strip("*"):
        return f"<em>{piece.strip('*')}</em>"
    return piece
