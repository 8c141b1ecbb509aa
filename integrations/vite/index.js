// A plugin for Vite: `import plastic from './plastic.burnish'` gives the texts of shaders.
//
// Vite calls the hooks below. Each imported file is compiled by the program `burnish` into a folder
// of Vite's cache, from which the module is made. All files that were read are watched, and mistakes
// are shown in the page, with their place.

import { createHash } from "node:crypto";
import path from "node:path";

import { compiled } from "./compiled.js";
import { moduleOf } from "./module.js";
import { asError, asWarning } from "./told.js";

const TARGETS = ["wgsl", "glsl:es300"];

/** @type {import("./index.js").default} */
export default function burnish({ targets = TARGETS, options = [], program } = {}) {
  const command = program ?? process.env.BURNISH ?? "burnish";
  const words = [...targets.flatMap((name) => ["--target", name]), ...options];
  /** The modules that have read a file, by its path; also those that could not be compiled. */
  const readers = new Map();
  let cache = "";

  /** The folder for what a file becomes. */
  function folderOf(file) {
    const digest = createHash("sha256").update(JSON.stringify([file, words])).digest("hex");
    return path.join(cache, digest.slice(0, 16));
  }

  function watch(context, file, read) {
    for (const each of read) {
      const known = path.resolve(each);
      context.addWatchFile(known);
      const modules = readers.get(toSlashes(known)) ?? new Set();
      readers.set(toSlashes(known), modules.add(file));
    }
  }

  return {
    name: "burnish",
    enforce: "pre",

    configResolved(config) {
      cache = path.join(config.cacheDir, "burnish");
    },

    async load(id) {
      if (id.startsWith("\0") || !id.endsWith(".burnish")) {
        return null;
      }
      const answer = await compiled(command, id, folderOf(id), words);
      if (answer.failure !== undefined) {
        this.error({ message: answer.failure, id });
      }
      const told = answer.diagnostics;
      watch(this, id, [...answer.read, ...told.flatMap((each) => each.span?.file ?? [])]);
      const errors = told.filter((each) => each.severity === "error");
      if (!answer.succeeded) {
        this.error(await asError(errors, answer.remarks, id));
      }
      for (const each of told) {
        this.warn(await asWarning(each));
      }
      return { code: await moduleOf(answer.outputs), map: null };
    },

    // What could not be compiled has told Vite of no file that it read, so Vite is told here.
    hotUpdate({ file, modules }) {
      const ids = readers.get(toSlashes(path.resolve(file))) ?? [];
      const more = [...ids].flatMap((id) => [
        ...(this.environment.moduleGraph.getModulesByFile(toSlashes(id)) ?? []),
      ]);
      return more.length === 0 ? undefined : [...new Set([...modules, ...more])];
    },
  };
}

/** A path as Vite writes it, on Windows as well. */
function toSlashes(file) {
  return file.replaceAll(path.sep, "/");
}
