"""Imports of many files, in circles, and of whatever else may lie where a file was expected."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.compiler import opening
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.syntax import load


def complaint(source: str | Path, folder: Path) -> str:
    """The only error of a file or text, with its place."""
    (found,) = burnish.check(source, search_path=[folder])
    return shown(found)


def shown(found: Diagnostic) -> str:
    place = "" if found.span is None else f"{Path(str(found.span)).name}: "
    return f"{place}{found.rule.code} {found.message}"


@pytest.mark.parametrize("style", ["one name", "whole", "quoted"])
def test_a_long_chain(style: str, tmp_path: Path) -> None:
    """Nothing recurses over the files that import each other."""
    count = 1100
    written = {
        "one name": "import m{i}.{{f{i}}}",
        "whole": "import m{i}",
        "quoted": 'import "m{i}.burnish".{{f{i}}}',
    }[style]
    for i in range(count):
        body = f"sin(f{i + 1}(x))" if i < count - 1 else "x"
        head = written.format(i=i + 1) if i < count - 1 else ""
        text = f"{head}\nfn f{i}(x: float) -> float = {body}\n"
        (tmp_path / f"m{i}.burnish").write_text(text, "utf-8")
    main = tmp_path / "main.burnish"
    main.write_text(f"{written.format(i=0)}\nmaterial M {{ alpha = f0(uv.x) }}", "utf-8")
    (material,) = burnish.compile(main, "wgsl")
    assert material.text("wgsl", "fragment").count("sin(") == count - 1


def test_a_chain_of_constants(tmp_path: Path) -> None:
    count = 1100
    for i in range(count):
        following = f"import m{i + 1}.{{c{i + 1}}}\nc{i} : float = c{i + 1} + 1.0"
        text = following if i < count - 1 else f"c{i} : float = 1.0"
        (tmp_path / f"m{i}.burnish").write_text(text, "utf-8")
    main = tmp_path / "main.burnish"
    main.write_text("import m0.{c0}\nmaterial M { alpha = uv.x * c0 }", "utf-8")
    (material,) = burnish.compile(main, "wgsl")
    assert "1100.0" in material.text("wgsl", "vertex")


def circle(folder: Path, names: list[str]) -> Path:
    """Files that import each other in a circle; the first of them."""
    for name, following in zip(names, [*names[1:], names[0]], strict=True):
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f'import "{following}"\nmaterial M {{ }}\n', "utf-8")
    return folder / names[0]


def test_a_circle(tmp_path: Path) -> None:
    main = circle(tmp_path, ["a.burnish", "b.burnish", "c.burnish"])
    assert complaint(main, tmp_path) == (
        "c.burnish:1:1: B0008 these files import each other: "
        "a.burnish → b.burnish → c.burnish → a.burnish"
    )


def test_a_circle_of_files_with_the_same_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    main = circle(Path(), ["x/m.burnish", "y/m.burnish"])
    assert complaint(main, Path()) == (
        "m.burnish:1:1: B0008 these files import each other: "
        "x/m.burnish → y/m.burnish → x/m.burnish"
    )


def test_a_large_circle_is_told_shortly(tmp_path: Path) -> None:
    main = circle(tmp_path, [f"m{i}.burnish" for i in range(1000)])
    assert complaint(main, tmp_path) == (
        "m999.burnish:1:1: B0008 these files import each other: "
        "m0.burnish → m1.burnish → m2.burnish → m3.burnish → 992 more → "
        "m996.burnish → m997.burnish → m998.burnish → m999.burnish → m0.burnish"
    )


@pytest.fixture
def odd(tmp_path: Path) -> Iterator[Path]:
    """A folder with things that are no files of text."""
    folder = tmp_path / "odd"
    folder.mkdir()
    (folder / "loop").symlink_to("loop")
    (folder / "folder").mkdir()
    os.mkfifo(folder / "pipe")
    (folder / "latin").write_bytes("// größe".encode("latin-1"))
    with (folder / "large").open("wb") as large:
        large.truncate(1 << 30)
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(os.path.relpath(folder / "socket"))
        yield folder


ODD = {
    "a" * 300: f"B0003 `{'a' * 300}` cannot be read: File name too long",
    "/".join(["d" * 200] * 30): (
        f"B0003 `{'/'.join(['d' * 200] * 30)}` cannot be read: File name too long"
    ),
    "a\0b": "B0003 `a\0b` cannot be read: no file has a name like this",
    "loop": "B0003 `loop` cannot be read: Too many levels of symbolic links",
    "loop/x": "B0003 `loop/x` cannot be read: Too many levels of symbolic links",
    "folder": "B0002 `{folder}/folder` is a folder, not a file",
    "pipe": "B0003 `{folder}/pipe` cannot be read: it is a pipe or a device",
    "socket": "B0003 `{folder}/socket` cannot be read: it is a pipe or a device",
    "latin": "B0004 `{folder}/latin` is not UTF-8 text: byte 5 is 0xf6",
    "large": "B0005 `{folder}/large` is larger than 1048576 bytes",
    "": "B0002 `{folder}` is a folder, not a file",
}


@pytest.mark.parametrize(("name", "expected"), ODD.items(), ids=[name[:9] for name in ODD])
def test_an_import_of_something_else(name: str, expected: str, odd: Path) -> None:
    text = f'import "{name}".{{x}}\nmaterial M {{ alpha = x(uv.x) }}\n'
    assert complaint(text, odd) == f"<text>:1:1: {expected.format(folder=odd)}"


def test_files_are_only_so_large_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error is reported once, and no further file is read."""
    monkeypatch.setattr(opening, "TOTAL_LIMIT", 1000)
    for name in "abc":
        (tmp_path / f"{name}.burnish").write_text(f"{name} = 1.0 //{'x' * 600}\n", "utf-8")
    imports = "".join(f'import "{name}.burnish".{{{name}}}\n' for name in "abc")
    assert complaint(f"{imports}material M {{ alpha = a + b + c }}\n", tmp_path) == (
        f"<text>:2:1: B0014 with `{tmp_path}/b.burnish`, the imported files are larger than 1000 "
        "characters"
    )


def test_a_text_is_only_so_large(tmp_path: Path) -> None:
    text = f"material M {{ }}\n//{'x' * load.SIZE_LIMIT}"
    assert complaint(text, tmp_path) == "B0005 `<text>` is larger than 1048576 characters"


def test_an_import_that_nobody_may_read(odd: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Root may read everything, so the system's answer is made up."""
    stat = Path.stat

    def refused(path: Path, **options: bool) -> os.stat_result:
        if path.name == "a.burnish":
            raise PermissionError(13, "Permission denied")
        return stat(path, **options)

    monkeypatch.setattr(Path, "stat", refused)
    assert complaint("import folder.a\nmaterial M { }\n", odd) == (
        "<text>:1:1: B0003 `folder/a.burnish` cannot be read: Permission denied"
    )


@pytest.mark.parametrize("name", ["a" * 300, "a\0b", "a\ud800", "loop", "loop/x", "pipe"])
def test_a_search_path_of_something_else(name: str, odd: Path) -> None:
    (odd / "main.burnish").write_text("material M { }", "utf-8")
    (found,) = burnish.check(odd / "main.burnish", search_path=[odd / name])
    assert found.rule.code == "B0013"


FILES = {
    "a" * 300: "File name too long",
    "a\0b": "no file has a name like this",
    "a\ud800": "no file has a name like this",
    "loop": "Too many levels of symbolic links",
    "socket": "No such device or address",
    "pipe": "nothing has come out of it for 0 seconds",
}


@pytest.mark.parametrize(("name", "reason"), FILES.items(), ids=lambda text: ascii(text)[:9])
def test_a_file_of_another_kind(
    name: str, reason: str, odd: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(load, "PATIENCE", 0)
    (found,) = burnish.check(odd / name)
    assert shown(found).startswith("B0003 `")
    assert found.message.endswith(f"` cannot be read: {reason}")
    found.message.encode()


def test_a_text_with_a_lone_surrogate() -> None:
    (found,) = burnish.check("// \udce9\nmaterial M { }\n")
    assert shown(found) == (
        "B0004 `<text>` is not UTF-8 text: character 3 is the lone surrogate U+DCE9"
    )


@pytest.mark.parametrize(
    "written, meant",
    [
        ('import "C.burnish"', '`"c.burnish"`'),
        ('import "sub/ddd.burnish"', '`"sub/dd.burnish"`'),
        ("import C", "`c`"),
        ("import sub.DD", "`sub.dd`"),
        ("import lights", "`std.lights`"),
    ],
)
def test_an_import_that_is_nearly_right(written: str, meant: str, tmp_path: Path) -> None:
    """The files beside are looked at, and those of the library."""
    (tmp_path / "sub").mkdir()
    (tmp_path / "c.burnish").write_text("fn c(x: float) = x", "utf-8")
    (tmp_path / "sub" / "dd.burnish").write_text("fn d(x: float) = x", "utf-8")
    main = tmp_path / "main.burnish"
    main.write_text(f"{written}\nmaterial M {{ color = #fff }}", "utf-8")
    (found,) = burnish.check(main, search_path=[tmp_path])
    assert found.hint == f"did you mean {meant}?"
    assert found.fixes


def test_an_import_may_leave_a_folder_that_it_enters(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "c.burnish").write_text("fn c(x: float) = x", "utf-8")
    main = tmp_path / "main.burnish"
    main.write_text(
        'import "sub/../c.burnish"\nimport "c.burnish"\nmaterial M { alpha = c(0.5) }', "utf-8"
    )
    assert burnish.check(main) == ()
    main.write_text('import "sub/../../c.burnish"\nmaterial M { color = #fff }', "utf-8")
    assert complaint(main, tmp_path).endswith(
        "B0007 `sub/../../c.burnish` leads out of the search path"
    )
