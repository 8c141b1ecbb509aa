// What an API of the browser has to do for frames: `frame.ts` says when.
export {};
