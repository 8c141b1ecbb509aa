"""Compiling the same again gives the same from the cache, and never what is no longer true."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from ..suite.package import copy_package
from ..suite.processes import Background
from .kit import PLAIN, tree
from .place import Place

IMPORTING = 'import "shades.burnish".{shade}\nmaterial Main { color = vec3(shade) }\n'
DOUBTFUL = "material Main { colour = vec3(1) }\n"
"""Compiles with a warning, as the slot is nearly called like an inherited one."""


def written(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in tree(folder)}


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("material Main { }", ()),
        (DOUBTFUL, ()),
        ("material Main { }", ("--single-file",)),
        ("material Main { alpha = sin(uv.x) // ü\n}", ("--line-directives", "--flip-y")),
        ("material Main { } material Other { }", ("--no-hoist",)),
    ],
)
def test_the_same_again(place: Place, text: str, options: tuple[str, ...]) -> None:
    place.write(main=text)
    how, *first = place.run(*options)
    files = written(place.folder / "out")
    shutil.rmtree(place.folder / "out")
    again, *second = place.run(*options)
    assert (how, again) == ("COMPILED", "KNOWN")
    assert first == second
    assert first[0] == 0
    assert written(place.folder / "out") == files


def test_the_same_again_on_standard_output(place: Place) -> None:
    place.write(main="/// ü → x\n" + DOUBTFUL)
    first, second = place.run(output="-"), place.run(output="-")
    assert (first.how, second.how) == ("COMPILED", "KNOWN")
    assert first[1:] == second[1:]
    assert "warning[B0210]" in second.errors
    assert tree(place.folder) == {"main.burnish"}


def test_the_same_again_in_processes_whose_terminal_shows_little(place: Place) -> None:
    place.write(main="material Main { colour = vec3(1) /* ü */ }\n")
    place.environment({"PYTHONIOENCODING": "ascii"})
    first, second = place.process(), place.process()
    assert (first.how, second.how) == ("COMPILED", "KNOWN")
    assert first[1:] == second[1:]


def test_errors_are_not_kept(place: Place) -> None:
    place.write(main="material Main { color = tnt }")
    first, second = place.run(), place.run()
    assert first == second
    assert first[:2] == ("COMPILED", 1)
    assert place.results() == []


def _touch(place: Place) -> None:
    os.utime(place.folder / "main.burnish")
    os.utime(place.folder / "shades.burnish", (0, 0))


def _restore(place: Place) -> None:
    place.write(shades="shade = 0.75\n")
    place.write(shades="shade = 0.25\n")


@pytest.mark.parametrize("change", [_touch, _restore], ids=["touched", "edited and restored"])
def test_what_makes_no_difference(place: Place, change: Callable[[Place], None]) -> None:
    place.write(main=IMPORTING, shades="shade = 0.25\n")
    place.run()
    change(place)
    assert place.run()[0] == "KNOWN"


def _edit_keeping_size_and_time(place: Place) -> None:
    path = place.folder / "main.burnish"
    status = path.stat()
    path.write_text(path.read_text().replace("vec3(shade)", "vec3(pi+0)"))
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def _edit_import(place: Place) -> None:
    place.write(shades="shade = 0.75\n")


def _remove_import(place: Place) -> None:
    (place.folder / "shades.burnish").unlink()


def _replace_import_by_folder(place: Place) -> None:
    (place.folder / "shades.burnish").unlink()
    (place.folder / "shades.burnish").mkdir()


def _link_import_elsewhere(place: Place) -> None:
    (place.folder / "other").mkdir()
    (place.folder / "other" / "shades.burnish").write_text("shade = 0.75\n")
    (place.folder / "shades.burnish").unlink()
    (place.folder / "shades.burnish").symlink_to("other/shades.burnish")


def _link_out(place: Place) -> None:
    """Moves the same text to a place where no import may lead."""
    shutil.move(place.folder / "shades.burnish", place.folder.parent / "shades.burnish")
    (place.folder / "shades.burnish").symlink_to("../shades.burnish")


@pytest.mark.parametrize(
    "change",
    [
        _edit_keeping_size_and_time,
        _edit_import,
        _remove_import,
        _replace_import_by_folder,
        _link_import_elsewhere,
        _link_out,
    ],
)
def test_what_makes_a_difference(place: Place, change: Callable[[Place], None]) -> None:
    place.write(main=IMPORTING, shades="shade = 0.25\n")
    place.run()
    assert place.run()[0] == "KNOWN"
    change(place)
    how, *found = place.run()
    assert how == "COMPILED"
    _, *expected = place.run("--no-cache")
    assert found == expected


def test_an_import_that_shadows_another(place: Place) -> None:
    (place.folder / "library").mkdir()
    (place.folder / "library" / "shades.burnish").write_text("shade = 0.25\n")
    place.write(main=IMPORTING)
    place.run("-I", "library")
    assert place.run("-I", "library")[0] == "KNOWN"
    before = place.fragment()
    place.write(shades="shade = 0.75\n")
    assert place.run("-I", "library")[0] == "COMPILED"
    assert place.fragment() != before


def test_a_folder_of_the_search_path_that_goes_away(place: Place) -> None:
    (place.folder / "empty").mkdir()
    place.write(main=PLAIN)
    place.run("-I", "empty")
    (place.folder / "empty").rmdir()
    how, code, _, errors = place.run("-I", "empty")
    assert (how, code) == ("COMPILED", 1)
    assert "B0013" in errors


@pytest.mark.parametrize("options", [("--flip-y",), ("--no-hoist",), ("-t", "hlsl"), ("--rig=R",)])
def test_other_options(place: Place, options: tuple[str, ...]) -> None:
    place.write(main="rig R { }\nmaterial Main { }")
    place.run()
    assert place.run(*options)[0] == "COMPILED"
    assert place.run()[0] == "KNOWN"


def test_another_folder(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    place.write(main="material Main { }")
    place.run()
    other = place.folder / "other"
    other.mkdir()
    (other / "main.burnish").write_text("material Main { alpha = 0.5 }")
    monkeypatch.chdir(other)
    assert place.run()[0] == "COMPILED"
    monkeypatch.chdir(place.folder)
    assert place.run()[0] == "KNOWN"


def test_a_file_by_way_of_a_link(place: Place) -> None:
    place.write(one="material Main { }", two="material Main { alpha = 0.5 }")
    link = place.folder / "main.burnish"
    link.symlink_to("one.burnish")
    place.run()
    assert place.run()[0] == "KNOWN"
    link.unlink()
    link.symlink_to("two.burnish")
    assert place.run()[0] == "COMPILED"


def test_another_compiler(place: Place, tmp_path: Path) -> None:
    """A checkout that is edited; a copy of this one."""
    copy = copy_package(tmp_path / "python" / "burnish")
    place.environment({"PYTHONPATH": str(copy.parent)})
    place.write(main="material Main { }")
    place.process()
    assert place.process().how == "KNOWN"
    edited = ("compiler/layout.py", "stdlib/mtlx/noise.burnish", "targets/wgsl/reserved.txt")
    for changed in edited:
        status = (copy / changed).stat()
        text = (copy / changed).read_text("utf-8")
        (copy / changed).write_text(text, "utf-8")
        os.utime(copy / changed, ns=(status.st_atime_ns, status.st_mtime_ns))
        assert place.process().how == "COMPILED", changed


def test_a_pipe_is_read_by_the_compile_alone(place: Place) -> None:
    pipe = place.folder / "main.burnish"
    os.mkfifo(pipe)
    for color in ("vec3(1)", "vec3(0)"):
        text = f"material Main {{ color = {color} }}\n"
        writing = Background(partial(pipe.write_text, text, "utf-8"))
        assert place.run().how == "COMPILED"
        writing.returned()


def test_switched_off(place: Place) -> None:
    place.write(main="material Main { }")
    assert [place.run("--no-cache")[0] for _ in range(2)] == ["COMPILED"] * 2
    assert place.results() == []


def test_what_cannot_be_written_as_before_is_told(place: Place) -> None:
    place.write(main="material Main { }")
    place.run()
    shutil.rmtree(place.folder / "out")
    (place.folder / "out").write_text("in the way")
    how, code, output, errors = place.run()
    assert (how, code, output) == ("COMPILED", 1, "")
    assert "B0009" in errors
    (place.folder / "out").unlink()
    (place.folder / "out" / "Main.json").mkdir(parents=True)
    before = tree(place.folder)
    how, code, output, errors = place.run()
    assert (how, code) == ("COMPILED", 1)
    assert tree(place.folder) == before
