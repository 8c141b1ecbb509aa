// Draws packages of frames with the host for web pages, which the page has under `host/`.

import { answer, base64 } from "./answers.mjs";
import { openFrame } from "./host/host.js";

/** Draws `count` frames, and answers with the texels of some outputs of each of them. */
export function frames({ whole, count, outputs }) {
  return answer(async () => {
    const frame = await openFrame(null, whole);
    try {
      const texels = [];
      for (let number = 0; number < count; number++) {
        frame.draw();
        for (const output of outputs) texels.push(packed(await frame.read(output)));
      }
      return { texels };
    } finally {
      frame.dispose();
    }
  });
}

/** The contents of a texture that was read, in the form of frame_job.py. */
export const packed = ({ texels, ...size }) => ({ ...size, texels: base64(texels) });
