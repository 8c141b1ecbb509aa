"""The steps of a frame: their draws or kernels, their destinations, and their inputs.

``frames.py`` asks for the slots of a frame in an order in which each stands behind those that it
needs. A step is checked where it is written, with all that it reads of others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import count

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.fixes import write
from ...diagnostics.source import Span
from ...ir import build
from ...ir.frame import (
    DEPTH,
    Attachment,
    Drawn,
    Elements,
    FrameShader,
    FromHost,
    KernelStep,
    Previous,
    RenderStep,
    Size,
    Step,
    StepTexture,
    Use,
)
from ...ir.leaves import Parameter, Texture, behind
from ...ir.node import Node
from ...ir.shader import RenderTarget, Result
from ...ir.stages import EXTENT, IMAGE, TARGET
from ...ir.types import INT, IVEC2
from ...syntax import ast
from ..checking.arguments import refuse_names
from ..checking.slots import slot
from ..checking.step_needs import PREVIOUS, SCREEN, Key, Need, applied, is_previous
from ..checking.unknown_names import unknown
from ..declarations.textures import DEFAULTS
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import FAILURE, OUTERMOST, Failure
from .destinations import Destinations
from .extents import SIZE, in_frame
from .inputs import Inputs, Later, Replacements, check_previous
from .light_textures import Bringing
from .pass_draws import Draws, ModelsOf
from .repetitions import FACES, Repetitions
from .samples import SampleChecks
from .settings import AREAS, Settings
from .shaders import Shaders
from .step_context import WHOLE, AttachmentPoint, EquationOwner, StepContext
from .values import Made, Numbers, StepValue, no_result, no_step

DEEPEST = 48
"""The limit of nesting of expressions about steps."""

MOST_STEPS = 1024
"""The largest number of steps of one frame.

The largest example has 52; planning and hosts look at each of them.
"""
MOST_TOGETHER = 4096
"""The largest number of steps of all frames of a compile."""

DEPTH_FORMAT = "depth32f"

OF_A_DEFAULT = (
    "`{0}` is what a texture is that nobody binds: `map plain : texture2d = {0}` in the frame "
    "declares one, which steps are given by its name"
)


class Steps:
    """Checks the steps of one frame, and keeps their values."""

    def __init__(
        self,
        ctx: Context,
        frame: EquationOwner,
        lights: Mapping[str, EquationOwner],
        shaders: Shaders,
        models: Mapping[str, ModelsOf],
    ) -> None:
        """``lights`` are the single lights of the rig, by name."""
        self._ctx = ctx
        self._frame = frame
        self._shaders = shaders
        self._models = models
        self.numbers = Numbers()
        bringing = Bringing(ctx, lights, self.check, self.made)
        self._repetitions = Repetitions(ctx, self.made)
        self._destinations = Destinations(ctx, frame.instance, self.numbers, self.made)
        self._drawn = Draws(ctx, shaders, models, self.numbers, bringing)
        self.steps: list[Step] = []
        self._names: set[str] = set()
        self._previous: list[tuple[Previous, ast.Call, StepContext]] = []
        self._later: list[Later] = []
        self._samples = SampleChecks(ctx.report)

    def check(self, owner: EquationOwner, needs: list[Need]) -> None:
        """Check steps that nobody has asked for yet, each behind those that it needs."""
        for key in owner.dependencies.ordered(needs):
            if key in owner.values:
                continue
            definition = owner.dependencies.definition(key)
            assert definition is not None and isinstance(definition.member, ast.Slot)
            written = definition.member.value
            assert written is not None
            scope = owner.scope(definition.owner, definition.level)
            name = behind(owner.name, key[0])
            owner.values[key] = self.made(written, StepContext(owner, scope, name))

    # --- expressions ---

    def made(self, e: ast.Expression, around: StepContext) -> Made:
        """The value of an expression about steps; errors have been reported."""
        if around.depth > DEEPEST:
            return no_step(self._ctx, e.span)
        inside = around.inside()
        symbol = applied(e, around.scope.module)
        if symbol is not None:
            assert isinstance(e, ast.Call)
            return self._applied(symbol, e, (), around)
        match e:
            case ast.With(operand=ast.Call() as call, replacements=given):
                symbol = applied(call, around.scope.module)
                if symbol is not None:
                    return self._applied(symbol, call, given, around)
            case ast.Reference():
                return self._named(e, around)
            case ast.Field(operand=ast.Reference(name="inherited")):
                return self._slot((e.name.text, around.scope.level + 1), e.span, around.owner)
            case ast.Field():
                return self._left(self.made(e.operand, inside), e)
            case ast.Call() if is_previous(e):
                return self._previously(e, inside)
            case ast.Conditional():
                return self._chosen(e, inside)
            case ast.FoldOver() | ast.Fold(operator="each"):
                return self._repetitions.repeated(e, inside)
            case ast.Iterate():
                return self._repetitions.iterated(e, inside)
        return no_step(self._ctx, e.span)

    def _named(self, e: ast.Reference, around: StepContext) -> Made:
        if e.name in around.states:
            return around.states[e.name]
        if around.owner is self._frame and e.name in self._frame.instance.bound:
            return FromHost(e.name)
        return self._slot((e.name, OUTERMOST), e.span, around.owner)

    def _slot(self, key: Key, span: Span, owner: EquationOwner) -> Made:
        if key in owner.values:
            return owner.values[key]
        definitions = owner.instance.record.definitions
        if key[0] in definitions and owner.dependencies.is_step(key):
            return FAILURE  # The step needs itself, which was reported.
        if key[0] in definitions:
            number = slot(self._ctx, owner.instance, key[0], span, key[1])
            return FAILURE if isinstance(number, Failure) else no_step(self._ctx, span)
        if key[0] in self._models:
            hint = f"models are drawn by a pass: `Pass({key[0]})` is a step"
            self._ctx.report.add(rules.NO_STEP, span, hint=hint)
            return FAILURE
        self._unknown_step(key[0], span, owner)
        return FAILURE

    def _unknown_step(self, name: str, span: Span, owner: EquationOwner) -> None:
        """Report a name that is neither a step nor something that the frame's host binds."""
        is_step = owner.dependencies.is_step
        known = [n for n in owner.instance.record.definitions if is_step((n, OUTERMOST))]
        if owner is self._frame:
            known += self._frame.instance.bound
            if name in DEFAULTS:
                hint = OF_A_DEFAULT.format(name)
                self._ctx.report.add(rules.UNKNOWN_NAME, span, kind="step", name=name, hint=hint)
                return
        unknown(self._ctx, "step", name, span, known)

    def _left(self, whole: Made, e: ast.Field) -> Made:
        """``step.target``: a result of a step."""
        if isinstance(whole, Failure):
            return FAILURE
        if not isinstance(whole, StepValue):
            self._ctx.report.add(rules.NO_STEP, e.operand.span)
            return FAILURE
        found = whole.left.get(e.name.text)
        if found is None:
            unknown(self._ctx, "result", e.name.text, e.name.span, whole.left)
            return FAILURE
        return found

    def _previously(self, e: ast.Call, around: StepContext) -> Made:
        """``previous(step.target)``, which may be made later: it is looked up at the end."""
        if refuse_names(self._ctx, e):
            return FAILURE
        if not 1 <= len(e.arguments) <= 2:
            self._ctx.report.add(
                rules.STEP_ARGUMENTS, e.span, name=PREVIOUS, expected="one or two arguments",
                hint=f"`{PREVIOUS}(step.target, first.target)`: the second is what is read in the "
                "first frame",
            )  # fmt: skip
            return FAILURE
        found = Previous()
        self._previous.append((found, e, around))
        if len(e.arguments) == 2:
            initial = self.made(e.arguments[1], changed(around, name=f"{around.name}.first"))
            if not isinstance(initial, StepTexture | Elements | FromHost):
                return no_result(self._ctx, initial, e.arguments[1].span)
            found.initially = initial
        return found

    def settle_previous(self) -> None:
        """Finds the values of all ``previous(…)``, once every step is there."""
        for found, e, around in self._previous:
            left = self.made(e.arguments[0], around)
            if isinstance(left, StepTexture | Elements):
                found.of = left
            else:
                no_result(self._ctx, left, e.arguments[0].span)
        check_previous(self._ctx, self._later)

    def _chosen(self, e: ast.Conditional, around: StepContext) -> Made:
        """``if`` between steps is decided when compiling."""
        condition = node_of(self._ctx, e.condition, around.scope)
        if isinstance(condition, Failure):
            return FAILURE
        known = self._ctx.constants.known(condition)
        if not isinstance(known, bool):
            self._ctx.report.add(
                rules.NO_STEP, e.condition.span,
                hint="which step is drawn is decided when compiling, by constants",
            )  # fmt: skip
            return FAILURE
        return self.made(e.then if known else e.otherwise, around)

    # --- steps ---

    def _applied(
        self,
        symbol: Symbol,
        e: ast.Call,
        given: Replacements,
        around: StepContext,
    ) -> Made:
        declaration = symbol.declaration
        assert isinstance(declaration, ast.Record)
        if not self._has_room() or refuse_names(self._ctx, e):
            return FAILURE
        if declaration.abstract:
            self._ctx.report.add(rules.ABSTRACT_USE, e.callee.span, name=symbol.name)
            return FAILURE
        if declaration.kind == "kernel":
            return self._run(symbol, e, given, around)
        return self._draw(symbol, e, given, around)

    def _run(
        self,
        symbol: Symbol,
        e: ast.Call,
        given: Replacements,
        around: StepContext,
    ) -> Made:
        if e.arguments:
            self._ctx.report.add(
                rules.STEP_ARGUMENTS, e.span, name=symbol.name, expected="no arguments"
            )
            return FAILURE
        shader = self._shaders.kernel(symbol)
        if shader is None:
            return FAILURE
        name = self._unique(around.name)
        inputs = self._inputs(given, changed(around, name=name))
        use = self._drawn.use("", shader, symbol, inputs, e)
        if inputs.report_unknown() or use is None:
            return FAILURE
        size = self._extent(shader, use, name)
        images = {
            result.name: self._image(name, result, state, size, e)
            for result in shader.shader.results_of(IMAGE)
            if (state := result.state) is not None
        }
        buffers = {
            info.leaf.name: Elements(name, info, info.doc, e.span) for info in shader.shader.written
        }
        self._add(KernelStep(name, use, images, buffers, "", e.span))
        return StepValue(name, {**images, **buffers})

    def _extent(self, shader: FrameShader, use: Use, name: str) -> Size:
        """The size of a kernel's images: a number of the frame, if it gives all that it needs."""
        given = {each.name: each.source for each in use.given}
        tree, nodes = self._ctx.tree, self.numbers.nodes

        def number_of(parameter: Parameter) -> Node | None:
            source = given.get(parameter.name)
            return nodes[source] if isinstance(source, int) else None

        def size_of(texture: Texture) -> Node | None:
            source = given.get(texture.name)
            if isinstance(source, Previous):
                source = source.initially
            if isinstance(source, FromHost):
                read = self._frame.instance.bound[source.name]
                level = build.constant(tree, INT, 0)
                return tree.node("call", IVEC2, (read, level), SIZE)
            is_whole = isinstance(source, StepTexture) and not source.size.level
            value = source.size.value if isinstance(source, StepTexture) and is_whole else None
            return None if value is None else nodes[value]

        (extent,) = shader.shader.results_of(EXTENT)
        found = None if extent.value.type != IVEC2 else in_frame(
            tree, extent.value, number_of, size_of
        )  # fmt: skip
        if found is None:
            return Size(None, name)
        number = self.numbers.number(found)
        return Size(None, name) if isinstance(number, Failure) else Size(number)

    def _image(
        self, step: str, result: Result, state: RenderTarget, size: Size, e: ast.Call
    ) -> StepTexture:
        """An image that a kernel leaves."""
        return StepTexture(step, result.name, state.format, size, "2d", 1, 1, result.doc, e.span)

    def _draw(
        self,
        symbol: Symbol,
        e: ast.Call,
        given: Replacements,
        around: StepContext,
    ) -> Made:
        if not 1 <= len(e.arguments) <= 2:
            self._ctx.report.add(
                rules.STEP_ARGUMENTS, e.span, name=symbol.name, expected="one or two arguments",
                hint=write(e.span, f"{symbol.name}({next(iter(self._models), SCREEN)})"),
            )  # fmt: skip
            return FAILURE
        what = self._drawn.what(e.arguments[0], around.scope)
        place = around.place or AttachmentPoint()
        name = self._unique(around.name + place.suffix)
        within = changed(around, name=name, place=None, light=False)
        settings, given = Settings.parted(self._ctx, self.numbers, given, around.scope)
        inputs = self._inputs(given, within)
        draws = None if what is None else self._drawn.draws(symbol, what, inputs, e, around.light)
        over = self._destinations.of(e, changed(within, name=f"{name}.over"))
        if not draws or over is None or inputs.report_unknown():
            return FAILURE
        shader = draws[0].uses[0].shader
        step = self._step(name, shader, draws, over, settings, changed(around, place=place), e)
        first = step.drawn_to[0]
        if not self._destinations.check_size(first.image, e.span):
            return FAILURE
        size = first.image.size
        sides = self._destinations.known_size(size, size.level + first.level)
        if not settings.check(shader.shader, symbol.name, e.span, sides):
            return FAILURE
        self._add(step)
        return StepValue(around.name, self._all_left(step))

    def _add(self, step: Step) -> None:
        self.steps.append(step)
        self._ctx.records.work.steps += 1

    def _has_room(self) -> bool:
        """True if there may be one more step; if not, that has been reported."""
        if len(self.steps) >= MOST_STEPS:
            most = f"{MOST_STEPS} steps"
        elif self._ctx.records.work.steps >= MOST_TOGETHER:
            most = f"{MOST_TOGETHER} steps together with the frames before it"
        else:
            return True
        name = self._frame.instance.record.symbol.declaration.name
        self._ctx.report.add(rules.TOO_MANY_STEPS, name.span, name=name.text, most=most)
        return False

    @staticmethod
    def _all_left(step: RenderStep) -> dict[str, StepTexture]:
        return {each.target: each.image for each in step.drawn_to}

    def _inputs(self, given: Replacements, around: StepContext) -> Inputs:
        def made(e: ast.Expression, name: str) -> Made:
            return self.made(
                e, changed(around, name=behind(around.name, name), depth=around.depth + 1)
            )

        return Inputs(
            self._ctx, self._frame.instance, self.numbers, made, given, around.scope, self._later
        )

    def _step(
        self,
        name: str,
        shader: FrameShader,
        draws: Sequence[Drawn],
        over: Mapping[str, StepTexture] | Size,
        settings: Settings,
        around: StepContext,
        e: ast.Call,
    ) -> RenderStep:
        place = around.place or WHOLE
        layered = shader.shader.layers
        if layered:
            place = changed(place, dimension="cube" if layered == FACES else "2d_array",
                            layers=layered)  # fmt: skip
        state = shader.shader.render_state
        samples = state.samples
        given = over if isinstance(over, Mapping) else {}
        size = next(iter(given.values())).size if isinstance(over, Mapping) else over

        def attached(
            target: str, format_: str, doc: str, state: RenderTarget | float
        ) -> Attachment:
            drawn_over = given.get(target)
            image = place.images.get(target)
            if image is None:
                image = StepTexture(
                    around.name, target, format_, size, place.dimension, place.layers,
                    place.levels, doc, e.span, samples,
                )  # fmt: skip
                place.images[target] = image
            if drawn_over is not None and drawn_over.format != format_:
                self._ctx.report.add(
                    rules.PLACES_DIFFER, e.span, first=drawn_over.name, second=image.name,
                    reason=f"one is `{drawn_over.format}`, the other `{format_}`",
                )  # fmt: skip
            clear = settings.cleared(target, state, e.span if drawn_over is not None else None)
            layer = None if layered else place.layer
            return Attachment(target, image, layer, place.level, drawn_over, clear)

        targets = tuple(
            attached(result.name, result.state.format, result.doc, result.state)
            for result in shader.shader.results_of(TARGET)
            if result.state is not None
        )
        uses_depth = state.depth.is_used or state.stencil.is_used
        if uses_depth and any(target.target == DEPTH for target in targets):
            self._ctx.report.add(rules.TWO_DEPTHS, e.span, step=name)
        depth = attached(DEPTH, DEPTH_FORMAT, "", state.depth.clear) if uses_depth else None
        step = RenderStep(
            name, shader.shader.pass_name, targets, depth, tuple(draws), "", e.span,
            *(settings.number(setting) for setting in AREAS),
        )  # fmt: skip
        self._samples.check(step.drawn_to, samples, e.span)
        return step

    def _unique(self, name: str) -> str:
        """A name that no step has yet."""
        names = (name if number == 1 else f"{name}.{number}" for number in count(1))
        found = next(each for each in names if each not in self._names)
        self._names.add(found)
        return found
