// Draws frames with WebGPU.

import { halved, hasStencil, isDepth, lanesOf, toFloats } from "../bytes.js";
import type { PackagedShader, PictureRow, SlotRow } from "../generated/documents.js";
import type { Mesh } from "../geometry.js";
import type {
  Attachment, Bound, DrawCall, DrawSettings, Pixels, Renderer, TextureSize,
} from "../renderer.js";
import { Presenter } from "./canvas.js";
import { Arena, type Device } from "./device.js";
import { PROFILE, Pipelines, type Drawable, type Pipeline } from "./pipelines.js";
import { layerOf, makePicture, makeTexture, viewOf, type Texture } from "./textures.js";

/** Rows of texels that are copied to a buffer begin at multiples of this. */
const ROW_ALIGNMENT = 256;

/** What the device has of a mesh. */
interface Uploaded {
  vertices: GPUBuffer[];
  indices: GPUBuffer | null;
}

type Canvas = HTMLCanvasElement | OffscreenCanvas;
type Call = DrawCall<Texture, GPUBuffer>;

export class WebGpuRenderer implements Renderer<Texture, GPUBuffer> {
  readonly profile = PROFILE;
  private encoder!: GPUCommandEncoder;
  private readonly arena: Arena;
  private readonly uploaded = new Map<Mesh, Uploaded>();
  private readonly owned = new Set<GPUTexture | GPUBuffer>();

  private constructor(
    private readonly device: Device,
    private readonly pipelines: Pipelines,
    private readonly presenter: Presenter | null,
    readonly shaders: PackagedShader[],
    private readonly owns: boolean,
  ) {
    this.arena = new Arena(device.gpu);
  }

  /** A renderer that draws with a device, which it destroys in the end if it owns it. */
  static async open(device: Device, from: Drawable, canvas: Canvas | null, owns = !canvas) {
    const pipelines = await Pipelines.of(device, from);
    // Until here, the canvas shows what it did before.
    const presenter = canvas && new Presenter(device, canvas);
    return new WebGpuRenderer(device, pipelines, presenter, from.shaders, owns);
  }

  // --- resources ---

  makeTexture(size: TextureSize): Texture {
    return this.own(makeTexture(this.device, size));
  }

  makePicture(picture: PictureRow): Texture {
    return this.own(makePicture(this.device, picture));
  }

  makeBuffer(bytes: Uint8Array<ArrayBuffer>): GPUBuffer {
    return this.own(this.device.buffer(bytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC));
  }

  free(made: Texture | GPUBuffer): void {
    const memory = "gpu" in made ? made.gpu : made;
    this.owned.delete(memory);
    memory.destroy();
  }

  sizeOf = ({ sides }: Texture) => sides;
  bytesIn = ({ size }: GPUBuffer) => size;

  fill(buffer: GPUBuffer, bytes: Uint8Array<ArrayBuffer>): void {
    this.device.gpu.queue.writeBuffer(buffer, 0, bytes);
  }

  dispose(): void {
    this.owned.forEach((each) => each.destroy());
    this.arena.free();
    if (this.owns) this.device.gpu.destroy();
  }

  private own<Made extends Texture | GPUBuffer>(made: Made): Made {
    this.owned.add("gpu" in made ? made.gpu : made);
    return made;
  }

  // --- steps ---

  begin(): void {
    this.device.check();
    this.arena.begin();
    this.encoder = this.device.gpu.createCommandEncoder();
  }

  end(): void {
    this.device.gpu.queue.submit([this.encoder.finish()]);
  }

  draw(
    targets: Attachment<Texture>[], depth: Attachment<Texture> | null, calls: Call[],
    { viewport, scissor, blendConstant }: DrawSettings,
  ): void {
    const pass = this.encoder.beginRenderPass({
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
      const pipeline = this.pipelines.get(call.shader, formats, depth && depth.texture.gpu.format);
      pass.setPipeline(pipeline.render!);
      const { stencil } = this.shaders[call.shader].reflection.render_state;
      pass.setStencilReference(stencil?.reference ?? 0);
      this.bind(pass, pipeline, call, []);
      this.drawMesh(pass, call.mesh);
    }
    pass.end();
  }

  run(kernel: Bound<Texture, GPUBuffer>, images: Texture[], groups: number[]): void {
    const most = this.device.gpu.limits.maxComputeWorkgroupsPerDimension;
    if (Math.max(...groups) > most) {
      const wanted = groups.join(" x ");
      throw new Error(`${wanted} work groups, and the device runs at most ${most} along one axis`);
    }
    const pipeline = this.pipelines.get(kernel.shader, [], null);
    const pass = this.encoder.beginComputePass();
    pass.setPipeline(pipeline.compute!);
    this.bind(pass, pipeline, kernel, images);
    pass.dispatchWorkgroups(groups[0], groups[1], groups[2]);
    pass.end();
  }

  copy({ gpu: from }: Texture, { gpu: to }: Texture): void {
    for (let mipLevel = 0; mipLevel < from.mipLevelCount; mipLevel++) {
      const [width, height] = [from.width, from.height].map((side) => halved(side, mipLevel));
      const size = [width, height, from.depthOrArrayLayers];
      const [source, target] = [from, to].map((texture) => ({ texture, mipLevel }));
      this.encoder.copyTextureToTexture(source, target, size);
    }
  }

  private bind(
    pass: GPURenderPassEncoder | GPUComputePassEncoder, { groups }: Pipeline,
    bound: Bound<Texture, GPUBuffer>, images: Texture[],
  ): void {
    const blocks = bound.values.blocks();
    const resource = ({ kind, name, number, layout, sampler }: SlotRow): GPUBindingResource => {
      if (kind === "block") return this.arena.put(blocks.get(name)!);
      if (kind === "sampler") return this.device.gpu.createSampler(sampler);
      if (kind === "storage_texture") return viewOf(images[number], "2d");
      const found = kind === "buffer" ? bound.buffers.get(name) : bound.textures.get(name);
      if (!found) throw new Error(`nobody gives ${bound.values.name} its \`${name}\``);
      return "gpu" in found ? viewOf(found, layout.texture!.viewDimension) : { buffer: found };
    };
    groups.forEach(({ layout, slots }, group) => {
      const entries = slots.map((slot) => {
        return { binding: slot.layout.binding, resource: resource(slot) };
      });
      pass.setBindGroup(group, this.device.gpu.createBindGroup({ layout, entries }));
    });
  }

  private drawMesh(pass: GPURenderPassEncoder, mesh: Mesh): void {
    const { count, instance_count: instances } = mesh;
    if (!count || !instances) return;
    const { vertices, indices } = this.upload(mesh);
    vertices.forEach((buffer, at) => pass.setVertexBuffer(at, buffer));
    if (indices) {
      pass.setIndexBuffer(indices, "uint32");
      pass.drawIndexed(count, instances);
    } else {
      pass.draw(count, instances);
    }
  }

  private upload(mesh: Mesh): Uploaded {
    const known = this.uploaded.get(mesh);
    if (known) return known;
    const buffer = (bytes: Uint8Array<ArrayBuffer>, usage: number) =>
      this.own(this.device.buffer(bytes, usage));
    const streams = [mesh.vertices, mesh.instances].filter(({ length }) => length);
    const made = {
      vertices: streams.map((bytes) => buffer(bytes, GPUBufferUsage.VERTEX)),
      indices: mesh.indices && buffer(mesh.indices, GPUBufferUsage.INDEX),
    };
    this.uploaded.set(mesh, made);
    return made;
  }

  // --- results ---

  show(texture: Texture): void {
    if (!this.presenter) throw new Error("this frame was opened without a canvas");
    this.presenter.show(texture.gpu);
  }

  async finished(): Promise<void> {
    await this.device.gpu.queue.onSubmittedWorkDone();
    this.device.check();
  }

  async read({ gpu }: Texture): Promise<Pixels> {
    const { format, width, height, depthOrArrayLayers: layers } = gpu;
    const [lanes, bytesPerLane] = lanesOf(format);
    const row = width * lanes * bytesPerLane;
    const bytesPerRow = Math.ceil(row / ROW_ALIGNMENT) * ROW_ALIGNMENT;
    const aspect = isDepth(format) ? "depth-only" : "all";
    const padded = await this.device.bytesOf(bytesPerRow * height * layers, (encoder, buffer) => {
      const target = { buffer, bytesPerRow, rowsPerImage: height };
      encoder.copyTextureToBuffer({ texture: gpu, aspect }, target, [width, height, layers]);
    });
    const packed = new Uint8Array(row * height * layers);
    for (let y = 0; y < height * layers; y++) {
      packed.set(padded.subarray(y * bytesPerRow, y * bytesPerRow + row), y * row);
    }
    return { width, height, layers, texels: toFloats(format, packed) };
  }

  readBuffer(buffer: GPUBuffer): Promise<Uint8Array<ArrayBuffer>> {
    const { size } = buffer;
    return this.device.bytesOf(size, (encoder, to) => {
      encoder.copyBufferToBuffer(buffer, 0, to, 0, size);
    });
  }
}

function depthAttachment(
  { texture, layer, target, clear }: Attachment<Texture>,
): GPURenderPassDepthStencilAttachment {
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

const storeOp = ({ store }: { store: boolean }) => (store ? "store" : "discard");
