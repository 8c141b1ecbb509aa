// The APIs of browsers that the host draws with, as the page names them.

import { hasApi, PROFILES } from "../web_host/host.js";

/** @import { Api } from "../web_host/host.js" */

/** @type {Record<Api, string>} */
export const TITLES = { webgpu: "WebGPU", webgl2: "WebGL 2" };

/**
 * The first API that the browser has; null if it has none of them.
 * @returns {Promise<Api | null>}
 */
export async function chosenApi() {
  for (const api of /** @type {Api[]} */ (Object.keys(PROFILES))) if (await hasApi(api)) return api;
  return null;
}

export const NO_API =
  `This browser offers nothing that this page can draw with: ` +
  `${Object.values(TITLES).join(", ")}. A newer one may, such as Chrome 113, Edge 113, ` +
  `Safari 26 or Firefox 141.`;
