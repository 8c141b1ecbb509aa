// What an API of the browser has to do for frames: `frame.ts` says when.

import type { PackagedShader, PictureRow, AttachmentRow, FrameTextureRow } from "./generated/documents.js";
import type { Mesh } from "./geometry.js";
import type { Values } from "./values.js";

/** A texture that a frame draws to. */
export interface TextureSize
  extends Pick<FrameTextureRow, "dimension" | "layers" | "levels" | "samples" | "uses"> {
  format: GPUTextureFormat;
  width: number;
  height: number;
}

/** A shader of a frame, by its number, with everything that it reads. */
export interface Bound<Texture, Buffer> {
  shader: number;
  values: Values;
  /** By the reflection's names. */
  textures: Map<string, Texture>;
  buffers: Map<string, Buffer>;
}

export interface DrawCall<Texture, Buffer> extends Bound<Texture, Buffer> {
  mesh: Mesh;
}

/** What a target, or the depths, are drawn to. */
export interface Attachment<Texture> {
  target: Pick<AttachmentRow, "level" | "load" | "store" | "stencil">;
  texture: Texture;
  layer: number;
  /** Where the means of its samples are written behind the draws. */
  resolve: { texture: Texture; layer: number; level: number } | null;
  /** What it is cleared to: a colour, or a depth. */
  clear: number[];
}

/** A part of a picture: left, top, width and height. */
export type Area = [number, number, number, number];

/** What a step sets for all that it draws. */
export interface DrawSettings {
  /** Into which part of the targets the clip volume is drawn. */
  viewport: Area;
  /** To which part of the targets is drawn: nothing outside of the viewport. */
  scissor: Area;
  /** What the factor `constant` means where targets are blended. */
  blendConstant: [number, number, number, number];
}

/** Layer by layer and row by row from the top, four linear numbers a pixel. Lanes that the format
 * lacks are 0, 0, 1; depths are in the first lane. */
export interface Pixels { width: number; height: number; layers: number; texels: Float32Array }

export interface Renderer<Texture, Buffer> {
  /** The profile whose texts it draws. */
  readonly profile: string;
  readonly shaders: PackagedShader[];
  /** A texture without contents: transparent black, and depths of 1. */
  makeTexture(size: TextureSize): Texture;
  makePicture(picture: PictureRow): Texture;
  makeBuffer(bytes: Uint8Array<ArrayBuffer>): Buffer;
  free(made: Texture | Buffer): void;
  sizeOf(texture: Texture): number[];
  bytesIn(buffer: Buffer): number;
  /** Fill a buffer again, before anything that is still to be drawn. */
  fill(buffer: Buffer, bytes: Uint8Array<ArrayBuffer>): void;

  begin(): void;
  draw(
    targets: Attachment<Texture>[], depth: Attachment<Texture> | null,
    calls: DrawCall<Texture, Buffer>[], settings: DrawSettings,
  ): void;
  run(kernel: Bound<Texture, Buffer>, images: Texture[], groups: number[]): void;
  copy(from: Texture, to: Texture): void;
  end(): void;

  show(texture: Texture): void;
  read(texture: Texture): Promise<Pixels>;
  readBuffer(buffer: Buffer): Promise<Uint8Array<ArrayBuffer>>;
  finished(): Promise<void>;
  dispose(): void;
}
