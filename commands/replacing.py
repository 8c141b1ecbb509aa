"""Replaces a set of files in a folder: all of them, or none if anything goes wrong.

``output.py`` and ``results.py`` write everything with it that a command leaves in a folder. Such a
folder may have come from anywhere, and may hold links and files of any name. So nothing that lies
in it is believed, followed or deleted, and there is no record in it of what earlier processes did:

1. A file that has the wanted content already is left as it is, with its date: build systems run
   again what depends on a file that is newer than before.
2. Each other new file is written under a random name, such as ``.burnish-5f1c…``, which nobody else
   can have made.
3. Once all of them are complete, each old file gets a second name of that kind, and the new file is
   renamed over it. That takes microseconds. Processes that do this in the same folder take turns.
4. If anything goes wrong on the way, the old files get their names back.
5. The random names are deleted, each by itself.

The folder is opened once, and everything happens relative to its descriptor, so nobody can lead
Burnish elsewhere by changing the folder's path meanwhile. A process that is killed takes nothing
back, and leaves its random names. No later process can tell whose they are, so they stay.

Python has neither descriptors of folders nor locks for them on Windows: there, paths are used, and
processes do not take turns.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from os.path import basename, join
from stat import S_ISDIR, S_ISREG

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Self

    from .ownership import Ownership


PATIENCE = 10.0
"""The seconds to wait for another process, which needs far less to rename its files."""
TEMPORARY = ".burnish-"
"""The beginning of random names."""
LARGEST = 64 << 20
"""The bytes of a file that a guard sees: more than any output has."""

_ANCHORED = os.open in os.supports_dir_fd
"""True if names can be relative to an open folder, as everywhere but on Windows."""


class ForeignFileError(FileExistsError):
    """A file that must not be replaced has the name of a new one."""


def replace_all(folder: str, contents: Mapping[str, bytes], guard: Ownership | None = None) -> None:
    """Write each content under its name into a folder, or raise ``OSError`` and change nothing.

    The folder is made if need be. A link that has one of the names is replaced, not followed. The
    error's ``filename`` is the path that could not be written: the folder, or a file in it. It is a
    ``ForeignFileError`` where the ``guard`` objects to replacing a file; it settles at the end.
    """
    replace_tree(folder, {(name,): content for name, content in contents.items()}, guard)


def replace_tree(
    folder: str, contents: Mapping[tuple[str, ...], bytes], guard: Ownership | None = None
) -> None:
    """Do the same for a folder with folders in it: each content has the names on the way to it.

    Folders are made if need be, and taken away again if anything goes wrong. Links to folders are
    not followed.
    """
    for names in contents:
        with _told(join(folder, *names)):
            for name in names:
                _insist_on_name(name)
    with _told(folder):
        os.makedirs(folder, exist_ok=True)
        tree = _Tree(_Folder(folder))
    with ExitStack() as used:
        used.enter_context(tree)
        files = []
        for (*way, name), content in contents.items():
            place = tree.folder(tuple(way))
            with _told(join(place.path, name)):
                file = _File(place, name, content, guard)
                used.callback(file.clear)
                file.prepare()
            files.append(file)
        with _told(folder):
            tree.root.lock()
        _put_in_place(files)
        tree.keep()
        if guard is not None:
            guard.settle({"/".join(names): content for names, content in contents.items()})


def _insist_on_name(name: str) -> None:
    """Raise ``OSError`` unless this can be the name of a file in the folder itself.

    Some names come from compiled or shown files, and none of those may lead elsewhere.
    """
    separators = "/\0" if _ANCHORED else "/\0\\:"
    if name in ("", ".", "..") or any(separator in name for separator in separators):
        raise OSError(errno.EINVAL, "it is no name of a file")
    try:
        os.fsencode(name)
    except UnicodeEncodeError:
        reason = "names of files cannot have all of its characters here"
        raise OSError(errno.EILSEQ, reason) from None


class _Folder:
    """An open folder. Names are those of files directly in it, and no link is followed."""

    def __init__(self, path: str, outer: _Folder | None = None) -> None:
        """``outer`` is an open folder that contains this one, whose name must be no link."""
        self.path = path
        self._descriptor = None
        if not _ANCHORED:
            if outer is not None and (os.path.islink(path) or not os.path.isdir(path)):
                raise NotADirectoryError(errno.ENOTDIR, "it is no folder")
        elif outer is None:
            self._descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
        else:
            flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW
            self._descriptor = os.open(basename(path), flags, dir_fd=outer._descriptor)

    def make(self, name: str) -> bool:
        """Make a folder in this one; false if there is something of this name."""
        try:
            os.mkdir(self._at(name), dir_fd=self._descriptor)
        except FileExistsError:
            return False
        return True

    def unmake(self, name: str) -> None:
        """Take an empty folder away."""
        os.rmdir(self._at(name), dir_fd=self._descriptor)

    def close(self) -> None:
        """Close the folder, which unlocks it as well."""
        if self._descriptor is not None:
            os.close(self._descriptor)

    def content(self, name: str, most: int) -> bytes | None:
        """Up to so many bytes of a file that is no link; ``None`` if it cannot be read."""
        flags = os.O_RDONLY | getattr(os, "O_BINARY", 0)
        careful = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
        try:
            descriptor = os.open(self._at(name), flags | careful, dir_fd=self._descriptor)
            with open(descriptor, "rb") as file:
                return file.read(most) if S_ISREG(os.fstat(descriptor).st_mode) else None
        except OSError:
            return None

    def create(self, name: str) -> int:
        """The descriptor of a new file, to write to it; nothing else may have the name."""
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        return os.open(self._at(name), flags, 0o666, dir_fd=self._descriptor)

    def status(self, name: str) -> os.stat_result | None:
        """The status of a file, or of a link itself; ``None`` if there is none."""
        try:
            return os.stat(self._at(name), dir_fd=self._descriptor, follow_symlinks=False)
        except FileNotFoundError:
            return None

    def rename(self, name: str, new: str) -> None:
        """Give a file another name, in place of whichever file has it."""
        folder = self._descriptor
        os.replace(self._at(name), self._at(new), src_dir_fd=folder, dst_dir_fd=folder)

    def link(self, name: str, second: str) -> None:
        """Give a file, or a link itself, a second name."""
        folder, names = self._descriptor, (self._at(name), self._at(second))
        os.link(*names, src_dir_fd=folder, dst_dir_fd=folder, follow_symlinks=False)

    def delete(self, name: str) -> None:
        """Delete a file, or a link itself; never a folder."""
        os.unlink(self._at(name), dir_fd=self._descriptor)

    def lock(self) -> None:
        """Keep other processes from renaming files here; wait for one that is doing so."""
        give_up = time.monotonic() + PATIENCE
        while self._descriptor is not None and not lock_folder(self._descriptor):
            if time.monotonic() > give_up:
                waited = f"another process has held this folder for {PATIENCE:g} seconds"
                raise TimeoutError(errno.ETIMEDOUT, waited)
            time.sleep(0.005)

    def _at(self, name: str) -> str:
        """The name for a system call, besides the folder's descriptor if there is one."""
        return join(self.path, name) if self._descriptor is None else name


class _Tree:
    """A context manager for an open folder and those in it, which closes all of them.

    It takes the folders away that were made in vain.
    """

    def __init__(self, root: _Folder) -> None:
        self.root = root
        self._inner: dict[tuple[str, ...], _Folder] = {(): root}
        self._made: list[tuple[_Folder, str]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for outer, name in reversed(self._made):
            with suppress(OSError):
                outer.unmake(name)
        for place in self._inner.values():
            place.close()

    def folder(self, way: tuple[str, ...]) -> _Folder:
        """The folder to which these names lead. Each is made if need be."""
        for end, name in enumerate(way, 1):
            if way[:end] in self._inner:
                continue
            outer = self._inner[way[: end - 1]]
            path = join(outer.path, name)
            with _told(path):
                if outer.make(name):
                    self._made.append((outer, name))
                self._inner[way[:end]] = _Folder(path, outer)
        return self._inner[way]

    def keep(self) -> None:
        """Let the folders stay that were made."""
        self._made.clear()


class _File:
    """A file on its way into a folder.

    Until its name stands for the new content, this has a random name; from then on the old file
    has another one. If the old file has the new content already, neither happens.
    """

    def __init__(self, folder: _Folder, name: str, content: bytes, guard: Ownership | None) -> None:
        self.name = name
        self.path = join(folder.path, name)
        self._folder = folder
        self._content = content
        self._guard = guard
        self._new, self._old = (f"{TEMPORARY}{os.urandom(16).hex()}" for _ in range(2))
        self._seen: os.stat_result | None = None
        """The status of the old file when it was looked at."""
        self._stays = False
        """True if the old file has the new content."""
        self._is_made = False
        """True once the random names are this file's own."""
        self._is_begun = False
        """True once the name may stand for the new file."""

    def prepare(self) -> None:
        """Write the new content under its random name, unless the old file has it already.

        Raises ``OSError`` if a folder or a file of somebody else has the name.
        """
        self._seen = self._folder.status(self.name)
        self._stays = self._seen is not None and self._is_same(self._seen)
        if self._stays:
            return
        self._heed(self._seen)
        if self._is_made:
            return
        descriptor = self._folder.create(self._new)
        self._is_made = True
        with open(descriptor, "wb") as file:
            file.write(self._content)

    def put_in_place(self) -> None:
        """Let the name refer to the new content."""
        if not _is_untouched(self._seen, self._folder.status(self.name)):
            self.prepare()  # Another process has been here since.
        if self._stays:
            return
        self._is_begun = True
        with suppress(FileNotFoundError):
            self._set_aside()
        self._folder.rename(self._new, self.name)

    def take_back(self) -> None:
        """Let the name refer to the old content again, however far ``put_in_place`` came."""
        if not self._is_begun:
            return
        if self._folder.status(self._old) is not None:
            self._folder.rename(self._old, self.name)
        elif self._folder.status(self._new) is None:
            self._folder.delete(self.name)

    def clear(self) -> None:
        """Delete the files that still have a random name."""
        for name in (self._new, self._old) if self._is_made else ():
            with suppress(OSError):
                self._folder.delete(name)

    def _heed(self, status: os.stat_result | None) -> None:
        """Raise ``OSError`` if what has the name must not be replaced."""
        if status is not None and S_ISDIR(status.st_mode):
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        if status is None or self._guard is None or not S_ISREG(status.st_mode):
            return
        content = self._folder.content(self.name, LARGEST) or b""
        objection = self._guard.objection(self.name, content)
        if objection is not None:
            raise ForeignFileError(errno.EEXIST, objection)

    def _is_same(self, status: os.stat_result) -> bool:
        """True if a file may stay: an own one with the new content, and with this name only.

        What another user owns, or what has a second name elsewhere, might change at any time.
        """
        own = not hasattr(os, "geteuid") or status.st_uid == os.geteuid()
        if not own or status.st_nlink > 1 or not S_ISREG(status.st_mode):
            return False
        size = len(self._content)
        if status.st_size != size:
            return False
        return self._folder.content(self.name, size + 1) == self._content

    def standing(self) -> tuple[int, int] | None:
        """The device and number of the file that has this name; ``None`` if they are unknown."""
        status = self._folder.status(self.name)
        return (status.st_dev, status.st_ino) if status is not None and status.st_ino else None

    def _set_aside(self) -> None:
        """Give the old file its random name: as a second one, so that readers always find it.

        On systems where files cannot have two names, the file is renamed, and missing for a moment.
        """
        try:
            self._folder.link(self.name, self._old)
        except FileNotFoundError:
            raise
        except (OSError, NotImplementedError):
            self._folder.rename(self.name, self._old)


def _put_in_place(files: Sequence[_File]) -> None:
    """Let all names refer to the new contents; if that fails, undo it."""
    begun: list[_File] = []
    placed: dict[tuple[int, int], str] = {}
    try:
        for file in files:
            with _told(file.path):
                if (old := file.standing()) in placed:
                    raise FileExistsError(errno.EEXIST, f"here `{placed[old]}` is the same name")
                begun.append(file)
                file.put_in_place()
                if new := file.standing():
                    placed[new] = file.name
    except BaseException:
        for file in reversed(begun):
            with suppress(OSError):
                file.take_back()
        raise


def _is_untouched(before: os.stat_result | None, now: os.stat_result | None) -> bool:
    """True if a name stands for the same file as before, which nobody has written to since."""
    if before is None or now is None:
        return before is now
    return all(
        getattr(before, field) == getattr(now, field)
        for field in ("st_dev", "st_ino", "st_size", "st_mtime_ns", "st_ctime_ns")
    )


@contextmanager
def _told(path: str) -> Iterator[None]:
    """Let errors name the path that people know, not the one of the system call."""
    try:
        yield
    except ForeignFileError as error:
        raise ForeignFileError(error.errno, error.strerror, path) from error
    except OSError as error:
        raise OSError(error.errno, error.strerror, path) from error


def lock_folder(folder: int) -> bool:
    """Lock an open folder for this process, unless another one has locked it.

    Some file systems cannot lock folders, for example those of a network. There, processes should
    not write at the same time.
    """
    from fcntl import LOCK_EX, LOCK_NB, flock

    try:
        flock(folder, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True
