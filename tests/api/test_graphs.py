"""Results that are kept or pickled: their graphs are dropped, and are made again as they were."""

from __future__ import annotations

import copy
import gc
import pickle
import sys
import weakref
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points, graphs
from burnish.api.graphs import Recent
from burnish.api.remembered import Remembered
from burnish.compiler import opening

from ..suite.processes import at_once, run

FLAT = "material Flat {{ param tint : rgb = vec3({}), color = tint * sqrt(uv.x) }}"
EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(autouse=True)
def recent(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No graphs stay but those of the last result."""
    monkeypatch.setattr(graphs, "_RECENT", Recent(0))
    monkeypatch.setattr(entry_points, "_REMEMBERED", Remembered(results=0))
    yield


def told(result: burnish.CompileResult) -> list[object]:
    """Everything that a result can be asked for, in words."""
    return [
        *((file.name, file.text, _spans(file)) for each in result for file in each.files),
        *(burnish.to_json(each.reflection) for each in result),
        *(burnish.to_json(frame.plan) for frame in result.frames),
        *(burnish.to_json(frame.plan_of_reference) for frame in result.frames),
        *(len(frame.frame.shaders) for frame in result.frames),
        *(repr([(p.text, p.needs, p.steps) for p in each.proofs]) for each in result),
        *(len(each.emitted("wgsl:webgpu").results) for each in result),
        *(len(each.staged.program.stages) for each in result),
        *(len(each.shader.results) for each in result),
        *(len(each.instance().reflection.parameters) for each in result),
        [each.lacking for each in result],
        [(guard.reason, str(guard.span)) for each in result for guard in each.guards],
        [each.message for each in result.diagnostics],
        repr(result.materials),
        result.inputs.contents,
    ]


def _spans(file: burnish.OutputFile) -> list[tuple[int, str, int]]:
    return [(line, span.source.name, span.start) for line, span in file.spans.items()]


@pytest.mark.parametrize("name", ["plastic", "frames/deferred", "blur"])
def test_a_pickled_result_can_do_all_that_it_could(name: str) -> None:
    result = burnish.compile(EXAMPLES / f"{name}.burnish", "wgsl,glsl")
    early = pickle.loads(pickle.dumps(result))
    deep = copy.deepcopy(result)
    wanted = told(result)
    late = pickle.loads(pickle.dumps(result))
    assert told(early) == told(late) == told(deep) == wanted


UNPICKLED = """
import pickle, sys
from pathlib import Path
result = pickle.loads(Path(sys.argv[1]).read_bytes())
(material,) = result
print(material.text("wgsl", "fragment"), len(material.reflection.parameters), material.proofs)
"""


def test_another_process_can_ask_it(tmp_path: Path) -> None:
    result = burnish.compile(FLAT.format(1), "wgsl")
    (tmp_path / "result").write_bytes(pickle.dumps(result))
    said = run([sys.executable, "-c", UNPICKLED, str(tmp_path / "result")], check=True).stdout
    (made,) = result
    text = made.text("wgsl", "fragment")
    assert said == f"{text} {len(made.reflection.parameters)} {made.proofs}\n"


def test_what_was_asked_for_is_pickled() -> None:
    """The reader of a result that somebody has looked at compiles nothing for it."""
    result = burnish.compile(FLAT.format(1), "wgsl")
    wanted = burnish.to_json(result["Flat"].reflection)
    spans = _spans(result["Flat"].files[0])
    copied = pickle.loads(pickle.dumps(result))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(opening, "parse", None)
        assert burnish.to_json(copied["Flat"].reflection) == wanted
        assert _spans(copied["Flat"].files[0]) == spans


def test_a_deep_graph_is_pickled() -> None:
    terms = " + ".join(f"sin(uv.x * {number}.5)" for number in range(3000))
    result = burnish.compile(f"material Deep {{ color = vec3({terms}) }}", "wgsl")
    copied = pickle.loads(pickle.dumps(result))
    assert copied["Deep"].text("wgsl", "fragment") == result["Deep"].text("wgsl", "fragment")


def test_only_the_last_graphs_stay() -> None:
    first = burnish.compile(FLAT.format(1), "wgsl")
    assert first["Flat"].shader is first["Flat"].shader
    dropped = weakref.ref(first["Flat"].shader.graph)
    burnish.compile(FLAT.format(2), "wgsl")
    gc.collect()
    assert dropped() is None
    assert first["Flat"].reflection.material == "Flat"


def test_graphs_stay_if_they_are_to() -> None:
    first = burnish.compile(FLAT.format(1), "wgsl", keep_graphs=True)
    shader = first["Flat"].shader
    burnish.compile(FLAT.format(2), "wgsl")
    assert first["Flat"].shader is shader
    dropped = weakref.ref(shader.graph)
    del first, shader
    gc.collect()
    assert dropped() is None


def test_graphs_that_are_used_stay_longer() -> None:
    size = sum(len(f.text) for f in burnish.compile(FLAT.format(0), "wgsl")["Flat"].files)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(graphs, "_RECENT", Recent(int(2.5 * size)))
        one, two = (burnish.compile(FLAT.format(n), "wgsl")["Flat"] for n in (1, 2))
        kept, dropped = one.shader, two.shader
        assert one.shader is kept
        burnish.compile(FLAT.format(3), "wgsl")
        assert one.shader is kept
        assert two.shader is not dropped


def test_files_that_have_changed_since(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The graphs are those of the files as they were, wherever these are now."""
    monkeypatch.chdir(tmp_path)
    Path("far").mkdir()
    Path("far/tints.burnish").write_text("fn tint(at: float) = sqrt(at) + 1.5")
    Path("main.burnish").write_text(
        "import tints.{tint}\nmaterial Tinted { color = vec3(tint(uv.x)) }"
    )
    result = burnish.compile("main.burnish", "wgsl", search_path=["far"])
    copies = [pickle.dumps(result) for _ in range(2)]
    wanted = told(pickle.loads(copies[0]))
    Path("far/tints.burnish").unlink()
    Path("main.burnish").write_text("material Other { }")
    assert told(pickle.loads(copies[0])) == wanted
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert told(pickle.loads(copies[1])) == wanted


def test_another_burnish_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    result = burnish.compile(FLAT.format(1), "wgsl")
    copied = pickle.loads(pickle.dumps(result))
    monkeypatch.setattr("burnish.targets.emit.emitter.wrapped", lambda text: (text + "// new", ()))
    with pytest.raises(RuntimeError, match="compile its source again"):
        _ = copied["Flat"].reflection
    assert copied["Flat"].text("wgsl", "fragment") == result["Flat"].text("wgsl", "fragment")


def test_threads_ask_at_once() -> None:
    results = [burnish.compile(FLAT.format(number), "wgsl") for number in range(3)]
    wanted = [burnish.to_json(pickle.loads(pickle.dumps(r))["Flat"].reflection) for r in results]

    def ask(number: int) -> object:
        assert len(results[number]["Flat"].proofs) == len(results[number]["Flat"].guards)
        return burnish.to_json(results[number]["Flat"].reflection)

    found = at_once([partial(ask, number % 3) for number in range(12)])
    assert found == [wanted[number % 3] for number in range(12)]
