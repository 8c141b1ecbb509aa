// The form of this folder's answers: an object, or {error} with the reason why there is none.

/** An error whose text is meant for people. */
export class Refusal extends Error {}

/** An error after which this browser cannot draw any more; a new one may. */
export class LostBrowser extends Refusal {}

/** The result of `work`, or {error, lost} with the text of what it threw. */
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

/** The width and height of a mip level, and its number of layers, faces or slices. */
export function levelSize(image, level) {
  const halved = (side) => Math.max(side >> level, 1);
  const depth = image.dimension === "3d" ? halved(image.depth) : image.depth;
  return [halved(image.width), halved(image.height), depth];
}
