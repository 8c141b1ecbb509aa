// As much of Node as the programs here use; its own declarations are a package.

declare module "node:fs/promises" {
  export function readFile(path: string): Promise<Uint8Array>;
}
declare module "node:process" {
  export const argv: readonly string[];
  export const env: Readonly<Record<string, string | undefined>>;
}
declare module "node:vm" {
  export function runInNewContext(text: string): unknown;
}
declare class TextDecoder {
  decode(bytes: Uint8Array): string;
}
declare const console: { log(text: string): void };
