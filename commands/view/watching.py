"""The documents of each file that a page has opened, which are forgotten when the file changes."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from functools import partial
from pathlib import Path
from threading import Lock, Thread

from ..watch import Watcher, sources
from .documents import Documents
from .folder import Folder
from .keeping import Keeping
from .pictures import Pictures
from .request import Choice, ViewRequest
from .workshop import Workshop

_MOST_OPENED = 256
"""The most files whose readers the server remembers. It makes documents of other files when it is
asked, but reports no changes of them."""

Told = Callable[[str, str], None]
"""Called for a change: with the name of a file, and its new version."""


class Watched:
    """The files of a server that pages show. Threads may share it."""

    def __init__(self, request: ViewRequest, told: Told) -> None:
        """``told`` is called from another thread."""
        self._request = request
        self._told = told
        self.folder = Folder(request.file, request.search_path)
        self.workshop = Workshop()
        keeping = Keeping()
        self._made = Documents.shelf(keeping)
        self.pictures = Pictures(keeping)
        self.is_seen = False
        """True if any page is open: a page asks for a document itself after each change."""
        self._watcher = Watcher[str]()
        self._lock = Lock()
        self._opened: OrderedDict[str, Documents] = OrderedDict()

    @property
    def versions(self) -> dict[str, str]:
        """The version of each file that was opened, by its name."""
        with self._lock:
            return {name: each.version for name, each in self._opened.items()}

    def begin(self) -> None:
        """Make the first document before a browser asks, and print its errors.

        Then watch all opened files.
        """
        _start(self._first)
        _start(self._follow_all)

    def end(self) -> None:
        """Stop watching."""
        self._watcher.stop()

    def document(self, choice: Choice) -> bytes | None:
        """The document of a choice; of the first file, if it names no existing one.

        ``None`` if there is nothing to show.
        """
        name = choice.file
        path = self.folder.path(name) if name else None
        if path is None:
            name = self.folder.first()
            path = self.folder.path(name) if name else None
        if name is None or path is None:
            return None
        with self._lock:
            opened = self._opened.get(name)
        if opened is not None and (kept := opened.kept(choice)) is not None:
            return kept
        with self.workshop.working():
            return self._documents(name, path).get(choice)

    def _documents(self, name: str, path: Path) -> Documents:
        """The documents of a file, which is watched from now on.

        The caller works in the workshop.
        """
        with self._lock:
            found = self._opened.get(name)
            if found is not None:
                self._opened.move_to_end(name)
                return found
            found = Documents(self._request._replace(file=path), name, self.pictures, self._made)
            self._opened[name] = found
            old = self._opened.popitem(last=False) if len(self._opened) > _MOST_OPENED else None
        if old is not None:
            self._watcher.leave(old[0])
            old[1].forget()
        self._follow(name, found)
        return found

    def _first(self) -> None:
        self.document(Choice())
        self.workshop.tidy()

    def _follow_all(self) -> None:
        for name in self._watcher.changes():
            with self._lock:
                changed = self._opened.get(name)
            if changed is not None:
                self._change(name, changed)

    def _change(self, name: str, changed: Documents) -> None:
        """Report a change, and make documents that nobody asks for, so that errors are printed."""
        with self.workshop.working():
            changed.forget()
            self._follow(name, changed)
        self._told(name, changed.version)
        if not self.is_seen:
            _start(partial(self._make, changed))

    def _make(self, documents: Documents) -> None:
        with self.workshop.working():
            documents.get(Choice())
        self.workshop.tidy()

    def _follow(self, name: str, documents: Documents) -> None:
        file, search_path = documents.file, self._request.search_path
        find = partial(sources, file, search_path)
        self._watcher.follow(name, file, lambda: find() | documents.others)


def _start(act: Callable[[], object]) -> None:
    """Run a function in a thread that ends with the process, whatever it does then."""
    Thread(target=act, daemon=True).start()
