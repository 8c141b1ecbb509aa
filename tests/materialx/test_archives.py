"""Documents in archives are imported like those in folders, and unsafe archives are refused."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import gettempdir
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZipFile, ZipInfo

import pytest

from burnish.materialx import archives
from burnish.materialx.importing import imported
from burnish.materialx.outline import DocumentError
from burnish.targets.runner.files import FileError

from ..suite.processes import run
from .kit import DOCUMENTS, document

PICTURE = "images/tiles.png"
TEXT = document("image_plain").read_text("utf-8")
Files = Mapping[str, "str | bytes"]
PLAIN: Files = {"image_plain.mtlx": TEXT, PICTURE: (DOCUMENTS / PICTURE).read_bytes()}


@pytest.fixture(autouse=True)
def _own_temporary_folder(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is unpacked by others at the same time is not seen."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path_factory.mktemp("temporary")))


def archive(path: Path, files: Files) -> Path:
    """An archive with these files, whatever their names are."""
    with warnings.catch_warnings(), ZipFile(path, "w", ZIP_DEFLATED) as made:
        warnings.simplefilter("ignore")  # Two files of one name.
        for name, content in files.items():
            made.writestr(name, content)
    return path


def refused(path: Path) -> str:
    """Why an archive is not read; nothing of it stays."""
    with pytest.raises(DocumentError) as caught:
        imported(path)
    assert not list(Path(gettempdir()).iterdir())
    return str(caught.value).removeprefix(f"{path.name}:1: error: ")


@pytest.mark.parametrize("around", ["", "sticker/", "a/b/"])
def test_an_archive_is_imported_as_its_folder_would_be(around: str, tmp_path: Path) -> None:
    files = {f"{around}{name}": content for name, content in PLAIN.items()}
    files |= {"__MACOSX/._image_plain.mtlx": b"\0\5\26\7", f"{around}._x.mtlx": b"\0"}
    expected = imported(document("image_plain"))
    assert imported(archive(tmp_path / "sticker.mtlx.zip", files)) == expected
    assert expected.files["textures/tiles.png"] == PLAIN[PICTURE]


def test_pictures_lie_anywhere_in_the_archive(tmp_path: Path) -> None:
    """As in `materials/sticker.mtlx`, which reads `../images/tiles.png`."""
    text = TEXT.replace(PICTURE, f"../{PICTURE}")
    made = archive(tmp_path / "a.zip", {"materials/a.mtlx": text, PICTURE: PLAIN[PICTURE]})
    found = imported(made)
    assert found.files["textures/tiles.png"] == PLAIN[PICTURE]
    assert not found.problems


def test_what_a_document_includes_is_read_from_the_archive_only(tmp_path: Path) -> None:
    include = '<materialx version="1.39"><xi:include href="{}"/></materialx>'
    inside = {"a.mtlx": include.format("more/rest.mtlx"), "more/rest.mtlx": TEXT}
    assert [each.name for each in imported(archive(tmp_path / "a.zip", inside)).materials] == [
        "Sticker"
    ]
    (tmp_path / "secret.mtlx").write_text(TEXT)
    for href in ("../secret.mtlx", str(tmp_path / "secret.mtlx")):
        outside = archive(tmp_path / "b.zip", {"b.mtlx": include.format(href)})
        with pytest.raises(DocumentError, match="from outside of the document's folder"):
            imported(outside)


def test_of_several_documents_the_one_that_is_called_like_the_archive_is_read(
    tmp_path: Path,
) -> None:
    files = {**PLAIN, "b.mtlx": "no document"}
    assert imported(archive(tmp_path / "image_plain.mtlx.zip", files)).materials
    assert imported(archive(tmp_path / "image_plain.ZIP", files)).materials
    said = refused(archive(tmp_path / "c.zip", files))
    assert said == (
        "this archive has several documents, 'b.mtlx', 'image_plain.mtlx': unpack it, and import "
        "them one by one"
    )


NO_PATH = "'{}' is no path of a file within an archive"
UNSAFE: dict[str, tuple[Files, str]] = {
    **{
        name: ({**PLAIN, name: b"x"}, NO_PATH.format(name))
        for name in ("../up", "/etc/x", "a/../../x", "C:/x", "a\\..\\x", "a//x", "./x")
    },
    "no document": ({PICTURE: b"x"}, "there is no file `.mtlx` in this archive"),
    "nothing": ({}, "there is no file `.mtlx` in this archive"),
    "a folder": ({**PLAIN, "a": b"x", "a/b": b"x"}, "'a/b' is a file and a folder"),
    "a long name": (
        {**PLAIN, "x" * 300: b"x"}, f"'{'x' * 300}' cannot be unpacked: File name too long",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", UNSAFE)
def test_unsafe_names_are_refused(name: str, tmp_path: Path) -> None:
    files, expected = UNSAFE[name]
    assert refused(archive(tmp_path / "a.zip", files)) == expected


def link(made: ZipFile) -> None:
    info = ZipInfo("link.png")
    info.external_attr = 0o120777 << 16
    made.writestr(info, "/etc/passwd")


ODD: dict[str, tuple[Callable[[ZipFile], None], str]] = {
    "a link": (link, "'link.png' is a link, and links are not followed there"),
    "another packing": (
        lambda made: made.writestr("b.png", b"x" * 99, ZIP_BZIP2),
        "'b.png' is packed in a way that is not read: use Deflate",
    ),
    "twice": (
        lambda made: made.writestr("image_plain.mtlx", TEXT),
        "two files are called 'image_plain.mtlx'",
    ),
}


@pytest.mark.parametrize("name", ODD)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_odd_files_are_refused(name: str, tmp_path: Path) -> None:
    add, expected = ODD[name]
    path = archive(tmp_path / "a.zip", PLAIN)
    with ZipFile(path, "a") as made:
        add(made)
    assert refused(path) == expected


def patched(path: Path, signature: bytes, place: int, value: bytes) -> Path:
    """An archive in which some bytes of a record are others: of the last one with its signature."""
    data = bytearray(path.read_bytes())
    start = data.rindex(signature) + place
    data[start : start + len(value)] = value
    path.write_bytes(data)
    return path


def test_encrypted_and_damaged_archives_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    only: Files = {"a.mtlx": TEXT}
    encrypted = patched(archive(path, only), b"PK\1\2", 8, b"\1")
    assert refused(encrypted) == "'a.mtlx' is encrypted"
    broken = "this is no whole ZIP archive: "
    assert refused(patched(archive(path, only), b"PK\1\2", 16, b"0000")).startswith(broken)
    assert refused(patched(archive(path, only), b"PK\3\4", 45, b"~~~~~~~~")).startswith(broken)
    assert refused(patched(archive(path, only), b"PK\5\6", 12, b"\xff\xff\xff\x7f")).startswith(
        broken
    )
    path.write_bytes(archive(path, only).read_bytes()[:-30])
    assert refused(path) == f"{broken}File is not a zip file"
    path.write_text("hello")
    assert refused(path) == f"{broken}File is not a zip file"


def test_an_archive_that_grows_is_refused_before_the_disk_is_full(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(archives, "LARGEST_UNPACKED", 1 << 20)
    path = archive(tmp_path / "a.zip", {**PLAIN, "zeros.png": bytes(2 << 20)})
    assert path.stat().st_size < 10_000
    assert refused(path).endswith("unpacked, are not read")
    # The list says that the file is small.
    lying = patched(path, b"PK\1\2", 24, (1000).to_bytes(4, "little"))
    assert refused(lying).startswith("this is no whole ZIP archive: Bad CRC-32")


def test_archives_of_very_many_files_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    many: Files = {f"{place}": b"" for place in range(200)}
    path = archive(tmp_path / "a.zip", many)
    deep = archive(tmp_path / "b.zip", {**PLAIN, "/".join("x" * 101): b""})
    monkeypatch.setattr(archives, "MOST_PLACES", 100)
    for made in (path, deep):
        assert refused(made) == (
            "archives of more than 100 files, with the folders around them, are not read"
        )
    monkeypatch.setattr(archives, "LARGEST_LIST", 2000)
    assert refused(path).startswith("this is no whole ZIP archive: ")


@pytest.mark.parametrize("name", ["folder.mtlx", "folder.mtlx.zip"])
def test_a_folder_is_no_document(name: str, tmp_path: Path) -> None:
    (tmp_path / name).mkdir()
    with pytest.raises(FileError, match=r"it is not a file$"):
        imported(tmp_path / name)


IMPORTS = """
import sys
from pathlib import Path
from burnish.materialx.importing import imported
from burnish.targets.runner.files import FileError
for name in sys.argv[1:]:
    try:
        imported(Path(name))
    except FileError as error:
        print(error)
"""


def test_pipes_and_devices_are_refused_and_not_waited_for(tmp_path: Path) -> None:
    names = ["pipe.mtlx", "pipe.mtlx.zip"]
    for name in names:
        os.mkfifo(tmp_path / name)
    (tmp_path / "link.mtlx").symlink_to("pipe.mtlx")
    names += ["link.mtlx", "/dev/zero"]
    said = run([sys.executable, "-c", IMPORTS, *names], cwd=tmp_path)
    assert said.stdout.splitlines() == [f"cannot read {name}: it is not a file" for name in names]
