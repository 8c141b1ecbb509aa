// The interface of a renderer: the operations that `frame.js` needs from an API of the browser.

/**
 * @import {
 *   PackagedShader, PictureRow, AttachmentRow, FrameTextureRow,
 * } from "./generated/documents.js"
 * @import { Mesh } from "./geometry.js"
 * @import { Values } from "./values.js"
 */

/**
 * A texture that a frame draws to.
 * @typedef {Pick<FrameTextureRow, "dimension" | "layers" | "levels" | "samples" | "uses"> & {
 *   format: GPUTextureFormat, width: number, height: number,
 * }} TextureSize
 */

/**
 * A shader of a frame, by its number, with everything that it reads.
 * @template Texture, Buffer
 * @typedef {object} Bound
 * @property {number} shader
 * @property {Values} values
 * @property {Map<string, Texture>} textures By the reflection's names.
 * @property {Map<string, Buffer>} buffers
 */

/**
 * One draw call.
 * @template Texture, Buffer
 * @typedef {Bound<Texture, Buffer> & { mesh: Mesh }} DrawCall
 */

/**
 * The texture that a target, or the depths, are drawn to.
 * @template Texture
 * @typedef {object} Attachment
 * @property {Pick<AttachmentRow, "level" | "load" | "store" | "stencil">} target
 * @property {Texture} texture
 * @property {number} layer
 * @property {{ texture: Texture, layer: number, level: number } | null} resolve The place to
 *   which the means of its samples are written after the draws.
 * @property {number[]} clear The colour or the depth that it is cleared to.
 */

/**
 * A part of a picture: left, top, width and height.
 * @typedef {[number, number, number, number]} Area
 */

/**
 * The settings of a step, for all its draw calls.
 * @typedef {object} DrawSettings
 * @property {Area} viewport The part of the targets into which the clip volume is drawn.
 * @property {Area} scissor The part of the targets that is drawn to; it lies in the viewport.
 * @property {[number, number, number, number]} blendConstant The value of the factor
 *   `constant` where targets are blended.
 */

/**
 * Layer by layer and row by row from the top, four linear numbers a pixel. Lanes that the format
 * lacks are 0, 0, 1; depths are in the first lane.
 * @typedef {object} Pixels
 * @property {number} width
 * @property {number} height
 * @property {number} layers
 * @property {Float32Array} texels
 */

/**
 * Draws with an API.
 * @template Texture, Buffer
 * @typedef {object} Renderer
 * @property {string} profile The profile whose texts it takes.
 * @property {PackagedShader[]} shaders
 * @property {(size: TextureSize) => Texture} makeTexture A texture without contents: transparent
 *   black, and depths of 1.
 * @property {(picture: PictureRow) => Texture} makePicture
 * @property {(bytes: Uint8Array<ArrayBuffer>) => Buffer} makeBuffer
 * @property {(made: Texture | Buffer) => void} free
 * @property {(texture: Texture) => number[]} sizeOf
 * @property {(buffer: Buffer) => number} bytesIn
 * @property {(buffer: Buffer, bytes: Uint8Array<ArrayBuffer>) => void} fill Fill a buffer again,
 *   before the draws that are not submitted yet.
 * @property {() => void} begin
 * @property {(
 *   targets: Attachment<Texture>[], depth: Attachment<Texture> | null,
 *   calls: DrawCall<Texture, Buffer>[], settings: DrawSettings,
 * ) => void} draw
 * @property {(kernel: Bound<Texture, Buffer>, images: Texture[], groups: number[]) => void} run
 * @property {(from: Texture, to: Texture) => void} copy
 * @property {() => void} end
 * @property {(texture: Texture, isBottomUp: boolean) => void} show Put a texture on the canvas;
 *   with `isBottomUp`, its first row is that at the bottom.
 * @property {(texture: Texture) => Promise<Pixels>} read
 * @property {(buffer: Buffer) => Promise<Uint8Array<ArrayBuffer>>} readBuffer
 * @property {() => Promise<void>} finished
 * @property {() => void} dispose
 */

export {};
