"""``burnish corpus`` writes all of its files or none, and says what it cannot do."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from .kit import invoke, tree


def test_files(tmp_path: Path) -> None:
    folder = tmp_path / "a" / "corpus"
    result = invoke("corpus", "--only", "sqrt, /", "--only", "and", "-o", folder)
    assert result.exit_code == 0, result.output
    assert tree(folder) == {"index.json", "div.json", "and.json", "sqrt.json"}
    size = sum(path.stat().st_size for path in folder.iterdir())
    assert result.stdout == f"3 operations, {size / 1e6:.1f} MB: {folder / 'index.json'}\n"
    index = json.loads((folder / "index.json").read_text("utf-8"))
    assert [row["name"] for row in index["operations"]] == ["div", "and", "sqrt"]
    for row in index["operations"]:
        document = json.loads((folder / row["file"]).read_text("utf-8"))
        assert document["name"] == row["name"]
        assert sum(len(each["cases"]) for each in document["overloads"]) == row["cases"]


def test_a_sign_of_two_operations(tmp_path: Path) -> None:
    invoke("corpus", "--only", "-", "-o", tmp_path)
    assert tree(tmp_path) == {"index.json", "sub.json", "neg.json"}


def test_by_default_it_has_its_own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    invoke("corpus", "--only", "not")
    assert tree(tmp_path) == {"corpus", "corpus/index.json", "corpus/not.json"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--only", "sqart"), "there is no operation 'sqart': did you mean `sqrt`?"),
        (("--only", "texture"), "there is no operation 'texture': docs/builtins.md lists them"),
        (("--only", "ddx"), "there is no operation 'ddx'"),
        (("--only", " , "), "it names no operation"),
        (("--seed", "-1"), "-1 is not in the range"),
        (("extra",), "Got unexpected extra argument (extra)"),
    ],
)
def test_misuse(arguments: tuple[str, ...], message: str, tmp_path: Path) -> None:
    result = invoke("corpus", *arguments, "-o", tmp_path / "out")
    assert result.exit_code == 2
    assert message in result.stderr
    assert tree(tmp_path) == set()


def test_a_folder_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    result = invoke("corpus", "--only", "not", "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "is a file, not a folder" in result.stderr
    assert (tmp_path / "out").read_text() == "mine"


def test_all_or_nothing(tmp_path: Path) -> None:
    (tmp_path / "sqrt.json").mkdir()
    (tmp_path / "index.json").write_text("old")
    result = invoke("corpus", "--only", "sqrt,not", "-o", tmp_path)
    assert result.exit_code == 1
    assert "sqrt.json" in result.stderr
    assert tree(tmp_path) == {"sqrt.json", "index.json"}
    assert (tmp_path / "index.json").read_text() == "old"


@pytest.mark.parametrize("name", ["index", "not"])
def test_files_follow_the_printed_schema(name: str, tmp_path: Path) -> None:
    invoke("corpus", "--only", "not", "-o", tmp_path)
    printed = invoke("schema", "corpus_index" if name == "index" else "corpus")
    document = json.loads((tmp_path / f"{name}.json").read_text("utf-8"))
    assert list(Draft202012Validator(json.loads(printed.stdout)).iter_errors(document)) == []
    other = invoke("schema", "corpus" if name == "index" else "corpus_index")
    assert list(Draft202012Validator(json.loads(other.stdout)).iter_errors(document))
