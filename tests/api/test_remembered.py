"""Results that ``burnish.compile`` remembers: they are what a compile would give again."""

from __future__ import annotations

import os
import random
import shutil
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points
from burnish.api.remembered import Remembered
from burnish.compiler.watching import SHOWN, VARIABLE

from ..suite.processes import at_once, run

FLAT = "material Flat {{ color = vec3({}) }}"
TINTED = "import {}.{{tint}}\nmaterial Tinted {{ color = vec3(1, 0.5, 0.25) * tint(2.0) }}"
TINT = "fn tint(at: float) = at + {}"


FORKING = """
import faulthandler, os, threading, time
import burnish

def work(number):
    while time.monotonic() < until:
        burnish.compile(TEXT % (number + time.monotonic()), "wgsl")

def forked():
    child = os.fork()
    if child == 0:
        faulthandler.dump_traceback_later(20, exit=True)
        burnish.compile(TEXT % 0, "wgsl")
        burnish.compile(TEXT % os.getpid(), "wgsl")
        os._exit(0)
    return child

TEXT = "material Flat { color = vec3(%s) }"
burnish.compile(TEXT % 0, "wgsl")  # Nothing is imported any more, for which Python has locks.
until = time.monotonic() + 2
threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
for thread in threads:
    thread.start()
children = [forked() for _ in range(10)]
for thread in threads:
    thread.join()
assert all(os.waitpid(child, 0)[1] == 0 for child in children)
"""


@pytest.fixture(autouse=True)
def _unwatched(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tests verify all passes, which every compile then has to run."""
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setattr(entry_points, "_REMEMBERED", Remembered())


def texts(result: burnish.CompileResult) -> dict[str, str]:
    return {file.name: file.text for each in result for file in each.files}


def fresh(*arguments: object, **named: object) -> dict[str, str] | tuple[str, ...]:
    """The texts, or the messages, of a compile that remembers nothing."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(entry_points, "_REMEMBERED", Remembered(results=0))
        return outcome(*arguments, **named)


def outcome(*arguments: object, **named: object) -> dict[str, str] | tuple[str, ...]:
    try:
        return texts(burnish.compile(*arguments, **named))  # type: ignore[arg-type]
    except burnish.CompileError as error:
        return tuple(each.message for each in error.diagnostics)


def test_the_same_text_gives_the_same_record() -> None:
    one = burnish.compile(FLAT.format(1), "wgsl,hlsl")
    assert burnish.compile(FLAT.format(1), ["wgsl", "hlsl"]) is one
    assert burnish.compile(FLAT.format(2), "wgsl,hlsl") is not one


@pytest.mark.parametrize(
    "other",
    [
        {"targets": "glsl"}, {"flip_y": True}, {"single_file": True}, {"partial": True},
        {"line_directives": True}, {"hoist": False}, {"native_stages": True},
        {"material": "Flat"}, {"pass_": "Forward"}, {"search_path": ["."]},
    ],
    ids=lambda other: next(iter(other)),
)  # fmt: skip
def test_every_argument_counts(other: dict[str, object]) -> None:
    source = FLAT.format(1)
    usual: dict[str, object] = {"targets": "wgsl"}
    found = outcome(source, **usual)
    assert outcome(source, **{**usual, **other}) == fresh(source, **{**usual, **other})
    assert outcome(source, **usual) == found


def test_a_text_and_a_file_of_that_name_are_not_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    name = "material Flat {}"
    Path(name).write_text(FLAT.format(1))
    assert list(texts(burnish.compile(Path(name), "wgsl")))
    assert outcome(name, "wgsl") != outcome(Path(name), "wgsl")


@pytest.fixture
def tinted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], object]:
    """A file that imports another; asking compiles it, and compares with a fresh compile."""
    monkeypatch.chdir(tmp_path)
    Path("near").mkdir()
    Path("far").mkdir()
    Path("main.burnish").write_text(TINTED.format("tints"))
    Path("far/tints.burnish").write_text(TINT.format(1.5))

    def ask() -> object:
        found = outcome("main.burnish", "wgsl", search_path=["near", "far"])
        assert found == fresh("main.burnish", "wgsl", search_path=["near", "far"])
        assert found == outcome("main.burnish", "wgsl", search_path=["near", "far"])
        return found

    return ask


def test_what_is_imported_counts(tinted: Callable[[], object]) -> None:
    before = tinted()
    assert isinstance(before, dict)
    Path("far/tints.burnish").write_text(TINT.format(2.5))
    changed = tinted()
    # This one is imported first, and was looked for in vain before.
    Path("near/tints.burnish").write_text(TINT.format(3.5))
    nearer = tinted()
    Path("near/tints.burnish").unlink()
    assert tinted() == changed
    Path("far/tints.burnish").write_text(TINT.format(1.5))
    assert tinted() == before
    assert len({repr(each) for each in (before, changed, nearer)}) == 3
    shutil.rmtree("near")
    assert isinstance(tinted(), tuple)
    shutil.rmtree("far")
    assert isinstance(tinted(), tuple)


def test_an_edit_that_leaves_size_and_time_counts(tmp_path: Path) -> None:
    file = tmp_path / "flat.burnish"
    file.write_text(FLAT.format(1))
    before, status = texts(burnish.compile(file, "wgsl")), file.stat()
    file.write_text(FLAT.format(2))
    os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert texts(burnish.compile(file, "wgsl")) != before


def test_a_link_that_leads_elsewhere_counts(tmp_path: Path) -> None:
    link = tmp_path / "flat.burnish"
    found = []
    for number in (1, 2):
        (tmp_path / f"{number}.burnish").write_text(FLAT.format(number))
        link.unlink(missing_ok=True)
        link.symlink_to(f"{number}.burnish")
        found.append(texts(burnish.compile(link, "wgsl")))
    assert found[0] != found[1]


def test_the_current_folder_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for number in (1, 2):
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "flat.burnish").write_text(FLAT.format(number))
        monkeypatch.chdir(folder)
        found.append(texts(burnish.compile("flat.burnish", "wgsl")))
    assert found[0] != found[1]


def test_mistakes_are_told_each_time() -> None:
    messages = outcome("material Flat { color = nothing }", "wgsl")
    assert isinstance(messages, tuple)
    assert outcome("material Flat { color = nothing }", "wgsl") == messages
    with pytest.raises(TypeError):
        burnish.compile(FLAT.format(1), 3)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", [VARIABLE, SHOWN])
def test_whoever_watches_the_passes_sees_them_each_time(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = burnish.compile(FLAT.format(1), "wgsl")
    monkeypatch.setenv(name, "1")
    two = burnish.compile(FLAT.format(1), "wgsl")
    assert two is not one
    monkeypatch.delenv(name)
    assert burnish.compile(FLAT.format(1), "wgsl") is one


def test_another_library_counts() -> None:
    kept = Remembered()
    result = burnish.compile(FLAT.format(1), "wgsl")
    library, other = object(), object()
    kept.keep("key", library, result)
    assert kept.find("key", library) is result
    assert kept.find("key", other) is None
    assert kept.find("key", library) is None


def test_the_oldest_are_forgotten() -> None:
    library = object()
    results = [burnish.compile(FLAT.format(number), "wgsl") for number in range(4)]
    kept = Remembered(results=2)
    kept.keep(0, library, results[0])
    kept.keep(1, library, results[1])
    assert kept.find(0, library) is results[0]  # So 1 was not used for longer.
    kept.keep(2, library, results[2])
    assert [kept.find(key, library) is not None for key in range(3)] == [True, False, True]
    size = sum(map(len, texts(results[3]).values()))
    small = Remembered(characters=2 * size + 10)
    for key, result in enumerate(results):
        small.keep(key, library, result)
    assert [small.find(key, library) is not None for key in range(4)] == [False, False, True, True]
    tiny = Remembered(characters=size - 100)
    tiny.keep(0, library, results[3])
    assert tiny.find(0, library) is None


def test_threads_share_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entry_points, "_REMEMBERED", Remembered(results=3))
    sources = [FLAT.format(number) for number in range(6)]
    wanted = {source: fresh(source, "wgsl") for source in sources}
    order = random.Random(7).choices(sources, k=60)
    found = at_once([partial(outcome, source, "wgsl") for source in order])
    assert found == [wanted[source] for source in order]


def test_a_process_forks_in_the_middle_of_compiles() -> None:
    """Whatever other threads hold then, the copy compiles, too."""
    done = run([sys.executable, "-c", FORKING])
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.parametrize("seed", range(4))
def test_random_edits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    """However files come, go and change, a compile gives what a fresh one gives."""
    monkeypatch.chdir(tmp_path)
    rng = random.Random(seed)
    for folder in ("near", "far"):
        Path(folder).mkdir()
    files = {
        "main.burnish": [TINTED.format("tints"), TINTED.format("others"), "material Tinted {"],
        "near/tints.burnish": [TINT.format(1.0), TINT.format(2.0), ""],
        "far/tints.burnish": [TINT.format(3.0), "fn other() = 1.0"],
        "far/others.burnish": [TINT.format(4.0), TINT.format(5.0)],
    }
    for _ in range(25):
        name = rng.choice(list(files))
        if rng.random() < 0.3:
            Path(name).unlink(missing_ok=True)
        else:
            Path(name).write_text(rng.choice(files[name]))
        folders = rng.choice((["near", "far"], ["far", "near"], ["far"]))
        arguments = {"targets": rng.choice(("wgsl", "hlsl")), "search_path": folders}
        assert outcome("main.burnish", **arguments) == fresh("main.burnish", **arguments)
