// Opens packages of frames in a web page: see docs/hosts.md.

import { checkVersions, PlanFrame } from "./frame.js";
import type { Frame, FramePackage } from "./types.js";
import { Device } from "./webgpu/device.js";
import { WebGpuRenderer } from "./webgpu/renderer.js";

export type { Camera, Frame, FramePackage, Pixels, Value } from "./types.js";

/** A frame that draws with WebGPU; without a canvas it cannot be shown, but read. */
export async function openFrame(
  canvas: HTMLCanvasElement | OffscreenCanvas | null,
  from: FramePackage,
): Promise<Frame> {
  checkVersions(from);
  const device = await Device.open();
  try {
    return new PlanFrame(from, await WebGpuRenderer.open(device, from, canvas));
  } catch (error) {
    device.gpu.destroy();
    throw error;
  }
}
