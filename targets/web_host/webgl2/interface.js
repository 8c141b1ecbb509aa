// Checks that a program reads nothing that its reflection lacks: WebGL would read zeros.

import { present } from "../present.js";

/**
 * @import { Reflection } from "../generated/documents.js"
 * @import { Gl } from "./context.js"
 */

/**
 * Throws an error for a vertex input, a block or a uniform that would stay unbound, and for a block
 * that is larger in the text than in the reflection.
 * @param {Gl} gl
 * @param {WebGLProgram} program
 * @param {Reflection} reflection
 * @param {string} profile
 */
export function checkInterface(gl, program, { material, blocks, backends }, profile) {
  const backend = backends[profile];
  /**
   * @type {(kind: string, known: Record<string, { identifier: string }>, read: string[]) => void}
   */
  const refuse = (kind, known, read) => {
    const names = Object.values(known).map(({ identifier }) => identifier);
    const other = read.find((name) => !names.includes(name) && !name.startsWith("gl_"));
    if (other === undefined) return;
    const wrong = `a text of ${material} reads ${kind} '${other}'`;
    throw new Error(`${wrong}, which its reflection does not have`);
  };
  const heights = Object.fromEntries(backend.host_uniforms.map((identifier) => {
    return [identifier, { identifier }];
  }));
  refuse("vertex attribute", backend.vertex_inputs, attributes(gl, program));
  refuse("uniform block", backend.blocks, blockNames(gl, program));
  refuse("uniform", { ...backend.textures, ...heights }, looseUniforms(gl, program));
  for (const { name, size } of blocks) {
    const identifier = backend.blocks[name]?.identifier;
    const index = gl.getUniformBlockIndex(program, identifier ?? "");
    if (index === gl.INVALID_INDEX) continue; // not used, so left out by the linker
    const read = gl.getActiveUniformBlockParameter(program, index, gl.UNIFORM_BLOCK_DATA_SIZE);
    if (read > size) {
      const wrong = `uniform block '${identifier}' has ${read} bytes in a text of ${material}`;
      throw new Error(`${wrong}, but only ${size} are bound`);
    }
  }
}

/** @type {(length: number) => number[]} */
const numbers = (length) => Array.from({ length }, (_, at) => at);

/**
 * @param {Gl} gl
 * @param {WebGLProgram} program
 * @returns {string[]}
 */
function attributes(gl, program) {
  const count = /** @type {number} */ (gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES));
  return numbers(count).map((at) => present(gl.getActiveAttrib(program, at)).name);
}

/**
 * @param {Gl} gl
 * @param {WebGLProgram} program
 * @returns {string[]}
 */
function blockNames(gl, program) {
  const count = /** @type {number} */ (gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS));
  return numbers(count).map((at) => present(gl.getActiveUniformBlockName(program, at)));
}

/**
 * @param {Gl} gl
 * @param {WebGLProgram} program
 * @returns {string[]}
 */
function looseUniforms(gl, program) {
  const all = numbers(/** @type {number} */ (gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS)));
  /** @type {number[]} */
  const blocks = gl.getActiveUniforms(program, all, gl.UNIFORM_BLOCK_INDEX);
  const loose = all.filter((at) => blocks[at] < 0);
  return loose.map((at) => present(gl.getActiveUniform(program, at)).name);
}
