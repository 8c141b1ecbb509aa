"""The list of actions: what it declares is all that a command needs, and digests are Bazel's."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from jsonschema import Draft202012Validator

from burnish.compiler.documents.actions import BuildActions
from burnish.compiler.documents.schema import json_schema
from burnish.compiler.watching import VARIABLE

from .build_kit import FILES, LINE, TONES, write_project
from .kit import invoke, shell, tree

FIELDS: Mapping[str, Sequence[tuple[str, int, str]]] = {
    "Digest": [("hash", 1, "string"), ("size_bytes", 2, "int64")],
    "Named": [("name", 1, "string"), ("value", 2, "string")],
    "Platform": [("properties", 1, "Named*")],
    "Command": [
        ("arguments", 1, "string*"), ("environment_variables", 2, "Named*"),
        ("platform", 5, "Platform"), ("output_paths", 7, "string*"),
    ],
    "Node": [("name", 1, "string"), ("digest", 2, "Digest")],
    "Directory": [("files", 1, "Node*"), ("directories", 2, "Node*")],
    "Action": [
        ("command_digest", 1, "Digest"), ("input_root_digest", 2, "Digest"),
        ("platform", 10, "Platform"),
    ],
}  # fmt: skip
"""The fields of messages of the Remote Execution API 2 that a build fills in: name, number, type,
and a star where there may be several. Files and folders in a folder have the same two."""


def messages() -> Mapping[str, Any]:
    """The classes of these messages, by Google's package."""
    file = descriptor_pb2.FileDescriptorProto(name="api.proto", package="api", syntax="proto3")
    kinds = descriptor_pb2.FieldDescriptorProto
    plain = {"string": kinds.TYPE_STRING, "int64": kinds.TYPE_INT64}
    for name, fields in FIELDS.items():
        message = file.message_type.add(name=name)
        for field, number, written in fields:
            kind = written.removesuffix("*")
            message.field.add(
                name=field, number=number, type=plain.get(kind, kinds.TYPE_MESSAGE),
                label=kinds.LABEL_REPEATED if written.endswith("*") else kinds.LABEL_OPTIONAL,
                type_name=None if kind in plain else f".api.{kind}",
            )  # fmt: skip
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return {
        name: message_factory.GetMessageClass(pool.FindMessageTypeByName(f"api.{name}"))
        for name in FIELDS
    }


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    write_project(tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    return tmp_path / "project"


def listed(*arguments: object) -> Any:
    """The document about some files."""
    done = invoke("build", *arguments, *LINE, "--actions")
    assert (done.exit_code, done.stderr) == (0, "")
    return json.loads(done.stdout)


def test_a_new_file_changes_one_batch_and_none_of_the_others() -> None:
    names = [f"m{number:02}.burnish" for number in range(40)]
    for name in names:
        Path(name).write_text(FILES["materials/c.burnish"])
    before = [each["inputs"] for each in listed(*names, "--batch", 5)["actions"]]
    assert 3 < len(before) < 20
    assert [each["path"] for inputs in before for each in inputs] == names
    Path("m17b.burnish").write_text(FILES["materials/c.burnish"])
    names.insert(18, "m17b.burnish")
    after = [each["inputs"] for each in listed(*names, "--batch", 5)["actions"]]
    assert sum(each not in before for each in after) in (1, 2), "it may end a batch"
    assert [each["path"] for inputs in after for each in inputs] == names


def digests(document: Any) -> dict[str, str]:
    return {action["name"]: action["digest"]["hash"] for action in document["actions"]}


def test_the_document_follows_its_schema_and_nothing_is_built() -> None:
    document = listed(".")
    Draft202012Validator(json_schema(BuildActions)).validate(document)
    assert len(document["actions"]) == 5
    assert not Path("build").exists()
    assert invoke("build", ".", *LINE, "--actions", "--to", "a.json").exit_code == 0
    assert json.loads(Path("a.json").read_text()) == document


def test_an_import_changes_the_digests_of_those_that_read_it(project: Path) -> None:
    before = digests(listed("."))
    assert len(set(before.values())) == 5
    Path(TONES).write_text(FILES[TONES].replace("0.5", "0.7"))
    after = digests(listed("."))
    changed = {name for name in before if before[name] != after[name]}
    assert changed == {"materials/a", "materials/b"}
    Path(TONES).write_text(FILES[TONES])
    assert digests(listed(".")) == before
    Path("link.burnish").symlink_to(project / TONES)
    Path(TONES).unlink()
    Path("link.burnish").rename(TONES)
    (project / "elsewhere.burnish").write_text(FILES[TONES])
    Path(TONES).unlink()
    Path(TONES).symlink_to(project / "elsewhere.burnish")
    assert digests(listed("materials"))["materials/a"] == before["materials/a"], "by contents"


def test_digests_depend_on_no_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    here = listed(".")
    shutil.copytree(".", tmp_path / "other" / "place")
    monkeypatch.chdir(tmp_path / "other" / "place")
    assert listed(".") == here


def test_digests_are_those_of_messages(project: Path) -> None:
    """Google's package makes the same bytes of the same fields."""
    kinds = messages()
    document = listed("materials", "--program", "python3 -m burnish")
    for action in document["actions"]:
        named = [kinds["Named"](**each) for each in action["platform"]]
        platform = kinds["Platform"](properties=named)
        assert action["arguments"][:4] == ["python3", "-m", "burnish", "compile"]
        files = {each["path"]: kinds["Digest"](**each["digest"]) for each in action["inputs"]}
        for path, digest in files.items():
            assert digest.hash == sha256((project / path).read_bytes()).hexdigest()
        command = kinds["Command"](
            arguments=action["arguments"], output_paths=action["outputs"], platform=platform
        )
        made = kinds["Action"](
            command_digest=kinds["Digest"](**action["command_digest"]),
            input_root_digest=kinds["Digest"](**action["input_root_digest"]),
            platform=platform,
        )
        for message, digest in (
            (command, action["command_digest"]),
            (folder(kinds, files, ""), action["input_root_digest"]),
            (made, action["digest"]),
        ):
            content = message.SerializeToString(deterministic=True)
            assert digest == {
                "hash": sha256(content).hexdigest(), "size_bytes": len(content),
            }  # fmt: skip


def folder(kinds: Mapping[str, Any], files: Mapping[str, Any], above: str) -> Any:
    """The message of a folder, whose name ends with a slash."""
    inner = sorted(path.removeprefix(above) for path in files if path.startswith(above))
    found = kinds["Directory"]()
    for name in inner:
        if "/" not in name:
            found.files.add(name=name, digest=files[above + name])
    for name in sorted({name.partition("/")[0] for name in inner if "/" in name}):
        content = folder(kinds, files, f"{above}{name}/").SerializeToString(deterministic=True)
        digest = kinds["Digest"](hash=sha256(content).hexdigest(), size_bytes=len(content))
        found.directories.add(name=name, digest=digest)
    return found


@pytest.mark.parametrize("batch", [1, 1000])
def test_a_command_needs_no_more_than_its_inputs(batch: int, tmp_path: Path) -> None:
    """It runs in a folder that has nothing else, and writes nothing but its outputs.

    The largest batches have all files in one, unless a digest happens to end one.
    """
    actions = listed("materials", "--batch", batch)["actions"]
    assert len(actions) == (5 if batch == 1 else 1)
    action, place = actions[0], tmp_path / "machine"
    for each in action["inputs"]:
        (place / each["path"]).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(each["path"], place / each["path"])
    done = shell(*action["arguments"][1:], folder=place)
    assert (done.returncode, done.stderr) == (0, "")
    written = {path for path in tree(place) if (place / path).is_file()}
    written -= {each["path"] for each in action["inputs"]}
    assert {str(Path(path).parent) for path in written} == set(action["outputs"])
    assert len(written) == 3 * len(action["outputs"])


def test_compilers_of_others_are_part_of_what_a_machine_has() -> None:
    own, with_tools = (
        listed("materials/c.burnish", *options)["actions"][0] for options in ((), ("--validate",))
    )
    assert [each["name"] for each in own["platform"]] == ["burnish"]
    assert [each["name"] for each in with_tools["platform"]] == ["burnish", "compilers"]
    assert re.search(r"\bglslang \d+\.\d+", with_tools["platform"][1]["value"])
    assert own["digest"] != with_tools["digest"]


def test_what_other_machines_cannot_have_is_told(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "tones.burnish").write_text(FILES[TONES])
    Path("near.burnish").write_text(
        'import "tones.burnish".{tone}\nmaterial N { color = vec3(tone(1)) }\n'
    )
    far = tmp_path / "far"
    done = invoke("build", "near.burnish", "-I", far, "-t", "wgsl", "--actions")
    assert (done.exit_code, done.stdout) == (1, "")
    assert done.stderr == (
        f"error: `{far}/tones.burnish` lies outside of this folder, and other machines get only "
        "what is in it: run `burnish build` in a folder that has all of its files\n"
    )
    done = invoke("build", "materials/c.burnish", "-o", tmp_path / "out", "--actions")
    assert (done.exit_code, done.stdout) == (1, "")
    assert "name a folder below it with -o" in done.stderr
