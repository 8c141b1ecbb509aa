// Makes the module of a file from what `burnish compile` has written.

import { readFile } from "node:fs/promises";
import path from "node:path";

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
  const written = new Map(ofKind("text").map(({ name, text }) => [name, text]));
  const shaders = new Map(
    ofKind("reflection").map(({ name, text }) => {
      const reflection = JSON.parse(text);
      return [name, { texts: textsOf(reflection, written), reflection }];
    }),
  );

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
 * The texts of a shader by target and stage. Its reflection says which files have them: shaders of
 * a frame may share one. The target's default profile is not in the names of files, nor here. One
 * text of several stages is `all`.
 */
function textsOf(reflection, written) {
  const texts = {};
  for (const [full, { files }] of Object.entries(reflection.backends)) {
    const [language, profile] = full.split(":");
    const isOne = files.length > 1 && files.every(({ file }) => file === files[0].file);
    for (const { stage, file } of files) {
      const target = file.includes(`.${profile}.`) ? full : language;
      texts[target] = { ...texts[target], [isOne ? "all" : stage]: written.get(file) };
    }
  }
  return texts;
}
