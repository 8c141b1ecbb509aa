// Draws textures over the whole framebuffer that is bound: to a canvas in sRGB, or unchanged.

import { isDepth, lanesOf } from "../bytes.js";
import { compiled } from "./programs.js";

/**
 * @import { Context } from "./context.js"
 * @import { Texture } from "./textures.js"
 */

const CORNERS = `#version 300 es
void main() {
  gl_Position = vec4(float(gl_VertexID & 1) * 4. - 1., float(gl_VertexID >> 1) * 4. - 1., 0, 1);
}`;

const TEXT = `#version 300 es
precision highp float;
uniform highp sampler2D shown;
uniform vec2 size;
out vec4 pixel;
vec4 texel(vec2 at) {
  return texelFetch(shown, ivec2(at / size * vec2(textureSize(shown, 0))), 0);
}`;

/** Encodes sRGB and drops the alpha. */
const ON_SCREEN = `${TEXT}
void main() {
  vec3 linear = clamp(texel(vec2(gl_FragCoord.x, ROW)).LANES, 0., 1.);
  vec3 bent = 1.055 * pow(linear, vec3(1. / 2.4)) - .055;
  pixel = vec4(mix(bent, linear * 12.92, lessThanEqual(linear, vec3(.0031308))), 1);
}`;

const AS_IT_IS = `${TEXT}
void main() { pixel = vec4(texel(gl_FragCoord.xy).r, 0, 0, 1); }`;

export class Presenter {
  /** @type {Map<string, WebGLProgram>} */
  #programs = new Map();
  /** @type {WebGLSampler} */
  #sampler;
  /** @type {WebGLVertexArrayObject} */
  #vertices;

  #context;

  /** @param {Context} context */
  constructor(context) {
    this.#context = context;
    const { gl } = context;
    this.#vertices = gl.createVertexArray();
    this.#sampler = gl.createSampler();
    gl.samplerParameteri(this.#sampler, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.samplerParameteri(this.#sampler, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  /**
   * Show a flat texture on the whole canvas.
   * @param {Texture} texture
   * @param {boolean} isBottomUp True if the first row of the texture is the bottom one.
   */
  show(texture, isBottomUp) {
    const { gl } = this.#context;
    const lanes = lanesOf(texture.format)[0] === 1 ? "rrr" : "rgb";
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    // A canvas counts its rows from below.
    const row = isBottomUp ? "gl_FragCoord.y" : "size.y - gl_FragCoord.y";
    const text = ON_SCREEN.replace("LANES", lanes).replace("ROW", row);
    this.#cover(text, texture, gl.drawingBufferWidth, gl.drawingBufferHeight);
  }

  /**
   * Draw the depths of a flat texture as numbers to the framebuffer that is bound.
   * @param {Texture} texture
   */
  unpack(texture) {
    if (!isDepth(texture.format)) throw new Error(`${texture.format} has no depths`);
    this.#cover(AS_IT_IS, texture, texture.width, texture.height);
  }

  dispose() {
    const { gl } = this.#context;
    this.#programs.forEach((each) => gl.deleteProgram(each));
    gl.deleteSampler(this.#sampler);
    gl.deleteVertexArray(this.#vertices);
  }

  /**
   * @param {string} text
   * @param {Texture} texture
   * @param {number} width
   * @param {number} height
   */
  #cover(text, texture, width, height) {
    const { gl } = this.#context;
    const tests = [gl.DEPTH_TEST, gl.STENCIL_TEST, gl.SCISSOR_TEST];
    for (const state of [...tests, gl.CULL_FACE, gl.BLEND]) gl.disable(state);
    gl.colorMask(true, true, true, true);
    gl.viewport(0, 0, width, height);
    const program = this.#program(text);
    gl.useProgram(program);
    gl.uniform2f(gl.getUniformLocation(program, "size"), width, height);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture.gl);
    gl.bindSampler(0, this.#sampler);
    gl.bindVertexArray(this.#vertices);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /**
   * @param {string} text
   * @returns {WebGLProgram}
   */
  #program(text) {
    const known = this.#programs.get(text);
    if (known) return known;
    const { gl } = this.#context;
    const program = gl.createProgram();
    gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, CORNERS));
    gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, text));
    gl.linkProgram(program);
    this.#programs.set(text, program);
    return program;
  }
}
