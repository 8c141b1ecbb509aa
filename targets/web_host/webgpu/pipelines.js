// Pipelines of WebGPU, each made once when a frame is opened.

import { present } from "../present.js";

/**
 * @import {
 *   Package, PackagedShader, PipelineRow, ShaderTextRow, SlotRow,
 * } from "../generated/documents.js"
 * @import { Device } from "./device.js"
 */

export const PROFILE = "wgsl:webgpu";

/**
 * The parts of a package that a renderer needs to open.
 * @typedef {Pick<Package, "shaders" | "pipelines">} Drawable
 */

/**
 * A pipeline, with its bind groups.
 * @typedef {object} Pipeline
 * @property {{ layout: GPUBindGroupLayout, slots: SlotRow[] }[]} groups
 * @property {GPURenderPipeline} [render]
 * @property {GPUComputePipeline} [compute]
 */

/** The formats of a pipeline's targets. @typedef {Omit<PipelineRow, "shader">} Formats */

/** All pipelines of a frame, by shader and formats. */
export class Pipelines {
  /** @type {Map<string, Pipeline>} */
  #made = new Map();

  /** Equal pipelines of several shaders are made once. @type {Map<string, Promise<Pipeline>>} */
  #alike = new Map();

  /** So are the modules of equal texts. @type {Map<string, Promise<GPUShaderModule>>} */
  #modules = new Map();

  #device;

  /**
   * @private
   * @param {Device} device
   */
  constructor(device) {
    this.#device = device;
  }

  /**
   * @param {Device} device
   * @param {Drawable} from
   * @returns {Promise<Pipelines>}
   */
  static async of(device, { pipelines, shaders }) {
    const found = new Pipelines(device);
    const lacking = shaders.find(({ webgpu }) => !webgpu)?.reflection.material;
    if (lacking) throw new Error(`${lacking} has no text for ${PROFILE}`);
    await Promise.all(
      pipelines.map(async ({ shader, ...formats }) => {
        found.#made.set(keyOf(shader, formats), await found.#alikeOf(shaders[shader], formats));
      }),
    );
    device.check();
    return found;
  }

  /**
   * @param {number} shader
   * @param {GPUTextureFormat[]} targets
   * @param {GPUTextureFormat | null} depth
   * @returns {Pipeline}
   */
  get(shader, targets, depth) {
    return present(this.#made.get(keyOf(shader, { targets, depth })));
  }

  /**
   * @param {PackagedShader} shader
   * @param {Formats} formats
   * @returns {Promise<Pipeline>}
   */
  #alikeOf(shader, formats) {
    const { texts, webgpu, reflection: { render_state: state } } = shader;
    const key = JSON.stringify([texts[PROFILE], webgpu, state, formats]);
    const made = this.#alike.get(key) ?? this.#make(shader, formats);
    this.#alike.set(key, made);
    return made;
  }

  /**
   * @param {PackagedShader} shader
   * @param {Formats} formats
   * @returns {Promise<Pipeline>}
   */
  async #make(shader, formats) {
    const { reflection: { material, render_state: state }, texts } = shader;
    const webgpu = present(shader.webgpu);
    const { compute, vertex, fragment } = texts[PROFILE];
    const { gpu } = this.#device;
    const groups = webgpu.groups.map((slots) => {
      const entries = slots.map(({ layout }) => layout);
      return { slots, layout: gpu.createBindGroupLayout({ entries }) };
    });
    const bindGroupLayouts = groups.map(({ layout }) => layout);
    const layout = gpu.createPipelineLayout({ bindGroupLayouts });
    if (compute) {
      const stage = await this.#stage(material, compute);
      return { groups, compute: await gpu.createComputePipelineAsync({ layout, compute: stage }) };
    }
    if (state.fill === "lines") {
      throw new Error(`WebGPU cannot draw the edges of triangles, as ${material} asks`);
    }
    const vertices = await this.#stage(material, vertex);
    // A pass that writes depths only needs no fragments.
    const fragments = fragment && (await this.#stage(material, fragment));
    const targets = formats.targets.map((format, at) => ({ ...webgpu.targets[at], format }));
    const render = await gpu.createRenderPipelineAsync({
      layout,
      vertex: { ...vertices, buffers: webgpu.buffers },
      ...(fragments && { fragment: { ...fragments, targets } }),
      primitive: webgpu.primitive,
      multisample: {
        count: state.samples,
        alphaToCoverageEnabled: state.alpha_to_coverage,
      },
      ...(formats.depth && { depthStencil: { ...webgpu.depthStencil, format: formats.depth } }),
    });
    return { groups, render };
  }

  /**
   * @param {string} material
   * @param {ShaderTextRow} row
   */
  async #stage(material, { text, entry }) {
    const module = this.#modules.get(text) ?? this.#module(material, text);
    this.#modules.set(text, module);
    return { module: await module, entryPoint: entry };
  }

  /**
   * @param {string} material
   * @param {string} text
   * @returns {Promise<GPUShaderModule>}
   */
  async #module(material, text) {
    const module = this.#device.gpu.createShaderModule({ code: text });
    const { messages } = await module.getCompilationInfo();
    const wrong = messages
      .filter(({ type }) => type === "error")
      .map(({ lineNum, linePos, message }) => `\n${lineNum}:${linePos}: ${message}`);
    if (wrong.length) {
      throw new Error(`the browser refuses a text of ${material}:${wrong.join("")}`);
    }
    return module;
  }
}

/** @type {(shader: number, formats: Formats) => string} */
const keyOf = (shader, { targets, depth }) => [shader, ...targets, depth].join(" ");
