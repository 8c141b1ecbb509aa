// Shows textures on a canvas, as a screen does: sRGB, without alpha.

import { isDepth, lanesOf } from "../bytes.js";
import type { Device } from "./device.js";

const TEXT = `
@group(0) @binding(0) var shown: texture_2d<f32>;
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}
@fragment fn pixel(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let texel = vec2u(at.xy / SIZE * vec2f(textureDimensions(shown)));
  let linear = saturate(textureLoad(shown, texel, 0).LANES);
  let bent = 1.055 * pow(linear, vec3f(1 / 2.4)) - 0.055;
  return vec4f(select(bent, linear * 12.92, linear <= vec3f(0.0031308)), 1);
}`;

export class Presenter {
  private readonly context: GPUCanvasContext;
  private readonly format = navigator.gpu.getPreferredCanvasFormat();
  private readonly pipelines = new Map<string, GPURenderPipeline>();

  constructor(
    private readonly device: Device,
    private readonly canvas: HTMLCanvasElement | OffscreenCanvas,
  ) {
    const context = canvas.getContext("webgpu");
    if (!context) throw new Error("this canvas cannot be drawn to by WebGPU");
    this.context = context as GPUCanvasContext;
    this.context.configure({ device: device.gpu, format: this.format, alphaMode: "opaque" });
  }

  /** Show the first layer and level of a texture, over the whole canvas. */
  show(texture: GPUTexture): void {
    const pipeline = this.pipeline(texture.format);
    const aspect = isDepth(texture.format) ? "depth-only" : "all";
    const view = texture.createView({
      dimension: "2d", mipLevelCount: 1, arrayLayerCount: 1, aspect,
    });
    const encoder = this.device.gpu.createCommandEncoder();
    const pass = encoder.beginRenderPass({
      colorAttachments: [
        { view: this.context.getCurrentTexture().createView(), loadOp: "clear", storeOp: "store" },
      ],
    });
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.device.gpu.createBindGroup({
      layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: view }],
    }));
    pass.draw(3);
    pass.end();
    this.device.gpu.queue.submit([encoder.finish()]);
  }

  private pipeline(format: GPUTextureFormat): GPURenderPipeline {
    const lanes = lanesOf(format)[0] === 1 ? "rrr" : "rgb";
    const size = `vec2f(${this.canvas.width}, ${this.canvas.height})`;
    const code = TEXT.replace("LANES", lanes).replace("SIZE", size);
    const key = code + isDepth(format);
    const known = this.pipelines.get(key);
    if (known) return known;
    const { gpu } = this.device;
    const group = gpu.createBindGroupLayout({
      entries: [{ binding: 0, visibility: 2, texture: { sampleType: "unfilterable-float" } }],
    });
    const module = gpu.createShaderModule({ code });
    const made = gpu.createRenderPipeline({
      layout: gpu.createPipelineLayout({ bindGroupLayouts: [group] }),
      vertex: { module },
      fragment: { module, targets: [{ format: this.format }] },
    });
    this.pipelines.set(key, made);
    return made;
  }
}
