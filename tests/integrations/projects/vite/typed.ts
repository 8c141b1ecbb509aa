import burnish, { type Frame, type Shader } from "vite-plugin-burnish";
import plastic from "./materials/plastic.burnish";
import { PlasticMaterial } from "./materials/plastic.burnish?binding";

const shader: Shader | undefined = plastic["Plastic"];
const text: string | undefined = shader?.texts["wgsl"]?.fragment;
const frame: Frame | undefined = plastic["Frame"];
export const block = new PlasticMaterial({ power: 32 });
export const found = [text, frame?.shaders[0]?.reflection, burnish({ targets: ["wgsl"] }).name];

// @ts-expect-error - there is no such stage
export const wrong = shader?.texts["wgsl"]?.fragmnt;
