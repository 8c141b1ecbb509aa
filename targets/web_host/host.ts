// Opens packages of frames in a web page: see docs/hosts.md.

import { checkVersions, PlanFrame } from "./frame.js";
import type { Package } from "./generated/documents.js";
import { PROFILE as ES_3_00 } from "./webgl2/programs.js";
import { WebGl2Renderer } from "./webgl2/renderer.js";
import { Device } from "./webgpu/device.js";
import { PROFILE as WGSL } from "./webgpu/pipelines.js";
import { WebGpuRenderer } from "./webgpu/renderer.js";

export type { CameraRow as Camera, Package as FramePackage, Value } from "./generated/documents.js";
export type { Pixels } from "./renderer.js";

/** A frame of any API. */
export type Frame = Pick<PlanFrame<unknown, unknown>, keyof PlanFrame<unknown, unknown>>;

/** What a browser can draw with. */
export type Api = "webgpu" | "webgl2";

/** The profile whose texts each of them takes, the better one first. */
export const PROFILES: Record<Api, string> = { webgpu: WGSL, webgl2: ES_3_00 };

/** Whether this browser has an API, and a device for it. */
export async function hasApi(api: Api): Promise<boolean> {
  if (api === "webgpu") return Boolean(await navigator.gpu?.requestAdapter());
  return Boolean(new OffscreenCanvas(1, 1).getContext("webgl2"));
}

type Canvas = HTMLCanvasElement | OffscreenCanvas | null;

/** The API that draws a package here: WebGPU where the browser has it and the package has its
 * texts, and else WebGL 2. An error says why neither of them does. */
export async function apiFor(from: Package): Promise<Api> {
  checkVersions(from);
  const has = (profile: string) => from.shaders.every(({ texts }) => texts[profile]);
  if (has(WGSL) && (await hasApi("webgpu"))) return "webgpu";
  if (has(ES_3_00)) return "webgl2";
  const { frame } = from.plan;
  throw new Error(
    has(WGSL)
      ? `this browser offers no WebGPU adapter, and ${frame} has no texts for WebGL 2`
      : `the package of ${frame} has no texts for a browser`,
  );
}

/** The device of each canvas: frames that are opened on it one after the other share what it has
 * compiled. */
const devices = new WeakMap<HTMLCanvasElement | OffscreenCanvas, Device>();

/** A frame that draws to a canvas; without one it cannot be shown, but read. A canvas keeps the API
 * with which it was opened first. */
export async function openFrame(canvas: Canvas, from: Package, api?: Api): Promise<Frame> {
  checkVersions(from);
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
