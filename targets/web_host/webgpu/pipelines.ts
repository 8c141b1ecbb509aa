// Pipelines of WebGPU, each made once when a frame is opened.

import { formatOf } from "../bytes.js";
import type {
  FramePackage, PackagedShader, Reflection, ShaderText,
} from "../generated/documents.js";
import type { Device } from "./device.js";
import { PROFILE, slotsOf, type Slot } from "./slots.js";
import { colorTarget, depthStencil, vertexBuffers } from "./states.js";

/** A pipeline, with its bind groups. */
export interface Pipeline {
  groups: { layout: GPUBindGroupLayout; slots: Slot[] }[];
  render?: GPURenderPipeline;
  compute?: GPUComputePipeline;
}

/** The formats of what a pipeline draws to. */
interface Formats {
  targets: GPUTextureFormat[];
  depth: GPUTextureFormat | null;
}

/** All pipelines of a frame, by shader and formats. */
export class Pipelines {
  private readonly made = new Map<string, Pipeline>();

  private constructor(private readonly device: Device) {}

  static async of(device: Device, { plan, shaders }: FramePackage): Promise<Pipelines> {
    const found = new Pipelines(device);
    const wanted = new Map<string, [number, Formats]>();
    const want = (shader: number, formats: Formats) => {
      wanted.set(keyOf(shader, formats), [shader, formats]);
    };
    const format = ({ texture }: { texture: number }) => formatOf(plan.textures[texture].format);
    for (const step of plan.steps) {
      if (step.kind === "draw") {
        const depth = step.depth && format(step.depth);
        const formats = { targets: step.targets.map(format), depth };
        step.draws.forEach(({ uses }) => uses.forEach(({ shader }) => want(shader, formats)));
      } else if (step.kind === "run") {
        const isDrawn = "fragment" in (shaders[step.shader].texts[PROFILE] ?? {});
        want(step.shader, { targets: isDrawn ? step.images.map(format) : [], depth: null });
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

  private async make(shader: PackagedShader, formats: Formats): Promise<Pipeline> {
    const { reflection, texts } = shader;
    const { compute, vertex, fragment } = texts[PROFILE] ?? {};
    if (!compute && !vertex) throw new Error(`${reflection.material} has no text for ${PROFILE}`);
    const { gpu } = this.device;
    const groups = slotsOf(shader).map((slots) => {
      const entries = slots.map(({ layout }) => layout);
      return { slots, layout: gpu.createBindGroupLayout({ entries }) };
    });
    const bindGroupLayouts = groups.map(({ layout }) => layout);
    const layout = gpu.createPipelineLayout({ bindGroupLayouts });
    if (compute) {
      const stage = await this.stage(reflection, compute);
      return { groups, compute: await gpu.createComputePipelineAsync({ layout, compute: stage }) };
    }
    const { backends, draw, render_state: state, material } = reflection;
    const topology = draw?.topology ?? "triangle";
    if (state.fill === "lines") {
      throw new Error(`WebGPU cannot draw the edges of triangles, as ${material} asks`);
    }
    const [vertices, fragments] = [
      await this.stage(reflection, vertex), await this.stage(reflection, fragment),
    ];
    const render = await gpu.createRenderPipelineAsync({
      layout,
      vertex: { ...vertices, buffers: vertexBuffers(reflection) },
      fragment: { ...fragments, targets: this.targets(reflection, formats.targets) },
      primitive: {
        topology: `${topology}-list` as GPUPrimitiveTopology,
        cullMode: state.cull,
        frontFace: backends[PROFILE].front_face,
      },
      ...(formats.depth && { depthStencil: depthStencil(state, formats.depth, topology) }),
    });
    return { groups, render };
  }

  private async stage({ material }: Reflection, { text, entry }: ShaderText) {
    const module = this.device.gpu.createShaderModule({ code: text });
    const { messages } = await module.getCompilationInfo();
    const wrong = messages
      .filter(({ type }) => type === "error")
      .map(({ lineNum, linePos, message }) => `\n${lineNum}:${linePos}: ${message}`);
    if (wrong.length) {
      throw new Error(`the browser refuses a text of ${material}:${wrong.join("")}`);
    }
    return { module, entryPoint: entry };
  }

  private targets(
    { targets, material }: Reflection, formats: GPUTextureFormat[],
  ): GPUColorTargetState[] {
    const blends32 = this.device.gpu.features.has("float32-blendable");
    return formats.map((format, at) => {
      if (targets[at].blend && format.includes("32float") && !blends32) {
        throw new Error(`this device cannot blend ${format}, which ${material} draws to`);
      }
      return colorTarget(targets[at], format);
    });
  }
}

const keyOf = (shader: number, { targets, depth }: Formats) =>
  [shader, ...targets, depth].join(" ");
