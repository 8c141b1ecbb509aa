// Draws materials of Burnish with WebGL 2: `index.html?draw=plastic`.
//
// `shaders.ts` is written by `burnish bind`; package.json has the command. It has the texts of the
// shaders, too, so that both always fit together.

import scene from "./scene.json";
import {
  BannerBlocks, type Blocks, GlBindings, type GlMesh, type GlResources, type Material,
  PlasticBlocks, ShadowsParameters, WebGlFrames, banner, drawGlMesh, drawShadows, plastic,
  shadowsShadowedClay, showOnCanvas,
} from "./shaders.ts";

type Gl = WebGL2RenderingContext;

const [WIDTH, HEIGHT] = scene.size as [number, number];

/** What all scenes are seen by, under the names of roles. */
const camera = { world_to_clip: scene.camera.view_projection, eye: scene.camera.eye };

// --- what is drawn ---

/** A ball with lights of all kinds and a texture. */
function drawPlastic(gl: Gl): void {
  const { lights, models: [model] } = scene.scenes.plastic;
  const blocks = new PlasticBlocks();
  blocks.rig.set({
    sunDirection: lights.sun.direction,
    lamps: lights.lamps.map(({ place, diffuse_color: diffuseColor }) => ({ place, diffuseColor })),
    torchPlace: lights.torch.place,
    torchAxis: lights.torch.axis,
  });
  blocks.setRoles({ ...camera, object_to_world: model!.object_to_world });
  const albedo = picture(gl, scene.pictures.tiles, gl.SRGB8_ALPHA8);
  drawMaterial(gl, plastic, blocks, { albedo }, "ball");
}

/** A cloth that bones bend, with a normal map. */
function drawBanner(gl: Gl): void {
  const { lights, models: [model] } = scene.scenes.banner;
  const blocks = new BannerBlocks();
  blocks.rig.sunDirection = lights.sun.direction;
  blocks.setRoles({ ...camera, object_to_world: model!.object_to_world });
  blocks.draw.bones = scene.bones;
  const threads = picture(gl, scene.pictures.threads, gl.RGBA8);
  drawMaterial(gl, banner, blocks, { normal_map: threads }, "banner");
}

/** A frame: what a lamp sees is drawn first, and only that is lit. */
function drawFrame(gl: Gl): void {
  const { lights: { lamp }, models } = scene.scenes.shadows;
  const frames = new WebGlFrames(gl, models.map((model) => ({
    material: model.material,
    mesh: mesh(gl, shadowsShadowedClay, model.mesh),
    set: (blocks) => blocks.setRoles({ ...camera, object_to_world: model.object_to_world }),
  })));
  const size = [WIDTH, HEIGHT];
  drawShadows(frames, new ShadowsParameters({ size, lampPlace: lamp.place, lampAxis: lamp.axis }));
  showOnCanvas(gl, frames.output("picture"), true);
}

// -- glue

/** Draws a mesh: the binding makes the program, and binds all by its tables. */
function drawMaterial(gl: Gl, material: Material, blocks: Blocks, resources: GlResources, name: string): void {
  const light = target(gl);
  new GlBindings(gl, material, blocks, resources).upload().bind();
  drawGlMesh(gl, material, mesh(gl, material, name));
  showOnCanvas(gl, light, false);
}

// -- end of glue

/** The buffers of a mesh: the vertex input `vertex_normal` is the mesh's `normal`. */
function mesh(gl: Gl, material: Material, name: string): GlMesh {
  const channels: Record<string, number[]> = scene.meshes[name as keyof typeof scene.meshes];
  const vertices: GlMesh["vertices"] = {};
  for (const { name: input, format } of material.vertexInputs) {
    const values = channels[input.replace("vertex_", "")] ?? [];
    const type = format?.startsWith("uint") ? Uint32Array : Float32Array;
    vertices[input] = buffer(gl, new type(values), gl.ARRAY_BUFFER);
  }
  const corners = new Uint32Array(channels.indices ?? []);
  return { vertices, indices: buffer(gl, corners, gl.ELEMENT_ARRAY_BUFFER), count: corners.length };
}

function buffer(gl: Gl, data: Float32Array | Uint32Array, kind: number): WebGLBuffer {
  const made = gl.createBuffer();
  gl.bindBuffer(kind, made);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return made;
}

/** A texture with a picture; the format `SRGB8_ALPHA8` decodes colours. */
function picture(gl: Gl, { width, height, rgba }: typeof scene.pictures.tiles, format: number): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  const texels = new Uint8Array(rgba);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  return texture;
}

/** Draw to a texture with depths from here on, which are cleared; it has linear light. */
function target(gl: Gl): WebGLTexture {
  const light = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, light);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.SRGB8_ALPHA8, WIDTH, HEIGHT);
  const depths = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, depths);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, WIDTH, HEIGHT);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, light, 0);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depths);
  gl.viewport(0, 0, WIDTH, HEIGHT);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  return light;
}

const scenes: Record<string, (gl: Gl) => void> = {
  plastic: drawPlastic, banner: drawBanner, shadows: drawFrame,
};

function main(): void {
  const name = new URLSearchParams(location.search).get("draw") ?? "plastic";
  const draw = scenes[name];
  const known = Object.keys(scenes).join(", ");
  if (draw === undefined) throw new Error(`there is no scene \`${name}\`: there are ${known}`);
  const gl = document.querySelector("canvas")!.getContext("webgl2", { alpha: false, antialias: false });
  if (!gl) throw new Error("this browser has no WebGL 2");
  draw(gl);
  const wrong = gl.getError();
  if (wrong !== gl.NO_ERROR) throw new Error(`WebGL refuses something: error ${wrong}`);
  document.body.dataset.drawn = name;
}

try {
  main();
} catch (error) {
  document.querySelector("[role=alert]")!.textContent = (error as Error).message;
}
