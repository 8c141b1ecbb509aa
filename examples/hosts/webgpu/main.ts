// Draws materials of Burnish with WebGPU: `index.html?draw=plastic`.
//
// `shaders.ts` is written by `burnish bind`; package.json has the command. It has the texts of the
// shaders, too, so that both always fit together.

import scene from "./scene.json";
import {
  BannerBlocks, Bindings, type Blocks, type Material, type Mesh, PlasticBlocks, type Resources,
  ShadowsParameters, WebGpuFrames, banner, drawMesh, drawShadows, plastic, renderPipeline,
  shadowsShadowedClay,
} from "./shaders.ts";

const DEPTHS = "depth32float";
const [WIDTH, HEIGHT] = scene.size as [number, number];

/** What all scenes are seen by, under the names of roles. */
const camera = { world_to_clip: scene.camera.view_projection, eye: scene.camera.eye };

// --- what is drawn ---

/** A ball with lights of all kinds and a texture. */
function drawPlastic(device: GPUDevice, canvas: GPUTexture): void {
  const { lights, models: [model] } = scene.scenes.plastic;
  const blocks = new PlasticBlocks();
  blocks.rig.set({
    sunDirection: lights.sun.direction,
    lamps: lights.lamps.map(({ place, diffuse_color: diffuseColor }) => ({ place, diffuseColor })),
    torchPlace: lights.torch.place,
    torchAxis: lights.torch.axis,
  });
  blocks.setRoles({ ...camera, object_to_world: model!.object_to_world });
  const albedo = picture(device, scene.pictures.tiles, "rgba8unorm-srgb");
  drawMaterial(device, canvas, plastic, blocks, { albedo }, "ball");
}

/** A cloth that bones bend, with a normal map. */
function drawBanner(device: GPUDevice, canvas: GPUTexture): void {
  const { lights, models: [model] } = scene.scenes.banner;
  const blocks = new BannerBlocks();
  blocks.rig.sunDirection = lights.sun.direction;
  blocks.setRoles({ ...camera, object_to_world: model!.object_to_world });
  blocks.draw.bones = scene.bones;
  const threads = picture(device, scene.pictures.threads, "rgba8unorm");
  drawMaterial(device, canvas, banner, blocks, { normal_map: threads }, "banner");
}

/** A frame: what a lamp sees is drawn first, and only that is lit. */
function drawFrame(device: GPUDevice, canvas: GPUTexture): void {
  const { lights: { lamp }, models } = scene.scenes.shadows;
  const frames = new WebGpuFrames(device, models.map((model) => ({
    material: model.material,
    mesh: mesh(device, shadowsShadowedClay, model.mesh),
    set: (blocks) => blocks.setRoles({ ...camera, object_to_world: model.object_to_world }),
  })));
  const size = [WIDTH, HEIGHT];
  drawShadows(frames, new ShadowsParameters({ size, lampPlace: lamp.place, lampAxis: lamp.axis }));
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToTexture({ texture: frames.output("picture") }, { texture: canvas }, size);
  device.queue.submit([encoder.finish()]);
}

// -- glue

/** Draws a mesh: the binding makes the pipeline, and binds all by its tables. */
function drawMaterial(device: GPUDevice, canvas: GPUTexture, material: Material, blocks: Blocks, resources: Resources, name: keyof typeof scene.meshes): void {
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginRenderPass(attachments(device, canvas));
  const pipeline = renderPipeline(device, material, DEPTHS);
  pass.setPipeline(pipeline);
  new Bindings(device, material, pipeline, blocks, resources).upload().bind(pass);
  drawMesh(pass, material, mesh(device, material, name));
  pass.end();
  device.queue.submit([encoder.finish()]);
}

// -- end of glue

/** The buffers of a mesh: the vertex input `vertex_normal` is the mesh's `normal`. */
function mesh(device: GPUDevice, material: Material, name: string): Mesh {
  const channels: Record<string, number[]> = scene.meshes[name as keyof typeof scene.meshes];
  const vertices: Mesh["vertices"] = {};
  for (const { name: input, format } of material.vertexInputs) {
    const values = channels[input.replace("vertex_", "")] ?? [];
    const type = format?.startsWith("uint") ? Uint32Array : Float32Array;
    vertices[input] = buffer(device, new type(values), GPUBufferUsage.VERTEX);
  }
  const corners = new Uint32Array(channels.indices ?? []);
  return { vertices, indices: buffer(device, corners, GPUBufferUsage.INDEX), count: corners.length };
}

function buffer(device: GPUDevice, data: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>, usage: number): GPUBuffer {
  const made = device.createBuffer({ size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST });
  device.queue.writeBuffer(made, 0, data);
  return made;
}

/** The view of a texture with a picture; a format that ends in `-srgb` decodes colours. */
function picture(device: GPUDevice, { width, height, rgba }: typeof scene.pictures.tiles, format: GPUTextureFormat): GPUTextureView {
  const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
  const texture = device.createTexture({ size: [width, height], format, usage });
  const rows = { bytesPerRow: 4 * width, rowsPerImage: height };
  device.queue.writeTexture({ texture }, new Uint8Array(rgba), rows, [width, height]);
  return texture.createView();
}

/** The canvas and the depths, cleared. What is drawn is linear light, which the view encodes. */
function attachments(device: GPUDevice, canvas: GPUTexture): GPURenderPassDescriptor {
  const usage = GPUTextureUsage.RENDER_ATTACHMENT;
  const depths = device.createTexture({ size: [WIDTH, HEIGHT], format: DEPTHS, usage });
  return {
    colorAttachments: [{
      view: canvas.createView({ format: "rgba8unorm-srgb" }),
      clearValue: [0, 0, 0, 1], loadOp: "clear", storeOp: "store",
    }],
    depthStencilAttachment: {
      view: depths.createView(), depthClearValue: 1, depthLoadOp: "clear", depthStoreOp: "discard",
    },
  };
}

const scenes: Record<string, (device: GPUDevice, canvas: GPUTexture) => void> = {
  plastic: drawPlastic, banner: drawBanner, shadows: drawFrame,
};

async function main(): Promise<void> {
  const name = new URLSearchParams(location.search).get("draw") ?? "plastic";
  const draw = scenes[name];
  const known = Object.keys(scenes).join(", ");
  if (draw === undefined) throw new Error(`there is no scene \`${name}\`: there are ${known}`);
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) throw new Error("this browser has no WebGPU");
  const device = await adapter.requestDevice();
  device.addEventListener("uncapturederror", ({ error }) => tell(error.message));
  const context = document.querySelector("canvas")!.getContext("webgpu") as unknown as GPUCanvasContext;
  const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_DST;
  context.configure({ device, format: "rgba8unorm", viewFormats: ["rgba8unorm-srgb"], usage });
  draw(device, context.getCurrentTexture());
  await device.queue.onSubmittedWorkDone();
  document.body.dataset.drawn = name;
}

function tell(message: string): void {
  document.querySelector("[role=alert]")!.textContent = message;
}

main().catch((error: Error) => tell(error.message));
