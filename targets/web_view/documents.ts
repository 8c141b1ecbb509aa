// What the server tells the page: the documents of `burnish view`, and word of every change.

import type { FramePackage, Value } from "../web_host/host.js";
import type { OrbitRow } from "./orbit.js";

/** What somebody can set: a row of `controls.py`. */
export interface Control {
  name: string;
  section: string;
  doc: string;
  kind:
    | "number" | "angle" | "vector" | "direction" | "matrix"
    | "color" | "checkbox" | "checkboxes" | "texture";
  type: string;
  is_light: boolean;
  /** Of a light in an array: its number, and the parameter that says how many shine. */
  element: { count: string | null; index: number } | null;
  value: Value;
  lanes?: number;
  columns?: number;
  whole?: boolean;
  range?: [number, number] | null;
  /** Of a texture: whether it is something else than the default, which `value` names. */
  is_given?: boolean;
  /** The picture that the page has given it. */
  picture: { file: string; is_float: boolean; is_srgb: boolean } | null;
  /** Whether it is a number that changes from frame to frame, such as a time. */
  is_timed?: boolean;
}

/** What a page shows of the file. */
export interface Choice {
  /** One of a folder's files. */
  file: string | null;
  subject: string | null;
  rig: string | null;
  pass: string | null;
  mesh: string | null;
  /** Which output is shown of it; the server need not know. */
  output?: string | null;
}

/** What every document has. */
export interface Head {
  version: string;
  file: string;
  subjects: { name: string; kind: "frame" | "material" | "kernel" }[];
  rigs: string[];
  passes: string[];
  meshes: string[];
  /** How large the file of a picture may be. */
  most_bytes: number;
}

/** What is wrong, as the compiler shows it on a terminal. */
export interface Broken extends Head {
  error: string;
}

export interface Drawable extends Head {
  error?: undefined;
  chosen: Choice;
  doc: string;
  controls: Control[];
  orbit: OrbitRow;
  package: FramePackage;
}

export type Document = Broken | Drawable;

/** The document of a choice; `further` are names and values of the query besides. */
export async function fetchDocument(
  choice: Choice, profile: string, further: [string, string][],
): Promise<Document> {
  const asked = new URLSearchParams([["profile", profile], ...further]);
  for (const [name, value] of Object.entries(choice)) if (value) asked.set(name, value);
  const answer = await fetch(`/document?${asked}`);
  if (!answer.ok) throw new Error(`The server answered: ${answer.status} ${await answer.text()}`);
  return (await answer.json()) as Document;
}

/** Files of a folder under one heading. */
export interface Group {
  title: string;
  files: { name: string; what: string; subjects: string[] }[];
}

/** The files of the folder that is shown; none, if it is a single file. */
export async function fetchFiles(): Promise<Group[]> {
  const answer = await fetch("/files");
  return answer.ok ? ((await answer.json()) as Group[]) : [];
}

/** Calls `changed` with a file and its version, now and after each change; `connected` is told
 * whether the server is there. */
export function listen(
  changed: (file: string, version: string) => void, connected: (is: boolean) => void,
): void {
  const source = new EventSource("/changes");
  source.onopen = () => connected(true);
  source.onerror = () => connected(false);
  source.onmessage = (event) => {
    const { file, version } = JSON.parse(event.data) as { file: string; version: string };
    changed(file, version);
  };
}
