// Executes frame jobs with a renderer of the host for web pages. `job_document.py` makes what is
// given here, and says what it has.

import { base64, Refusal } from "./answers.mjs";
import { packed } from "./frames.mjs";
import { bytesOf, halved } from "./host/bytes.js";
import { unpacked } from "./host/geometry.js";
import { settingsOf } from "./host/settings.js";

/** Executes a job, and returns the contents that it reads back. Then the renderer is disposed of. */
export async function found(renderer, job) {
  try {
    const run = new Run(renderer, job);
    for (const step of job.steps) await run.step(step);
    await renderer.finished();
    return run.read;
  } finally {
    renderer.dispose();
  }
}

class Run {
  read = { texels: [], buffers: [], captured: [] };

  constructor(renderer, job) {
    this.renderer = renderer;
    this.sizes = job.textures;
    this.textures = job.textures.map((size) => renderer.makeTexture(size));
    this.pictures = job.pictures.map((picture) => renderer.makePicture(picture));
    this.buffers = job.buffers.map((data) => renderer.makeBuffer(bytesOf(data)));
  }

  async step(step) {
    this.renderer.begin();
    if (step.copied.length) this.renderer.copy(...step.copied.map((at) => this.textures[at]));
    else if (step.captures !== null) this.capture(step);
    else if (step.groups) this.run(step);
    else if (step.calls.length || step.targets.length || step.depth) this.draw(step);
    this.renderer.end();
    for (const at of step.read) {
      this.read.texels.push(packed(await this.renderer.read(this.textures[at])));
    }
    for (const at of step.read_buffers) {
      this.read.buffers.push(base64(await this.renderer.readBuffer(this.buffers[at])));
    }
  }

  draw({ targets, depth, calls, viewport, scissor, blend_constant: constant }) {
    const first = targets[0] ?? depth;
    const { width, height } = this.sizes[first.texture];
    const sides = [width, height].map((side) => halved(side, first.level));
    this.renderer.draw(
      targets.map((each) => this.attachment(each)),
      depth && this.attachment(depth),
      calls.map((each) => this.call(each)),
      settingsOf(sides, viewport, scissor, constant),
    );
  }

  attachment({ texture, layer, clear, resolve, ...target }) {
    const into = resolve && { ...resolve, texture: this.textures[resolve.texture] };
    return { target, texture: this.textures[texture], layer, clear, resolve: into };
  }

  run({ calls: [kernel], images, groups }) {
    if (!groups.every(Boolean)) return;
    this.renderer.run(this.call(kernel), images.map((at) => this.textures[at]), groups);
  }

  capture({ calls: [drawn], captures: most }) {
    if (!this.renderer.capture) throw new Refusal("WebGPU has no stream output");
    const call = this.call(drawn);
    const count = call.mesh.count * call.mesh.instance_count;
    if (count > most) throw new Refusal(`${count} vertices are captured, with room for ${most}`);
    this.read.captured.push({ count, data: base64(this.renderer.capture(call)) });
  }

  /** A shader with everything that it reads, by the numbers of its slots. */
  call({ shader, mesh, blocks, textures, buffers }) {
    const named = (items) => new Map(items.map((item, at) => [`${at}`, item]));
    return {
      shader,
      values: { name: `pipeline ${shader}`, blocks: () => named(blocks.map(bytesOf)) },
      textures: named(textures.map(({ own, number }) => {
        return own ? this.pictures[number] : this.textures[number];
      })),
      buffers: named(buffers.map((each) => {
        return typeof each === "number"
          ? this.buffers[each] : this.renderer.makeBuffer(bytesOf(each));
      })),
      mesh: mesh && unpacked(mesh),
    };
  }
}
