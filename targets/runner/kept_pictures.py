"""Keeps what the reference has drawn, under the rules on which it depends.

Drivers differ in the rules by which triangles become pixels, but most pictures depend on few of
these. So what was drawn for one driver serves another one, too, if both agree on the rules that
have counted. ``reference.py`` keeps pictures of single shaders so, and
``conformance/frame_pictures.py`` those of frames.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

from ...compiler.reference.picture import Counted, RasterRules
from .store import Store


class KeptPictures(Protocol):
    """Pictures that the reference has drawn."""

    @property
    def counted(self) -> Counted:
        """The rare rules on which they depend."""


T = TypeVar("T", bound=KeptPictures)
Rules = RasterRules | Sequence[object]
"""The rules under which pictures are kept: all of them, or the common ones."""


def kept(
    store: Store,
    rules: RasterRules,
    name: Callable[[Rules], str],
    make: Callable[[], T],
    *,
    dumped: Callable[[T], bytes],
    loaded: Callable[[bytes], T],
) -> T:
    """The pictures that ``make`` draws, from the store if they were drawn before.

    They are kept under the rules on which most pictures depend. If those that are kept there depend
    on rarer ones, which differ from these ``rules``, then they are kept under all of them. ``name``
    makes a digest of some rules, and of everything else that the pictures depend on.
    """
    for by in (sorted(rules.common), rules):
        data = store.read(name(by))
        if data is None:
            break
        pictures = loaded(data)
        if rules.agree_with(pictures.counted):
            return pictures
    made = make()
    store.write(name(by), dumped(made))
    return made
