// Executes the plan of a frame, step by step, with the renderer of an API: see docs/plans.md.

import { bytesOf, halved, turnedOver } from "./bytes.js";
import { bareMesh, checkLevels, unpacked } from "./geometry.js";
import { present } from "./present.js";
import { hostBuffer, previousOf, Resources } from "./resources.js";
import { settingsOf } from "./settings.js";
import { Values } from "./values.js";

/**
 * @import {
 *   CameraRow, Package, ModelRow, PackagedShader, FramePlan, DrawStep, DrawnRow, InputRow,
 *   RunStep, AttachmentRow, UseRow, Value,
 * } from "./generated/documents.js"
 * @import { Mesh } from "./geometry.js"
 * @import { Attachment, Bound, DrawCall, Pixels, Renderer } from "./renderer.js"
 */

/** Frames and vertices are numbered below this: float32 holds all whole numbers up to it. */
const NUMBERS = 2 ** 24;

/**
 * True if a shader draws the bottom row of its picture to the first row of a texture. No shader of
 * a frame does, but those of single materials do so for WebGL 2.
 * @param {PackagedShader} shader
 * @param {string} profile
 */
function drawsBottomUp({ reflection }, profile) {
  const { first_row: first, images } = reflection.backends[profile];
  // A kernel that writes images itself has their top row first.
  return first === "bottom" && !Object.keys(images).length;
}

/**
 * An open frame: `openFrame` makes one. Methods throw an `Error` with a sentence if they fail.
 * @template Texture, Buffer
 */
export class PlanFrame {
  /** @readonly @type {FramePlan} */
  plan;
  /** @type {Values} */
  #values;
  /** @type {Values[]} */
  #materials;
  /** @type {Resources<Texture, Buffer>} */
  #resources;
  /** @type {Set<string>} */
  #given;
  /** @type {CameraRow} */
  #camera;
  /** @type {[number, number]} */
  #size;
  #drawn = 0;
  #isFirst = true;
  /**
   * Each mesh with the storage buffers that hold its vertex inputs.
   * @type {Map<string, { mesh: Mesh, elements: [string, Buffer][] }>}
   */
  #meshes = new Map();

  #from;
  #renderer;
  #isBottomUp;

  /**
   * @param {Package} from
   * @param {Renderer<Texture, Buffer>} renderer
   */
  constructor(from, renderer) {
    this.#from = from;
    this.#renderer = renderer;
    const { plan, shaders } = from;
    const declared = { ...plan, blocks: [], derived: [], buffers: plan.host_buffers };
    this.plan = plan;
    this.#given = new Set(from.given);
    this.#camera = from.camera;
    this.#size = from.size;
    this.#isBottomUp = shaders.some((each) => drawsBottomUp(each, renderer.profile));
    this.#values = new Values(plan.frame, declared);
    this.#materials = shaders.map(({ reflection }) => new Values(reflection.material, reflection));
    this.#resources = new Resources(from, renderer, this.#values);
    this.#fill(this.#values, from);
    this.#materials.forEach((each, number) => this.#fill(each, shaders[number]));
  }

  /**
   * Set the values and buffers that a package gives a frame or a shader.
   * @param {Values} values
   * @param {Pick<PackagedShader, "values" | "buffers">} from
   */
  #fill(values, from) {
    for (const [name, value] of Object.entries(from.values)) values.set(name, value);
    for (const row of values.declared.buffers) {
      const bytes = bytesOf(from.buffers[row.name] ?? "");
      values.count(row, bytes.length);
      // No API binds a buffer of no bytes.
      const buffer = this.#renderer.makeBuffer(bytes.length ? bytes : new Uint8Array(row.stride));
      this.#resources.buffers.set(hostBuffer(values.name, row.name), buffer);
    }
  }

  // --- what a page does ---

  /**
   * Set something of the frame, `sun.direction` or `lamps[2].place`; or else of all shaders that
   * have it, such as a material's colour; or, as `Clay.base`, of one material.
   * @param {string} name
   * @param {Value} value
   */
  set(name, value) {
    const every = [this.#values, ...this.#materials];
    const own = every.some((each) => each.has(name)) ? name : name.slice(name.indexOf(".") + 1);
    // The names of shaders end with that of their material, as `Pair.Drawn.Clay` does for `Clay`.
    const end = `.${name.slice(0, -own.length)}`;
    const owners = every.filter((each) => each.has(own) && `.${each.name}.`.endsWith(end));
    if (!owners.length) throw new Error(`${this.plan.frame} has no parameter \`${name}\``);
    for (const each of owners[0] === this.#values ? [this.#values] : owners) each.set(own, value);
    this.#given.add(name);
  }

  /**
   * Give a texture of the host, of two dimensions, an output that another frame on the same canvas
   * has drawn. It is read as it is when this frame draws, and what this frame shows has its rows in
   * the same order.
   * @param {string} name
   * @param {PlanFrame<Texture, Buffer>} from
   * @param {string} output
   */
  give(name, from, output) {
    this.#resources.pictures[this.#from.textures[name]] = from.#outputOf(output);
    this.#isBottomUp = from.#isBottomUp;
  }

  /**
   * Move the camera. Members that are left out stay as they are.
   * @param {Partial<CameraRow>} camera
   */
  setCamera(camera) {
    this.#camera = { ...this.#camera, ...camera };
  }

  /**
   * Set the width and height of the textures for which the frame declares no size of its own.
   * @param {number} width
   * @param {number} height
   */
  resize(width, height) {
    if (!(width >= 1 && height >= 1)) {
      throw new Error(`a frame cannot have ${width} x ${height} pixels`);
    }
    this.#size = [Math.floor(width), Math.floor(height)];
  }

  /** Draw the frame once; the results that it keeps are those of the last time. */
  draw() {
    const told = { ...this.#camera, size: this.#size, number: this.#drawn % NUMBERS };
    this.#apply(this.#values, this.#from.roles, told, this.#size[0] / this.#size[1]);
    this.#renderer.begin();
    this.#isFirst = !this.#resources.begin(this.#isFirst);
    for (const step of this.plan.steps) {
      if (step.only_first && !this.#isFirst) continue;
      if (step.kind === "draw") this.#drawStep(step);
      else if (step.kind === "run") this.#run(step);
      else {
        const { copied, into } = step;
        const [from, to] = [copied, into].map((end) => this.#resources.texture(end.texture));
        this.#renderer.copy(from, to);
      }
    }
    this.#renderer.end();
    this.#resources.end();
    this.#isFirst = false;
    this.#drawn += 1;
  }

  /**
   * Put an output on the canvas, by default the first one that is a picture.
   * @param {string} [output]
   */
  show(output) {
    this.#renderer.show(this.#outputOf(output), this.#isBottomUp);
  }

  /**
   * The width and height of an output's first level.
   * @param {string} output
   * @returns {[number, number]}
   */
  sizeOf(output) {
    return /** @type {[number, number]} */ (this.#renderer.sizeOf(this.#outputOf(output)));
  }

  /**
   * The bytes of an output that is a buffer; its row of `results` gives their layout.
   * @param {string} output
   * @returns {Promise<Uint8Array<ArrayBuffer>>}
   */
  async readElements(output) {
    const row = this.plan.outputs.find((each) => each.name === output && each.texture === null);
    const buffer = row && this.#resources.written(row.result);
    const { frame } = this.plan;
    if (!buffer) throw new Error(`\`${output}\` of ${frame} is no buffer, or was not written yet`);
    return (await this.#renderer.readBuffer(buffer)).subarray(0, this.#resources.bytesIn(buffer));
  }

  /**
   * The numbers of an output's first level.
   * @param {string} output
   * @returns {Promise<Pixels>}
   */
  async read(output) {
    const pixels = await this.#renderer.read(this.#outputOf(output));
    if (this.#isBottomUp) turnedOver(pixels);
    return pixels;
  }

  /**
   * Wait until everything is drawn; rejects with an error if the API has refused something.
   * @returns {Promise<void>}
   */
  finished() {
    return this.#renderer.finished();
  }

  /** Free everything that the frame has made. */
  dispose() {
    this.#renderer.dispose();
  }

  /**
   * @param {string} [name]
   * @returns {Texture}
   */
  #outputOf(name) {
    const { outputs, frame } = this.plan;
    const row = outputs.find((each) => (name ? each.name === name : each.texture !== null));
    const wanted = name ? `\`${name}\`` : "that is a picture";
    if (!row) throw new Error(`${frame} has no output ${wanted}`);
    const found = this.#resources.shown(row.result, row.texture);
    if (!found) throw new Error(`\`${row.name}\` of ${frame} is no picture, or was not drawn yet`);
    return found;
  }

  /**
   * Set the values that come from a scene, unless the page has set them.
   * @param {Values} values
   * @param {Record<string, string>} roles
   * @param {Record<string, Value>} scene
   * @param {number} aspect
   */
  #apply(values, roles, scene, aspect) {
    for (const [name, role] of Object.entries(roles)) {
      if (!(role in scene) || this.#given.has(name)) continue;
      const value = scene[role];
      const isView = role === "view_projection";
      values.set(name, isView ? ofAspect(/** @type {number[][]} */ (value), aspect) : value);
    }
  }

  // --- steps that draw ---

  /** @param {DrawStep} step */
  #drawStep(step) {
    const first = step.targets[0] ?? present(step.depth);
    const sides = this.#resources.sizeOf(first.texture).map((side) => halved(side, first.level));
    /** @type {(value: number | null) => number[] | null} */
    const given = (value) => (value === null ? null : this.#resources.number(value));
    const { viewport, scissor, blend_constant: constant } = step;
    const settings = settingsOf(sides, given(viewport), given(scissor), given(constant));
    const [, , wide, high] = settings.viewport;
    const calls = step.draws.flatMap((drawn) => this.#calls(drawn, wide / high));
    const layers = first.layer === null ? this.plan.textures[first.texture].layers : 1;
    for (let layer = 0; layer < layers; layer++) {
      if (first.layer === null) this.#tellLayer(calls, layer);
      /** @type {(target: AttachmentRow) => Attachment<Texture>} */
      const attachment = (target) => ({
        target,
        texture: this.#resources.texture(target.texture),
        layer: target.layer ?? layer,
        resolve: target.resolve && {
          ...target.resolve, texture: this.#resources.texture(target.resolve.texture),
        },
        clear: this.#cleared(target),
      });
      const depth = step.depth && attachment(step.depth);
      this.#renderer.draw(step.targets.map(attachment), depth, calls, settings);
    }
  }

  /**
   * The colour that a target is cleared to, or the depth, which is between 0 and 1.
   * @param {AttachmentRow} attachment
   * @returns {number[]}
   */
  #cleared({ texture, clear }) {
    const isDepths = this.plan.textures[texture].format.startsWith("depth");
    if (clear === null) return isDepths ? [1] : [0, 0, 0, 0];
    const found = this.#resources.number(clear);
    return isDepths ? [Math.min(Math.max(found[0], 0), 1)] : found;
  }

  /**
   * Set the number of the layer for shaders that draw each layer by itself.
   * @param {DrawCall<Texture, Buffer>[]} calls
   * @param {number} layer
   */
  #tellLayer(calls, layer) {
    for (const { shader, values } of calls) {
      const parameter = this.#from.shaders[shader].reflection.draw.layers?.parameter;
      if (parameter) values.set(parameter, layer);
    }
  }

  /**
   * @param {DrawnRow} drawn
   * @param {number} aspect
   * @returns {DrawCall<Texture, Buffer>[]}
   */
  #calls(drawn, aspect) {
    const { models: tag } = drawn;
    const models = tag === null
      ? [null] : this.#from.models.filter(({ tags }) => tags.includes(tag));
    return this.#lights(drawn.light).flatMap((light) =>
      models.map((model) => this.#call(drawn, model, light, aspect)),
    );
  }

  /**
   * @param {DrawnRow} drawn
   * @param {number} shader
   * @param {ModelRow | null} model
   */
  #meshOf({ vertices }, shader, model) {
    if (!model) return this.#vertices(shader, this.#resources.number(present(vertices))[0]);
    const number = model.geometries[shader];
    return this.#known(`${number}`, () => unpacked(this.#from.geometries[number]));
  }

  /**
   * @param {number} shader
   * @param {number} count
   */
  #vertices(shader, count) {
    if (!(count >= 0 && count <= NUMBERS)) throw new Error(`a step would draw ${count} vertices`);
    const { reflection } = this.#from.shaders[shader];
    return this.#known(`${count} vertices of ${shader}`, () => bareMesh(reflection, count));
  }

  /**
   * @param {string} key
   * @param {() => Mesh} make
   */
  #known(key, make) {
    const known = this.#meshes.get(key);
    if (known) return known;
    const mesh = make();
    /** @type {[string, Buffer][]} */
    const elements =
      mesh.elements.map(({ name, bytes }) => [name, this.#renderer.makeBuffer(bytes)]);
    const found = { mesh, elements };
    this.#meshes.set(key, found);
    return found;
  }

  /**
   * The number of each light of an entry of the rig; null for a single light, and if there is no
   * entry.
   * @param {string | null} entry
   * @returns {(number | null)[]}
   */
  #lights(entry) {
    const row = this.plan.lights.find((light) => light.entry === entry);
    if (!row || row.capacity === null) return [null];
    const lit = row.count === null ? [row.capacity] : this.#values.get(row.count);
    const [length] = /** @type {number[]} */ (lit);
    return Array.from({ length }, (_, number) => number);
  }

  /**
   * @param {DrawnRow} drawn
   * @param {ModelRow | null} model
   * @param {number | null} light
   * @param {number} aspect
   * @returns {DrawCall<Texture, Buffer>}
   */
  #call(drawn, model, light, aspect) {
    const use = useFor(drawn, model);
    const shader = this.#from.shaders[use.shader];
    const bound = this.#bind(use, model);
    this.#apply(bound.values, shader.roles, { ...model?.values, ...this.#camera }, aspect);
    for (const [name, source] of Object.entries(shader.lights)) {
      const value = this.#values.get(source.replace("[]", `[${light}]`));
      bound.values.set(name, /** @type {Value} */ (value));
    }
    this.#give(bound, use);
    checkLevels(shader, bound.values);
    const { mesh, elements } = this.#meshOf(drawn, use.shader, model);
    for (const [name, buffer] of elements) this.#giveBuffer(bound, name, buffer);
    return { ...bound, mesh };
  }

  // --- what shaders read ---

  /**
   * A shader with the values of its material, and with its pictures and buffers from the host.
   * @param {Pick<UseRow, "shader">} use
   * @param {ModelRow | null} model
   * @returns {Bound<Texture, Buffer>}
   */
  #bind(use, model) {
    const number = use.shader;
    const shader = this.#from.shaders[number];
    const values = this.#materials[number].copied();
    const { pictures, buffers: known } = this.#resources;
    const textures = Object.entries(shader.textures).map(([name, picture]) => {
      const own = this.#given.has(name) ? undefined : model?.textures[shader.texture_roles[name]];
      return /** @type {const} */ ([name, pictures[own ?? picture]]);
    });
    const buffers = values.declared.buffers.map(({ name }) =>
      /** @type {const} */ ([name, present(known.get(hostBuffer(values.name, name)))]),
    );
    return { shader: number, values, textures: new Map(textures), buffers: new Map(buffers) };
  }

  /**
   * Set the inputs of a shader that the frame sets.
   * @param {Bound<Texture, Buffer>} bound
   * @param {{ inputs: InputRow[] }} inputs
   */
  #give(bound, { inputs }) {
    for (const { name, source: said } of inputs) {
      const isEarly = this.#isFirst && said.kind === "previous" && said.initially;
      const source = isEarly || said;
      if (source.kind === "value") {
        bound.values.set(name, this.#resources.number(source.value));
      } else if (source.kind === "host" && source.host in this.#from.textures) {
        bound.textures.set(name, this.#resources.pictures[this.#from.textures[source.host]]);
      } else if (source.kind !== "host" && source.texture !== null) {
        bound.textures.set(name, this.#resources.texture(source.texture));
      } else {
        const key = this.#bufferOf(source);
        const buffer = this.#resources.buffers.get(key);
        if (!buffer) throw new Error(`${this.plan.frame} reads ${key}, which nobody has written`);
        const count = this.#giveBuffer(bound, name, buffer);
        const host = source.kind === "host" ? source.host : "";
        const row = this.plan.host_buffers.find((each) => each.name === host);
        if (row) bound.values.set(count, /** @type {Value} */ (this.#values.get(row.count)));
      }
    }
  }

  /**
   * @param {Exclude<InputRow["source"], { kind: "value" }>} source
   * @returns {string}
   */
  #bufferOf(source) {
    if (source.kind === "host") return hostBuffer(this.plan.frame, source.host);
    return source.kind === "previous" ? previousOf(source.previous) : source.result;
  }

  /**
   * Returns the name of the parameter with the number of the buffer's elements.
   * @param {Bound<Texture, Buffer>} bound
   * @param {string} name
   * @param {Buffer} buffer
   * @returns {string}
   */
  #giveBuffer(bound, name, buffer) {
    const row = present(bound.values.declared.buffers.find((each) => each.name === name));
    bound.values.count(row, this.#resources.bytesIn(buffer));
    bound.buffers.set(name, buffer);
    return row.count;
  }

  // --- kernels ---

  /** @param {RunStep} step */
  #run(step) {
    const { use } = step;
    const bound = this.#bind(use, null);
    this.#give(bound, use);
    const extent = this.#resources.extent(step, bound);
    const { reflection } = this.#from.shaders[use.shader];
    const images = step.images.map(({ texture }) => this.#resources.texture(texture));
    if (images.length && !Object.keys(reflection.backends[this.#renderer.profile].images).length) {
      // Without images to write, a kernel is a fragment shader, drawn over all of its targets.
      const target = /** @type {const} */ ({ level: 0, load: "clear", store: true, stencil: null });
      const targets = images.map((texture) => ({
        target, texture, layer: 0, clear: [0, 0, 0, 0], resolve: null,
      }));
      const settings = settingsOf(this.#resources.sizeOf(step.images[0].texture));
      const call = { ...bound, mesh: this.#vertices(use.shader, 3).mesh };
      this.#renderer.draw(targets, null, [call], settings);
      return;
    }
    this.#resources.giveWritten(step, bound);
    const groups = present(reflection.work_group).map((side, axis) =>
      Math.ceil(Math.max(extent[axis] ?? 1, 0) / side),
    );
    this.#renderer.run(bound, images, groups);
  }
}

/**
 * The shader that draws a model, or vertices without a model.
 * @param {DrawnRow} drawn
 * @param {ModelRow | null} model
 * @returns {UseRow}
 */
function useFor({ uses, models }, model) {
  const use = model ? uses.find(({ material }) => material === model.material) : uses[0];
  if (use) return use;
  const known = uses.map(({ material }) => material).join(", ");
  const wrong = `a model of \`${models}\` has the material ${present(model).material}`;
  throw new Error(`${wrong}, and the frame draws ${known}`);
}

/**
 * The columns of a projection for a picture that is `aspect` times as wide as high.
 * @type {(columns: number[][], aspect: number) => number[][]}
 */
const ofAspect = (columns, aspect) => columns.map(([x, ...others]) => [x / aspect, ...others]);
