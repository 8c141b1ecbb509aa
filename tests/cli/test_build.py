"""``burnish build``: those compiles are run that are out of date, each into its own folder."""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path

import pytest

from burnish.commands.building import locking
from burnish.compiler.watching import VARIABLE

from .build_kit import FILES, LINE, TONES, write_project
from .kit import invoke, tree

WRONG = "material Wrong { color = nothing }\n"


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with imports, a file of several rigs, and one that is only for importing."""
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "project"
    write_project(folder)
    monkeypatch.chdir(folder)
    return folder


def built(*arguments: object, code: int = 0) -> list[str]:
    """The lines that a build prints."""
    done = invoke("build", *arguments, *LINE)
    assert (done.exit_code, done.stderr if code == 0 else "") == (code, "")
    return done.stdout.splitlines()


def refused(*arguments: object) -> str:
    """What a build says that does nothing."""
    before = tree(Path.cwd())
    done = invoke("build", *arguments, "-t", "wgsl")
    assert done.exit_code in (1, 2) and not done.stdout
    assert tree(Path.cwd()) == before
    return done.stderr.splitlines()[-1]


def test_only_what_is_out_of_date_is_run() -> None:
    assert built(".") == [
        "materials/a: 3 files in build/materials/a",
        "materials/b: 3 files in build/materials/b",
        "materials/c: 3 files in build/materials/c",
        "materials/metal/r/Day: 3 files in build/materials/metal/r/Day",
        "materials/metal/r/Night: 3 files in build/materials/metal/r/Night",
        "5 actions run, 0 up to date",
    ]
    assert built(".") == ["0 actions run, 5 up to date"]
    Path(TONES).write_text(FILES[TONES].replace("0.5", "0.7"))
    assert [line.partition(":")[0] for line in built(".")] == [
        "materials/a", "materials/b", "2 actions run, 3 up to date",
    ]  # fmt: skip
    Path("build/materials/c/C.frag.wgsl").unlink()
    Path("build/materials/b/B.json").write_text("{}")
    assert [line.partition(":")[0] for line in built(".", "--force")] == [
        *(f"materials/{name}" for name in ("a", "b", "c", "metal/r/Day", "metal/r/Night")),
        "5 actions run, 0 up to date",
    ], "other options, other actions"
    Path("build/materials/c/C.frag.wgsl").unlink()
    assert built(".", "--force")[-1] == "1 action run, 4 up to date"


def test_what_is_built_is_what_compile_writes() -> None:
    built("materials/c.burnish", "-o", "out")
    assert invoke("compile", "materials/c.burnish", "-t", "wgsl", "-o", "one").exit_code == 0
    for path in Path("one").iterdir():
        assert path.read_bytes() == Path("out/materials/c", path.name).read_bytes()
    assert len(tree(Path("one"))) == len(tree(Path("out/materials/c"))) == 3


def test_an_error_keeps_no_other_file_from_being_built() -> None:
    built(".")
    before = Path("build/materials/a/A.frag.wgsl").read_bytes()
    Path("materials/a.burnish").write_text(WRONG)
    Path("materials/c.burnish").write_text(FILES["materials/c.burnish"].replace("0.2", "0.3"))
    done = invoke("build", ".", *LINE)
    assert (done.exit_code, done.stdout.splitlines()) == (
        1,
        ["materials/c: 3 files in build/materials/c", "1 action run, 3 up to date, 1 failed"],
    )
    assert "unknown name `nothing`" in done.stderr
    assert done.stderr.endswith(
        "note: the outputs of what failed are as they were: `materials/a`\n"
    )
    assert Path("build/materials/a/A.frag.wgsl").read_bytes() == before
    assert built("materials/c.burnish")[-1] == "0 actions run, 1 up to date"


@pytest.mark.parametrize("text", ["material {", 'import "none.burnish".{x}', "\0"])
def test_a_file_that_cannot_be_read_keeps_no_other_from_being_built(text: str) -> None:
    Path("materials/a.burnish").write_text(text)
    done = invoke("build", "materials/a.burnish", "none.burnish", "materials/c.burnish", *LINE)
    assert done.stdout.splitlines() == [
        "materials/c: 3 files in build/materials/c", "1 action run, 0 up to date, 2 failed",
    ]  # fmt: skip
    assert "materials/a.burnish" in done.stderr
    assert "error[B0001]: there is no file `none.burnish`" in done.stderr
    for option in ("--ninja", "--actions"):
        done = invoke("build", "materials", "none.burnish", *LINE, option)
        assert (done.exit_code, done.stdout) == (1, "")
        assert "error[B0001]: there is no file `none.burnish`" in done.stderr
    assert not Path("build.ninja").exists()


def test_warnings_are_told_until_they_are_heeded() -> None:
    for _ in range(2):
        done = invoke("build", "materials/c.burnish", "-t", "wgsl", "--line-directives")
        assert (done.exit_code, "warning[B0450]" in done.stderr) == (0, True)
        assert done.stdout.endswith("1 action run, 0 up to date\n")


def test_variants_have_folders_and_options_of_their_own() -> None:
    Path("materials/c.burnish").write_text(
        "material C { param gain : float in 0..1 = 1  color = vec3(gain) }\n"
    )
    found = built(
        "materials/c.burnish", "--variant", "none: --set gain=0", "--variant", "text:--single-file"
    )
    assert found == [
        "none/materials/c: 3 files in build/none/materials/c",
        "text/materials/c: 2 files in build/text/materials/c",
        "2 actions run, 0 up to date",
    ]
    assert "gain" not in Path("build/none/materials/c/C.frag.wgsl").read_text()
    assert "gain" in Path("build/text/materials/c/C.wgsl").read_text()


def test_folders_are_searched_but_for_hidden_ones_and_outputs() -> None:
    for name in (".hidden/h.burnish", "build/o.burnish", "materials/.h.burnish"):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).write_text(WRONG)
    assert built(".")[-1] == "5 actions run, 0 up to date"
    assert built("materials", "./materials/a.burnish")[-1] == "0 actions run, 5 up to date"
    assert (
        refused("shared") == "error: no file in `shared` declares a material, a kernel or a frame"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["../outside.burnish"],
            "error: `../outside.burnish` lies outside of this folder, from which the paths of "
            "outputs are counted: run `burnish build` in a folder that has all of its files",
        ),
        (
            ["materials/c.burnish", "-o", "shared/tones.burnish"],
            "error[B0009]: cannot write to `shared/tones.burnish`: `shared/tones.burnish` is a "
            "file, not a folder",
        ),
        (
            ["materials/c.burnish", "-o", "/proc/burnish"],
            "error[B0009]: cannot write to `/proc/burnish`: ",
        ),
        (
            ["materials/c.burnish", "-o", "-"],
            "Error: a build writes many files: -o names the folder for them",
        ),
        (
            ["materials/c.burnish", "--ninja", "--actions"],
            "Error: --ninja and --actions write different documents: choose one",
        ),
        (
            ["materials/c.burnish", "--part", "--actions"],
            "Error: --part compiles, and --ninja and --actions do not: choose one",
        ),
        (
            ["materials/c.burnish", "--to", "x"],
            "Error: --to names the file for --ninja or --actions: give one of them",
        ),
        (
            ["materials/c.burnish", "--variant", "a/b: --hoist"],
            "Error: Invalid value for --variant: 'a/b: --hoist' is not NAME:OPTIONS, such as "
            "'night: --rig Night'",
        ),
        (
            ["materials/c.burnish", "--variant", "a:", "--variant", "A:"],
            "Error: Invalid value for --variant: there are two called 'A'",
        ),
        (
            ["materials/c.burnish", "--variant", "a: --watch"],
            "Error: Invalid value for --variant: 'a': No such option '--watch'.",
        ),
        (
            ["materials/c.burnish", "--variant", "a: 'b"],
            "Error: Invalid value for --variant: 'a': No closing quotation",
        ),
        (
            ["materials/c.burnish", "--ninja", "--program", ""],
            "Error: Invalid value for --program: it has no word",
        ),
    ],
)
def test_what_cannot_be_built_is_told(arguments: list[str], message: str) -> None:
    Path("../outside.burnish").write_text(FILES["materials/c.burnish"])
    before = tree(Path.cwd())
    done = invoke("build", *arguments, "-t", "wgsl")
    assert done.exit_code in (1, 2) and not done.stdout
    assert message in done.stderr
    assert tree(Path.cwd()) == before


def test_two_files_that_write_into_one_folder_are_told() -> None:
    Path("materials/C.burnish").write_text("material Other { color = vec3(1) }\n")
    assert refused("materials/c.burnish", "materials/C.burnish") == (
        "error: `materials/c.burnish` and `materials/C.burnish` would both write into "
        "`build/materials/C`: rename one of them"
    )


def test_two_builds_do_not_write_into_one_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(locking, "PATIENCE", 0.02)
    Path("build").mkdir()
    descriptor = os.open("build", os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        assert refused("materials/c.burnish") == (
            "error: another build is writing into `build`: wait until it has ended, or name "
            "another folder with -o"
        )
    finally:
        os.close(descriptor)
    assert built("materials/c.burnish")[-1] == "1 action run, 0 up to date"


def test_files_of_others_are_left() -> None:
    Path("build/materials/c").mkdir(parents=True)
    Path("build/materials/c/C.json").write_text("mine")
    done = invoke("build", "materials/c.burnish", "-t", "wgsl")
    assert done.exit_code == 1
    assert "it is no file that Burnish has written" in done.stderr
    assert tree(Path("build")) == {"materials", "materials/c", "materials/c/C.json"}


def test_former_outputs_that_nothing_makes_any_more_are_removed() -> None:
    """All others are left: files of other builds, and those that somebody has changed."""
    line = ("build", ".", "-I", ".")
    both = invoke(*line, "-t", "wgsl,hlsl")
    assert (both.exit_code, both.stderr) == (0, "")
    changed, gone = Path("build/materials/a/A.frag.hlsl"), Path("build/materials/b/B.frag.hlsl")
    changed.write_text("// Mine.\n")
    Path("build/materials/b/notes.txt").write_text("Mine.\n")
    assert invoke("build", "materials/a.burnish", "-I", ".", "-t", "wgsl").exit_code == 0
    assert gone.is_file(), "it was not asked about"
    Path("materials/c.burnish").unlink()
    Path("materials/metal/r.burnish").write_text("material R { color = vec3(0.1) }\n")
    done = invoke(*line, "-t", "wgsl", "--format", "json")
    answer = json.loads(done.stdout)
    assert set(answer["result"]["removed"]) == {
        "build/materials/b/B.frag.hlsl", "build/materials/b/B.vert.hlsl",
        *(f"build/materials/c/C.{end}" for end in _ENDS),
        *(f"build/materials/metal/r/Day/R.Day.{end}" for end in _ENDS),
        *(f"build/materials/metal/r/Night/R.Night.{end}" for end in _ENDS),
    }  # fmt: skip
    assert [row["name"] for row in answer["result"]["run"]] == ["materials/b", "materials/metal/r"]
    assert answer["result"]["up_to_date"] == ["materials/a"]
    assert "build/materials/b/B.frag.wgsl" in answer["written"]
    paths = [Path("build", each) for each in tree(Path("build"))]
    assert not Path("build/materials/c").exists()
    assert sorted(str(path.relative_to("build")) for path in paths if path.is_file()) == [
        "materials/a/A.frag.hlsl",
        *(f"materials/a/A.{end}" for end in _KEPT),
        *(f"materials/b/B.{end}" for end in _KEPT),
        "materials/b/notes.txt",
        *(f"materials/metal/r/R.{end}" for end in _KEPT),
    ]
    assert built(".") == ["0 actions run, 3 up to date"]


_KEPT = ("frag.wgsl", "json", "vert.wgsl")
_ENDS = ("frag.hlsl", "vert.hlsl", *_KEPT)
