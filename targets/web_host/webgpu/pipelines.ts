// Pipelines of WebGPU, each made once when a frame is opened.

import { formatOf, hasStencil } from "../bytes.js";
import type {
  BlendEquation, FramePackage, PackagedShader, Place, Reflection, RenderState, ShaderText, StencilSide,
} from "../types.js";
import { ShaderStage, type Device } from "./device.js";

export const PROFILE = "wgsl:webgpu";

/** A pipeline, with the layouts of its bind groups. */
export interface Pipeline {
  layouts: GPUBindGroupLayout[];
  render?: GPURenderPipeline;
  compute?: GPUComputePipeline;
}

/** What a shader reads or writes at one place of a bind group. */
export type Slot = { binding: number } & (
  | { kind: "block" | "texture" | "sampler"; name: string }
  | { kind: "buffer"; name: string; written: boolean }
  | { kind: "image"; number: number }
);

type Formats = { targets: GPUTextureFormat[]; depth: GPUTextureFormat | null };

const keyOf = (shader: number, { targets, depth }: Formats) => [shader, ...targets, depth].join(" ");

/** All pipelines of a frame, by shader and the formats of what it draws to. */
export class Pipelines {
  private readonly made = new Map<string, Pipeline>();

  private constructor(private readonly device: Device) {}

  static async of(device: Device, { plan, shaders }: FramePackage): Promise<Pipelines> {
    const found = new Pipelines(device);
    const wanted = new Map<string, [number, Formats]>();
    const want = (shader: number, formats: Formats) => wanted.set(keyOf(shader, formats), [shader, formats]);
    const format = ({ texture }: { texture: number }) => formatOf(plan.textures[texture].format);
    for (const step of plan.steps) {
      if (step.kind === "draw") {
        const formats = { targets: step.targets.map(format), depth: step.depth && format(step.depth) };
        step.draws.forEach(({ uses }) => uses.forEach(({ shader }) => want(shader, formats)));
      } else if (step.kind === "run") {
        const drawn = "fragment" in shaders[step.shader].texts[PROFILE];
        want(step.shader, { targets: drawn ? step.images.map(format) : [], depth: null });
      }
    }
    await Promise.all(
      [...wanted].map(async ([key, [shader, formats]]) => {
        found.made.set(key, await found.make(shaders[shader], formats));
      }),
    );
    device.check();
    return found;
  }

  get(shader: number, targets: GPUTextureFormat[], depth: GPUTextureFormat | null): Pipeline {
    return this.made.get(keyOf(shader, { targets, depth }))!;
  }

  private async make({ reflection, texts }: PackagedShader, formats: Formats): Promise<Pipeline> {
    const { compute, vertex, fragment } = texts[PROFILE] ?? {};
    if (!compute && !vertex) throw new Error(`${reflection.material} has no text for ${PROFILE}`);
    const { gpu } = this.device;
    const layouts = slotsOf(reflection).map((slots) =>
      gpu.createBindGroupLayout({
        entries: slots.map((slot) => layoutEntry(reflection, slot, compute ? ShaderStage.COMPUTE : ShaderStage.DRAWN)),
      }),
    );
    const layout = gpu.createPipelineLayout({ bindGroupLayouts: layouts });
    if (compute) {
      const stage = await this.stage(reflection, compute);
      return { layouts, compute: await gpu.createComputePipelineAsync({ layout, compute: stage }) };
    }
    const { backends, draw, render_state: state } = reflection;
    if (state.fill === "lines") throw new Error(`WebGPU cannot draw the edges of triangles, as ${reflection.material} asks`);
    const render = await gpu.createRenderPipelineAsync({
      layout,
      vertex: { ...(await this.stage(reflection, vertex)), buffers: vertexBuffers(reflection) },
      fragment: { ...(await this.stage(reflection, fragment)), targets: this.targets(reflection, formats.targets) },
      primitive: {
        topology: `${draw?.topology ?? "triangle"}-list`,
        cullMode: state.cull,
        frontFace: backends[PROFILE].front_face,
      },
      ...(formats.depth && { depthStencil: depthStencil(state, formats.depth, draw?.topology) }),
    });
    return { layouts, render };
  }

  private async stage({ material }: Reflection, { text, entry }: ShaderText) {
    const module = this.device.gpu.createShaderModule({ code: text });
    const { messages } = await module.getCompilationInfo();
    const wrong = messages.filter(({ type }) => type === "error");
    if (wrong.length) {
      const lines = wrong.map(({ lineNum, linePos, message }) => `${lineNum}:${linePos}: ${message}`);
      throw new Error(`the browser refuses a text of ${material}:\n${lines.join("\n")}`);
    }
    return { module, entryPoint: entry };
  }

  private targets({ targets, material }: Reflection, formats: GPUTextureFormat[]): GPUColorTargetState[] {
    return formats.map((format, at) => {
      const { blend, mask } = targets[at];
      if (blend && /32float/.test(format) && !this.device.gpu.features.has("float32-blendable")) {
        throw new Error(`this device cannot blend ${format}, which ${material} does: it lacks float32-blendable`);
      }
      const writeMask = [..."rgba"].reduce((bits, lane, at) => bits | (written(mask, lane) ? 1 << at : 0), 0);
      if (!blend) return { format, writeMask };
      return { format, writeMask, blend: { color: component(blend.color), alpha: component(blend.alpha) } };
    });
  }
}

function depthStencil(
  { depth, stencil }: RenderState, format: GPUTextureFormat, topology = "triangle",
): GPUDepthStencilState {
  return {
    format,
    depthWriteEnabled: depth.write,
    depthCompare: word<GPUCompareFunction>(depth.compare),
    ...(depth.bias && topology === "triangle" && {
      depthBias: depth.bias.constant,
      depthBiasSlopeScale: depth.bias.slope,
      depthBiasClamp: depth.bias.clamp,
    }),
    ...(stencil && hasStencil(format) && {
      stencilFront: stencilSide(stencil.front),
      stencilBack: stencilSide(stencil.back),
      stencilReadMask: stencil.read_mask,
      stencilWriteMask: stencil.write_mask,
    }),
  };
}

const stencilSide = ({ compare, fail, depth_fail, pass }: StencilSide): GPUStencilFaceState => ({
  compare: word(compare), failOp: word(fail), depthFailOp: word(depth_fail), passOp: word(pass),
});

/** A word of a reflection as WebGPU writes it. */
const word = <Word extends string>(text: string) => text.replaceAll("_", "-") as Word;

const written = (mask: string, lane: string) => mask !== "none" && mask.includes(lane);

const component = ({ source, destination, operation }: BlendEquation): GPUBlendComponent => ({
  operation: word(operation), srcFactor: word(source), dstFactor: word(destination),
});

/** One buffer for the inputs of vertices and one for those of instances, as `interleaved` makes
 * them. */
function vertexBuffers({ vertex_inputs: inputs }: Reflection): GPUVertexBufferLayout[] {
  return (["vertex", "instance"] as const).flatMap((stepMode) => {
    const members = inputs.filter((each) => each.step === stepMode && !each.buffer);
    let arrayStride = 0;
    const attributes = members.map(({ representation, location }) => {
      const lanes = Number(/\d$/.exec(representation)?.[0] ?? 1);
      const offset = arrayStride;
      arrayStride += 4 * lanes;
      return { format: vertexFormat(representation, lanes), offset, shaderLocation: location! };
    });
    return members.length ? [{ arrayStride, stepMode, attributes }] : [];
  });
}

function vertexFormat(representation: string, lanes: number): GPUVertexFormat {
  const type = representation.startsWith("u") ? "uint32" : representation.startsWith("i") ? "sint32" : "float32";
  return (lanes > 1 ? `${type}x${lanes}` : type) as GPUVertexFormat;
}

/** What a shader reads and writes, by group; a group that is not used is empty. */
export function slotsOf(reflection: Reflection): Slot[][] {
  const { blocks, buffers, images, textures, samplers } = reflection.backends[PROFILE];
  const found: Slot[][] = [];
  const add = ({ group, binding }: Place, slot: object) => {
    while (found.length <= group) found.push([]);
    found[group].push({ ...slot, binding } as Slot);
  };
  for (const { name } of reflection.blocks) add(blocks[name], { kind: "block", name });
  for (const [written, rows] of [[false, reflection.buffers], [true, reflection.results]] as const) {
    for (const { name } of rows) if (buffers[name]) add(buffers[name], { kind: "buffer", name, written });
  }
  reflection.targets.forEach(({ name }, number) => {
    if (images[name]) add(images[name], { kind: "image", number });
  });
  for (const { name } of reflection.textures) {
    if (textures[name]) add(textures[name], { kind: "texture", name });
    if (samplers[name]) add(samplers[name], { kind: "sampler", name });
  }
  return found;
}

// The layout that WebGPU infers would leave out bindings that a text does not use.
function layoutEntry(reflection: Reflection, slot: Slot, visibility: number): GPUBindGroupLayoutEntry {
  const entry = { binding: slot.binding, visibility };
  switch (slot.kind) {
    case "block":
      return { ...entry, buffer: {} };
    case "buffer":
      return { ...entry, buffer: { type: slot.written ? "storage" : "read-only-storage" } };
    case "image": {
      const format = formatOf(reflection.targets[slot.number].format);
      return { ...entry, storageTexture: { format } };
    }
  }
  const { layout } = reflection.textures.find(({ name }) => name === slot.name)!;
  const { viewDimension, sampleType, sampler } = layout;
  if (slot.kind === "sampler") return { ...entry, sampler: { type: sampler! } };
  return { ...entry, texture: { viewDimension, sampleType } };
}

