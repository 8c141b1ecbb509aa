// Makes the module of a file from what `burnish compile` has written.

import { readFile } from "node:fs/promises";
import path from "node:path";

const LANGUAGES = { wgsl: "wgsl", glsl: "glsl", hlsl: "hlsl", metal: "msl" };
/** The names of stages as hosts know them, by what names of files have. */
const STAGES = {
  vert: "vertex",
  frag: "fragment",
  comp: "compute",
  geom: "geometry",
  tesc: "tessellation_control",
  tese: "tessellation_evaluation",
};

/** The text of a module whose default export has each material, kernel and frame by its name. */
export async function moduleOf(outputs) {
  const read = await Promise.all(
    outputs.map(async ({ path: file, kind }) => ({
      name: path.basename(file),
      kind,
      text: await readFile(file, "utf8"),
    })),
  );
  const ofKind = (kind) => read.filter((each) => each.kind === kind);
  const shaders = new Map(
    ofKind("reflection").map(({ name, text }) => [
      name,
      { texts: {}, reflection: JSON.parse(text) },
    ]),
  );
  for (const { name, text } of ofKind("text")) {
    place(shaders, name, text);
  }

  const exported = {};
  for (const { text } of ofKind("plan")) {
    const plan = JSON.parse(text);
    const own = plan.shaders.map((row) => row.reflection);
    exported[plan.frame] = { plan, shaders: own.map((name) => shaders.get(name)) };
    own.forEach((name) => shaders.delete(name));
  }
  for (const shader of shaders.values()) {
    exported[shader.reflection.material] = shader;
  }
  return `export default ${JSON.stringify(exported)};\n`;
}

/**
 * Put a text where its name says: `Plastic.es300.frag.glsl` is for the stage `fragment` of the
 * target `glsl:es300`, and belongs to `Plastic.json`. A text of all stages names none.
 */
function place(shaders, name, text) {
  const [owner] = [...shaders.keys()]
    .map((key) => key.replace(/json$/, ""))
    .filter((stem) => name.startsWith(stem))
    .sort((one, other) => other.length - one.length);
  const parts = name.slice(owner.length).split(".");
  const language = LANGUAGES[parts.pop()];
  const stage = parts.at(-1) in STAGES ? STAGES[parts.pop()] : "all";
  const target = [language, ...parts].join(":");
  const { texts } = shaders.get(`${owner}json`);
  texts[target] = { ...texts[target], [stage]: text };
}
