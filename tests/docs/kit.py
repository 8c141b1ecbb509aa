"""The pages, and the fenced blocks in them.

What stands behind a block's language says how it is tried:

```burnish                       a whole file; one without a material gets an empty one
```burnish in-material           members of a material that imports the library's lights and terms
```burnish file=shared/x.burnish a whole file that later blocks and commands of the page can use
```burnish error=B0203           must fail with this code and no other
```burnish rig=R pass=P          compiled with that rig and pass
```burnish targets=glsl,hlsl     compiled for these instead of the default ones
```burnish error=B0203 as=clay   likewise, in a file that its message calls `clay.burnish`
```wgsl from=plastic:fragment    lines of the text that the example becomes; `…` stands for others
```glsl made                    lines that `generate` writes, and compares with the page
```json from=own_light            a row of the example's reflection; of `plastic`, if none is named
```text from=B0203               how the error of the block before is shown
```python                        run, together with the page's other ones, among the examples
```python comparer               a test with a comparer, which tests/comparers runs
```console picture=pictures/x.png the same; what `-o` names is that picture of the page's folder
```console                       lines that begin with `$ burnish` are run there as well; what is
                                 quoted below one is in what it prints, with `…` for other lines
```
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
PAGES = (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md")))

_FENCE = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block of a page."""

    page: Path
    line: int
    language: str
    marks: tuple[str, ...]
    """The words after the language."""
    text: str

    def __str__(self) -> str:
        return f"{self.page.name}:{self.line}"

    def value(self, key: str) -> str | None:
        """The text after ``key=``, or ``None``."""
        found = [mark.partition("=")[2] for mark in self.marks if mark.startswith(f"{key}=")]
        return found[0] if found else None


def blocks(page: Path, language: str) -> list[Block]:
    """The blocks of one language on a page, in order."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(page, text.count("\n", 0, m.start()) + 1, m[1], tuple(m[2].split()), m[3])
        for m in _FENCE.finditer(text)
        if m[1] == language
    ]


def all_blocks(language: str) -> list[Block]:
    """The blocks of one language on all pages."""
    return [block for page in PAGES for block in blocks(page, language)]
