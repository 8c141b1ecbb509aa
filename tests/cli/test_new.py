"""The command that makes projects of the example hosts: whole ones, or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.commands.new import COMMON, HOSTS, hosts

from .kit import invoke, tree


@pytest.fixture(autouse=True)
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_all_hosts_are_listed() -> None:
    folders = {path.name for path in HOSTS.iterdir() if path.is_dir()} - {COMMON, "__pycache__"}
    assert folders == set(hosts())
    said = invoke("new").stdout
    assert all(f"  {name} " in said and what in said for name, what in hosts().items())
    assert ", ".join(hosts()) in " ".join(invoke("new", "--help").stdout.split())


@pytest.mark.parametrize("host", hosts())
def test_a_project_has_what_it_needs_and_says_how_it_is_built(host: str, tmp_path: Path) -> None:
    said = invoke("new", "lantern", "--host", host)
    assert said.exit_code == 0
    written = tree(tmp_path / "lantern")
    assert written >= {"README.md", "scene.json", "materials/plastic.burnish"}
    *_, build, draw = said.stdout.splitlines()
    assert f"  cd {Path('lantern')}" in said.stdout.splitlines()
    page = (tmp_path / "lantern" / "README.md").read_text(encoding="utf-8")
    assert build.strip() in page
    assert draw.strip() in page


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("lantern", "name a host: `--host` with one of wgpu-py, "),
        ("lantern --host wgpupy", "there is no host `wgpupy`; did you mean `wgpu-py`?"),
        ("lantern --host common", "there is no host `common`"),
        ("a/lantern --host moderngl", "`a/lantern` is a path: give the name of a new folder"),
        ("../lantern --host moderngl", "`../lantern` is a path: give the name of a new folder"),
        ("con --host moderngl", "`con` is a name that Windows keeps for itself: give"),
        ("NUL.txt --host moderngl", "`NUL.txt` is a name that Windows keeps for itself: give"),
        ("lantern. --host moderngl", "`lantern.` ends in a dot, which Windows leaves out: give"),
        ("l" * 256 + " --host moderngl", "is longer than the 255 bytes that a name may have: give"),
        (".. --host moderngl", "`..` is no name of a folder: give the name of a new folder"),
    ],
)
def test_what_makes_no_sense_is_told(line: str, said: str, tmp_path: Path) -> None:
    result = invoke("new", *line.split())
    assert result.exit_code == 2
    assert said in result.stderr
    assert not tree(tmp_path)


CALLED = {
    "webgpu": {"package.json": '"name": "laterne-2"', "index.html": "<title>Laterne.2</title>"},
    "webgl2": {"package.json": '"name": "laterne-2"', "index.html": "<title>Laterne.2</title>"},
    "three": {"index.html": "<title>Laterne.2</title>", "lit.html": "<title>Laterne.2</title>"},
    "rust-wgpu": {"Cargo.toml": 'name = "laterne-2"', "Cargo.lock": 'name = "laterne-2"'},
    "cpp-vulkan": {"CMakeLists.txt": "add_executable(laterne-2 main.cpp)"},
}


@pytest.mark.parametrize("host", hosts())
def test_a_project_is_called_by_its_name(host: str, tmp_path: Path) -> None:
    name = "Laterne.2"
    said = invoke("new", name, "--host", host)
    assert said.exit_code == 0
    folder = tmp_path / name
    assert (folder / "README.md").read_text("utf-8").startswith(f"# {name}\n")
    assert "node_modules/\n" in (folder / ".gitignore").read_text("utf-8")
    for file, text in CALLED.get(host, {}).items():
        assert text in (folder / file).read_text("utf-8"), file
    if host == "cpp-vulkan":
        assert "  build/laterne-2 plastic plastic.png" in said.stdout


@pytest.mark.parametrize("kind", ["folder", "file", "link"])
def test_what_is_there_stays(kind: str, tmp_path: Path) -> None:
    place = tmp_path / "lantern"
    if kind == "folder":
        place.mkdir()
    elif kind == "file":
        place.write_text("mine")
    else:
        place.symlink_to("nowhere")
    before = tree(tmp_path)
    result = invoke("new", "lantern", "--host", "moderngl")
    assert result.exit_code == 1
    assert "`lantern` is there already, and nothing was written" in result.stderr
    assert tree(tmp_path) == before
