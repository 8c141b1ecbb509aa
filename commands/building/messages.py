"""Messages of Bazel's Remote Execution API, as bytes, whose digests name actions and inputs.

``document.py`` calls this. The API (``build.bazel.remote.execution.v2``) says what is in a message,
and Protocol Buffers in which bytes; a text or a number of 0 is left out. Digests have to stay the
same, and the package of Protocol Buffers promises no bytes, so the few fields are written here. A
test holds them against that package.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ...compiler.documents.actions import ContentDigest, NamedText
from ...support.frozen import frozen
from .actions import BuildError, digest_of

_LENGTH_DELIMITED = 2
_VARINT = 0


@frozen
class Messages:
    """The messages of one action."""

    action: bytes
    command: bytes
    directories: tuple[bytes, ...]
    """The folder in which the command runs, and those in it, each only once; the former is last."""


def messages_of(
    arguments: Sequence[str],
    environment: Iterable[NamedText],
    platform: Iterable[NamedText],
    outputs: Iterable[str],
    inputs: Mapping[str, ContentDigest],
    folders: Iterable[str],
) -> Messages:
    """The messages of a command. Raises ``BuildError`` for an input outside of the folder."""
    named = [_named(each) for each in sorted(platform, key=lambda each: each.name)]
    properties = b"".join(_bytes(1, each) for each in named)
    command = b"".join((
        *(_text(1, each) for each in arguments),
        *(_bytes(2, _named(each)) for each in sorted(environment, key=lambda each: each.name)),
        _bytes(5, properties),
        *(_text(7, each) for each in sorted(outputs)),
    ))  # fmt: skip
    directories = _directories(inputs, folders)
    action = b"".join((
        _bytes(1, _digest(digest_of(command))),
        _bytes(2, _digest(digest_of(directories[-1]))),
        _bytes(10, properties),
    ))  # fmt: skip
    return Messages(action, command, tuple(dict.fromkeys(directories)))


def _directories(inputs: Mapping[str, ContentDigest], folders: Iterable[str]) -> list[bytes]:
    """The messages of all folders that a command sees, each behind those in it."""
    files: dict[tuple[str, ...], dict[str, ContentDigest]] = {(): {}}
    inner: dict[tuple[str, ...], set[str]] = {(): set()}

    def enter(way: tuple[str, ...]) -> None:
        for end in range(1, len(way) + 1):
            files.setdefault(way[:end], {})
            inner.setdefault(way[:end], set())
            inner[way[: end - 1]].add(way[end - 1])

    for path, digest in inputs.items():
        *above, name = _parts(path)
        enter(tuple(above))
        files[tuple(above)][name] = digest
    for folder in folders:
        enter(_parts(folder))
    found: list[bytes] = []
    digests: dict[tuple[str, ...], ContentDigest] = {}
    for way in sorted(files, key=lambda way: (-len(way), way)):
        message = b"".join((
            *(_bytes(1, _file(name, files[way][name])) for name in sorted(files[way])),
            *(_bytes(2, _file(name, digests[*way, name])) for name in sorted(inner[way])),
        ))  # fmt: skip
        digests[way] = digest_of(message)
        found.append(message)
    return found


def _parts(path: str) -> tuple[str, ...]:
    """The names on the way to a file or a folder. Raises ``BuildError`` if it leads elsewhere."""
    parts = tuple(part for part in path.split("/") if part != ".")
    if path.startswith("/") or ".." in parts:
        raise BuildError(
            f"`{path}` lies outside of this folder, and other machines get only what is in it: run "
            "`burnish build` in a folder that has all of its files"
        )
    return parts


def _file(name: str, digest: ContentDigest) -> bytes:
    """A file or a folder in another folder: both messages have the same fields."""
    return _text(1, name) + _bytes(2, _digest(digest))


def _digest(digest: ContentDigest) -> bytes:
    size = _varint(2 << 3 | _VARINT) + _varint(digest.size_bytes) if digest.size_bytes else b""
    return _text(1, digest.hash) + size


def _named(pair: NamedText) -> bytes:
    return _text(1, pair.name) + _text(2, pair.value)


def _text(number: int, text: str) -> bytes:
    """A field that is a text; an empty one is left out. Raises ``BuildError`` for odd names."""
    try:
        content = text.encode()
    except UnicodeEncodeError:
        shown = text.encode("utf-8", "backslashreplace").decode()
        raise BuildError(
            f"`{shown}` is no Unicode, and so no name that other machines can be told"
        ) from None
    return _bytes(number, content) if content else b""


def _bytes(number: int, content: bytes) -> bytes:
    """A field that is a message or an element of a list, which are never left out."""
    return _varint(number << 3 | _LENGTH_DELIMITED) + _varint(len(content)) + content


def _varint(number: int) -> bytes:
    """A number as bytes of 7 bits, the lowest first; all but the last have an eighth bit."""
    found = bytearray()
    while number > 0x7F:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    found.append(number)
    return bytes(found)
