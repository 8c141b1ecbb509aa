"""Bindings in TypeScript: tsc accepts them when it is strict, and node runs what it makes of them.

One program has the blocks of all examples. It reads values, and writes the bytes of each block.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import pytest

import burnish
from burnish.bindings import registry
from burnish.bindings.fields import Field, Structure
from burnish.bindings.model import Block
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import deriving, spelling_of, written
from burnish.bindings.writing import drawing as drawing_of
from burnish.targets.toolchain.tools import program

from ..suite.processes import run
from .calls import ROUNDS, every_builtin, expected, is_close, operands, stored
from .frame_calls import Drawing, drawings, wrong
from .kit import (
    ELSEWHERE,
    EXAMPLES,
    PLASTIC,
    UNFIT_BY_NAME,
    Sample,
    defaults,
    difference,
    everything,
    reflections,
    samples,
)

pytestmark = pytest.mark.xdist_group("bindings")

_OPTIONS = {
    "target": "es2022",
    "module": "es2022",
    "moduleResolution": "bundler",
    "lib": ["es2022", "dom"],
    "types": [],
    "strict": True,
    "noUncheckedIndexedAccess": True,
    "exactOptionalPropertyTypes": True,
    "erasableSyntaxOnly": True,
    "verbatimModuleSyntax": True,
    "noImplicitOverride": True,
    "noImplicitReturns": True,
}
_HEAD = """\
import * as examples from "./examples.js";
import * as builtins from "./builtins.js";
import * as plastic from "./plastic.js";
import * as web from "./web.js";
import * as lamps from "./lamps.js";
import { MixedMaterial, Mode } from "./modes.js";
type Turn = { name: string; values?: object; sources?: number[] };
type Refused = { block: string; name: string; value: unknown };
type Model = { material: string; tags: string[] };
type Drawing = { draw: string; type: string; values: object; models: Model[]; first: boolean };
type Given = {
  turns: Turn[]; refused: Refused[]; reflections: never[]; drawings: Drawing[];
};
type Anything = Record<string, any>;

/** An engine that writes its calls down. */
class Recorder implements examples.FrameHost {
  readonly calls: unknown[] = [];
  readonly #models: Model[];
  readonly #isFirst: boolean;

  constructor(models: Model[], isFirst: boolean) {
    this.#models = models;
    this.#isFirst = isFirst;
  }

  begin(_: examples.Frame, sizes: examples.Lanes[]): boolean {
    this.calls.push(["begin", sizes.map((each) => Array.from(each))]);
    return !this.#isFirst;
  }

  beginPass({ name, targets, depth, viewport, scissor, blendConstant }: examples.Pass): void {
    const attachments = [...targets, ...(depth ? [depth] : [])].map((each) => {
      const clear = [...Array.from(each.clear), 0, 0, 0].slice(0, 4);
      return [each.texture, each.layer, each.level, each.load, clear, each.store];
    });
    const settings = [viewport, scissor, blendConstant];
    this.calls.push(
      ["pass", name, attachments, ...settings.map((each) => each ? Array.from(each) : null)]);
  }

  drawModels(tag: string, uses: examples.Use[]): void {
    for (const { material } of this.#models.filter(({ tags }) => tags.includes(tag))) {
      const use = uses.find((each) => each.material === material)!;
      this.calls.push(["draw", used(use), null]);
    }
  }

  fill(use: examples.Use, vertices: number): void {
    this.calls.push(["draw", used(use), Math.floor(vertices / 3)]);
  }

  endPass(): void {
    this.calls.push(["end pass"]);
  }

  dispatch(use: examples.Use, groups: examples.Lanes, images: examples.Written): void {
    this.calls.push(["dispatch", used(use), Array.from(groups), images]);
  }

  copy(from: number, to: number): void {
    this.calls.push(["copy", from, to]);
  }

  end(): void {
    this.calls.push(["end"]);
  }
}

function used(use: examples.Use): unknown {
  const blocks = new use.shader.Blocks();
  const bytes = () => blocks.given().map((each) => Array.from(each.bytes));
  const before = bytes();
  use.give(blocks);
  return [use.shader.name, use.reads, before, bytes()];
}

function drawn({ draw, type, values, models, first }: Drawing): unknown[] {
  const recorder = new Recorder(models, first);
  const all: Anything = examples;
  all[draw](recorder, new all[type](values));
  return recorder.calls;
}

export function answer({ turns, refused, reflections, drawings }: Given): unknown {
  const made: examples.Block[] = [];
  const all: Anything = { ...examples, ...builtins };
  for (const { name, values, sources } of turns) {
    made.push(sources ? all[name](...sources.map((each) => made[each])) : new all[name](values));
  }
  const bytes = made.map((each) => Array.from(each.bytes));
  const told = refused.map(({ block, name, value }) => {
    const found = new (plastic as Anything)[block]();
    const before = String(found.bytes);
    try {
      found[name] = JSON.parse(JSON.stringify(value), (_, each) => each === "NaN" ? NaN : each);
    } catch (error) {
      const { message } = error as Error;
      return [error instanceof RangeError, String(found.bytes) === before, message];
    }
    return [];
  });
  const names = [
    (all: Anything) => new all["PlasticBlocks"]({ rigs: new plastic.StudioRig() }),
    (all: Anything) => new all["PlasticBlocks"]({ derived: [] }),
    (all: Anything) => new all["StudioRig"]({ bytes: new Uint8Array(4) }),
    (all: Anything) => new all["PlasticBlocks"]().setRoles({ eye: [1, 2, 3], eyes: [1, 2, 3] }),
  ].map((make) => {
    try {
      return String(make(plastic));
    } catch (error) {
      return (error as Error).message;
    }
  });
  const stale = reflections.map((each) => plastic.stale(plastic.plastic, each) ?? "");
  stale.push(plastic.stale(plastic.plastic, {} as never) ?? "");
  const texts = plastic.plastic.profiles["wgsl:webgpu"].texts.map(({ text }) => text);
  return { bytes, told, names, lit: lit(), stale, texts, drawn: drawings.map(drawn) };
}

/** True if roles set the camera, and leave the lights of a rig as they are. */
function lit(): boolean {
  const blocks = new plastic.PlasticBlocks({ rig: new plastic.StudioRig() });
  blocks.setRoles({ place: [1, 2, 3], towards_object: [1, 0, 0], eye: [1, 2, 3] });
  const isSame = String(blocks.rig.bytes) === String(new plastic.StudioRig().bytes);
  return isSame && String(blocks.view.eye) === "1,2,3";
}

/** The compiler refuses names that a material's blocks do not have, and names of no role. */
export function misspelt(): void {
  // @ts-expect-error
  new plastic.PlasticBlocks({ rigs: new plastic.StudioRig() });
  // @ts-expect-error
  new plastic.PlasticBlocks().setRoles({ eyes: [1, 2, 3] });
}

/** What a host of WebGPU writes: the descriptors fit as they are. */
export async function host(device: GPUDevice, module: GPUShaderModule): Promise<GPURenderPipeline> {
  const { webgpu } = plastic.plastic;
  const rig = new plastic.StudioRig({ torchPlace: [0, 3, 0] });
  rig.lamps = [{ place: [0, 2, 1] }, new plastic.Point({ place: new Float64Array(3) })];
  const buffer = device.createBuffer({ size: plastic.StudioRig.SIZE, usage: 0x48 });
  device.queue.writeBuffer(buffer, 0, rig.bytes);
  const sampler = plastic.plastic.textures.albedo.sampler;
  device.createSampler(sampler);
  const bindGroupLayouts = webgpu.bindGroupLayouts.map((each) =>
    device.createBindGroupLayout(each));
  return device.createRenderPipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts }),
    vertex: { module, buffers: webgpu.vertexBuffers },
    fragment: { module, targets: webgpu.targets },
    primitive: webgpu.primitive,
    depthStencil: { ...webgpu.depthStencil, format: "depth24plus" },
    multisample: webgpu.multisample,
  });
}

/** A member of an enumeration is set by its name, and nothing else is taken. */
export function mixed(): Mode {
  const material = new MixedMaterial({ mode: Mode.mix });
  // @ts-expect-error
  material.mode = 7;
  return material.mode;
}

/** What hosts of WebGPU and of WebGL write to draw a frame. */
export function frames(device: GPUDevice, gl: WebGL2RenderingContext): void {
  const parameters = new lamps.LightByLightParameters({ lamps: [{ place: [0, 2, 1] }] });
  lamps.drawLightByLight(new lamps.WebGpuFrames(device, []), parameters);
  lamps.drawLightByLight(new lamps.WebGlFrames(gl, []), parameters);
}

/** What a host of WebGL writes. */
export function bound(gl: WebGL2RenderingContext, program: WebGLProgram): void {
  for (const { kind, identifier } of web.plastic.profiles["glsl:es300"].bound) {
    if (kind === "uniform") gl.getUniformBlockIndex(program, identifier);
  }
}
"""


LAMPS = EXAMPLES / "frames" / "light_by_light.burnish"
MODES = """
enum Mode { add, mix }

material Mixed {
    param mode  : Mode = Mode.mix
    param power : float = 1
    color = if mode == Mode.add then #ff0000 * power else #00ff00
}
"""


class Told(NamedTuple):
    """What the program answers."""

    bytes: list[bytes]
    told: list[list[Any]]
    names: list[str]
    lit: bool
    stale: list[str]
    texts: list[str]
    drawn: list[list[list[Any]]]
    """The calls of each drawing."""


@cache
def _spelling() -> Spelling:
    return spelling_of(everything(), registry.load("typescript"))


def _values(fields: tuple[Field, ...], values: Any, spelling: Spelling) -> dict[str, Any]:
    """Values as a host gives them; the count of an array is set behind it."""
    pairs = zip(fields, values, strict=True)
    return {spelling.member(field.word): _host(field, one, spelling) for field, one in pairs}


def _host(field: Field, value: Any, spelling: Spelling) -> Any:
    if field.capacity:
        return [_element(field, each, spelling) for each in value]
    return _element(field, value, spelling)


def _element(field: Field, value: Any, spelling: Spelling) -> Any:
    if isinstance(field.type, Structure):
        return _values(field.type.fields, value, spelling)
    if field.type.columns:
        return [lane for column in value for lane in column]
    return value if field.type.lanes > 1 else value[0]


def _turns() -> Iterator[dict[str, Any]]:
    """The blocks to make, in the order of the samples, the defaults, and the rounds of builtins."""
    known: dict[tuple[str, int, str], int] = {}
    for number, sample in enumerate(samples()):
        if sample.block.derivation is None:
            known[sample.material, sample.seed, sample.block.plain_name] = number
            yield _given(sample.block, sample.values, _spelling())
        else:
            sources = [known[sample.material, sample.seed, each] for each in sample.sources]
            yield {"name": _spelling().function(deriving(sample.block)), "sources": sources}
    for block, _ in defaults():
        yield {"name": _spelling().type(block.name)}
    binding, _ = every_builtin()
    spelling = spelling_of(binding, registry.load("typescript"))
    first = len(samples()) + sum(1 for _ in defaults())
    for seed in range(ROUNDS):
        yield _given(binding.blocks[0], operands(seed), spelling)
        yield {"name": "deriveResults", "sources": [first + 2 * seed]}


def _given(block: Block, values: dict[str, Any], spelling: Spelling) -> dict[str, Any]:
    fields = block.structure.fields
    given = _values(fields, [values[field.word] for field in fields], spelling)
    return {"name": spelling.type(block.name), "values": given}


def _drawing(drawing: Drawing) -> dict[str, Any]:
    """A drawing as the program is told of it."""
    frame, spelling = drawing.frame, _spelling()
    fields = [each for each in frame.parameters.structure.fields if each.word in drawing.values]
    # The number of an array's elements behind the array, which sets it.
    fields.sort(key=lambda field: bool(field.counts))
    values = [drawing.values[field.word] for field in fields]
    return {
        "draw": spelling.function(drawing_of(frame)),
        "type": spelling.type(frame.parameters.name),
        "values": _values(tuple(fields), values, spelling),
        "models": drawing.models,
        "first": drawing.first,
    }


REFUSED: tuple[tuple[str, str, Any, str], ...] = (
    ("PlasticMaterial", "power", 600, "`power` is declared in 1..512: 600 is not"),
    ("PlasticMaterial", "base", [1, 2], "`base` takes 3 numbers, not 2"),
    ("PlasticMaterial", "shine", [1, "NaN", 0], "`shine` takes finite numbers: NaN is not"),
    ("StudioRig", "torchAxis", [0, 2, 0], "`torchAxis` has to be of length 1, not 2"),
    ("StudioRig", "lampsCount", 1.5, "`lampsCount` takes whole numbers: 1.5 is not"),
    ("StudioRig", "lampsCount", 9, "`lampsCount` is declared in 0..8: 9 is not"),
    ("StudioRig", "lamps", [{}], "`lamps` needs `place`, which is not given"),
    ("StudioRig", "lamps", [{"place": [0, 0, 0], "plaice": 1}], "Point has no `plaice`"),
    ("StudioRig", "lamps", [{}] * 9, "`lamps` takes at most 8 elements, not 9"),
    ("StudioRig", "lamps", [{"place": [0, 0, 0]}, {"place": [1]}],
     "`place` takes 3 numbers, not 1"),
)  # fmt: skip


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> Told:
    """What the program tells, once tsc has accepted it."""
    folder = tmp_path_factory.mktemp("typescript")
    language = registry.load("typescript")
    texts = {
        "examples": written(everything(), language),
        # TypeScript does not follow a function of as many statements as all builtins take.
        "builtins": f"// @ts-nocheck\n{written(every_builtin()[0], language)}",
        "plastic": burnish.bind(PLASTIC, "typescript", "wgsl", embed=True),
        "lamps": burnish.bind(LAMPS, "typescript", ("wgsl", "glsl:es300")),
        "modes": burnish.bind(MODES, "typescript", "wgsl"),
        "web": burnish.bind(PLASTIC, "typescript", "glsl:es300"),
        "main": _HEAD,
    }
    for name, text in texts.items():
        (folder / f"{name}.ts").write_text(text, "utf-8")
    (folder / "package.json").write_text('{"type": "module"}', "utf-8")
    options = {"compilerOptions": _OPTIONS, "include": ["*.ts"]}
    (folder / "tsconfig.json").write_text(json.dumps(options), "utf-8")
    node, compiler = program("node", "node"), program("typescript", "tsc")
    assert node is not None
    assert compiler is not None
    done = run([str(node), str(compiler), "-p", str(folder)], limit=600)
    assert done.returncode == 0, done.stdout[:4000]
    given = {
        "turns": list(_turns()),
        "refused": [dict(zip(("block", "name", "value"), row[:3], strict=True)) for row in REFUSED],
        "reflections": reflections(),
        "drawings": [_drawing(each) for each in drawings()],
    }
    (folder / "given.json").write_text(json.dumps(given), "utf-8")
    script = (
        'import { readFileSync } from "node:fs"; import { answer } from "./main.js";'
        'console.log(JSON.stringify(answer(JSON.parse(readFileSync("given.json", "utf-8")))));'
    )
    (folder / "run.js").write_text(script, "utf-8")
    done = run([str(node), "run.js"], cwd=folder)
    assert done.returncode == 0, done.stderr[:4000]
    found = json.loads(done.stdout)
    return Told(**(found | {"bytes": [bytes(each) for each in found["bytes"]]}))


def test_values_have_the_bytes_of_the_runtime_and_so_have_derived_ones(told: Told) -> None:
    def wrong(sample: Sample, found: bytes) -> str:
        text = difference(sample.expected, found)
        return text and f"{sample.block.name} of {sample.material}, {sample.seed}: {text}"

    found = zip(samples(), told.bytes[: len(samples())], strict=True)
    assert not [text for each in found if (text := wrong(*each))]


def test_blocks_begin_with_their_defaults(told: Told) -> None:
    found = zip(defaults(), told.bytes[len(samples()) : -2 * ROUNDS], strict=True)
    assert not [block.name for (block, expected), bytes_ in found if bytes_ != expected]


def test_builtins_mean_what_they_do_in_the_reference(told: Told) -> None:
    wrong = []
    for seed, block in enumerate(told.bytes[-2 * ROUNDS :][1::2]):
        values = operands(seed)
        for row in every_builtin()[1]:
            pair = expected(row, values), stored(row, block)
            if not all(is_close(*each) for each in zip(*pair, strict=True)):
                given = [values[field.word] for field, _ in row.operands]
                wrong.append(f"{row.function}({given}) is {pair[0]}, not {pair[1]}")
    assert not wrong, "\n".join(wrong[:20])


def test_values_that_break_a_promise_are_refused_and_nothing_changes(told: Told) -> None:
    assert told.told == [[True, True, sentence] for *_, sentence in REFUSED]


def test_names_that_there_are_not_are_refused(told: Told) -> None:
    assert told.names == [
        "PlasticBlocks has no `rigs`",
        "PlasticBlocks has no `derived`",
        "StudioRig has no `bytes`",
        "no role is called `eyes`",
    ]


def test_roles_of_lights_are_left_to_the_rig(told: Told) -> None:
    assert told.lit


def test_a_stale_binding_is_told(told: Told) -> None:
    stale = "the binding of Plastic is stale: "
    assert told.stale == [
        "",
        f"{stale}`Rig` has another layout; run `burnish bind` again",
        f"{stale}it lacks `Fog`; run `burnish bind` again",
        *[f"{stale}for `wgsl:webgpu`, {ELSEWHERE}"] * 2,
        *UNFIT_BY_NAME,
        UNFIT_BY_NAME[-1],
    ]


def test_texts_are_embedded(told: Told) -> None:
    (material,) = burnish.compile(PLASTIC, "wgsl")
    assert told.texts == [file.text for file in material.files]


def test_frames_are_drawn_as_burnish_draws_them(told: Told) -> None:
    found = zip(drawings(), told.drawn, strict=True)
    assert not [text for each in found if (text := wrong(*each))]
