// Programs of WebGL 2, each linked once when a frame is opened.

import { present } from "../present.js";
import { checkInterface } from "./interface.js";

/**
 * @import { PackagedShader, SamplerRow } from "../generated/documents.js"
 * @import { Context, Gl } from "./context.js"
 */

export const PROFILE = "glsl:es300";

/**
 * A program with the numbers of everything that it reads.
 * @typedef {object} Program
 * @property {WebGLProgram} gl
 * @property {string[]} blocks The name of the block at each binding.
 * @property {{ name: string, state: SamplerRow["state"] | null }[]} textures The texture of each
 *   unit, with its sampler; null where its texels are only loaded.
 * @property {Map<string, number>} inputs The location of each vertex input that the program reads,
 *   by name.
 * @property {WebGLUniformLocation[]} heights Uniforms that are set to the height of the
 *   targets.
 */

/** WebGL links no program without a fragment shader, not even where vertices are captured. */
const NO_FRAGMENTS = { text: "#version 300 es\nvoid main() {}\n" };

/**
 * The programs of all shaders. The browser compiles them at the same time.
 * @param {Context} context
 * @param {PackagedShader[]} shaders
 * @returns {Program[]}
 */
export function linked({ gl }, shaders) {
  /** Equal texts are compiled once. @type {Map<string, WebGLShader>} */
  const compiledOf = new Map();
  const started = shaders.map((shader) => start(gl, shader, compiledOf));
  return shaders.map((shader, at) => finished(gl, shader, started[at]));
}

/**
 * @param {Gl} gl
 * @param {PackagedShader} shader
 * @param {Map<string, WebGLShader>} compiledOf
 * @returns {WebGLProgram}
 */
function start(gl, { reflection, texts }, compiledOf) {
  const { vertex, fragment = reflection.capture && NO_FRAGMENTS } = texts[PROFILE] ?? {};
  if (!vertex || !fragment) {
    throw new Error(`WebGL 2 cannot draw ${reflection.material}: there is no text for ${PROFILE}`);
  }
  const program = gl.createProgram();
  const stages = /** @type {const} */ ([
    [gl.VERTEX_SHADER, vertex.text],
    [gl.FRAGMENT_SHADER, fragment.text],
  ]);
  for (const [kind, text] of stages) {
    const shader = compiledOf.get(text) ?? compiled(gl, kind, text);
    compiledOf.set(text, shader);
    gl.attachShader(program, shader);
  }
  const { capture, backends } = reflection;
  if (capture) {
    const { captures } = backends[PROFILE];
    const names = capture.members.map(({ name }) => captures[name].identifier);
    gl.transformFeedbackVaryings(program, names, gl.INTERLEAVED_ATTRIBS);
  }
  gl.linkProgram(program);
  return program;
}

/**
 * A shader of a text. Errors in the text are reported when its program is linked.
 * @param {Gl} gl
 * @param {number} kind
 * @param {string} text
 * @returns {WebGLShader}
 */
export function compiled(gl, kind, text) {
  const shader = present(gl.createShader(kind));
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
}

/**
 * @param {Gl} gl
 * @param {PackagedShader} shader
 * @param {WebGLProgram} program
 * @returns {Program}
 */
function finished(gl, { reflection }, program) {
  const shaders = present(gl.getAttachedShaders(program));
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    const logs = shaders.map((each) => gl.getShaderInfoLog(each));
    const told = [...logs, gl.getProgramInfoLog(program)].filter(Boolean).join("\n");
    throw new Error(`the browser refuses a text of ${reflection.material}:\n${told}`);
  }
  shaders.forEach((each) => gl.deleteShader(each));
  checkInterface(gl, program, reflection, PROFILE);
  const { blocks, textures, ...others } = reflection.backends[PROFILE];
  const { vertex_inputs: inputs, host_uniforms: heights } = others;
  gl.useProgram(program);
  const bound = reflection.blocks.map(({ name }) => name).filter((name) => blocks[name]);
  bound.forEach((name, at) => {
    const index = gl.getUniformBlockIndex(program, blocks[name].identifier);
    // The linker has left out a block that nothing reads.
    if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, index, at);
  });
  const read = reflection.textures.filter(({ name }) => textures[name]);
  read.forEach(({ name }, unit) => {
    gl.uniform1i(gl.getUniformLocation(program, textures[name].identifier), unit);
  });
  const located = Object.entries(inputs).map(([name, { identifier }]) =>
    /** @type {const} */ ([name, gl.getAttribLocation(program, identifier)]),
  );
  return {
    gl: program,
    blocks: bound,
    textures: read.map(({ name, layout }) => {
      const row = reflection.samplers.find((each) => each.texture === name);
      return { name, state: layout.sampler === null ? null : present(row).state };
    }),
    inputs: new Map(located.filter(([, location]) => location >= 0)),
    heights: heights.flatMap((name) => gl.getUniformLocation(program, name) ?? []),
  };
}
