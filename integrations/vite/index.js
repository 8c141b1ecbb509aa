// A plugin for Vite: `import plastic from './plastic.burnish'` gives the texts of shaders, and
// `import { plastic } from './plastic.burnish?binding'` their binding in TypeScript.
//
// Vite calls the hooks below. Each imported file is compiled by the program `burnish` into a folder
// of Vite's cache, from which the module is made. All files that were read are watched, and mistakes
// are shown in the page, with their place.

import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import path from "node:path";

import { bound, compiled } from "./compiled.js";
import { moduleOf } from "./module.js";
import { asError, asWarning } from "./told.js";

const TARGETS = ["wgsl", "glsl:es300"];
const ENDING = ".burnish";
const BINDING = "?binding";
/** The end of the names of bindings within Vite, by which it takes them for TypeScript. */
const OF_BINDING = `${BINDING}&lang.ts`;

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

    async resolveId(source, importer, options) {
      if (!source.endsWith(`${ENDING}${BINDING}`)) {
        return null;
      }
      const plain = source.slice(0, -BINDING.length);
      const found = await this.resolve(plain, importer, { ...options, skipSelf: true });
      return found && { ...found, id: `${found.id}${OF_BINDING}` };
    },

    async load(id) {
      const isBinding = id.endsWith(`${ENDING}${OF_BINDING}`);
      const file = isBinding ? id.slice(0, -OF_BINDING.length) : id;
      if (id.startsWith("\0") || !file.endsWith(ENDING)) {
        return null;
      }
      const answer = await (isBinding ? bound : compiled)(command, file, folderOf(file), words);
      if (answer.failure !== undefined) {
        this.error({ message: answer.failure, id });
      }
      const told = answer.diagnostics;
      watch(this, file, [...answer.read, ...told.flatMap((each) => each.span?.file ?? [])]);
      const errors = told.filter((each) => each.severity === "error");
      if (!answer.succeeded) {
        this.error(await asError(errors, answer.remarks, id));
      }
      for (const each of told) {
        this.warn(await asWarning(each));
      }
      const code = isBinding
        ? await readFile(answer.outputs[0].path, "utf8")
        : await moduleOf(answer.outputs);
      return { code, map: null };
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
