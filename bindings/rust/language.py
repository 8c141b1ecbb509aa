"""Describes Rust as a language of hosts."""

from __future__ import annotations

from pathlib import Path

from ..folding import Style
from ..host_language import HostLanguage
from ..naming import pascal, screaming, snake
from ..spelling import Manner
from .functions import FUNCTIONS
from .printer import RustPrinter
from .texts import texts

_KEYWORDS = """
    abstract as async await become box break const continue crate do dyn else enum extern false
    final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self
    Self static struct super trait true try type typeof union unsafe unsized use virtual where
    while yield _
"""
_OF_SKELETON = """
    Attachment Binding Block Blocks Box Buffer Bytes Default Err FrameBuffer FrameTable FrameHost
    FrameTexture Kept Kind Lanes MATERIALS Material NAMES NamedBinding None Ok Option Pass Place
    Profile PulledInput Resource Result Sampler Some Source StencilLoad Target Text Texture Use Vec
    VertexInput Written columns has_length_one of_shader value_of
"""
"""Words of the skeleton and of the prelude; types, variables and modules are apart in Rust."""

LANGUAGE = HostLanguage(
    name="rust",
    title="Rust",
    extension="rs",
    skeleton=Path(__file__).with_name("binding.rs.j2"),
    printer=RustPrinter,
    texts=texts,
    style=Style(comments=("///", "//"), last_comma=True),
    manner=Manner(
        reserved=frozenset((*_KEYWORDS.split(), *_OF_SKELETON.split(), *FUNCTIONS)),
        type_case=pascal,
        function_case=snake,
        value_case=snake,
        constant_case=screaming,
    ),
)
