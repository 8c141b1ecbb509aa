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
    // The host's own errors are sentences; others are mistakes in it, and keep their names.
    const isSentence = error instanceof Refusal || error.constructor === Error;
    const told = isSentence ? error.message : `${error.name}: ${error.message}`;
    return { error: told, lost: error instanceof LostBrowser };
  }
}

const NEWS_DELAY = 100; // milliseconds

/** Wait until the page is idle: only then it learns that its device, or its context, was lost. */
export const news = () => new Promise((resolve) => setTimeout(resolve, NEWS_DELAY));

export const base64 = ({ buffer, byteOffset, byteLength }) =>
  new Uint8Array(buffer, byteOffset, byteLength).toBase64();
