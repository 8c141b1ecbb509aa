// The APIs of browsers that the host draws with, the better ones first.

import type { Api as Name } from "../web_host/host.js";

export interface Api {
  name: Name;
  title: string;
  /** The texts that it takes. */
  profile: string;
  isThere(): Promise<boolean>;
}

const APIS: Api[] = [
  {
    name: "webgpu",
    title: "WebGPU",
    profile: "wgsl:webgpu",
    isThere: async () => Boolean(await navigator.gpu?.requestAdapter()),
  },
  {
    name: "webgl2",
    title: "WebGL 2",
    profile: "glsl:es300",
    isThere: async () => Boolean(document.createElement("canvas").getContext("webgl2")),
  },
];

/** The first API that the browser has; null if it has none of them. */
export async function chosenApi(): Promise<Api | null> {
  for (const api of APIS) if (await api.isThere()) return api;
  return null;
}

export const NO_API =
  `This browser offers nothing that this page can draw with: ` +
  `${APIS.map(({ title }) => title).join(", ")}. A newer one may, such as Chrome 113, Edge 113, ` +
  `Safari 26 or Firefox 141.`;
