// Draws with WebGPU: packages of frames, and frame jobs.

import { answer, LostBrowser, news, Refusal } from "./answers.mjs";
import { Device } from "./host/webgpu/device.js";
import { PROFILE } from "./host/webgpu/pipelines.js";
import { WebGpuRenderer } from "./host/webgpu/renderer.js";
import { found } from "./jobs.mjs";

export { frames } from "./frames.mjs";

// WebGPU does not report it. This is `subPixelPrecisionBits` of SwiftShader's Vulkan driver, which
// the browser was told to use.
const SUBPIXEL_BITS = 4;

let opened = null;

/** The page's device, or a new one if it was lost. */
async function theDevice() {
  if (opened && !opened.isLost) return opened;
  try {
    opened = await Device.open();
  } catch (error) {
    throw new LostBrowser(error.message);
  }
  return opened;
}

export function device() {
  return answer(async () => {
    const { gpu } = await theDevice();
    const { vendor, architecture, device, description } = gpu.adapterInfo;
    return {
      name: [description || device, vendor, architecture].filter(Boolean).join(", "),
      subpixel_bits: SUBPIXEL_BITS,
      most_groups: gpu.limits.maxComputeWorkgroupsPerDimension,
    };
  });
}

/** Executes a frame job, and answers with the contents that it reads back. */
export function job(given) {
  return answer(async () => {
    const device = await theDevice();
    // A job that broke off may have left errors, which are not this job's.
    complaints(device);
    try {
      return await Promise.race([executed(device, given), loss(device)]);
    } catch (error) {
      await news(); // What the device complains about is the reason of other errors.
      throw complaints(device) ?? error;
    }
  });
}

async function executed(device, given) {
  await refuseMessages(device, given.shaders);
  return found(await WebGpuRenderer.open(device, given, null, false), given);
}

async function loss({ gpu }) {
  const { reason, message } = await gpu.lost;
  throw new Refusal(`the WebGPU device was lost (${reason}): ${message}`);
}

/** An error with what the device complains about, if it does. */
function complaints(device) {
  try {
    device.check();
    return null;
  } catch (error) {
    return error;
  }
}

/** Any message of the compiler about a text is an error here, also what pages do not care about. */
async function refuseMessages({ gpu }, shaders) {
  for (const { texts } of shaders) {
    for (const [stage, { text }] of Object.entries(texts[PROFILE])) {
      const { messages } = await gpu.createShaderModule({ code: text }).getCompilationInfo();
      if (!messages.length) continue;
      const lines = messages.map(
        ({ type, lineNum, linePos, message }) => `${stage} ${lineNum}:${linePos}: ${type}: ${message}`,
      );
      throw new Refusal(lines.join("\n"));
    }
  }
}
