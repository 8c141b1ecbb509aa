// Opens packages of frames in a web page: see docs/hosts.md.

import { checkPackage } from "./checking.js";
import { PlanFrame } from "./frame.js";
import { PROFILE as ES_3_00 } from "./webgl2/programs.js";
import { WebGl2Renderer } from "./webgl2/renderer.js";
import { Device } from "./webgpu/device.js";
import { PROFILE as WGSL } from "./webgpu/pipelines.js";
import { WebGpuRenderer } from "./webgpu/renderer.js";

/** @import { Package } from "./generated/documents.js" */

/** @typedef {import("./generated/documents.js").CameraRow} Camera */
/** @typedef {import("./generated/documents.js").Package} FramePackage */
/** @typedef {import("./generated/documents.js").Value} Value */
/** @typedef {import("./renderer.js").Pixels} Pixels */

/** A frame of any API. @typedef {PlanFrame<any, any>} Frame */

/** The API that a browser draws with. @typedef {"webgpu" | "webgl2"} Api */

/**
 * The profile whose texts each API takes, the better API first.
 * @type {Record<Api, string>}
 */
export const PROFILES = { webgpu: WGSL, webgl2: ES_3_00 };

/**
 * True if this browser has an API, and a device for it.
 * @param {Api} api
 * @returns {Promise<boolean>}
 */
export async function hasApi(api) {
  if (api === "webgpu") return Boolean(await navigator.gpu?.requestAdapter());
  return Boolean(new OffscreenCanvas(1, 1).getContext("webgl2"));
}

/** @typedef {HTMLCanvasElement | OffscreenCanvas | null} Canvas */

/**
 * The API that draws a package here: WebGPU where the browser has it and the package has its
 * texts, and else WebGL 2. If neither can, the error says why.
 * @param {Package} from
 * @returns {Promise<Api>}
 */
export async function apiFor(from) {
  checkPackage(from);
  /** @type {(profile: string) => boolean} */
  const has = (profile) => from.shaders.every(({ texts }) => profile in texts);
  if (has(WGSL) && (await hasApi("webgpu"))) return "webgpu";
  if (has(ES_3_00)) return "webgl2";
  const { frame } = from.plan;
  throw new Error(
    has(WGSL)
      ? `this browser offers no WebGPU adapter, and ${frame} has no texts for WebGL 2`
      : `the package of ${frame} has no texts for a browser`,
  );
}

/**
 * The device of each canvas: frames that are opened on one canvas, one after the other, share the
 * pipelines that the device has compiled.
 * @type {WeakMap<HTMLCanvasElement | OffscreenCanvas, Device>}
 */
const devices = new WeakMap();

/**
 * A frame that draws to a canvas; without a canvas it can be read, but not shown. A canvas keeps
 * the API with which it was opened first.
 * @param {Canvas} canvas
 * @param {Package} from
 * @param {Api} [api]
 * @returns {Promise<Frame>}
 */
export async function openFrame(canvas, from, api) {
  checkPackage(from);
  if ((api ?? (await apiFor(from))) === "webgl2") {
    return new PlanFrame(from, WebGl2Renderer.open(from, canvas));
  }
  const known = canvas && devices.get(canvas);
  const device = known && !known.isLost ? known : await Device.open();
  if (canvas) devices.set(canvas, device);
  try {
    return new PlanFrame(from, await WebGpuRenderer.open(device, from, canvas));
  } catch (error) {
    if (!canvas) device.gpu.destroy();
    throw error;
  }
}
