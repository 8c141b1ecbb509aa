// Opens the device, and collects its errors from all sources.

import { LostBrowser, Refusal } from "./answers.mjs";

// Features that float32 targets and textures need, and stencil values beside float32 depths.
const FEATURES = ["float32-blendable", "float32-filterable", "depth32float-stencil8"];
// Several float32 targets need more than the default.
const LIMITS = ["maxColorAttachmentBytesPerSample"];
const SCOPES = ["validation", "out-of-memory", "internal"];

/** The adapter, its device, and a promise of the answer to give if the device is lost. */
export async function openDevice() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) {
    throw new LostBrowser("chromium offers no WebGPU adapter; SwiftShader, its own, is missing");
  }
  const device = await adapter.requestDevice({
    requiredFeatures: FEATURES.filter((feature) => adapter.features.has(feature)),
    requiredLimits: Object.fromEntries(LIMITS.map((name) => [name, adapter.limits[name]])),
  });
  const lost = device.lost.then(({ reason, message }) => {
    return { error: `the WebGPU device was lost (${reason}): ${message}` };
  });
  return { adapter, device, lost };
}

/** The result of `work`, unless the device reports an error in the meantime. */
export async function collectErrors(device, work) {
  const messages = [];
  const listen = ({ error }) => messages.push(error.message);
  device.addEventListener("uncapturederror", listen);
  SCOPES.forEach((scope) => device.pushErrorScope(scope));
  let result, thrown;
  try {
    result = await work();
  } catch (error) {
    thrown = error;
  }
  for (const error of await Promise.all(SCOPES.map(() => device.popErrorScope()))) {
    if (error) messages.push(error.message);
  }
  device.removeEventListener("uncapturederror", listen);
  if (thrown instanceof Refusal) throw thrown;
  if (thrown && !(thrown instanceof DOMException)) throw thrown;
  if (messages.length || thrown) {
    throw new Refusal([...new Set([...messages, thrown?.message])].filter(Boolean).join("\n"));
  }
  return result;
}
