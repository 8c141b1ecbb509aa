// Runs `burnish compile` or `burnish bind` for one file, and reads its answer.

import { execFile } from "node:child_process";
import { mkdir } from "node:fs/promises";
import path from "node:path";

/** More than all texts and diagnostics of a file take. */
const LARGEST_ANSWER = 1 << 28;

/**
 * What became of a file: its outputs, the files that were read, and what was told. If the program
 * did not answer at all, `failure` says why.
 */
export async function compiled(command, file, folder, words) {
  await mkdir(folder, { recursive: true });
  return answered(command, file, ["compile", ...words, "--output", folder]);
}

/** The same for the binding of a file in TypeScript, which has the texts in it. */
export async function bound(command, file, folder, words) {
  await mkdir(folder, { recursive: true });
  const output = path.join(folder, "binding.ts");
  const asked = ["bind", ...words, "--lang", "typescript", "--embed", "--output", output];
  return answered(command, file, asked);
}

async function answered(command, file, words) {
  const asked = [...words, "--format", "json", "--", file];
  const { error, stdout, stderr } = await ended(command, asked);
  if (error?.code === "ENOENT" || error?.code === "EACCES") {
    return {
      failure:
        `cannot run \`${command}\` (${error.code}): start Vite where the Python environment with ` +
        "Burnish is activated, or name the program by the variable BURNISH or burnish({ program })",
    };
  }
  let answer;
  try {
    answer = JSON.parse(stdout);
  } catch {
    return { failure: `\`${command}\` gave no answer:\n${stderr.trim() || error?.message}` };
  }
  return {
    succeeded: answer.exit_code === 0,
    diagnostics: answer.diagnostics,
    remarks: answer.remarks,
    outputs: answer.result?.outputs ?? [],
    read: answer.result?.read ?? [file],
  };
}

function ended(command, asked) {
  const settings = { maxBuffer: LARGEST_ANSWER, windowsHide: true };
  return new Promise((resolve) => {
    execFile(command, asked, settings, (error, stdout, stderr) => {
      resolve({ error, stdout, stderr });
    });
  });
}
