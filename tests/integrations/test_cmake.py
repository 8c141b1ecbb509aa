"""The CMake function, in the project of the page: by Ninja and by Make."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from subprocess import CompletedProcess

import pytest

import burnish

from ..suite.processes import run
from .kit import (
    BROKEN,
    INTEGRATIONS,
    PLACE,
    environment,
    project,
    replaced,
    tool,
    without_burnish,
    words,
)  # fmt: skip

pytestmark = pytest.mark.xdist_group("cmake")  # Its projects are made once.

GENERATORS = {"Ninja": "Ninja", "Make": "Unix Makefiles"}
COMPILING = "Compiling materials/{}.burnish"


LINEAR = ((0xB5 / 255 + 0.055) / 1.055) ** 2.4
"""The red of the material's base colour, `#b5651d`, as light."""


class Built:
    """A folder with the project of the page, and its build."""

    def __init__(self, folder: Path, generator: str) -> None:
        self.folder = folder
        self.materials = folder / "materials"
        self.outputs = folder / "build" / "burnish" / "materials"
        self._generator = generator

    def configure(self, *, check: bool = True) -> CompletedProcess[str]:
        return configured(self.folder, self._generator, check=check)

    def build(self, *, check: bool = True) -> str:
        """What the build prints; with `check` it has to succeed, and else to fail."""
        done = run([tool("cmake", "cmake"), "--build", "build"], cwd=self.folder, env=environment())
        assert (done.returncode == 0) == check, done
        return done.stdout + done.stderr

    def compiled(self, printed: str) -> set[str]:
        """The materials that a build has compiled, as it says."""
        names = (path.stem for path in self.materials.glob("*.burnish"))
        return {name for name in names if COMPILING.format(name) in printed}

    def dates(self) -> dict[str, int]:
        return {path.name: path.stat().st_mtime_ns for path in self.outputs.iterdir()}


def configured(
    folder: Path, generator: str = "Ninja", *more: str, check: bool = True
) -> CompletedProcess[str]:
    command = [tool("cmake", "cmake"), "-S", ".", "-B", "build", "-G", generator, *more]
    ninja = f"-DCMAKE_MAKE_PROGRAM={tool('ninja', 'ninja')}"
    command += [f"-DBurnish_ROOT={INTEGRATIONS / 'cmake'}"]
    command += [ninja] if generator == "Ninja" else []
    return run(command, cwd=folder, env=environment(), check=check)


@pytest.fixture(scope="module", params=GENERATORS)
def built(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Built:
    name = str(request.param)
    # A name that Make, Ninja and shells could misread.
    folder = project("cmake", tmp_path_factory.mktemp("with blank (1)") / name)
    found = Built(folder, GENERATORS[name])
    found.configure()
    assert found.compiled(found.build()) == {"plastic", "glow"}
    return found


@pytest.fixture
def same_after(built: Built) -> Iterator[None]:
    """Leaves the sources as they were."""
    sources = {path: path.read_text() for path in built.materials.rglob("*.burnish")}
    yield
    for path, text in sources.items():
        if path.read_text() != text:
            path.write_text(text)
    built.build()


def test_the_program_has_the_shaders(built: Built) -> None:
    program = built.folder / "build" / "viewer"
    (material,) = burnish.compile(built.materials / "plastic.burnish", ("glsl:gl330",))
    text, value = run([str(program)], check=True).stdout.rsplit("//", 1)
    assert text == material.text("glsl:gl330", "fragment")
    assert float(value) == pytest.approx(LINEAR, rel=1e-5)


def test_nothing_is_made_twice(built: Built) -> None:
    assert built.compiled(built.build()) == set()


@pytest.mark.usefixtures("same_after")
def test_what_depends_on_a_changed_import_is_made_again(built: Built) -> None:
    before = built.dates()
    replaced(built.materials / "shared" / "tints.burnish", "0.5", "0.25")
    assert built.compiled(built.build()) == {"plastic"}
    after = built.dates()
    changed = {name for name in after if after[name] != before[name]}
    assert changed == {"Plastic.frag.wgsl", "Plastic.gl330.frag.glsl"}
    assert built.compiled(built.build()) == set()


@pytest.mark.usefixtures("same_after")
def test_outputs_that_stay_the_same_keep_their_dates(built: Built) -> None:
    before = built.dates()
    replaced(built.materials / "plastic.burnish", "\n    param", "\n    // Brown.\n    param")
    assert built.compiled(built.build()) == {"plastic"}
    assert built.dates() == before
    assert built.compiled(built.build()) == set()


@pytest.mark.usefixtures("same_after")
def test_a_mistake_is_told_in_a_line_with_its_place(built: Built) -> None:
    before = built.dates()
    source = built.materials / "plastic.burnish"
    right = source.read_text()
    source.write_text(BROKEN)
    (line,) = (line for line in built.build(check=False).splitlines() if "tnt" in line)
    assert line.startswith(f"{source}{PLACE}")
    assert built.dates() == before
    source.write_text(right)
    built.build()


@pytest.mark.usefixtures("same_after")
def test_a_new_material_in_a_file_is_taken_up(built: Built) -> None:
    source = built.materials / "glow.burnish"
    source.write_text(f"{source.read_text()}\nmaterial Dark {{ color = #000000 }}\n")
    assert built.compiled(built.build()) == {"glow"}
    assert (built.outputs / "Dark.frag.wgsl").exists()
    assert built.compiled(built.build()) == set()


EXPANDING = """
mixin Same { expand triangle { strip of 3 as i { position = corner[i].position } } }
abstract material Base : Surface + Same { color = #ffffff }
"""


def test_other_outputs_by_an_import_are_taken_up(tmp_path: Path) -> None:
    """The build says so once: it may be that another command needs the files."""
    (tmp_path / "base.burnish").write_text("abstract material Base { color = #ffffff }\n")
    (tmp_path / "a.burnish").write_text('import "base.burnish".{Base}\nmaterial A : Base {}\n')
    call = "m a.burnish TARGETS glsl OPTIONS --native-stages"
    (tmp_path / "CMakeLists.txt").write_text(CALL.format(call))
    other = Built(tmp_path, "Ninja")
    other.configure()
    other.build()
    (tmp_path / "base.burnish").write_text(EXPANDING)
    told = f"{tmp_path / 'a.burnish'} has other outputs now than CMake knows of: build again"
    assert told in words(other.build(check=False))
    other.build()
    assert (tmp_path / "build" / "burnish" / "m" / "A.geom.glsl").exists()
    assert "no work to do" in other.build()


def test_a_mistake_before_the_first_build(tmp_path: Path) -> None:
    """CMake can be configured: it is the build that tells mistakes."""
    (tmp_path / "a.burnish").write_text(BROKEN)
    (tmp_path / "CMakeLists.txt").write_text(CALL.format("m a.burnish"))
    other = Built(tmp_path, "Ninja")
    other.configure()
    assert f"a.burnish{PLACE}" in other.build(check=False)
    assert not (tmp_path / "build" / "burnish").exists()
    (tmp_path / "a.burnish").write_text("material Plastic { color = #ff8000 }\n")
    other.build()
    assert "no work to do" in other.build()


IN_C = """
cmake_minimum_required(VERSION 3.25)
project(InC LANGUAGES C)
find_package(Burnish REQUIRED)
add_executable(program main.c)
target_link_libraries(program PRIVATE m)
burnish_add_materials(program a.burnish BINDINGS c TARGETS wgsl)
"""


def test_a_binding_in_c(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(IN_C)
    (tmp_path / "a.burnish").write_text(
        "material A { param tone : float = 0.5  color = rgb(tone) }\n"
    )
    main = "program_AMaterial block = program_default_a_material();"
    main = f'#include "program.h"\nint main(void) {{ {main} return block.tone != 0.5f; }}\n'
    (tmp_path / "main.c").write_text(main)
    configured(tmp_path, check=True)
    run([tool("cmake", "cmake"), "--build", "build"], cwd=tmp_path, env=environment(), check=True)
    run([str(tmp_path / "build" / "program")], check=True)


CALL = """
cmake_minimum_required(VERSION 3.25)
project(Calls NONE)
find_package(Burnish REQUIRED)
add_custom_target(utility)
burnish_add_materials({})
"""

WRONG_CALLS = {
    "m": "`m` gets no materials: name at least one file behind it",
    "m a.burnish TARGETS": "there is no value behind TARGETS",
    "m gone.burnish": "there is no file `gone.burnish`",
    "utility a.burnish": "`utility` is no library or executable of this project",
    "m a.burnish OPTIONS -o x": "OPTIONS cannot have -o, which CMake decides on",
    "m a.burnish OPTIONS --wath": "No such option '--wath'",
    "m a.burnish OPTIONS --target=x": "OPTIONS cannot have --target=x, which CMake decides on",
    "m a.burnish BINDINGS cobol": "there are no BINDINGS in cobol for CMake, but in c and cpp",
    "m a.burnish b.burnish": "give one of them another OUTPUT_DIRECTORY",
}


@pytest.mark.parametrize("call", WRONG_CALLS)
def test_wrong_calls(call: str, tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.burnish").write_text("material A { color = #ffffff }\n")
    (tmp_path / "CMakeLists.txt").write_text(CALL.format(call))
    done = configured(tmp_path, check=False)
    assert done.returncode == 1
    assert WRONG_CALLS[call] in words(done.stderr)


def test_burnish_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(CALL.format("m a.burnish"))
    command = [tool("cmake", "cmake"), "-B", "build", "-G", "Ninja"]
    command += [f"-DBurnish_ROOT={INTEGRATIONS / 'cmake'}"]
    done = run(command, cwd=tmp_path, env=without_burnish())
    assert done.returncode == 1
    assert "there is no program `burnish` on PATH: activate" in words(done.stderr)


@pytest.mark.parametrize(
    ("wanted", "is_found"),
    [("0.1", True), ("0.1.0", True), ("0.0", False), ("0.1.1", False), ("1", False)],
)
def test_versions(wanted: str, is_found: bool, tmp_path: Path) -> None:
    text = CALL.format("m a.burnish").replace("Burnish REQUIRED", f"Burnish {wanted} REQUIRED")
    (tmp_path / "CMakeLists.txt").write_text(text)
    (tmp_path / "a.burnish").write_text("material A { color = #ffffff }\n")
    assert (configured(tmp_path, check=False).returncode == 0) == is_found
