// Draws packages of frames with the host for web pages, which the page has under `host/`.

import { answer, base64, Refusal } from "./answers.mjs";
import { openFrame } from "./host/host.js";

/** What some outputs show, frame after frame. */
export function frames({ whole, count, outputs }) {
  return answer(async () => {
    try {
      return { texels: await drawAll(whole, count, outputs) };
    } catch (error) {
      // The host's own errors are sentences; others are mistakes in it, and keep their names.
      throw error.constructor === Error ? new Refusal(error.message) : error;
    }
  });
}

async function drawAll(whole, count, outputs) {
  const frame = await openFrame(null, whole);
  try {
    const found = [];
    for (let number = 0; number < count; number++) {
      frame.draw();
      for (const output of outputs) {
        const { texels, ...size } = await frame.read(output);
        found.push({ ...size, texels: base64(new Uint8Array(texels.buffer)) });
      }
    }
    return found;
  } finally {
    frame.dispose();
  }
}
