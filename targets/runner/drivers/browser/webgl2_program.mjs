// Links a program, and checks that all of its inputs are bound.

import { Refusal } from "./answers.mjs";

// WebGL links no program without a fragment shader, also where vertices are captured.
const NO_FRAGMENTS = "#version 300 es\nvoid main() {}\n";

/** Compile and link; the binding of a block or texture is its number in the pipeline. */
export function linkProgram(gl, job) {
  const program = gl.createProgram();
  const shaders = [
    makeShader(gl, gl.VERTEX_SHADER, job.stages.vertex.text),
    makeShader(gl, gl.FRAGMENT_SHADER, job.stages.fragment?.text ?? NO_FRAGMENTS),
  ];
  shaders.forEach((shader) => gl.attachShader(program, shader));
  if (job.stream_output) {
    const names = job.stream_output.outputs.map((output) => output.identifier);
    gl.transformFeedbackVaryings(program, names, gl.INTERLEAVED_ATTRIBS);
  }
  gl.linkProgram(program);
  const failed = [...shaders, program].map((object) => complaint(gl, object)).filter(Boolean);
  shaders.forEach((shader) => gl.deleteShader(shader));
  if (failed.length) throw new Refusal(failed.join("\n"));
  refuseStrangers(gl, program, job);
  bindNames(gl, program, job);
  return program;
}

function makeShader(gl, stage, text) {
  const shader = gl.createShader(stage);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
}

/** The compiler's or linker's message about a shader or program that it refuses. */
function complaint(gl, object) {
  const isShader = object instanceof WebGLShader;
  const taken = isShader
    ? gl.getShaderParameter(object, gl.COMPILE_STATUS)
    : gl.getProgramParameter(object, gl.LINK_STATUS);
  if (taken) return "";
  return isShader ? `shader: ${gl.getShaderInfoLog(object)}` : gl.getProgramInfoLog(object);
}

// WebGL would read zeros for anything that is not bound.
function refuseStrangers(gl, program, job) {
  const attributes = job.inputs.map((slot) => slot.identifier);
  const count = gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES);
  const read = Array.from({ length: count }, (_, at) => gl.getActiveAttrib(program, at).name);
  refuse("vertex attribute", attributes, read);
  const blocks = job.blocks.map((slot) => slot.place.identifier);
  const uniforms = job.textures.map((slot) => slot.texture.identifier).concat(job.host_uniforms);
  refuse("uniform block", blocks, blockNames(gl, program));
  refuse("uniform", uniforms, looseUniforms(gl, program));
}

function blockNames(gl, program) {
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS);
  return Array.from({ length: count }, (_, at) => gl.getActiveUniformBlockName(program, at));
}

function looseUniforms(gl, program) {
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  const all = Array.from({ length: count }, (_, at) => at);
  const blocks = gl.getActiveUniforms(program, all, gl.UNIFORM_BLOCK_INDEX);
  return all.filter((at) => blocks[at] < 0).map((at) => gl.getActiveUniform(program, at).name);
}

function refuse(what, filled, read) {
  const stranger = read.find((name) => !filled.includes(name) && !name.startsWith("gl_"));
  if (stranger) {
    throw new Refusal(`the shader reads ${what} '${stranger}', which the job does not have`);
  }
}

function bindNames(gl, program, job) {
  job.blocks.forEach(({ place, size }, number) => {
    const index = gl.getUniformBlockIndex(program, place.identifier);
    if (index === gl.INVALID_INDEX) return; // not used, so left out by the linker
    const inShader = gl.getActiveUniformBlockParameter(program, index, gl.UNIFORM_BLOCK_DATA_SIZE);
    if (inShader > size) {
      throw new Refusal(
        `uniform block '${place.identifier}' has ${inShader} bytes in the shader,` +
          ` but only ${size} are bound`,
      );
    }
    gl.uniformBlockBinding(program, index, number);
  });
  gl.useProgram(program);
  job.textures.forEach(({ texture }, number) => {
    gl.uniform1i(gl.getUniformLocation(program, texture.identifier), number);
  });
}
