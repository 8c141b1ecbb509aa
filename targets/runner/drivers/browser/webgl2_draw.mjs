// Draws one picture of a job: its resources, the state, and reading it back.

import { bytes, Refusal } from "./answers.mjs";
import {
  clear, deleteScreen, makeScreen, readTarget, resolve, setBlending,
} from "./webgl2_screen.mjs";
import { bindSampler, bindTexture, COMPARES } from "./webgl2_textures.mjs";

/** The picture of a draw: the format and the texels of each target. */
export function drawPicture(gl, extensions, program, job, draw) {
  const size = [draw.width, draw.height];
  const resolved = job.samples > 1 ? makeScreen(gl, job, size, true) : null;
  const screen = makeScreen(gl, job, size);
  try {
    clear(gl, job, draw);
    setState(gl, extensions, job);
    setBlending(gl, extensions, job.targets, draw.blend_constant);
    drawMesh(gl, program, job, draw);
    if (resolved) resolve(gl, job, screen, resolved, size);
    return job.targets.map(({ format }, at) => readTarget(gl, at, format, size));
  } finally {
    deleteScreen(gl, screen);
    if (resolved) deleteScreen(gl, resolved);
  }
}

const OPERATIONS = {
  keep: "KEEP", zero: "ZERO", replace: "REPLACE", invert: "INVERT",
  increment_clamp: "INCR", decrement_clamp: "DECR",
  increment_wrap: "INCR_WRAP", decrement_wrap: "DECR_WRAP",
};

function setState(gl, extensions, job) {
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl[COMPARES[job.depth_compare]]);
  gl.depthMask(job.depth_write);
  (job.cull === "none" ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
  gl.cullFace(job.cull === "front" ? gl.FRONT : gl.BACK);
  gl.frontFace(job.front_face === "cw" ? gl.CW : gl.CCW);
  setBias(gl, extensions, job.depth_bias);
  setStencil(gl, job.stencil);
}

function setBias(gl, { EXT_polygon_offset_clamp: clamped }, { constant, slope, clamp }) {
  gl.enable(gl.POLYGON_OFFSET_FILL);
  if (!clamp) return gl.polygonOffset(slope, constant);
  if (!clamped) throw new Refusal("WebGL cannot limit a depth bias: it lacks EXT_polygon_offset_clamp");
  clamped.polygonOffsetClampEXT(slope, constant, clamp);
}

function setStencil(gl, stencil) {
  if (!stencil) return gl.disable(gl.STENCIL_TEST);
  gl.enable(gl.STENCIL_TEST);
  gl.stencilMask(stencil.write_mask);
  for (const [face, side] of [[gl.FRONT, stencil.front], [gl.BACK, stencil.back]]) {
    const { reference, read_mask: mask } = stencil;
    gl.stencilFuncSeparate(face, gl[COMPARES[side.compare]], reference, mask);
    const operations = [side.fail, side.depth_fail, side.passed];
    gl.stencilOpSeparate(face, ...operations.map((name) => gl[OPERATIONS[name]]));
  }
}

function drawMesh(gl, program, job, draw) {
  withMesh(gl, program, job, draw, () => {
    const [mode, corners] = job.primitive === "line" ? [gl.LINES, 2] : [gl.TRIANGLES, 3];
    const indices = firstVertexLast(new Uint32Array(bytes(draw.indices).buffer), corners);
    const mesh = makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, indices);
    try {
      gl.drawElementsInstanced(mode, indices.length, gl.UNSIGNED_INT, 0, draw.instance_count);
    } finally {
      gl.deleteBuffer(mesh);
    }
  });
}

/** Calls `work` while everything is bound that the program reads, and deletes it in any case. */
export function withMesh(gl, program, job, draw, work) {
  const deletions = [];
  const keep = (made, remove) => (deletions.push(() => remove.call(gl, made)), made);
  try {
    bindEverything(gl, program, job, draw, keep);
    work();
  } finally {
    gl.bindVertexArray(null);
    deletions.forEach((remove) => remove());
  }
}

function bindEverything(gl, program, job, draw, keep) {
  gl.useProgram(program);
  job.host_uniforms.forEach((name) => {
    gl.uniform1f(gl.getUniformLocation(program, name), draw.height);
  });
  draw.textures.forEach((image, unit) => keep(bindTexture(gl, unit, image), gl.deleteTexture));
  job.textures.forEach((slot, unit) => keep(bindSampler(gl, unit, slot), gl.deleteSampler));
  draw.blocks.forEach((data, at) => {
    const block = keep(makeBuffer(gl, gl.UNIFORM_BUFFER, bytes(data)), gl.deleteBuffer);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, at, block);
  });
  gl.bindVertexArray(keep(gl.createVertexArray(), gl.deleteVertexArray));
  job.inputs.forEach((slot, at) =>
    keep(feed(gl, program, slot, draw.vertices[at]), gl.deleteBuffer),
  );
}

function makeBuffer(gl, kind, data) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(kind, buffer);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return buffer;
}

/** A buffer with the values of a vertex attribute, bound to that attribute. */
function feed(gl, program, { identifier, format, step }, data) {
  const buffer = makeBuffer(gl, gl.ARRAY_BUFFER, bytes(data));
  const location = gl.getAttribLocation(program, identifier);
  if (location < 0) return buffer; // not used, so left out by the linker
  const [kind, lanes = "1"] = format.split("x");
  gl.enableVertexAttribArray(location);
  gl.vertexAttribDivisor(location, step === "instance" ? 1 : 0);
  if (kind === "float32") {
    gl.vertexAttribPointer(location, Number(lanes), gl.FLOAT, false, 0, 0);
  } else {
    const type = kind === "sint32" ? gl.INT : gl.UNSIGNED_INT;
    gl.vertexAttribIPointer(location, Number(lanes), type, 0, 0);
  }
  return buffer;
}

/** The same triangles or lines, with the first vertex of each moved to the end.
 *
 * In a job, a flat varying has its value at the first vertex, but in WebGL at the last.
 */
function firstVertexLast(indices, corners) {
  const turned = new Uint32Array(indices.length);
  for (let at = 0; at < indices.length; at += corners) {
    turned.set(indices.subarray(at + 1, at + corners), at);
    turned[at + corners - 1] = indices[at];
  }
  return turned;
}
