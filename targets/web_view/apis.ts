// The APIs of browsers that the host draws with, as the page names them.

import { hasApi, PROFILES, type Api } from "../web_host/host.js";

export const TITLES: Record<Api, string> = { webgpu: "WebGPU", webgl2: "WebGL 2" };

/** The first API that the browser has; null if it has none of them. */
export async function chosenApi(): Promise<Api | null> {
  for (const api of Object.keys(PROFILES) as Api[]) if (await hasApi(api)) return api;
  return null;
}

export const NO_API =
  `This browser offers nothing that this page can draw with: ` +
  `${Object.values(TITLES).join(", ")}. A newer one may, such as Chrome 113, Edge 113, ` +
  `Safari 26 or Firefox 141.`;
