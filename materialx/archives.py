"""Documents in archives: ``chair.mtlx.zip`` has a document with its pictures, as tools hand it out.

An archive may come from anybody. It is unpacked into a folder of its own, which is gone afterwards,
and only if nothing in it leads out of that folder: so all that follows reads a document with files
beside it, as it does without an archive.
"""

from __future__ import annotations

import stat
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from io import FileIO
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import NamedTuple
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from ..targets.runner.files import regular
from .outline import DocumentError

ENDING = ".zip"
MOST_PLACES = 50_000
"""The most files of an archive, with the folders around each of them."""
LARGEST_LIST = 4 << 20
"""The most bytes that the list of an archive's files may take, which is read at once."""
LARGEST_UNPACKED = 4 << 30
"""The most bytes that all files of an archive may have together, once they are unpacked."""
_CHUNK = 1 << 20
_METHODS = (ZIP_STORED, ZIP_DEFLATED)
"""The ways of packing that are read: all others may need any amount of memory."""
_ENCRYPTED = 1
"""The bit of a file's flags that says so."""
_NOT_OURS = "__MACOSX"
"""The folder in which macOS keeps what other systems do not know of files."""


class Source(NamedTuple):
    """A document that can be read, and further folders in which its pictures may lie."""

    document: Path
    image_folders: tuple[Path, ...]


@contextmanager
def unpacked(path: Path, image_folders: tuple[Path, ...] = ()) -> Iterator[Source]:
    """The document in an archive, for as long as the ``with`` block runs; a file that is no
    archive by its name is the document itself.

    Raises ``DocumentError``, ``FileError``, and ``OSError`` if the file cannot be read.
    """
    if path.suffix.lower() != ENDING:
        yield Source(path, image_folders)
        return
    with TemporaryDirectory(prefix="burnish-") as name:
        folder = Path(name)
        document = _Archive(path, folder).document()
        yield Source(folder / document, (*image_folders, folder))


class _Archive:
    """An archive while it is unpacked to a folder."""

    def __init__(self, path: Path, folder: Path) -> None:
        self._path, self._folder = path, folder
        self._left = LARGEST_UNPACKED

    def document(self) -> PurePosixPath:
        """Unpack all files; gives the path of the document among them."""
        try:
            with (
                regular(self._path, str(self._path)) as file,
                _Bounded(file.fileno(), closefd=False) as bounded,
                ZipFile(bounded) as archive,
            ):
                files = [info for info in archive.infolist() if not info.is_dir()]
                self._look_through(files)
                document = self._chosen(files)
                for info in files:
                    self._unpack(archive, info)
        except (BadZipFile, zlib.error, EOFError, NotImplementedError) as error:
            raise self._error(f"this is no whole ZIP archive: {error}") from None
        return document

    def _look_through(self, files: list[ZipInfo]) -> None:
        """Refuse what is unsafe by the list of files, before any is unpacked."""
        # Each folder around a file takes place on the disk, too.
        if len(files) + sum(info.filename.count("/") for info in files) > MOST_PLACES:
            raise self._error(
                f"archives of more than {MOST_PLACES} files, with the folders around them, are not "
                "read"
            )
        names = set()
        for info in files:
            name = info.filename
            if not _is_inside(name):
                raise self._error(f"'{name}' is no path of a file within an archive")
            if stat.S_ISLNK(info.external_attr >> 16):
                raise self._error(f"'{name}' is a link, and links are not followed there")
            if info.flag_bits & _ENCRYPTED:
                raise self._error(f"'{name}' is encrypted")
            if info.compress_type not in _METHODS:
                raise self._error(f"'{name}' is packed in a way that is not read: use Deflate")
            if name in names:
                raise self._error(f"two files are called '{name}'")
            names.add(name)
        if sum(info.file_size for info in files) > LARGEST_UNPACKED:
            raise self._too_large()

    def _chosen(self, files: list[ZipInfo]) -> PurePosixPath:
        """The document: the only one that lies in as few folders as any, or that is called like the
        archive."""
        found = [path for info in files if _is_document(path := PurePosixPath(info.filename))]
        least = min((len(path.parts) for path in found), default=0)
        outer = [path for path in found if len(path.parts) == least]
        named = [path for path in outer if path.stem == self._path.stem.removesuffix(path.suffix)]
        if not outer:
            raise self._error("there is no file `.mtlx` in this archive")
        if len(outer) > 1 and len(named) != 1:
            names = ", ".join(f"'{path}'" for path in sorted(outer)[:4])
            more = f" and {len(outer) - 4} more" if len(outer) > 4 else ""
            raise self._error(
                f"this archive has several documents, {names}{more}: unpack it, and import them "
                "one by one"
            )
        return (named if len(named) == 1 else outer)[0]

    def _unpack(self, archive: ZipFile, info: ZipInfo) -> None:
        place = self._folder / info.filename
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            with archive.open(info) as packed, place.open("xb") as file:
                # What the list says of a file's size need not be true.
                while chunk := packed.read(_CHUNK):
                    self._left -= len(chunk)
                    if self._left < 0:
                        raise self._too_large()
                    file.write(chunk)
        except (FileExistsError, NotADirectoryError):
            raise self._error(f"'{info.filename}' is a file and a folder") from None
        except OSError as error:
            raise self._error(f"'{info.filename}' cannot be unpacked: {error.strerror}") from None

    def _too_large(self) -> DocumentError:
        return self._error(
            f"archives of more than {LARGEST_UNPACKED >> 30} GiB, unpacked, are not read"
        )

    def _error(self, text: str) -> DocumentError:
        return DocumentError(f"{self._path.name}:1: error: {text}")


class _Bounded(FileIO):
    """A file of which nobody can read very much at once."""

    def read(self, size: int | None = -1, /) -> bytes:
        """Read as every file does; the list of an archive may claim to be as long as the file."""
        if size is not None and size > LARGEST_LIST:
            raise BadZipFile("its list of files is too long")
        return super().read(LARGEST_LIST if size is None or size < 0 else size) or b""


def _is_inside(name: str) -> bool:
    """True for the name of a file that lies in the folder that the archive is unpacked to, on all
    systems."""
    parts = name.split("/")
    return "\\" not in name and ":" not in parts[0] and not {"", ".", ".."} & set(parts)


def _is_document(path: PurePosixPath) -> bool:
    is_hidden = path.name.startswith(".") or _NOT_OURS in path.parts
    return path.suffix.lower() == ".mtlx" and not is_hidden
