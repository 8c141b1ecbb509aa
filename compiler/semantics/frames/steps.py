"""The steps of a frame: what each draws or computes, where to, and what it is given.

``frames.py`` asks for the slots of a frame in an order in which each stands behind those that it
needs. A step is checked where it is written, with all that it reads of others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import count

from ....frozen import changed, frozen, record
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.blending import REPLACES
from ...ir.frame import (
    DEPTH,
    Attachment,
    Drawn,
    Elements,
    FrameShader,
    FromHost,
    Image,
    ImageDimension,
    KernelStep,
    Previous,
    RenderStep,
    Size,
    Step,
    Use,
)
from ...ir.leaves import Attribute, Parameter, Resource
from ...ir.node import Node, reachable
from ...ir.shader import RenderTarget
from ...ir.stages import EXTENT, IMAGE, TARGET
from ...ir.types import INT, IVEC2
from ...syntax import ast
from ..checking.slots import slot
from ..checking.step_needs import PREVIOUS, SCREEN, Key, Need, applied, is_previous
from ..checking.unknown_names import unknown
from ..declarations.fitting import fit
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import FAILURE, OUTERMOST, Failure, Scope
from .around import WHOLE, Around, Owner, Place
from .bringing import Bringing
from .extents import SIZE, in_frame
from .inputs import Inputs, Later, Replacements, check_previous
from .settings import AREAS, Settings
from .shaders import Shaders, required_of
from .values import Made, Numbers, StepValue, on_host, report_not_left

CORNERS = 3
"""Its vertices."""
VERTICES = "vertices"
"""``vertices(n)``: as many as that, which have nothing but their numbers."""
BARE = ("point", "triangle")
"""What vertices without a mesh can make."""
FACES = 6
MOST_STEPS = 256
"""That one repetition may come to."""
DEEPEST = 48
"""How deep expressions about steps nest."""

DEPTH_FORMAT = "depth32f"


@frozen(eq=False)
class What:
    """What a pass draws: models with materials, or vertices without them."""

    models: str = ""
    materials: tuple[Symbol | None, ...] = (None,)
    vertices: int | None = None
    """The number of the value that says how many."""


@record
class ModelsOf:
    """Models that a frame declares, and the materials that they may have."""

    member: ast.Models
    materials: tuple[Symbol, ...]


class Steps:
    """Checks the steps of one frame, and keeps what they are."""

    def __init__(
        self,
        ctx: Context,
        frame: Owner,
        lights: Mapping[str, Owner],
        shaders: Shaders,
        models: Mapping[str, ModelsOf],
    ) -> None:
        """``lights`` are the single lights of the rig, by name."""
        self._ctx = ctx
        self._frame = frame
        self._bringing = Bringing(ctx, lights, self.check, self.made)
        self._shaders = shaders
        self._models = models
        self.numbers = Numbers()
        self.steps: list[Step] = []
        self._names: set[str] = set()
        self._previous: list[tuple[Previous, ast.Call, Around]] = []
        self._later: list[Later] = []

    def check(self, owner: Owner, needs: list[Need]) -> None:
        """Check steps that nobody has asked for yet, each behind those that it needs."""
        for key in owner.dependencies.ordered(needs):
            if key in owner.values:
                continue
            definition = owner.dependencies.definition(key)
            assert definition is not None and isinstance(definition.member, ast.Slot)
            written = definition.member.value
            assert written is not None
            scope = owner.scope(definition.owner, definition.level)
            name = f"{owner.name}.{key[0]}" if owner.name else key[0]
            owner.values[key] = self.made(written, Around(owner, scope, name))

    # --- expressions ---

    def made(self, e: ast.Expression, around: Around) -> Made:
        """What an expression about steps stands for; what is wrong with it has been reported."""
        if around.depth > DEEPEST:
            return self._no_step(e.span)
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
                return self._repeated(e, inside)
            case ast.Iterate():
                return self._iterated(e, inside)
        return self._no_step(e.span)

    def _no_step(self, span: Span) -> Failure:
        self._ctx.report.add(rules.NO_STEP, span)
        return FAILURE

    def _named(self, e: ast.Reference, around: Around) -> Made:
        if e.name in around.states:
            return around.states[e.name]
        if around.owner is self._frame and e.name in self._frame.instance.resources:
            return FromHost(e.name)
        return self._slot((e.name, OUTERMOST), e.span, around.owner)

    def _slot(self, key: Key, span: Span, owner: Owner) -> Made:
        if key in owner.values:
            return owner.values[key]
        definitions = owner.instance.record.definitions
        if key[0] in definitions and owner.dependencies.is_step(key):
            return FAILURE  # It needs itself, which has been reported.
        if key[0] in definitions:
            number = slot(self._ctx, owner.instance, key[0], span, key[1])
            return FAILURE if isinstance(number, Failure) else self._no_step(span)
        unknown(self._ctx, "step", key[0], span, [*definitions, *self._models])
        return FAILURE

    def _left(self, whole: Made, e: ast.Field) -> Made:
        """``step.target``: what a step leaves."""
        if isinstance(whole, Failure):
            return FAILURE
        if not isinstance(whole, StepValue):
            self._ctx.report.add(rules.NO_STEP, e.operand.span)
            return FAILURE
        found = whole.left.get(e.name.text)
        if found is None:
            what = f"result of `{whole.name}`"
            unknown(self._ctx, what, e.name.text, e.name.span, whole.left)
            return FAILURE
        return found

    def _previously(self, e: ast.Call, around: Around) -> Made:
        """``previous(step.target)``, which may be made later: it is looked up at the end."""
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
            if not isinstance(initial, Image | Elements | FromHost):
                return self._no_result(initial, e.arguments[1].span)
            found.initially = initial
        return found

    def settle_previous(self) -> None:
        """Find what all ``previous(…)`` mean, once every step is there."""
        for found, e, around in self._previous:
            left = self.made(e.arguments[0], around)
            if isinstance(left, Image | Elements):
                found.of = left
            else:
                self._no_result(left, e.arguments[0].span)
        check_previous(self._ctx, self._later)

    def _no_result(self, found: Made, span: Span) -> Failure:
        """Report that something is no result of a step, unless more has been said about it."""
        if not isinstance(found, Failure):
            report_not_left(self._ctx, found, span, "result of a step")
        return FAILURE

    def _chosen(self, e: ast.Conditional, around: Around) -> Made:
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

    # --- repetitions ---

    def _repeated(self, e: ast.Fold | ast.FoldOver, around: Around) -> Made:
        if isinstance(e, ast.Fold):
            turns = self._range(e.turns, around)
            return FAILURE if turns is None else self._layers(e, "2d_array", turns, around)
        over = e.over
        match over, e.operator:
            case ast.Reference(name="rig"), "sum":
                return self.made(e.body, changed(around, light=True))
            case ast.Reference(name="cube"), "each":
                return self._layers(e, "cube", range(FACES), around)
            case ast.Call(callee=ast.Reference(name="mips"), arguments=(most,)), "each":
                levels = self._integer(most, around)
                return FAILURE if levels is None else self._levels(e, levels, around)
        self._ctx.report.add(rules.NO_RANGE_OF_STEPS, over.span)
        return FAILURE

    def _layers(
        self,
        e: ast.Fold | ast.FoldOver,
        dimension: ImageDimension,
        turns: range,
        around: Around,
    ) -> Made:
        outer = around.place or Place()
        if outer.layers > 1:
            return self._no_step(e.span)
        variable = e.turns.variable if isinstance(e, ast.Fold) else e.variable
        made: Made = FAILURE
        for layer, turn in enumerate(turns):
            place = changed(
                outer, dimension=dimension, layers=len(turns), layer=layer,
                suffix=f"{outer.suffix}.{turn}",
            )  # fmt: skip
            made = self._turn(e.body, variable, turn, changed(around, place=place))
            if isinstance(made, Failure):
                return FAILURE
        return made

    def _levels(self, e: ast.FoldOver, levels: int, around: Around) -> Made:
        outer = around.place or Place()
        if outer.levels > 1:
            return self._no_step(e.span)
        made: Made = FAILURE
        for level in range(levels):
            place = changed(
                outer, levels=levels, level=level, suffix=f"{outer.suffix}.level{level}"
            )
            made = self._turn(e.body, e.variable, level, changed(around, place=place))
            if isinstance(made, Failure):
                return FAILURE
        return made

    def _turn(self, body: ast.Expression, variable: ast.Name, turn: int, around: Around) -> Made:
        number = build.constant(self._ctx.tree, INT, turn)
        local = {**around.scope.locals, variable.text: number} if variable.text else {}
        scope = changed(around.scope, locals=local or around.scope.locals)
        return self.made(body, changed(around, scope=scope))

    def _iterated(self, e: ast.Iterate, around: Around) -> Made:
        """``iterate s from first up to n : Step(screen) with { before = s.value }``."""
        turns = self._range(e.turns, around)
        if turns is None:
            return FAILURE
        if e.condition is not None:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, e.condition.span)
            return FAILURE
        state = self.made(e.initial, changed(around, name=f"{around.name}.first"))
        for number, turn in enumerate(turns):
            if isinstance(state, Failure):
                return FAILURE
            last = number == len(turns) - 1
            name = around.name if last else f"{around.name}.{number}"
            states = {**around.states, e.state.text: state}
            inner = changed(around, states=states, name=name)
            state = self._turn(e.body, e.turns.variable, turn, inner)
        return state

    def _range(self, turns: ast.Turns, around: Around) -> range | None:
        start, end = self._integer(turns.start, around), self._integer(turns.end, around)
        if start is None or end is None:
            return None
        if not 0 < end - start <= MOST_STEPS:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, turns.end.span)
            return None
        return range(start, end)

    def _integer(self, e: ast.Expression, around: Around) -> int | None:
        """A number that is known when compiling, 1 or more where it counts levels."""
        node = fit(self._ctx, node_of(self._ctx, e, around.scope), INT, "int", e.span)
        if isinstance(node, Failure):
            return None
        known = self._ctx.constants.known_integer(node)
        if known is None or known > MOST_STEPS:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, e.span)
            return None
        return known

    # --- steps ---

    def _applied(
        self,
        symbol: Symbol,
        e: ast.Call,
        given: Replacements,
        around: Around,
    ) -> Made:
        declaration = symbol.declaration
        assert isinstance(declaration, ast.Record)
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
        around: Around,
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
        use = self._use("", shader, symbol, inputs, e)
        if inputs.report_unknown(symbol.name) or use is None:
            return FAILURE
        size = self._extent(shader, use, name)
        images = {
            result.name: self._image(f"{name}.{result.name}", state, size, result.doc, e)
            for result in shader.shader.results_of(IMAGE)
            if (state := result.state) is not None
        }
        buffers = {
            info.buffer.name: Elements(f"{name}.{info.buffer.name}", info, info.doc, e.span)
            for info in shader.shader.written
        }
        self.steps.append(KernelStep(name, use, images, buffers, "", e.span))
        return StepValue(name, {**images, **buffers})

    def _extent(self, shader: FrameShader, use: Use, name: str) -> Size:
        """How large the images of a kernel are: a number of the frame, if it gives all that says
        so."""
        given = {each.name: each.source for each in use.given}
        tree, nodes = self._ctx.tree, self.numbers.nodes

        def number_of(parameter: Parameter) -> Node | None:
            source = given.get(parameter.name)
            return nodes[source] if isinstance(source, int) else None

        def size_of(resource: Resource) -> Node | None:
            source = given.get(resource.name)
            if isinstance(source, Previous):
                source = source.initially
            if isinstance(source, FromHost):
                read = self._frame.instance.resources[source.name]
                level = build.constant(tree, INT, 0)
                return tree.node("call", IVEC2, (read, level), SIZE)
            is_whole = isinstance(source, Image) and not source.size.level
            value = source.size.value if isinstance(source, Image) and is_whole else None
            return None if value is None else nodes[value]

        (extent,) = shader.shader.results_of(EXTENT)
        found = None if extent.value.type != IVEC2 else in_frame(
            tree, extent.value, number_of, size_of
        )  # fmt: skip
        if found is None:
            return Size(None, name)
        number = self.numbers.number(found)
        return Size(None, name) if isinstance(number, Failure) else Size(number)

    def _image(self, name: str, state: RenderTarget, size: Size, doc: str, e: ast.Call) -> Image:
        return Image(name, state.format, size, "2d", 1, 1, doc, e.span)

    def _draw(
        self,
        symbol: Symbol,
        e: ast.Call,
        given: Replacements,
        around: Around,
    ) -> Made:
        if not 1 <= len(e.arguments) <= 2:
            self._ctx.report.add(
                rules.STEP_ARGUMENTS, e.span, name=symbol.name, expected="one or two arguments",
                hint=f"write `{symbol.name}({next(iter(self._models), SCREEN)})`",
            )  # fmt: skip
            return FAILURE
        what = self._what(e.arguments[0], around.scope)
        place = around.place or Place()
        name = self._unique(around.name + place.suffix)
        within = changed(around, name=name, place=None, light=False)
        settings, given = Settings.parted(self._ctx, self.numbers, given, around.scope)
        inputs = self._inputs(given, within)
        draws = None if what is None else self._draws(symbol, what, inputs, e, around.light)
        over = self._where(e, changed(within, name=f"{name}.over"))
        if not draws or over is None or inputs.report_unknown(symbol.name):
            return FAILURE
        shader = draws[0].uses[0].shader
        step = self._step(name, shader, draws, over, settings, changed(around, place=place), e)
        if not settings.check(shader.shader, symbol.name, e.span):
            return FAILURE
        self.steps.append(step)
        return StepValue(around.name, self._all_left(step))

    @staticmethod
    def _all_left(step: RenderStep) -> dict[str, Image]:
        attachments = [*step.attachments, *([step.depth] if step.depth else [])]
        return {each.target: each.image for each in attachments}

    def _what(self, e: ast.Expression, scope: Scope) -> What | None:
        """What is drawn, by the first argument of a pass; ``None`` after reporting what is wrong
        with it."""
        name = e.name if isinstance(e, ast.Reference) else ""
        if name in self._models:
            materials = self._models[name].materials
            return What(name, materials) if materials else None
        tree = self._ctx.tree
        if name == SCREEN:
            return self._vertices(build.constant(tree, INT, CORNERS))
        match e:
            case ast.Call(callee=ast.Reference(name=called), arguments=(count,)):
                if called == VERTICES:
                    node = node_of(self._ctx, count, scope)
                    number = fit(self._ctx, node, INT, "int", count.span)
                    return self._vertices(on_host(self._ctx, number, count.span))
        known = [*self._models, SCREEN, f"{VERTICES}(n)"]
        hint = f"there is {', '.join(f'`{each}`' for each in known)}"
        if name and not self._models:
            hint += f"; models of the host's scene are declared by `models {name}`"
        self._ctx.report.add(rules.NOT_DRAWN, e.span, hint=hint)
        return None

    def _vertices(self, count: Node | Failure) -> What | None:
        number = self.numbers.number(count)
        return None if isinstance(number, Failure) else What(vertices=number)

    def _inputs(self, given: Replacements, around: Around) -> Inputs:
        def made(e: ast.Expression, name: str) -> Made:
            return self.made(
                e, changed(around, name=f"{around.name}.{name}", depth=around.depth + 1)
            )

        return Inputs(
            self._ctx, self._frame.instance, self.numbers, made, given, around.scope, self._later
        )

    def _draws(
        self,
        symbol: Symbol,
        what: What,
        inputs: Inputs,
        e: ast.Call,
        by_light: bool,
    ) -> list[Drawn] | None:
        """What a pass draws, one behind the other; ``None`` after reporting what is wrong."""
        rig = self._shaders.rig.declaration
        lights = rig.entries if by_light and isinstance(rig, ast.Rig) else (None,)
        draws = []
        for light in lights:
            uses = []
            for material in what.materials:
                shader = self._shaders.drawn(symbol, material, light)
                if shader is None or (light and not self._is_added(shader, symbol, e)):
                    return None
                if material is None and not self._is_bare(shader, symbol, e):
                    return None
                use = self._use(material.name if material else "", shader, symbol, inputs, e)
                if use is None:
                    return None
                uses.append(use)
            named = light.name.text if light else ""
            draws.append(Drawn(what.models, what.vertices, tuple(uses), named))
        return draws

    def _is_added(self, shader: FrameShader, symbol: Symbol, e: ast.Call) -> bool:
        """Whether what one light adds does not replace what others have."""
        for result in shader.shader.results_of(TARGET):
            if result.state is not None and result.state.blend == REPLACES:
                self._ctx.report.add(rules.NOT_ADDED, e.span, target=result.name, step=symbol.name)
                return False
        return True

    def _is_bare(self, shader: FrameShader, symbol: Symbol, e: ast.Call) -> bool:
        """Whether a shader can be drawn without a mesh."""
        span, step = e.arguments[0].span, symbol.name
        expansion = shader.shader.expansion
        primitive = expansion.primitive if expansion else "triangle"
        if shader.shader.tessellation:
            primitive = "patch"
        if primitive not in BARE:
            kinds = primitive.replace("_", " with ") + ("es" if primitive == "patch" else "s")
            self._ctx.report.add(rules.NO_SHARED_VERTICES, span, step=step, primitives=kinds)
            return False
        for node in reachable(shader.shader.roots):
            if isinstance(node.data, Attribute):
                self._ctx.report.add(rules.NO_VERTEX_INPUTS, span, step=step, input=node.data.name)
                return False
        return True

    def _use(
        self, material: str, shader: FrameShader, symbol: Symbol, inputs: Inputs, e: ast.Call
    ) -> Use | None:
        """A shader with what it is given; ``None`` after reporting what it lacks."""
        found = inputs.of(shader.shader)
        missing = inputs.lacks(required_of(self._ctx.records.of(symbol)))
        for name in missing:
            self._ctx.report.add(
                rules.INPUT_MISSING, e.span, step=symbol.name, name=name.text,
                labels=[Label(name.span, "declared here, without a default")],
            )  # fmt: skip
        brought = self._bringing.given(shader.shader, inputs, e)
        if found is None or brought is None or missing:
            return None
        return Use(material, shader, (*found, *brought))

    def _step(
        self,
        name: str,
        shader: FrameShader,
        draws: Sequence[Drawn],
        over: Mapping[str, Image] | Size,
        settings: Settings,
        around: Around,
        e: ast.Call,
    ) -> RenderStep:
        place = around.place or WHOLE
        layered = shader.shader.layers
        if layered:
            place = changed(place, dimension="cube" if layered == FACES else "2d_array",
                            layers=layered)  # fmt: skip
        given = over if isinstance(over, Mapping) else {}
        size = next(iter(given.values())).size if isinstance(over, Mapping) else over

        def attached(
            target: str, format_: str, doc: str, state: RenderTarget | float
        ) -> Attachment:
            behind = given.get(target)
            image = place.images.get(target)
            if image is None:
                image = Image(
                    f"{around.name}.{target}", format_, size, place.dimension, place.layers,
                    place.levels, doc, e.span,
                )  # fmt: skip
                place.images[target] = image
            if behind is not None and behind.format != format_:
                self._ctx.report.add(
                    rules.PLACES_DIFFER, e.span, first=behind.name, second=image.name,
                    reason=f"one is `{behind.format}`, the other `{format_}`",
                )  # fmt: skip
            clear = settings.cleared(target, state, e.span if behind is not None else None)
            layer = None if layered else place.layer
            return Attachment(target, image, layer, place.level, behind, clear)

        targets = tuple(
            attached(result.name, result.state.format, result.doc, result.state)
            for result in shader.shader.results_of(TARGET)
            if result.state is not None
        )
        state = shader.shader.render_state
        uses_depth = state.depth.is_used or state.stencil.is_used
        depth = attached(DEPTH, DEPTH_FORMAT, "", state.depth.clear) if uses_depth else None
        return RenderStep(
            name, shader.shader.pass_name, targets, depth, tuple(draws), "", e.span,
            *(settings.number(setting) for setting in AREAS),
        )  # fmt: skip

    def _where(self, e: ast.Call, around: Around) -> Mapping[str, Image] | Size | None:
        """Where to a pass draws: new images of a size, or over what others have left."""
        if len(e.arguments) == 1:
            return self._whole_size(e)
        written = e.arguments[1]
        parts = written.elements if isinstance(written, ast.Array) else (written,)
        if not all(self._is_step(part, around) for part in parts):
            return self._size(written, around.scope)
        found: dict[str, Image] = {}
        for number, part in enumerate(parts):
            left = self.made(part, changed(around, name=f"{around.name}{number or ''}"))
            if isinstance(left, Failure):
                return None
            if isinstance(left, StepValue):
                images = {n: i for n, i in left.left.items() if isinstance(i, Image)}
            elif isinstance(left, Image):
                images = {left.name.rpartition(".")[2]: left}
            else:
                self._no_result(left, part.span)
                return None
            for name in found.keys() & images.keys():
                reason = f"both are called `{name}`, and a pass draws over one of this name"
                self._differ(found[name], images[name], reason, part.span)
                return None
            found |= images
        first, *others = found.values()
        for other in others:
            if (other.dimension, other.layers) != (first.dimension, first.layers):
                self._differ(first, other, "they have different layers", written.span)
                return None
            one, two = self._known_size(first), self._known_size(other)
            if one and two and one != two:
                reason = f"one is {one[0]} x {one[1]}, the other {two[0]} x {two[1]}"
                self._differ(first, other, reason, written.span)
                return None
        return found

    def _differ(self, first: Image, second: Image, reason: str, span: Span) -> None:
        """Report that two results cannot be drawn over at once."""
        self._ctx.report.add(
            rules.PLACES_DIFFER, span, first=first.name, second=second.name, reason=reason
        )

    def _known_size(self, image: Image) -> tuple[int, int] | None:
        """The size of an image, if it is known when compiling."""
        if image.size.value is None:
            return None
        match self._ctx.constants.known(self.numbers.nodes[image.size.value]):
            case (int(width), int(height)):
                level = image.size.level
                return max(width >> level, 1), max(height >> level, 1)
        return None

    def _is_step(self, e: ast.Expression, around: Around) -> bool:
        """Whether an expression is about steps, and no number."""
        if applied(e, around.scope.module) is not None:
            return True
        while isinstance(e, ast.Field | ast.With):
            e = e.operand
        if isinstance(e, ast.Reference):
            named = (e.name, OUTERMOST)
            return e.name in around.states or around.owner.dependencies.is_step(named)
        return applied(e, around.scope.module) is not None

    def _whole_size(self, e: ast.Call) -> Size | None:
        """The size of what the host shows: the frame's own ``size``."""
        reference = ast.Reference(e.span, "size")
        frame = self._frame.instance
        return self._size(reference, Scope(frame.record.root.module, frame))

    def _size(self, written: ast.Expression, scope: Scope) -> Size | None:
        node = node_of(self._ctx, written, scope)
        if isinstance(node, Failure):
            return None
        if node.type == INT:
            node = build.splat(self._ctx.tree, node, 2)
        fitted = fit(self._ctx, node, IVEC2, "ivec2", written.span)
        number = self.numbers.number(on_host(self._ctx, fitted, written.span))
        return None if isinstance(number, Failure) else Size(number)

    def _unique(self, name: str) -> str:
        """A name that no step has yet."""
        names = (name if number == 1 else f"{name}.{number}" for number in count(1))
        found = next(each for each in names if each not in self._names)
        self._names.add(found)
        return found
