// Opens a device of WebGPU, and collects its errors.

/**
 * Features that 32-bit textures and targets need, and stencil values beside 32-bit depths.
 * @type {GPUFeatureName[]}
 */
const FEATURES = ["float32-filterable", "float32-blendable", "depth32float-stencil8"];
/** Limits that some frames need above the default: the device gets all that the adapter has. */
const LIMITS = /** @type {const} */ ([
  "maxColorAttachmentBytesPerSample", "maxBufferSize", "maxStorageBufferBindingSize",
  "maxSampledTexturesPerShaderStage",
]);

export class Device {
  isLost = false;
  /** @type {string[]} */
  #complaints = [];

  /** @readonly */
  gpu;

  /**
   * @private
   * @param {GPUDevice} gpu
   */
  constructor(gpu) {
    this.gpu = gpu;
    /** @type {(message: string) => number} */
    const complain = (message) => this.#complaints.push(message);
    gpu.addEventListener("uncapturederror", ({ error }) => complain(error.message));
    void gpu.lost.then(({ message }) => {
      this.isLost = true;
      complain(`the WebGPU device was lost: ${message}`);
    });
  }

  /** @returns {Promise<Device>} */
  static async open() {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) throw new Error("this browser offers no WebGPU adapter");
    const limits = Object.fromEntries(LIMITS.map((name) => [name, adapter.limits[name]]));
    return new Device(
      await adapter.requestDevice({
        requiredFeatures: FEATURES.filter((feature) => adapter.features.has(feature)),
        requiredLimits: limits,
      }),
    );
  }

  /** Throws an error that lists the errors of the device since the last call. */
  check() {
    const found = [...new Set(this.#complaints.splice(0))];
    if (found.length) throw new Error(found.join("\n"));
  }

  /**
   * @param {Uint8Array<ArrayBuffer> | Uint32Array<ArrayBuffer>} bytes
   * @param {number} usage
   * @returns {GPUBuffer}
   */
  buffer(bytes, usage) {
    const size = Math.max(bytes.byteLength, 4);
    const buffer = this.gpu.createBuffer({ size, usage: usage | GPUBufferUsage.COPY_DST });
    this.gpu.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
  }

  /**
   * The bytes that are copied to a buffer which the host can read.
   * @param {number} size
   * @param {(encoder: GPUCommandEncoder, to: GPUBuffer) => void} copy
   * @returns {Promise<Uint8Array<ArrayBuffer>>}
   */
  async bytesOf(size, copy) {
    const usage = GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ;
    const buffer = this.gpu.createBuffer({ size, usage });
    const encoder = this.gpu.createCommandEncoder();
    copy(encoder, buffer);
    this.gpu.queue.submit([encoder.finish()]);
    try {
      await buffer.mapAsync(GPUMapMode.READ);
      this.check();
      return new Uint8Array(buffer.getMappedRange()).slice();
    } finally {
      buffer.destroy();
    }
  }
}

/** Small pieces of data in large buffers: the uniform blocks of a frame's draws. */
export class Arena {
  /** @type {GPUBuffer[]} */
  #chunks = [];
  #chunk = 0;
  #used = 0;

  #gpu;
  #size;

  /** @param {GPUDevice} gpu */
  constructor(gpu, size = 1 << 18) {
    this.#gpu = gpu;
    this.#size = size;
  }

  /**
   * The place of a piece, valid until the next `begin`; the next submission finds it there.
   * @param {Uint8Array<ArrayBuffer>} bytes
   * @returns {GPUBufferBinding}
   */
  put(bytes) {
    if (this.#used + bytes.length > this.#size) {
      this.#chunk += 1;
      this.#used = 0;
    }
    const usage = GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST;
    this.#chunks[this.#chunk] ??= this.#gpu.createBuffer({ size: this.#size, usage });
    const buffer = this.#chunks[this.#chunk];
    const offset = this.#used;
    this.#gpu.queue.writeBuffer(buffer, offset, bytes);
    const alignment = this.#gpu.limits.minUniformBufferOffsetAlignment;
    this.#used = Math.ceil((offset + bytes.length) / alignment) * alignment;
    return { buffer, offset, size: bytes.length };
  }

  begin() {
    this.#chunk = 0;
    this.#used = 0;
  }

  free() {
    this.#chunks.forEach((buffer) => buffer.destroy());
  }
}
