"""Small or absurd glTF files that would take much memory or time: refused before they do."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

import pytest

from burnish.compiler.budget import LIMITS, BudgetError, raised
from burnish.targets.runner.scenes.gltf.reading import read_gltf
from burnish.targets.runner.scenes.records import SceneError

from ..fuzz.hostile.scene_bytes import mutated, read, seeds
from ..suite.memory import measured
from .kit import Json, triangle

MOST = 10**9
"""The memory that the limit promises, in bytes."""

READING = """\
from pathlib import Path
from burnish.compiler.budget import BudgetError
from burnish.targets.runner.scenes.gltf.reading import read_gltf
from burnish.targets.runner.scenes.records import SceneError
try:
    print(len(read_gltf(Path(sys.argv[1])).objects), "objects")
except (BudgetError, SceneError) as error:
    print(error)
"""


def told(whole: Json | str, folder: Path) -> str:
    """The message about a file, without its name, from a process that keeps to the limit."""
    path = folder / "m.gltf"
    path.write_text(whole if isinstance(whole, str) else json.dumps(whole, separators=(",", ":")))
    said, peak = measured(READING, str(path))
    assert peak < MOST
    return said.replace(str(path), "m")


def zeros(**counts: int) -> Json:
    """A triangle whose accessors have no bytes, with indices."""
    whole = triangle().whole
    whole["accessors"] = [
        {"componentType": 5126, "count": counts["vertices"], "type": "VEC3"},
        {"componentType": 5125, "count": counts["indices"], "type": "SCALAR"},
    ]
    whole["meshes"][0]["primitives"][0] |= {"attributes": {"POSITION": 0}, "indices": 1}
    return whole


def test_indices_that_no_bytes_stand_for(tmp_path: Path) -> None:
    assert told(zeros(vertices=3, indices=6_291_456), tmp_path) == (
        "m draws 6,291,456 vertices, and the limit is 4,000,000 vertices: "
        "`--budget vertices=6292k` raises it"
    )


def test_what_is_allowed_takes_no_more_than_is_counted(tmp_path: Path) -> None:
    """Each triangle gets vertices of its own, as there are no normals. More are refused."""
    assert told(zeros(vertices=3, indices=1_800_000), tmp_path) == "1 objects"
    assert told(zeros(vertices=3, indices=3_000_000), tmp_path) == (
        "reading m takes 1.58 GB, and the limit is 1 GB: `--budget memory=1585M` raises it"
    )


def test_a_mesh_that_is_drawn_again_and_again_is_counted_each_time(tmp_path: Path) -> None:
    whole = zeros(vertices=3, indices=30_000)
    whole["nodes"] = [{"mesh": 0}] * 200
    whole["scenes"] = [{"nodes": list(range(200))}]
    assert told(whole, tmp_path) == (
        "m draws 4,020,000 vertices, and the limit is 4,000,000 vertices: "
        "`--budget vertices=4020k` raises it"
    )


@pytest.mark.parametrize("mode", [0, 4, 5, 6])
def test_a_strip_has_three_corners_for_each_vertex(mode: int, tmp_path: Path) -> None:
    whole = zeros(vertices=30_000, indices=1)
    primitive = whole["meshes"][0]["primitives"][0]
    primitive["mode"] = mode
    del primitive["indices"]
    path = tmp_path / "m.gltf"
    path.write_text(json.dumps(whole))
    drawn = {0: 30_000, 4: 30_000}.get(mode, 3 * 29_998)
    with raised({"vertices": drawn}):
        read_gltf(path)
    with raised({"vertices": drawn - 1}), pytest.raises(BudgetError, match=f"draws {drawn:,}"):
        read_gltf(path)


RECORDS = {
    "nodes": ('"nodes":[', "{}", "]"),
    "targets": ('"meshes":[{"primitives":[{"attributes":{},"targets":[', "{}", "]}]}]"),
    "weights": ('"nodes":[{"weights":[', "1", "]}]"),
    "materials": ('"materials":[', "{}", "]"),
    "animations": ('"animations":[', "0", "]"),
    "extensions": ('"extensionsUsed":[', '"a"', "]"),
    "extras": ('"nodes":[{"extras":[', "[[]]", "]}]"),
}
"""For each kind, the text before a list, its shortest element, and the text behind the list."""


@pytest.mark.parametrize("kind", RECORDS)
def test_records_are_counted_before_they_are_made(kind: str, tmp_path: Path) -> None:
    """The allowed number of records is made within the limit of memory; more are refused."""
    before, element, behind = RECORDS[kind]
    values = sum(map(element.count, ",[{")) + 1
    count = (LIMITS["values"].most - 10) // values
    whole = '{"asset":{"version":"2.0"},%s%s%s}'
    said = told(whole % (before, ",".join([element] * count), behind), tmp_path)
    assert "values" not in said
    path = tmp_path / "m.gltf"
    path.write_text(whole % (before, ",".join([element] * (count + 10)), behind))
    with pytest.raises(BudgetError, match=r"m\.gltf has 3,0.* values, and the limit is 3,000,000"):
        read_gltf(path)


def test_too_many_nodes(tmp_path: Path) -> None:
    whole = {"asset": {"version": "2.0"}, "nodes": [{}] * 100_001}
    assert told(whole, tmp_path) == (
        "m has 100,001 nodes, and the limit is 100,000 nodes: `--budget nodes=101k` raises it"
    )


def test_tags_that_are_handed_down_are_counted(tmp_path: Path) -> None:
    """Each node of a chain adds a tag, so that all sets together grow with the square."""
    nodes: list[Json] = [
        {"children": [n + 1], "extras": {"tags": [f"t{n}"]}} for n in range(50_000)
    ]
    said = told({"asset": {"version": "2.0"}, "nodes": [*nodes, {}]}, tmp_path)
    assert said == (
        "handing down the tags of m takes 3,000,025 values, and the limit is 3,000,000 values: "
        "`--budget values=3001k` raises it"
    )


def test_tags_that_say_nothing_new_are_shared(tmp_path: Path) -> None:
    nodes: list[Json] = [{"children": [n + 1], "extras": {"tags": ["a", "b"]}} for n in range(3)]
    whole = triangle().whole | {"nodes": [*nodes, {"mesh": 0, "extras": {"tags": ["b"]}}]}
    whole["scenes"] = [{"nodes": [0]}]
    assert told(whole, tmp_path) == "1 objects"


@pytest.mark.parametrize(("skins", "most"), [(1, False), (2900, True)])
def test_joints(skins: int, most: bool, tmp_path: Path) -> None:
    """Skins name the same joint again and again."""
    whole = triangle().whole
    whole["skins"] = [{"joints": [0] * (2_900_000 // skins)}] * skins
    whole["nodes"] = [{"mesh": 0, "skin": skin} for skin in range(skins)]
    whole["scenes"] = [{"nodes": list(range(skins))}]
    said = told(whole, tmp_path)
    assert said == "2900 objects" if most else said.startswith("reading m takes 1.4 GB"), said


def test_matrices_of_joints_that_no_bytes_stand_for(tmp_path: Path) -> None:
    whole = zeros(vertices=3, indices=3)
    whole["accessors"].append({"componentType": 5126, "count": 2**31 - 1, "type": "MAT4"})
    whole["skins"] = [{"joints": [0], "inverseBindMatrices": 2}]
    whole["nodes"][0]["skin"] = 0
    assert "takes 34,359,738,352 numbers" in told(whole, tmp_path)


def test_weights_of_many_nodes_for_many_targets(tmp_path: Path) -> None:
    """The mesh is another one for each node, and has many targets that move nothing."""
    whole = zeros(vertices=3, indices=3)
    whole["meshes"][0]["primitives"][0]["targets"] = [{}] * 8000
    whole["meshes"][0]["primitives"] *= 64
    whole["nodes"] = [{"mesh": 0, "weights": [node] * 8000} for node in range(60)]
    whole["scenes"] = [{"nodes": list(range(60))}]
    assert "and the limit is 67,108,864 numbers" in told(whole, tmp_path)


def test_attributes_that_nobody_reads(tmp_path: Path) -> None:
    """The file is written part by part: as an object, it would take hundreds of megabytes here."""
    whole = zeros(vertices=3, indices=3)
    whole["meshes"][0]["primitives"][0]["attributes"]["_"] = 0
    before, after = json.dumps(whole, separators=(",", ":")).split('"_":0')
    starts = range(0, 2_500_000, 1000)
    rows = (",".join(f'"_{number}":0' for number in range(at, at + 1000)) for at in starts)
    assert "and the limit is 67,108,864 numbers" in told(
        f"{before}{','.join(rows)}{after}", tmp_path
    )


def test_lights_and_cameras_are_counted(tmp_path: Path) -> None:
    whole = triangle().whole
    whole["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
    whole["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": 0}}}] * 5000
    whole["scenes"] = [{"nodes": list(range(5001))}]
    assert told(whole, tmp_path) == (
        "m has 5,001 objects, and the limit is 4,096 objects: `--budget objects=5001` raises it"
    )


def test_a_long_text_is_not_repeated_in_full(tmp_path: Path) -> None:
    whole = triangle().whole | {"cameras": [{"type": "x" * 1_000_000}]}
    assert len(told(whole, tmp_path)) < 400


def test_notes_of_a_kind_are_told_a_few_times(tmp_path: Path) -> None:
    made = triangle()
    made.whole["meshes"][0]["primitives"] += [{"attributes": {}, "mode": 1}] * 1000
    made.whole["extensionsUsed"] = [f"EXT_{number}" for number in range(1_000_000)]
    notes = read_gltf(made.save(tmp_path)).notes
    assert notes[4:7] == (
        "the extension EXT_4 is left out",
        "and 999,995 more like this",
        "mesh 0, primitive 1: it consists of lines, and is left out",
    )
    assert notes[-1] == "and 995 more like this"
    assert len(notes) == 12


@pytest.mark.parametrize("first", range(0, 3000, 500))
@pytest.mark.filterwarnings("error")
def test_whatever_is_in_a_file_it_is_read_or_refused(first: int, tmp_path: Path) -> None:
    """``make fuzz`` tries other files, for as long as one likes."""
    good = seeds()
    refusals = 0
    for seed in range(first, first + 500):
        chance = Random(seed)
        content = mutated(chance.choice(good), chance)
        said = read(content, tmp_path / "m.gltf", read_gltf)
        if said is not None:
            assert len(said) < 1000, seed
            refusals += 1
    assert 100 < refusals < 500


def test_the_files_that_are_changed_are_good(tmp_path: Path) -> None:
    for content in seeds():
        assert read(content, tmp_path / "m.gltf", read_gltf) is None


def test_a_limit_that_is_raised(tmp_path: Path) -> None:
    path = tmp_path / "m.gltf"
    whole = triangle().whole
    whole["nodes"] = [{"mesh": 0}] * 5000
    whole["scenes"] = [{"nodes": list(range(5000))}]
    path.write_text(json.dumps(whole))
    with raised({"objects": 5000}):
        assert len(read_gltf(path).objects) == 5000
    assert not issubclass(BudgetError, SceneError)
