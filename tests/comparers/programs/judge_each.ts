// Prints what the comparer in TypeScript says of each case of a list; `kit.py` tells the form.

import { readFile } from "node:fs/promises";
import { argv } from "node:process";

import { Bounds, judge, JudgeError, Picture, type Bytes, type Encoding } from "./burnish_judge.js";

/** The verdict, or the error. */
async function said(
  bounds: () => Promise<Bounds> | Bounds,
  picture: () => Promise<Picture> | Picture,
  encoding: Encoding,
  lanes: string,
): Promise<string> {
  try {
    let drawn = await picture();
    if (lanes) drawn = new Picture(drawn.width, drawn.height, Number(lanes), drawn.data);
    return judge(await bounds(), drawn, encoding).message;
  } catch (error) {
    if (error instanceof JudgeError) return `error: ${error.message}`;
    throw error;
  }
}

/** The bytes of a file, as a browser has them; none if it cannot be read. */
const content = async (path: string): Promise<Bytes> =>
  readFile(path).then((bytes) => new Uint8Array(bytes).buffer, () => new ArrayBuffer(0));

const list = new TextDecoder().decode(await readFile(argv[2]!));
for (const line of list.trimEnd().split("\n")) {
  const [folder, output, path, encoding, lanes] =
    line.split("\t") as [string, string, string, Encoding, string];
  const lower = await content(`${folder}/${output}.lower.npy`);
  const upper = await content(`${folder}/${output}.upper.npy`);
  const undecided = await content(`${folder}/undecided.npy`);
  const drawn = await content(path);
  const load = () => Bounds.load(folder, output, readFile);
  const parse = () => Bounds.parse(lower, upper, undecided);
  const loaded = await said(load, () => Picture.load(path, readFile), encoding, lanes);
  const parsed = await said(parse, () => Picture.parse(drawn), encoding, lanes);
  console.log(`${loaded}\t${parsed}`);
}
