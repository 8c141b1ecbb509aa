// Draws jobs with WebGPU. A job and its pictures are those of draw_job.py, as JSON.

export { frames } from "./frames.mjs";

import { answer } from "./answers.mjs";
import { collectErrors, openDevice } from "./webgpu_device.mjs";
import { runKernel } from "./webgpu_compute.mjs";
import { drawPicture } from "./webgpu_draw.mjs";
import { makePipeline } from "./webgpu_pipeline.mjs";

// WebGPU does not report it. This is `subPixelPrecisionBits` of SwiftShader's Vulkan driver, which
// the browser was told to use.
const SUBPIXEL_BITS = 4;

let opened = null;

/** The page's device, or a new one if it was lost. */
async function theDevice() {
  if (!opened) {
    opened = await openDevice();
    opened.lost.then(() => (opened = null));
  }
  return opened;
}

export function device() {
  return answer(async () => {
    const { vendor, architecture, device, description } = (await theDevice()).adapter.info;
    const name = [description || device, vendor, architecture].filter(Boolean).join(", ");
    return { name, subpixel_bits: SUBPIXEL_BITS };
  });
}

export function draw(job) {
  return answer(async () => {
    const { device, lost } = await theDevice();
    return Promise.race([collectErrors(device, () => drawAll(device, job)), lost]);
  });
}

export function kernel(job) {
  return answer(async () => {
    const { device, lost } = await theDevice();
    return Promise.race([collectErrors(device, () => runKernel(device, job)), lost]);
  });
}

async function drawAll(device, job) {
  const pipeline = await makePipeline(device, job.pipeline);
  const pictures = [];
  for (const each of job.draws) {
    pictures.push(await drawPicture(device, job.pipeline, pipeline, each));
  }
  return { pictures };
}
