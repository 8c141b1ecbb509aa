// How a module of this folder answers: its answer as an object, or why there is none as {error}.

/** An error to be told to people as it is. */
export class Refusal extends Error {}

/** Likewise; and only another browser may do better. */
export class LostBrowser extends Refusal {}

/** What `work` resolves to, or {error, lost} with the text of what it threw. */
export async function answer(work) {
  try {
    return await work();
  } catch (error) {
    const told = error instanceof Refusal ? error.message : `${error.name}: ${error.message}`;
    return { error: told, lost: error instanceof LostBrowser };
  }
}

/** A copy of its bytes. */
export const bytes = (base64) => Uint8Array.fromBase64(base64);
export const base64 = (bytes) => bytes.toBase64();

/** Width and height of a mip level, and its layers, faces or slices. */
export function levelSize(image, level) {
  const halved = (side) => Math.max(side >> level, 1);
  const depth = image.dimension === "3d" ? halved(image.depth) : image.depth;
  return [halved(image.width), halved(image.height), depth];
}
