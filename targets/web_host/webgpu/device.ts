// Opens a device of WebGPU, and keeps what it complains about.

// The constants of the specification, which TypeScript's own types lack.
export const BufferUsage = {
  MAP_READ: 0x1, COPY_SRC: 0x4, COPY_DST: 0x8, INDEX: 0x10, VERTEX: 0x20, UNIFORM: 0x40,
  STORAGE: 0x80,
} as const;
export const TextureUsage = {
  COPY_SRC: 0x1, COPY_DST: 0x2, TEXTURE_BINDING: 0x4, STORAGE_BINDING: 0x8, RENDER_ATTACHMENT: 0x10,
} as const;
export const MAP_READ = 0x1;

/** Features that targets and textures of 32 bits need, and stencil values beside such depths. */
const FEATURES: GPUFeatureName[] = [
  "float32-blendable", "float32-filterable", "depth32float-stencil8",
];
/** Limits that frames may need to be above the default. */
const LIMITS = [
  "maxColorAttachmentBytesPerSample", "maxBufferSize", "maxStorageBufferBindingSize",
] as const;

export class Device {
  isLost = false;
  private readonly complaints: string[] = [];

  private constructor(readonly gpu: GPUDevice) {
    const complain = (message: string) => this.complaints.push(message);
    gpu.addEventListener("uncapturederror", ({ error }) => complain(error.message));
    void gpu.lost.then(({ message }) => {
      this.isLost = true;
      complain(`the WebGPU device was lost: ${message}`);
    });
  }

  static async open(): Promise<Device> {
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

  /** An error with all that the device has complained about since the last time. */
  check(): void {
    const found = [...new Set(this.complaints.splice(0))];
    if (found.length) throw new Error(found.join("\n"));
  }

  buffer(bytes: Uint8Array<ArrayBuffer> | Uint32Array<ArrayBuffer>, usage: number): GPUBuffer {
    const size = Math.max(bytes.byteLength, 4);
    const buffer = this.gpu.createBuffer({ size, usage: usage | BufferUsage.COPY_DST });
    this.gpu.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
  }

  /** The bytes that are copied to a buffer which the host can read. */
  async bytesOf(
    size: number, copy: (encoder: GPUCommandEncoder, to: GPUBuffer) => void,
  ): Promise<Uint8Array<ArrayBuffer>> {
    const usage = BufferUsage.COPY_DST | BufferUsage.MAP_READ;
    const buffer = this.gpu.createBuffer({ size, usage });
    const encoder = this.gpu.createCommandEncoder();
    copy(encoder, buffer);
    this.gpu.queue.submit([encoder.finish()]);
    try {
      await buffer.mapAsync(MAP_READ);
      this.check();
      return new Uint8Array(buffer.getMappedRange()).slice();
    } finally {
      buffer.destroy();
    }
  }
}

/** Small pieces of data in large buffers: the uniform blocks of a frame's draws. */
export class Arena {
  private readonly chunks: { buffer: GPUBuffer; bytes: Uint8Array<ArrayBuffer> }[] = [];
  private chunk = 0;
  private used = 0;

  constructor(
    private readonly device: Device,
    private readonly usage: number,
    private readonly alignment: number,
    private readonly size = 1 << 18,
  ) {}

  /** Where a piece lies, until `begin` is called again. */
  put(bytes: Uint8Array): GPUBufferBinding {
    if (this.used + bytes.length > this.size) {
      this.chunk += 1;
      this.used = 0;
    }
    const { buffer, bytes: whole } = (this.chunks[this.chunk] ??= this.makeChunk());
    const offset = this.used;
    whole.set(bytes, offset);
    this.used = Math.ceil((offset + bytes.length) / this.alignment) * this.alignment;
    return { buffer, offset, size: bytes.length };
  }

  private makeChunk() {
    const bytes = new Uint8Array(this.size);
    return { buffer: this.device.buffer(bytes, this.usage), bytes };
  }

  begin(): void {
    this.chunk = 0;
    this.used = 0;
  }

  /** Bring everything to the device, before what reads it is submitted. */
  flush(): void {
    for (const { buffer, bytes } of this.chunks.slice(0, this.chunk + 1)) {
      this.device.gpu.queue.writeBuffer(buffer, 0, bytes);
    }
  }

  free(): void {
    this.chunks.forEach(({ buffer }) => buffer.destroy());
  }
}
