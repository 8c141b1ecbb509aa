"""The inputs that a frame gives a step by ``with``: numbers, textures and buffers.

``steps.py`` makes ``Inputs`` for each pass or kernel that a frame applies, and asks it for each
shader that this comes to: the same text means the same for all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from ....stdlib.builtins.facts import UNKNOWN
from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.nearest import nearest_in
from ...diagnostics.source import Span
from ...ir.frame import Elements, FromHost, Given, Previous, Source, StepTexture
from ...ir.shader import BufferInfo, ParameterInfo, Shader, TextureInfo
from ...ir.types import TextureType, Type
from ...syntax import ast
from ..checking.unknown_names import unknown
from ..declarations.contracts import as_declared
from ..names.duplicates import check_once
from ..shading.passes.render_states import of_a_pass
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import Failure, Instance, Scope
from ..types.typenames import Declared
from .samples import check_readable
from .shaders import Input, host_name, inputs_of
from .values import Made, Numbers, no_result, on_host

Replacements = Sequence[tuple[ast.Name, ast.Expression]]
"""The names behind ``with``, with their expressions."""

Later = tuple[Previous, Type, Span]
"""A result of the last frame, the type by which it is read, and the span of the read."""


def type_of(left: StepTexture | Elements) -> Type:
    """The type of texture or of buffer by which something is read that a step leaves."""
    if isinstance(left, Elements):
        return left.info.leaf.type
    return TextureType(left.dimension, "depth" if left.is_depth else "float")


class Inputs:
    """The inputs of one step."""

    def __init__(
        self,
        ctx: Context,
        instance: Instance,
        numbers: Numbers,
        made: Callable[[ast.Expression, str], Made],
        given: Replacements,
        scope: Scope,
        later: list[Later],
    ) -> None:
        """``made`` evaluates an expression about steps, for the input of this name.

        ``later`` gets the checks that need the results of the last frame.
        """
        self._ctx = ctx
        self._instance = instance
        self._numbers = numbers
        self._made = made
        self._given = given
        self._scope = scope
        self._known: dict[tuple[str, str], Source | Failure] = {}
        """Sources by the name of the input, and its declaration."""
        self._met: set[str] = set()
        self._seen: set[str] = set()
        """The names of all inputs there are."""
        self._later = later
        check_once(ctx.report, (name for name, _ in given))

    def of(self, shader: Shader) -> tuple[Given, ...] | None:
        """The inputs of a shader; ``None`` after reporting an error."""
        inputs = inputs_of(shader)
        leaves = (info.leaf for info in inputs.values())
        self._seen.update(
            leaf.short_name if leaf.owner == shader.pass_name else leaf.name for leaf in leaves
        )
        found: list[Given] = []
        for name, written in self._given:
            host = host_name(shader, name.text, inputs)
            if host is None:
                continue
            self._met.add(name.text)
            source = self._source(name.text, written, inputs[host])
            if isinstance(source, Failure):
                return None
            found.append(Given(host, source))
        return tuple(found)

    def sets(self, name: str) -> bool:
        """True if the step is given something of this name."""
        return any(name == given.text for given, _ in self._given)

    def lacks(self, required: Iterable[ast.Name]) -> list[ast.Name]:
        """The inputs among these that are not given, not even by a name that is misspelt.

        ``report_unknown`` says what a misspelt name was meant to be.
        """
        misspelt = {nearest_in(name.span.source, name.text, self._seen) for name in self._unmet()}
        return [name for name in required if not self.sets(name.text) and name.text not in misspelt]

    def _unmet(self) -> list[ast.Name]:
        """The names that no shader has as an input so far."""
        return [name for name, _ in self._given if name.text not in self._met]

    def report_unknown(self) -> bool:
        """True if some name is no input of any of the shaders, which is reported."""
        unmet = self._unmet()
        for name in unmet:
            if hint := of_a_pass(name.text):
                self._ctx.report.add(
                    rules.UNKNOWN_NAME, name.span, kind="input", name=name.text, hint=hint
                )
            else:
                unknown(self._ctx, "input", name.text, name.span, sorted(self._seen))
        return bool(unmet)

    def _source(self, name: str, written: ast.Expression, wanted: Input) -> Source | Failure:
        key = name, _declared(wanted)
        if key not in self._known:
            self._known[key] = self._found(name, written, wanted)
        return self._known[key]

    def _found(self, name: str, written: ast.Expression, wanted: Input) -> Source | Failure:
        if isinstance(wanted, ParameterInfo):
            return self._number(written, wanted)
        source = self._made(written, name)
        if isinstance(source, Failure):
            return source
        if isinstance(wanted, TextureInfo):
            return self.texture(source, written, wanted)
        return self._buffer(source, written, wanted)

    def _number(self, written: ast.Expression, wanted: ParameterInfo) -> Source | Failure:
        leaf = wanted.leaf
        declared = Declared(
            leaf.type, wanted.declared_type, changed(UNKNOWN, unit=leaf.fact.unit), leaf.meaning
        )
        value = node_of(self._ctx, written, self._scope)
        fitted = as_declared(self._ctx, value, declared, written, self._scope)
        return self._numbers.number(on_host(self._ctx, fitted, written.span))

    def texture(
        self, source: Made, written: ast.Expression, wanted: TextureInfo
    ) -> Source | Failure:
        """A result as the texture that a shader reads."""
        type_ = wanted.leaf.type
        assert isinstance(type_, TextureType)
        return self._read(source, written, type_, "texture")

    def _buffer(
        self, source: Made, written: ast.Expression, wanted: BufferInfo
    ) -> Source | Failure:
        return self._read(source, written, wanted.leaf.type, "buffer")

    def _read(
        self, source: Made, written: ast.Expression, wanted: Type, what: str
    ) -> Source | Failure:
        """A texture or a buffer as the type by which it is read."""
        if isinstance(source, Previous):
            self._later.append((source, wanted, written.span))
            initial = source.initially
            return (
                source if initial is None else self._fitting(source, initial, wanted, written, what)
            )
        if isinstance(source, StepTexture | Elements | FromHost):
            return self._fitting(source, source, wanted, written, what)
        return no_result(self._ctx, source, written.span, what)

    def _fitting(
        self,
        source: Source,
        read: StepTexture | Elements | FromHost,
        wanted: Type,
        written: ast.Expression,
        what: str,
    ) -> Source | Failure:
        if not check_readable(self._ctx.report, read, written.span):
            return Failure()
        found = (
            self._instance.bound[read.name].type if isinstance(read, FromHost) else (type_of(read))
        )
        if type(found) is not type(wanted):
            self._ctx.report.add(rules.NOT_LEFT, written.span, what=what)
            return Failure()
        return source if fits(self._ctx, found, wanted, written.span) else Failure()


def fits(ctx: Context, found: Type, wanted: Type, span: Span) -> bool:
    """True if something is of the type by which it is read; reported if not."""
    if found == wanted:
        return True
    ctx.report.add(
        rules.WRONG_TYPE, span, expected=str(wanted), found=str(found), caption=f"this is `{found}`"
    )
    return False


def check_previous(ctx: Context, later: Sequence[Later]) -> None:
    """Checks the types of the last frame's results, once these are known."""
    for source, wanted, span in later:
        if source.of is None:
            continue
        if isinstance(source.of, Elements) and source.initially is None:
            ctx.report.add(
                rules.NOTHING_BEFORE, span, name=source.of.name,
                hint=f"`previous({source.of.name}, first)`, where `first` is another buffer",
            )  # fmt: skip
        if check_readable(ctx.report, source.of, span):
            fits(ctx, type_of(source.of), wanted, span)


def _declared(wanted: Input) -> str:
    """The declaration of an input, by which equal ones are told."""
    match wanted:
        case ParameterInfo(declared_type=declared):
            return declared
        case TextureInfo(leaf=leaf) | BufferInfo(leaf=leaf):
            return str(leaf.type)
