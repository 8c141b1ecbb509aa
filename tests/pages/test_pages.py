"""Every mark on every page of this folder is true, and a page that says something wrong fails.

CONTRIBUTING.md says how to add a page.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from .claims import untrue
from .marks import BadPageError, programs
from .values import is_value

PAGES = sorted(Path(__file__).parent.glob("*.md"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page(page: Path) -> None:
    found = untrue(page)
    assert not found, "\n".join(["this is not true:", *found])


def written_page(folder: Path, program: str, language: str = "burnish") -> Path:
    """A page with one program, the first line of which is the page's line 4."""
    page = folder / "page.md"
    page.write_text(f"# Page\n\n```{language}\n{program}```\n", encoding="utf-8")
    return page


WRONG = """\
material M {
    number  = 3 + 4         // = 8
    lanes   = vec2(1, 2)    // = (1, 3)
    shape   = vec2(1, 2)    // = 1
    type    = uv            // : vec3
    both    = #fff          // : vec3 = (1, 1, 0)
    unknown = uv.x          // = 0.5
    wrong   = uv.z          // = 7
    nowhere                 // = 7
            = 7
    right   = 7             // B0302
    silent  = uv.w
}
"""
FOUND = """\
page.md:5: `number` is 7, and not 8
page.md:6: `lanes` is (1, 2), and not (1, 3)
page.md:7: `shape` is (1, 2), and not 1
page.md:8: `type` is `vec2`, and not `vec3`
page.md:9: `both` is `rgb`, and not `vec3`
page.md:9: `both` is (1, 1, 1), and not (1, 1, 0)
page.md:10: `unknown` has no value here: it reads what a host or a mesh gives
page.md:11: `wrong` has no type and no value, because it is wrong
page.md:12: no equation of a material ends on this line, so the mark is about nothing
page.md:11: no mark says that this is reported here:
error[B0304]: vec2 has no member `z`
 --> <text>:8:18
  |
8 |     wrong   = uv.z          // = 7
  |                  ^
  = help: its lanes are `xy`, or `rg`: up to four of them, and not mixed
page.md:14: B0302 is not reported here
page.md:15: no mark says that this is reported here:
error[B0304]: vec2 has no member `w`
  --> <text>:12:18
   |
12 |     silent  = uv.w
   |                  ^
   = help: its lanes are `xy`, or `rg`: up to four of them, and not mixed"""


def test_what_is_not_true_is_told_with_its_place(tmp_path: Path) -> None:
    assert "\n".join(untrue(written_page(tmp_path, WRONG))) == FOUND


def test_each_code_stands_for_one_report(tmp_path: Path) -> None:
    program = "material M { a = uv.z + uv.w // B0304\n}\n"
    (message,) = untrue(written_page(tmp_path, program))
    assert message.startswith("page.md:4: no mark says that this is reported here:\nerror[B0304]")
    assert not untrue(written_page(tmp_path, program.replace("B0304", "B0304, B0304")))


@pytest.mark.parametrize(
    ("program", "language", "message"),
    [
        ("material M { }\n", "burnish",
         "page.md:3: this program has no mark, so nothing of it would be tested"),
        ("1 + 1\n", "python", "page.md:3: the blocks of a page are marked `burnish`, not `python`"),
        ("a = 7 // is 7\n", "burnish",
         "page.md:4: `// is 7` is no mark such as `// : vec3`, `// = 7` or `// B0302`"),
        ("a = 7 //\n", "burnish",
         "page.md:4: `//` is no mark such as `// : vec3`, `// = 7` or `// B0302`"),
        ("a = 7 // = 7\n```\n\n```burnish\n", "burnish",
         "page.md:7: this program has no mark, so nothing of it would be tested"),
    ],
)  # fmt: skip
def test_pages_that_would_not_be_tested_are_refused(
    tmp_path: Path, program: str, language: str, message: str
) -> None:
    with pytest.raises(BadPageError) as caught:
        untrue(written_page(tmp_path, program, language))
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("# Only prose\n", "page.md: there is no program on this page"),
        ("```burnish\nmaterial M { a = 7 // = 8\n}\n", "page.md:1: this block is never closed"),
        ("~~~burnish\n}\n~~~\n", "page.md: there is no program on this page"),
    ],
)  # fmt: skip
def test_programs_that_would_not_be_found_are_refused(
    tmp_path: Path, text: str, message: str
) -> None:
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    with pytest.raises(BadPageError) as caught:
        programs(page)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("claimed", "value", "expected"),
    [
        ("7", (7,), True),
        ("7", (7.0,), True),
        ("7", (7.1,), False),
        ("7", (True,), False),
        ("1", (True,), False),
        ("true", (True,), True),
        ("true", (1,), False),
        ("false", (True,), False),
        ("1.41…", (1.4142,), True),
        ("1.41…", (1.42,), False),
        ("1.41…", (1.4099,), False),
        ("-1.41…", (-1.4142,), True),
        ("-1.41…", (1.4142,), False),
        ("0.…", (0.9,), True),
        ("1e-3", (0.001,), True),
        ("1e20", (1e20 + 1e5,), True),
        ("1e20", (1.001e20,), False),
        ("(1, 2)", (1, 2), True),
        ("(1,2)", (1, 2), True),
        ("(2, 1)", (1, 2), False),
        ("(1, 2)", (1, 2, 3), False),
        ("((1, 0), (0, 1))", ((1, 0), (0, 1)), True),
        ("(1, 0, 0, 1)", ((1, 0), (0, 1)), False),
        ("(1, 2)", ((1,), (2,)), True),
        ("seven", (7,), False),
        ("7 or so", (7,), False),
    ],
)
def test_values_of_marks(
    claimed: str, value: tuple[float | tuple[float, ...], ...], expected: bool
) -> None:
    assert is_value(claimed, value) is expected
