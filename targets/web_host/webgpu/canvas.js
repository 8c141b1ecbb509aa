// Shows textures on a canvas, as a screen does: sRGB, without alpha.

import { isDepth, lanesOf } from "../bytes.js";
import { cover, coverPipeline } from "./cover.js";

/** @import { Device } from "./device.js" */

const TEXT = `
@fragment fn pixel(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let texel = vec2u(at.xy / SIZE * vec2f(textureDimensions(texels)));
  let linear = saturate(textureLoad(texels, texel, 0).LANES);
  let bent = 1.055 * pow(linear, vec3f(1 / 2.4)) - 0.055;
  return vec4f(select(bent, linear * 12.92, linear <= vec3f(0.0031308)), 1);
}`;

export class Presenter {
  /** @type {GPUCanvasContext} */
  #context;
  #format = navigator.gpu.getPreferredCanvasFormat();
  /** @type {Map<string, GPURenderPipeline>} */
  #pipelines = new Map();

  #device;
  #canvas;

  /**
   * @param {Device} device
   * @param {HTMLCanvasElement | OffscreenCanvas} canvas
   */
  constructor(device, canvas) {
    this.#device = device;
    this.#canvas = canvas;
    const context = canvas.getContext("webgpu");
    if (!context) throw new Error("this canvas cannot be drawn to by WebGPU");
    this.#context = /** @type {GPUCanvasContext} */ (context);
    this.#context.configure({ device: device.gpu, format: this.#format, alphaMode: "opaque" });
  }

  /**
   * Show the first layer and level of a texture, over the whole canvas.
   * @param {GPUTexture} texture
   */
  show(texture) {
    const pipeline = this.#pipeline(texture.format);
    const aspect = isDepth(texture.format) ? "depth-only" : "all";
    const view = texture.createView({
      dimension: "2d", mipLevelCount: 1, arrayLayerCount: 1, aspect,
    });
    const canvas = this.#context.getCurrentTexture().createView();
    cover(this.#device.gpu, pipeline, view, {
      colorAttachments: [{ view: canvas, loadOp: "clear", storeOp: "store" }],
    });
  }

  /**
   * @param {GPUTextureFormat} format
   * @returns {GPURenderPipeline}
   */
  #pipeline(format) {
    const lanes = lanesOf(format)[0] === 1 ? "rrr" : "rgb";
    const size = `vec2f(${this.#canvas.width}, ${this.#canvas.height})`;
    const code = TEXT.replace("LANES", lanes).replace("SIZE", size);
    const made = this.#pipelines.get(code)
      ?? coverPipeline(this.#device.gpu, code, [{ format: this.#format }]);
    this.#pipelines.set(code, made);
    return made;
  }
}
