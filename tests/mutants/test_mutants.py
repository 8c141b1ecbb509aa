"""A few mutants are noticed, and the tool finds changes where there are some.

``python -m tests.mutants`` judges as many random ones as somebody has time for. These are fixed:
each is an edit of a text, so that other edits of the same file do not change what is tested.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from .changes import Change, changes, template_changes
from .copies import FRAMES, MATERIALS, Copy, Judgement, Known, copy
from .places import AREAS, ROOT, Mutant, mutants
from .texts import text_changes

pytestmark = pytest.mark.xdist_group("mutants")  # One process has the copy of the package.

NOTICED = [
    ("compiler/passes/rules/bounds.py", "where=x >= 0, drops", "where=(), drops"),
    ("compiler/ir/storage.py", "LANE = 4", "LANE = 8"),
    ("targets/hlsl/language.py", '"fract": "frac"', '"fract": "floor"'),
    ("targets/wgsl/shader.wgsl.j2", "@interpolate(flat)", "@interpolate(linear)"),
    ("compiler/planning/barriers.py", "if before == after and", "if before != after and"),
    ("targets/runner/frames/job_resources.py", "= at[other], at[one]", "= at[one], at[other]"),
    ("targets/runner/instances/blocks.py", 'f"<{shape.lanes}', 'f">{shape.lanes}'),
]
"""A file of the package, a text in it, and what replaces the text."""

SAME = ("compiler/ir/storage.py", "LANE = 4", "LANE = 2 + 2")
"""A change that changes nothing."""


@dataclass(frozen=True)
class Few:
    """A copy of the package that is judged by a few materials."""

    package: Copy
    known: Known

    def judged(self, mutant: Mutant) -> Judgement:
        return self.package.judged(mutant, self.known)


@pytest.fixture(scope="module")
def few(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Few]:
    folder = tmp_path_factory.mktemp("mutants")
    materials = folder / "materials"
    materials.mkdir()
    for file in ("operations.burnish", "integers.burnish"):
        shutil.copy(MATERIALS / file, materials)
    shutil.copy(FRAMES / "steps.burnish", materials)
    with copy(folder / "copy", [materials]) as package:
        yield Few(package, package.known())


def _mutant(path: str, before: str, after: str) -> Mutant:
    """The only place of a text in a file, with another text."""
    source, old = (ROOT / path).read_bytes(), before.encode()
    assert source.count(old) == 1, f"{path} does not say {before!r} once any more"
    start = source.index(old)
    return Mutant("one", path, Change(start, start + len(old), after, "text"))


@pytest.mark.parametrize(("path", "before", "after"), NOTICED)
def test_it_is_noticed(few: Few, path: str, before: str, after: str) -> None:
    found = few.judged(_mutant(path, before, after))
    assert found.verdict == "caught"
    assert found.by.endswith((": differs", ": failed")), found.by


def test_what_changes_nothing_is_the_same(few: Few) -> None:
    found = few.judged(_mutant(*SAME))
    assert found.verdict == "same"


def test_the_copy_is_unchanged_afterwards(few: Few) -> None:
    few.judged(_mutant("compiler/ir/storage.py", "LANE = 4", "LANE ="))
    assert few.judged(_mutant(*SAME)).verdict == "same"


@pytest.mark.parametrize("area", AREAS)
def test_every_part_has_mutants_that_python_can_read(area: str) -> None:
    found = mutants(area)
    assert found
    for mutant in found[:: max(1, len(found) // 50)]:
        if mutant.path.endswith(".py"):
            compile(mutant.change.applied((ROOT / mutant.path).read_bytes()), mutant.path, "exec")


SOURCE = b'''"""Says nothing that counts: 1 < 2."""

def f(a: "x < y", b):
    while a < b and not g(a, b + 2):
        del b[0]
        h(a)
    return {"x": "({0} + {1})", "y": "z"}
'''
CHANGES = [
    "4 condition: a < b and not g(a, b + 2) -> not (a < b and not g(a, b + 2))",
    "4 comparison: < -> <=",
    "4 and/or: and -> or",
    "4 sign: not g(a, b + 2) -> (g(a, b + 2))",
    "4 arguments: a, b + 2 -> b + 2, a",
    "4 operator: + -> -",
    "4 constant: 2 -> 1",
    "4 constant: 2 -> 3",
    "5 constant: 0 -> 1",
    "6 statement: h(a) -> pass",
    '7 text: "({0} + {1})" -> "({0} - {1})"',
    '7 text: "({0} + {1})" -> "({1} + {0})"',
    '7 entries: "({0} + {1})", "y": "z" -> "z", "y": "({0} + {1})"',
]


def test_changes_of_a_module() -> None:
    assert [change.told(SOURCE) for change in changes(SOURCE)] == CHANGES


def test_changes_of_a_template() -> None:
    source = b"{% if flat %}\nflat;\n{% endif %}\n"
    assert [change.told(source) for change in template_changes(source)] == [
        "1 condition: flat -> not (flat)",
        "2 line: flat; -> nothing",
    ]


TEXT = """layout(set = 1, binding = 0) uniform Material {
    vec3 base;
    float power;
};
flat in vec2 v_uv;
void main() {
    // a - b
    out_color = base.x < 2.5 ? max(base[1], 0.0) - power : 1.5 / power;
}
"""
TEXT_CHANGES = [
    "8 operand order: 1.5 / power -> power / 1.5",
    "8 operator: < -> <=",
    "8 operator: - -> +",
    "8 operator: / -> *",
    "8 constant: 2.5 -> 2.5000009536743164",
    "8 constant: 1.5 -> 1.5000004768371582",
    "8 lanes: .x -> .y",
    "8 guard: max(base[1], 0.0) -> (base[1])",
    "8 function: max -> min",
    "8 index: [1] -> [0]",
    "5 qualifier: flat -> nothing",
    "1 binding: binding = 0 -> binding = 1",
    "2 members: vec3 base; float power; -> float power; vec3 base;",
]


def test_changes_of_an_emitted_text() -> None:
    assert [change.told(TEXT) for change in text_changes(TEXT)] == TEXT_CHANGES


def test_all_of_the_package_that_is_named_is_there() -> None:
    missing = [p for patterns in AREAS.values() for p in patterns if not list(Path(ROOT).glob(p))]
    assert not missing
