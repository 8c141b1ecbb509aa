// Draws frames with WebGPU.

import { halved, hasStencil, isDepth, lanesOf, toFloats } from "../bytes.js";
import { present } from "../present.js";
import { Presenter } from "./canvas.js";
import { Arena } from "./device.js";
import { PROFILE, Pipelines } from "./pipelines.js";
import { layerOf, makePicture, makeTexture, viewOf } from "./textures.js";

/**
 * @import { PackagedShader, PictureRow, SlotRow } from "../generated/documents.js"
 * @import { Mesh } from "../geometry.js"
 * @import {
 *   Attachment, Bound, DrawCall, DrawSettings, Pixels, Renderer, TextureSize,
 * } from "../renderer.js"
 * @import { Device } from "./device.js"
 * @import { Drawable, Pipeline } from "./pipelines.js"
 * @import { Texture } from "./textures.js"
 */

/** Rows of texels that are copied to a buffer begin at multiples of this. */
const ROW_ALIGNMENT = 256;

/**
 * The buffers of a mesh on the device.
 * @typedef {object} Uploaded
 * @property {GPUBuffer[]} vertices
 * @property {GPUBuffer | null} indices
 */

/** @typedef {HTMLCanvasElement | OffscreenCanvas} Canvas */
/** @typedef {DrawCall<Texture, GPUBuffer>} Call */

/** @implements {Renderer<Texture, GPUBuffer>} */
export class WebGpuRenderer {
  /** @readonly */
  profile = PROFILE;
  /** The encoder of the steps, from `begin` to `end`. @type {GPUCommandEncoder | null} */
  #encoder = null;
  /** @type {Arena} */
  #arena;
  /** @type {Map<Mesh, Uploaded>} */
  #uploaded = new Map();
  /** @type {Set<GPUTexture | GPUBuffer>} */
  #owned = new Set();

  #device;
  #pipelines;
  #presenter;
  /** @readonly */
  shaders;
  #owns;

  /**
   * @private
   * @param {Device} device
   * @param {Pipelines} pipelines
   * @param {Presenter | null} presenter
   * @param {PackagedShader[]} shaders
   * @param {boolean} owns
   */
  constructor(device, pipelines, presenter, shaders, owns) {
    this.#device = device;
    this.#pipelines = pipelines;
    this.#presenter = presenter;
    this.shaders = shaders;
    this.#owns = owns;
    this.#arena = new Arena(device.gpu);
  }

  /**
   * A renderer that draws with a device; `owns` says that it destroys the device in the end.
   * @param {Device} device
   * @param {Drawable} from
   * @param {Canvas | null} canvas
   */
  static async open(device, from, canvas, owns = !canvas) {
    const pipelines = await Pipelines.of(device, from);
    // Everything that can fail comes first: until here, the canvas shows its last picture.
    const presenter = canvas && new Presenter(device, canvas);
    return new WebGpuRenderer(device, pipelines, presenter, from.shaders, owns);
  }

  // --- resources ---

  /**
   * @param {TextureSize} size
   * @returns {Texture}
   */
  makeTexture(size) {
    return this.#own(makeTexture(this.#device, size));
  }

  /**
   * @param {PictureRow} picture
   * @returns {Texture}
   */
  makePicture(picture) {
    return this.#own(makePicture(this.#device, picture));
  }

  /**
   * @param {Uint8Array<ArrayBuffer>} bytes
   * @returns {GPUBuffer}
   */
  makeBuffer(bytes) {
    return this.#own(this.#device.buffer(bytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC));
  }

  /** @param {Texture | GPUBuffer} made */
  free(made) {
    const memory = "gpu" in made ? made.gpu : made;
    this.#owned.delete(memory);
    memory.destroy();
  }

  /** @type {(texture: Texture) => number[]} */
  sizeOf = ({ sides }) => sides;
  /** @type {(buffer: GPUBuffer) => number} */
  bytesIn = ({ size }) => size;

  /**
   * @param {GPUBuffer} buffer
   * @param {Uint8Array<ArrayBuffer>} bytes
   */
  fill(buffer, bytes) {
    this.#device.gpu.queue.writeBuffer(buffer, 0, bytes);
  }

  dispose() {
    this.#owned.forEach((each) => each.destroy());
    this.#arena.free();
    if (this.#owns) this.#device.gpu.destroy();
  }

  /**
   * @template {Texture | GPUBuffer} Made
   * @param {Made} made
   * @returns {Made}
   */
  #own(made) {
    this.#owned.add("gpu" in made ? made.gpu : made);
    return made;
  }

  // --- steps ---

  begin() {
    this.#device.check();
    this.#arena.begin();
    this.#encoder = this.#device.gpu.createCommandEncoder();
  }

  end() {
    this.#device.gpu.queue.submit([present(this.#encoder).finish()]);
  }

  /**
   * @param {Attachment<Texture>[]} targets
   * @param {Attachment<Texture> | null} depth
   * @param {Call[]} calls
   * @param {DrawSettings} settings
   */
  draw(targets, depth, calls, { viewport, scissor, blendConstant }) {
    const pass = present(this.#encoder).beginRenderPass({
      colorAttachments: targets.map(({ target, texture, layer, clear, resolve }) => ({
        view: layerOf(texture.gpu, layer, target.level),
        clearValue: clear,
        loadOp: target.load,
        storeOp: storeOp(target),
        ...(resolve && {
          resolveTarget: layerOf(resolve.texture.gpu, resolve.layer, resolve.level),
        }),
      })),
      ...(depth && { depthStencilAttachment: depthAttachment(depth) }),
    });
    pass.setViewport(...viewport, 0, 1);
    pass.setScissorRect(...scissor);
    pass.setBlendConstant(blendConstant);
    const formats = targets.map(({ texture }) => texture.gpu.format);
    for (const call of calls) {
      const pipeline = this.#pipelines.get(call.shader, formats, depth && depth.texture.gpu.format);
      pass.setPipeline(present(pipeline.render));
      const { stencil } = this.shaders[call.shader].reflection.render_state;
      pass.setStencilReference(stencil?.reference ?? 0);
      this.#bind(pass, pipeline, call, []);
      this.#drawMesh(pass, call.mesh);
    }
    pass.end();
  }

  /**
   * @param {Bound<Texture, GPUBuffer>} kernel
   * @param {Texture[]} images
   * @param {number[]} groups
   */
  run(kernel, images, groups) {
    const most = this.#device.gpu.limits.maxComputeWorkgroupsPerDimension;
    if (Math.max(...groups) > most) {
      const wanted = groups.join(" x ");
      throw new Error(`${wanted} work groups, and the device runs at most ${most} along one axis`);
    }
    const pipeline = this.#pipelines.get(kernel.shader, [], null);
    const pass = present(this.#encoder).beginComputePass();
    pass.setPipeline(present(pipeline.compute));
    this.#bind(pass, pipeline, kernel, images);
    pass.dispatchWorkgroups(groups[0], groups[1], groups[2]);
    pass.end();
  }

  /**
   * @param {Texture} from
   * @param {Texture} to
   */
  copy({ gpu: from }, { gpu: to }) {
    for (let mipLevel = 0; mipLevel < from.mipLevelCount; mipLevel++) {
      const [width, height] = [from.width, from.height].map((side) => halved(side, mipLevel));
      const size = [width, height, from.depthOrArrayLayers];
      const [source, target] = [from, to].map((texture) => ({ texture, mipLevel }));
      present(this.#encoder).copyTextureToTexture(source, target, size);
    }
  }

  /**
   * @param {GPURenderPassEncoder | GPUComputePassEncoder} pass
   * @param {Pipeline} pipeline
   * @param {Bound<Texture, GPUBuffer>} bound
   * @param {Texture[]} images
   */
  #bind(pass, { groups }, bound, images) {
    const blocks = bound.values.blocks();
    /** @type {(slot: SlotRow) => GPUBindingResource} */
    const resource = ({ kind, name, number, layout, sampler }) => {
      if (kind === "block") return this.#arena.put(present(blocks.get(name)));
      if (kind === "sampler") return this.#device.gpu.createSampler(sampler);
      if (kind === "storage_texture") return viewOf(images[number], "2d");
      const found = kind === "buffer" ? bound.buffers.get(name) : bound.textures.get(name);
      if (!found) throw new Error(`nobody gives ${bound.values.name} its \`${name}\``);
      if (!("gpu" in found)) return { buffer: found };
      return viewOf(found, layout.texture?.viewDimension);
    };
    groups.forEach(({ layout, slots }, group) => {
      const entries = slots.map((slot) => {
        return { binding: slot.layout.binding, resource: resource(slot) };
      });
      pass.setBindGroup(group, this.#device.gpu.createBindGroup({ layout, entries }));
    });
  }

  /**
   * @param {GPURenderPassEncoder} pass
   * @param {Mesh} mesh
   */
  #drawMesh(pass, mesh) {
    const { count, instance_count: instances } = mesh;
    if (!count || !instances) return;
    const { vertices, indices } = this.#upload(mesh);
    vertices.forEach((buffer, at) => pass.setVertexBuffer(at, buffer));
    if (indices) {
      pass.setIndexBuffer(indices, "uint32");
      pass.drawIndexed(count, instances);
    } else {
      pass.draw(count, instances);
    }
  }

  /**
   * @param {Mesh} mesh
   * @returns {Uploaded}
   */
  #upload(mesh) {
    const known = this.#uploaded.get(mesh);
    if (known) return known;
    /** @type {(bytes: Uint8Array<ArrayBuffer>, usage: number) => GPUBuffer} */
    const buffer = (bytes, usage) => this.#own(this.#device.buffer(bytes, usage));
    const streams = [mesh.vertices, mesh.instances].filter(({ length }) => length);
    const made = {
      vertices: streams.map((bytes) => buffer(bytes, GPUBufferUsage.VERTEX)),
      indices: mesh.indices && buffer(mesh.indices, GPUBufferUsage.INDEX),
    };
    this.#uploaded.set(mesh, made);
    return made;
  }

  // --- results ---

  /** @param {Texture} texture */
  show(texture) {
    if (!this.#presenter) throw new Error("this frame was opened without a canvas");
    this.#presenter.show(texture.gpu);
  }

  /** @returns {Promise<void>} */
  async finished() {
    await this.#device.gpu.queue.onSubmittedWorkDone();
    this.#device.check();
  }

  /**
   * @param {Texture} texture
   * @returns {Promise<Pixels>}
   */
  async read({ gpu }) {
    const { format, width, height, depthOrArrayLayers: layers } = gpu;
    const [lanes, bytesPerLane] = lanesOf(format);
    const row = width * lanes * bytesPerLane;
    const bytesPerRow = Math.ceil(row / ROW_ALIGNMENT) * ROW_ALIGNMENT;
    const aspect = isDepth(format) ? "depth-only" : "all";
    const padded = await this.#device.bytesOf(bytesPerRow * height * layers, (encoder, buffer) => {
      const target = { buffer, bytesPerRow, rowsPerImage: height };
      encoder.copyTextureToBuffer({ texture: gpu, aspect }, target, [width, height, layers]);
    });
    const packed = new Uint8Array(row * height * layers);
    for (let y = 0; y < height * layers; y++) {
      packed.set(padded.subarray(y * bytesPerRow, y * bytesPerRow + row), y * row);
    }
    return { width, height, layers, texels: toFloats(format, packed) };
  }

  /**
   * @param {GPUBuffer} buffer
   * @returns {Promise<Uint8Array<ArrayBuffer>>}
   */
  readBuffer(buffer) {
    const { size } = buffer;
    return this.#device.bytesOf(size, (encoder, to) => {
      encoder.copyBufferToBuffer(buffer, 0, to, 0, size);
    });
  }
}

/**
 * @param {Attachment<Texture>} attachment
 * @returns {GPURenderPassDepthStencilAttachment}
 */
function depthAttachment({ texture, layer, target, clear }) {
  const { stencil } = target;
  return {
    view: layerOf(texture.gpu, layer, target.level),
    depthClearValue: clear[0],
    depthLoadOp: target.load,
    depthStoreOp: storeOp(target),
    ...(hasStencil(texture.gpu.format) && {
      stencilClearValue: stencil?.clear ?? 0,
      stencilLoadOp: stencil?.load ?? "clear",
      stencilStoreOp: storeOp(stencil ?? { store: false }),
    }),
  };
}

/** @type {(store: { store: boolean }) => "store" | "discard"} */
const storeOp = ({ store }) => (store ? "store" : "discard");
