// Draws frames with WebGL 2, as far as it can: it has no kernels over buffers.

import { halved, hasStencil, isDepth, toFloats } from "../bytes.js";
import { present } from "../present.js";
import { Presenter } from "./canvas.js";
import { captured, inOrder } from "./capture.js";
import { Context } from "./context.js";
import { freeMesh, MODES, topologyOf, uploadMesh } from "./meshes.js";
import { PROFILE, linked } from "./programs.js";
import { setState } from "./state.js";
import {
  attach, bindOf, depthPoint, freeTexture, makePicture, makeSampler, makeTexture,
} from "./textures.js";

/**
 * @import { Package, PackagedShader, PictureRow, SamplerRow } from "../generated/documents.js"
 * @import { Mesh } from "../geometry.js"
 * @import {
 *   Attachment, Bound, DrawCall, DrawSettings, Pixels, Renderer, TextureSize,
 * } from "../renderer.js"
 * @import { Gl } from "./context.js"
 * @import { Uploaded } from "./meshes.js"
 * @import { Program } from "./programs.js"
 * @import { Texture } from "./textures.js"
 */

/** @typedef {HTMLCanvasElement | OffscreenCanvas} Canvas */
/** @typedef {DrawCall<Texture, Uint8Array<ArrayBuffer>>} Call */

/** @implements {Renderer<Texture, Uint8Array<ArrayBuffer>>} */
export class WebGl2Renderer {
  /** @readonly */
  profile = PROFILE;
  /** @type {Gl} */
  #gl;
  /** @type {Program[]} */
  #programs;
  /** @type {Presenter} */
  #presenter;
  /** The framebuffer that steps draw to. @type {WebGLFramebuffer} */
  #screen;
  /** The framebuffer that texels are read and copied from. @type {WebGLFramebuffer} */
  #source;
  /** @type {Map<string, WebGLSampler>} */
  #samplers = new Map();
  /** @type {Map<Program, Map<Mesh, Uploaded>>} */
  #uploaded = new Map();
  /** @type {WebGLBuffer[]} */
  #blocks = [];
  /** @type {Set<Texture>} */
  #textures = new Set();

  #context;
  /** @readonly */
  shaders;
  #hasCanvas;

  /**
   * @private
   * @param {Context} context
   * @param {PackagedShader[]} shaders
   * @param {boolean} hasCanvas
   */
  constructor(context, shaders, hasCanvas) {
    this.#context = context;
    this.shaders = shaders;
    this.#hasCanvas = hasCanvas;
    this.#gl = context.gl;
    this.#programs = linked(context, shaders);
    this.#presenter = new Presenter(context);
    this.#screen = this.#gl.createFramebuffer();
    this.#source = this.#gl.createFramebuffer();
  }

  /**
   * A renderer that draws to a canvas; without one, several can share a context.
   * @param {Pick<Package, "shaders">} from
   * @param {Canvas | null} canvas
   * @returns {WebGl2Renderer}
   */
  static open({ shaders }, canvas, context = Context.open(canvas)) {
    return new WebGl2Renderer(context, shaders, canvas !== null);
  }

  // --- resources ---

  /**
   * @param {TextureSize} size
   * @returns {Texture}
   */
  makeTexture(size) {
    return this.#own(makeTexture(this.#context, size));
  }

  /**
   * @param {PictureRow} picture
   * @returns {Texture}
   */
  makePicture(picture) {
    return this.#own(makePicture(this.#context, picture));
  }

  /** @param {Texture | Uint8Array} texture */
  free(texture) {
    // Storage buffers are only counted here: no text of this profile reads them.
    if (texture instanceof Uint8Array) return;
    this.#textures.delete(texture);
    freeTexture(this.#gl, texture);
  }

  /**
   * @param {Texture} texture
   * @returns {Texture}
   */
  #own(texture) {
    this.#textures.add(texture);
    return texture;
  }

  /** @type {(bytes: Uint8Array<ArrayBuffer>) => Uint8Array<ArrayBuffer>} */
  makeBuffer = (bytes) => bytes;
  /** @type {(buffer: Uint8Array<ArrayBuffer>) => Promise<Uint8Array<ArrayBuffer>>} */
  readBuffer = async (buffer) => buffer;
  /** @type {(buffer: Uint8Array<ArrayBuffer>) => number} */
  bytesIn = (buffer) => buffer.length;
  fill() {}
  /** @type {(texture: Texture) => number[]} */
  sizeOf = ({ sides }) => sides;

  dispose() {
    const gl = this.#gl;
    this.#textures.forEach((each) => freeTexture(gl, each));
    this.#programs.forEach((each) => gl.deleteProgram(each.gl));
    this.#samplers.forEach((each) => gl.deleteSampler(each));
    for (const meshes of this.#uploaded.values()) meshes.forEach((each) => freeMesh(gl, each));
    this.#blocks.forEach((each) => gl.deleteBuffer(each));
    for (const each of [this.#screen, this.#source]) gl.deleteFramebuffer(each);
    this.#presenter.dispose();
  }

  // --- steps ---

  begin() {
    this.#context.check();
  }

  end() {
    this.#gl.flush();
  }

  /**
   * @param {Attachment<Texture>[]} targets
   * @param {Attachment<Texture> | null} depth
   * @param {Call[]} calls
   * @param {DrawSettings} settings
   */
  draw(targets, depth, calls, { viewport, scissor, blendConstant }) {
    const gl = this.#gl;
    const first = targets[0] ?? present(depth);
    const width = halved(first.texture.width, first.target.level);
    const height = halved(first.texture.height, first.target.level);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#screen);
    const points = this.#attachAll(targets, depth);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) {
      const formats = [...targets, ...(depth ? [depth] : [])].map(({ texture }) => texture.format);
      throw new Error(`WebGL cannot draw ${width} x ${height} pixels to ${formats.join(", ")}`);
    }
    this.#checkBlending(targets, calls);
    this.#clear(targets, depth);
    gl.viewport(...viewport);
    gl.scissor(...scissor);
    gl.enable(gl.SCISSOR_TEST);
    gl.blendColor(...blendConstant);
    for (const call of calls) this.#drawCall(call, depth, height);
    gl.disable(gl.SCISSOR_TEST);
    targets.forEach((target, at) => this.#resolve(target, points[at], width, height));
    const attached = depth ? [...targets, depth] : targets;
    const dropped = points.filter((_, at) => !attached[at].target.store);
    if (dropped.length) gl.invalidateFramebuffer(gl.FRAMEBUFFER, dropped);
    for (const point of points) {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, null, 0);
    }
  }

  /**
   * Throws an error if 32-bit floats are blended without the extension for it.
   * @param {Attachment<Texture>[]} targets
   * @param {Call[]} calls
   */
  #checkBlending(targets, calls) {
    for (const { shader } of calls) {
      this.shaders[shader].reflection.targets.forEach(({ blend }, at) => {
        const { format } = targets[at].texture;
        if (!blend || !format.endsWith("32float")) return;
        this.#context.need("EXT_float_blend", `blend what is drawn to ${format}`);
      });
    }
  }

  /**
   * Write the means of a target's samples to the texture that later steps read.
   * @param {Attachment<Texture>} attachment
   * @param {number} point
   * @param {number} width
   * @param {number} height
   */
  #resolve({ resolve }, point, width, height) {
    if (!resolve) return;
    const gl = this.#gl;
    const { DRAW_FRAMEBUFFER: into, COLOR_ATTACHMENT0: only, COLOR_BUFFER_BIT: colors } = gl;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.#screen);
    gl.readBuffer(point);
    gl.bindFramebuffer(into, this.#source);
    attach(gl, into, only, resolve.texture, resolve.layer, resolve.level);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, colors, gl.NEAREST);
    gl.framebufferTexture2D(into, only, gl.TEXTURE_2D, null, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#screen);
  }

  /**
   * Attach the targets to the framebuffer, the depths last.
   * @param {Attachment<Texture>[]} targets
   * @param {Attachment<Texture> | null} depth
   * @returns {number[]}
   */
  #attachAll(targets, depth) {
    const gl = this.#gl;
    const points = targets.map((_, at) => gl.COLOR_ATTACHMENT0 + at);
    targets.forEach(({ texture, layer, target }, at) => {
      attach(gl, gl.FRAMEBUFFER, points[at], texture, layer, target.level);
    });
    gl.drawBuffers(points.length ? points : [gl.NONE]);
    if (!depth) return points;
    const point = depthPoint(gl, depth.texture.format);
    attach(gl, gl.FRAMEBUFFER, point, depth.texture, depth.layer, depth.target.level);
    return [...points, point];
  }

  /**
   * @param {Attachment<Texture>[]} targets
   * @param {Attachment<Texture> | null} depth
   */
  #clear(targets, depth) {
    const gl = this.#gl;
    gl.colorMask(true, true, true, true);
    gl.disable(gl.SCISSOR_TEST);
    targets.forEach(({ target, clear }, at) => {
      if (target.load === "clear") gl.clearBufferfv(gl.COLOR, at, clear);
    });
    if (!depth) return;
    gl.depthMask(true);
    gl.stencilMask(0xff);
    if (depth.target.load === "clear") gl.clearBufferfv(gl.DEPTH, 0, depth.clear);
    const { stencil } = depth.target;
    if (hasStencil(depth.texture.format) && stencil?.load !== "load") {
      gl.clearBufferiv(gl.STENCIL, 0, [stencil?.clear ?? 0]);
    }
  }

  /**
   * @param {Call} call
   * @param {Attachment<Texture> | null} depth
   * @param {number} height
   */
  #drawCall(call, depth, height) {
    const gl = this.#gl;
    const program = this.#programs[call.shader];
    const { vertices, count } = this.#upload(program, call);
    if (!count || !call.mesh.instance_count) return;
    const { reflection } = this.shaders[call.shader];
    gl.useProgram(program.gl);
    program.heights.forEach((location) => gl.uniform1f(location, height));
    setState(this.#context, reflection, depth?.texture.format ?? null);
    this.#bind(program, call);
    gl.bindVertexArray(vertices);
    const [mode] = MODES[topologyOf(reflection)];
    gl.drawElementsInstanced(gl[mode], count, gl.UNSIGNED_INT, 0, call.mesh.instance_count);
    gl.bindVertexArray(null);
  }

  /**
   * Return the vertices that a draw captures, without drawing pixels: all values of a vertex one
   * behind the other.
   * @param {Call} call
   * @returns {Uint8Array<ArrayBuffer>}
   */
  capture(call) {
    const gl = this.#gl;
    const { reflection } = this.shaders[call.shader];
    const program = this.#programs[call.shader];
    const mesh = inOrder(reflection, call.mesh);
    const uploaded = uploadMesh(gl, program, reflection, mesh);
    gl.useProgram(program.gl);
    this.#bind(program, call);
    gl.bindVertexArray(uploaded.vertices);
    const { topology, stride } = present(reflection.capture);
    const found = captured(gl, gl[MODES[topology][0]], mesh, stride);
    gl.bindVertexArray(null);
    freeMesh(gl, uploaded);
    this.#context.check();
    return found;
  }

  /** @param {Bound<Texture, Uint8Array>} bound */
  run({ values }) {
    throw new Error(`WebGL 2 cannot run ${values.name}: it has no kernels over buffers`);
  }

  /**
   * @param {Texture} from
   * @param {Texture} to
   */
  copy(from, to) {
    for (let level = 0; level < from.levels; level++) {
      for (let layer = 0; layer < from.layers; layer++) {
        this.#copyLayer(from, layer, level, to, layer);
      }
    }
  }

  /**
   * @param {Texture} from
   * @param {number} layer
   * @param {number} level
   * @param {Texture} to
   * @param {number} into
   */
  #copyLayer(from, layer, level, to, into) {
    const gl = this.#gl;
    const [width, height] = [halved(from.width, level), halved(from.height, level)];
    const depth = isDepth(from.format);
    const point = depth ? depthPoint(gl, from.format) : gl.COLOR_ATTACHMENT0;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.#source);
    attach(gl, gl.READ_FRAMEBUFFER, point, from, layer, level);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.#screen);
    attach(gl, gl.DRAW_FRAMEBUFFER, point, to, into, level);
    gl.drawBuffers([depth ? gl.NONE : point]);
    gl.disable(gl.SCISSOR_TEST);
    const stencil = hasStencil(from.format) ? gl.STENCIL_BUFFER_BIT : 0;
    const parts = depth ? gl.DEPTH_BUFFER_BIT | stencil : gl.COLOR_BUFFER_BIT;
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, parts, gl.NEAREST);
    for (const framebuffer of [gl.READ_FRAMEBUFFER, gl.DRAW_FRAMEBUFFER]) {
      gl.framebufferTexture2D(framebuffer, point, gl.TEXTURE_2D, null, 0);
    }
  }

  // --- what a draw reads ---

  /**
   * @param {Program} program
   * @param {Call} call
   */
  #bind(program, { values, textures }) {
    const gl = this.#gl;
    const bytes = values.blocks();
    program.blocks.forEach((name, at) => {
      this.#blocks[at] ??= gl.createBuffer();
      gl.bindBufferBase(gl.UNIFORM_BUFFER, at, this.#blocks[at]);
      gl.bufferData(gl.UNIFORM_BUFFER, present(bytes.get(name)), gl.DYNAMIC_DRAW);
    });
    program.textures.forEach(({ name, state }, unit) => {
      const texture = textures.get(name);
      if (!texture) throw new Error(`nobody gives ${values.name} its \`${name}\``);
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(bindOf(gl, texture.dimension), texture.gl);
      gl.bindSampler(unit, this.#sampler(texture, state));
    });
  }

  /**
   * @param {Texture} texture
   * @param {SamplerRow["state"] | null} state
   * @returns {WebGLSampler}
   */
  #sampler({ format }, state) {
    if (state && state.filter === "linear" && /32float$/.test(format) && !isDepth(format)) {
      this.#context.need("OES_texture_float_linear", `filter textures of ${format}`);
    }
    const key = JSON.stringify(state);
    const found = this.#samplers.get(key) ?? makeSampler(this.#gl, state);
    this.#samplers.set(key, found);
    return found;
  }

  /**
   * @param {Program} program
   * @param {Call} call
   * @returns {Uploaded}
   */
  #upload(program, { mesh, shader }) {
    /** @type {Map<Mesh, Uploaded>} */
    const known = this.#uploaded.get(program) ?? new Map();
    this.#uploaded.set(program, known);
    const { reflection } = this.shaders[shader];
    const found = known.get(mesh) ?? uploadMesh(this.#gl, program, reflection, mesh);
    known.set(mesh, found);
    return found;
  }

  // --- results ---

  /**
   * @param {Texture} texture
   * @param {boolean} isBottomUp
   */
  show(texture, isBottomUp) {
    if (!this.#hasCanvas) throw new Error("this frame was opened without a canvas");
    this.#flat(texture, 0, (found) => this.#presenter.show(found, isBottomUp));
  }

  /** @returns {Promise<void>} */
  async finished() {
    this.#context.check();
  }

  /**
   * @param {Texture} texture
   * @returns {Promise<Pixels>}
   */
  async read(texture) {
    const { width, height, layers } = texture;
    const size = width * height * 4;
    const texels = new Float32Array(size * layers);
    for (let layer = 0; layer < layers; layer++) {
      texels.set(this.#layer(texture, layer), size * layer);
    }
    this.#context.check();
    return { width, height, layers, texels };
  }

  /**
   * The numbers of a layer of a texture's first level.
   * @param {Texture} texture
   * @param {number} layer
   * @returns {Float32Array}
   */
  #layer(texture, layer) {
    const gl = this.#gl;
    if (isDepth(texture.format)) return this.#depths(texture, layer);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#source);
    attach(gl, gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, texture, layer, 0);
    return readBound(gl, texture);
  }

  /**
   * The depths of a layer. WebGL reads no depths back, so they are drawn as colours first.
   * @param {Texture} texture
   * @param {number} layer
   * @returns {Float32Array}
   */
  #depths(texture, layer) {
    const gl = this.#gl;
    const { width, height } = texture;
    const colors = makeTexture(this.#context, { ...FLAT, format: "rgba32float", width, height });
    this.#flat(texture, layer, (found) => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.#source);
      attach(gl, gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, colors, 0, 0);
      gl.drawBuffers([gl.COLOR_ATTACHMENT0]);
      this.#presenter.unpack(found);
    });
    const texels = readBound(gl, colors);
    gl.deleteTexture(colors.gl);
    return texels;
  }

  /**
   * Call `work` with a flat texture that has the texels of a layer.
   * @param {Texture} texture
   * @param {number} layer
   * @param {(texture: Texture) => void} work
   */
  #flat(texture, layer, work) {
    if (texture.dimension === "2d") return work(texture);
    const { format, width, height } = texture;
    const copy = makeTexture(this.#context, { ...FLAT, format, width, height });
    this.#copyLayer(texture, layer, 0, copy, 0);
    work(copy);
    this.#gl.deleteTexture(copy.gl);
  }
}

/** @type {Pick<TextureSize, "dimension" | "layers" | "levels" | "samples" | "uses">} */
const FLAT = { dimension: "2d", layers: 1, levels: 1, samples: 1, uses: [] };

/**
 * The texels of the framebuffer that is bound. WebGL only promises to read four lanes.
 * @param {Gl} gl
 * @param {Texture} texture
 * @returns {Float32Array}
 */
function readBound(gl, { format, width, height }) {
  const isFloat = format.endsWith("float");
  const lanes = new (isFloat ? Float32Array : Uint8Array)(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, isFloat ? gl.FLOAT : gl.UNSIGNED_BYTE, lanes);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, null, 0);
  if (lanes instanceof Float32Array) return lanes;
  return toFloats(format.endsWith("srgb") ? "rgba8unorm-srgb" : "rgba8unorm", lanes);
}
