// Diagnostics as Vite shows them: in the terminal, and in the page above what is drawn.

import { readFile } from "node:fs/promises";

/** One error for all that was told; the first has the place that is shown. */
export async function asError(errors, remarks, id) {
  const [first, ...others] = errors;
  if (first === undefined) {
    return { message: remarks.map((each) => each.text).join("\n"), id };
  }
  const further = others.map((each) => `\n${oneLine(each)}`);
  return { ...(await shown(first)), message: sentence(first) + further.join(""), id };
}

export async function asWarning(diagnostic) {
  return { ...(await shown(diagnostic)), message: sentence(diagnostic) };
}

/** Where a diagnostic points to, with the line of the file; lines and columns count from 1. */
async function shown({ span }) {
  if (!span) {
    return {};
  }
  const { line, column } = span.start;
  const loc = { file: span.file, line, column };
  let text;
  try {
    text = (await readFile(span.file, "utf8")).split(/\r\n|\r|\n/)[line - 1] ?? "";
  } catch {
    return { loc }; // A file of the library, which is named `std/…`.
  }
  const end = span.end.line === line ? span.end.column : text.length + 1;
  const marks = "^".repeat(Math.max(1, end - column));
  const margin = " ".repeat(`${line}`.length);
  const blank = text.slice(0, column - 1).replace(/[^\t]/g, " ");
  return { loc, frame: `${line} | ${text}\n${margin} | ${blank}${marks}` };
}

function sentence({ code, message, hint }) {
  return `${code}: ${message}${hint ? ` (${hint})` : ""}`;
}

function oneLine(diagnostic) {
  const { file, start } = diagnostic.span ?? {};
  const place = file === undefined ? "" : `${file}:${start.line}:${start.column}: `;
  return place + sentence(diagnostic);
}
