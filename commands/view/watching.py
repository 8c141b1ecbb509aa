"""The documents of each file that a page has opened, with a thread that watches it for changes."""

from __future__ import annotations

from collections.abc import Callable
from threading import Event, Lock, Thread

from ..watch import states
from .documents import Documents
from .folder import Folder
from .pictures import Pictures
from .request import Choice, Request

_PATIENCE = 2.0
"""How many seconds threads may take to end."""

Told = Callable[[str, str], None]
"""Is told of a change: the name of a file, and its new version."""


class Watched:
    """The files of a server that somebody looks at."""

    def __init__(self, request: Request, pictures: Pictures, told: Told) -> None:
        """``told`` is called from other threads."""
        self._request = request
        self._pictures = pictures
        self._told = told
        self.folder = Folder(request.file, request.search_path)
        self.is_seen = False
        """Whether any page is open, which asks for a document itself after each change."""
        self._lock = Lock()
        self._stop = Event()
        self._opened: dict[str, Documents] = {}
        self._threads: list[Thread] = []

    @property
    def versions(self) -> dict[str, str]:
        """The version of each file that was opened, by its name."""
        with self._lock:
            return {name: each.version for name, each in self._opened.items()}

    def begin(self) -> None:
        """Have the first document ready before a browser asks, and tell the terminal what is wrong
        with it."""
        self._start(lambda: self.document(Choice()))

    def document(self, choice: Choice) -> bytes | None:
        """The document of a choice; of the first file, if it names none that there is. ``None`` if
        there is nothing to show."""
        name = choice.file
        path = self.folder.path(name) if name else None
        if path is None:
            name = self.folder.first()
            path = self.folder.path(name) if name else None
        if name is None or path is None:
            return None
        with self._lock:
            found = self._opened.get(name)
            if found is None:
                request = self._request._replace(file=path)
                found = self._opened[name] = Documents(request, name, self._pictures)
                self._watch(name, request, found)
        return found.get(choice)

    def end(self) -> None:
        """End all threads."""
        self._stop.set()
        for thread in self._threads:
            thread.join(_PATIENCE)

    def _watch(self, name: str, request: Request, documents: Documents) -> None:
        """Begin to watch a file: no change is missed from now on."""
        changes = states(request.file, request.search_path, documents.others, self._stop)
        next(changes)

        def follow() -> None:
            for _ in changes:
                documents.forget()
                self._told(name, documents.version)
                if not self.is_seen:
                    documents.get(Choice())

        self._start(follow)

    def _start(self, act: Callable[[], object]) -> None:
        thread = Thread(target=act, daemon=True)
        self._threads.append(thread)
        thread.start()
