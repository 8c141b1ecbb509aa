// The state of WebGL 2's pipeline that a pass asks for: see `render_state` and `targets` in
// docs/reflection.md.

import { hasStencil } from "../bytes.js";
import { PROFILE } from "./programs.js";
import { topologyOf } from "./meshes.js";
import { compareOf } from "./textures.js";

/**
 * @import { Reflection, TargetRow } from "../generated/documents.js"
 * @import { Context, Gl } from "./context.js"
 */

/** @typedef {Reflection["render_state"]} RenderState */
/** @typedef {NonNullable<TargetRow["blend"]>} Blend */
/** @typedef {Blend["color"]["source"]} BlendFactor */

/**
 * Set everything for draws of a shader. `depths` is the format of the depths, if there are any.
 * @param {Context} context
 * @param {Reflection} reflection
 * @param {GPUTextureFormat | null} depths
 */
export function setState(context, reflection, depths) {
  const { gl } = context;
  const { render_state: state, backends, material } = reflection;
  if (state.fill === "lines") {
    throw new Error(`WebGL 2 cannot draw the edges of triangles, as ${material} asks`);
  }
  turn(gl, gl.CULL_FACE, state.cull !== "none");
  gl.cullFace(state.cull === "front" ? gl.FRONT : gl.BACK);
  gl.frontFace(backends[PROFILE].front_face === "cw" ? gl.CW : gl.CCW);
  turn(gl, gl.SAMPLE_ALPHA_TO_COVERAGE, state.alpha_to_coverage);
  turn(gl, gl.DEPTH_TEST, depths !== null);
  gl.depthFunc(compareOf(gl, state.depth.compare));
  gl.depthMask(state.depth.write);
  setBias(context, state, topologyOf(reflection) === "triangle-list");
  setStencil(gl, depths !== null && hasStencil(depths) ? state.stencil : null);
  setTargets(context, reflection);
}

/**
 * @param {Gl} gl
 * @param {number} what
 * @param {boolean} on
 */
function turn(gl, what, on) {
  if (on) gl.enable(what);
  else gl.disable(what);
}

/**
 * The extension `EXT_polygon_offset_clamp`.
 * @typedef {object} Clamped
 * @property {(slope: number, constant: number, clamp: number) => void} polygonOffsetClampEXT
 */

/**
 * @param {Context} context
 * @param {RenderState} state
 * @param {boolean} isFilled
 */
function setBias(context, { depth }, isFilled) {
  const { gl } = context;
  const { bias, slope_bias: slope, bias_clamp: clamp } = depth;
  const isBiased = isFilled && (bias !== 0 || slope !== 0);
  turn(gl, gl.POLYGON_OFFSET_FILL, isBiased);
  if (!isBiased) return;
  if (clamp === 0) return gl.polygonOffset(slope, bias);
  const found = context.need("EXT_polygon_offset_clamp", "limit the bias of depths");
  /** @type {Clamped} */ (found).polygonOffsetClampEXT(slope, bias, clamp);
}

/**
 * @param {Gl} gl
 * @param {RenderState["stencil"]} stencil
 */
function setStencil(gl, stencil) {
  turn(gl, gl.STENCIL_TEST, stencil !== null);
  if (!stencil) return;
  gl.stencilMask(stencil.write_mask);
  const { front, back } = stencil;
  for (const [face, side] of /** @type {const} */ ([[gl.FRONT, front], [gl.BACK, back]])) {
    gl.stencilFuncSeparate(face, compareOf(gl, side.compare), stencil.reference, stencil.read_mask);
    const words = [side.fail_op, side.depth_fail_op, side.pass_op];
    const [fail, behind, pass] = words.map((word) => gl[STENCIL_OPERATIONS[word]]);
    gl.stencilOpSeparate(face, fail, behind, pass);
  }
}

const STENCIL_OPERATIONS = /** @type {const} */ ({
  "keep": "KEEP", "zero": "ZERO", "replace": "REPLACE", "invert": "INVERT",
  "increment-clamp": "INCR", "decrement-clamp": "DECR",
  "increment-wrap": "INCR_WRAP", "decrement-wrap": "DECR_WRAP",
});

// --- targets -------------------------------------------------------------------------------------

/**
 * Blending and masks. Only an extension has other ones for each target.
 * @param {Context} context
 * @param {Reflection} reflection
 */
function setTargets(context, { targets }) {
  const { gl } = context;
  const states = targets.map(({ blend, mask }) => JSON.stringify([blend, mask]));
  if (new Set(states).size > 1) {
    const found = context.need("OES_draw_buffers_indexed", "blend each target differently");
    const indexed = /** @type {OES_draw_buffers_indexed} */ (found);
    targets.forEach((target, at) => setTarget(gl, indexed, at, target));
    return;
  }
  const [first] = targets;
  if (!first) return;
  turn(gl, gl.BLEND, first.blend !== null);
  if (first.blend) {
    gl.blendEquationSeparate(...operations(gl, first.blend));
    gl.blendFuncSeparate(...factors(gl, first.blend));
  }
  gl.colorMask(...lanesOf(first.mask));
}

/**
 * @param {Gl} gl
 * @param {OES_draw_buffers_indexed} indexed
 * @param {number} at
 * @param {TargetRow} target
 */
function setTarget(gl, indexed, at, { blend, mask }) {
  indexed.colorMaskiOES(at, ...lanesOf(mask));
  if (!blend) return indexed.disableiOES(gl.BLEND, at);
  indexed.enableiOES(gl.BLEND, at);
  indexed.blendEquationSeparateiOES(at, ...operations(gl, blend));
  indexed.blendFuncSeparateiOES(at, ...factors(gl, blend));
}

/** @type {(mask: string) => Lanes} */
const lanesOf = (mask) =>
  /** @type {Lanes} */ ([..."rgba"].map((lane) => mask !== "none" && mask.includes(lane)));

/** @typedef {[boolean, boolean, boolean, boolean]} Lanes */
/** @typedef {"FUNC_ADD" | "FUNC_SUBTRACT" | "FUNC_REVERSE_SUBTRACT" | "MIN" | "MAX"} Equation */

/** @type {Record<GPUBlendOperation, Equation>} */
const OPERATIONS = {
  "add": "FUNC_ADD", "subtract": "FUNC_SUBTRACT", "reverse-subtract": "FUNC_REVERSE_SUBTRACT",
  "min": "MIN", "max": "MAX",
};

/** @type {(gl: Gl, blend: Blend) => [number, number]} */
const operations = (gl, { color, alpha }) =>
  [gl[OPERATIONS[color.operation]], gl[OPERATIONS[alpha.operation]]];

/** The factor of colours and that of alpha. @type {Record<BlendFactor, [keyof Gl, keyof Gl]>} */
const FACTORS = {
  "zero": ["ZERO", "ZERO"],
  "one": ["ONE", "ONE"],
  "src": ["SRC_COLOR", "SRC_ALPHA"],
  "one-minus-src": ["ONE_MINUS_SRC_COLOR", "ONE_MINUS_SRC_ALPHA"],
  "src-alpha": ["SRC_ALPHA", "SRC_ALPHA"],
  "one-minus-src-alpha": ["ONE_MINUS_SRC_ALPHA", "ONE_MINUS_SRC_ALPHA"],
  "dst": ["DST_COLOR", "DST_ALPHA"],
  "one-minus-dst": ["ONE_MINUS_DST_COLOR", "ONE_MINUS_DST_ALPHA"],
  "dst-alpha": ["DST_ALPHA", "DST_ALPHA"],
  "one-minus-dst-alpha": ["ONE_MINUS_DST_ALPHA", "ONE_MINUS_DST_ALPHA"],
  "src-alpha-saturated": ["SRC_ALPHA_SATURATE", "SRC_ALPHA_SATURATE"],
  "constant": ["CONSTANT_COLOR", "CONSTANT_ALPHA"],
  "one-minus-constant": ["ONE_MINUS_CONSTANT_COLOR", "ONE_MINUS_CONSTANT_ALPHA"],
};

/**
 * Of colours, source and destination; then of alpha.
 * @param {Gl} gl
 * @param {Blend} blend
 * @returns {[number, number, number, number]}
 */
function factors(gl, { color, alpha }) {
  /** @type {(word: BlendFactor, lanes: 0 | 1) => number} */
  const of = (word, lanes) => /** @type {number} */ (gl[FACTORS[word][lanes]]);
  return [
    of(color.source, 0), of(color.destination, 0), of(alpha.source, 1), of(alpha.destination, 1),
  ];
}
