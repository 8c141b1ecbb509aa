// Pipelines of WebGPU, each made once when a frame is opened.

import type {
  Package, PackagedShader, PipelineRow, ShaderTextRow, SlotRow,
} from "../generated/documents.js";
import type { Device } from "./device.js";

export const PROFILE = "wgsl:webgpu";

/** What of a package a renderer is opened for. */
export type Drawable = Pick<Package, "shaders" | "pipelines">;

/** A pipeline, with its bind groups. */
export interface Pipeline {
  groups: { layout: GPUBindGroupLayout; slots: SlotRow[] }[];
  render?: GPURenderPipeline;
  compute?: GPUComputePipeline;
}

/** The formats of what a pipeline draws to. */
type Formats = Omit<PipelineRow, "shader">;

/** All pipelines of a frame, by shader and formats. */
export class Pipelines {
  private readonly made = new Map<string, Pipeline>();

  private constructor(private readonly device: Device) {}

  static async of(device: Device, { pipelines, shaders }: Drawable): Promise<Pipelines> {
    const found = new Pipelines(device);
    const lacking = shaders.find(({ webgpu }) => !webgpu)?.reflection.material;
    if (lacking) throw new Error(`${lacking} has no text for ${PROFILE}`);
    await Promise.all(
      pipelines.map(async ({ shader, ...formats }) => {
        found.made.set(keyOf(shader, formats), await found.make(shaders[shader], formats));
      }),
    );
    device.check();
    return found;
  }

  get(shader: number, targets: GPUTextureFormat[], depth: GPUTextureFormat | null): Pipeline {
    return this.made.get(keyOf(shader, { targets, depth }))!;
  }

  private async make(shader: PackagedShader, formats: Formats): Promise<Pipeline> {
    const { reflection: { material, render_state: state }, texts } = shader;
    const webgpu = shader.webgpu!;
    const { compute, vertex, fragment } = texts[PROFILE];
    const { gpu } = this.device;
    const groups = webgpu.groups.map((slots) => {
      const entries = slots.map(({ layout }) => layout);
      return { slots, layout: gpu.createBindGroupLayout({ entries }) };
    });
    const bindGroupLayouts = groups.map(({ layout }) => layout);
    const layout = gpu.createPipelineLayout({ bindGroupLayouts });
    if (compute) {
      const stage = await this.stage(material, compute);
      return { groups, compute: await gpu.createComputePipelineAsync({ layout, compute: stage }) };
    }
    if (state.fill === "lines") {
      throw new Error(`WebGPU cannot draw the edges of triangles, as ${material} asks`);
    }
    const vertices = await this.stage(material, vertex);
    const fragments = await this.stage(material, fragment);
    const targets = formats.targets.map((format, at) => ({ ...webgpu.targets[at], format }));
    const render = await gpu.createRenderPipelineAsync({
      layout,
      vertex: { ...vertices, buffers: webgpu.buffers },
      fragment: { ...fragments, targets },
      primitive: webgpu.primitive,
      multisample: { count: state.samples },
      ...(formats.depth && { depthStencil: { ...webgpu.depthStencil, format: formats.depth } }),
    });
    return { groups, render };
  }

  private async stage(material: string, { text, entry }: ShaderTextRow) {
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
}

const keyOf = (shader: number, { targets, depth }: Formats) =>
  [shader, ...targets, depth].join(" ");
