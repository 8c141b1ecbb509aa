// Executes the plan of a frame, step by step, with the renderer of an API: see docs/plans.md.

import { bytesOf, halved } from "./bytes.js";
import type {
  CameraRow, Package, ModelRow, PackagedShader, FramePlan, DrawStep, DrawnRow, InputRow, RunStep,
  AttachmentRow, UseRow, Value,
} from "./generated/documents.js";
import { bareMesh, checkLevels, unpacked, type Mesh } from "./geometry.js";
import type { Attachment, Bound, DrawCall, Pixels, Renderer } from "./renderer.js";
import { hostBuffer, previousOf, Resources } from "./resources.js";
import { settingsOf } from "./settings.js";
import { Values } from "./values.js";

const VERSION = 2;
/** How many frames are told apart, and how many vertices: as many as float32 can. */
const NUMBERS = 2 ** 24;

/** An error for a package that this host cannot draw. */
export function checkVersions({ package: version, plan, shaders }: Package): void {
  const reflections = shaders.map(({ reflection }) => reflection.format);
  const found = { packages: [version], plans: [plan.plan], reflections };
  for (const [what, versions] of Object.entries(found)) {
    const other = versions.find((each) => each !== VERSION);
    if (other === undefined) continue;
    const known = `this host knows ${what} of version ${VERSION}`;
    throw new Error(`${known}, and this one is of version ${other}`);
  }
}

/** A frame that is open: `openFrame` makes one. What cannot be done is an `Error` with a
 * sentence. */
export class PlanFrame<Texture, Buffer> {
  readonly plan: FramePlan;
  private readonly values: Values;
  private readonly materials: Values[];
  private readonly resources: Resources<Texture, Buffer>;
  private readonly given: Set<string>;
  private camera: CameraRow;
  private size: [number, number];
  private drawn = 0;
  private isFirst = true;
  /** Each with the storage buffers that stand for its vertex inputs. */
  private readonly meshes = new Map<string, { mesh: Mesh; elements: [string, Buffer][] }>();

  constructor(
    private readonly from: Package,
    private readonly renderer: Renderer<Texture, Buffer>,
  ) {
    const { plan, shaders } = from;
    const declared = { ...plan, blocks: [], derived: [], buffers: plan.host_buffers };
    this.plan = plan;
    this.given = new Set(from.given);
    this.camera = from.camera;
    this.size = from.size;
    this.values = new Values(plan.frame, declared);
    this.materials = shaders.map(({ reflection }) => new Values(reflection.material, reflection));
    this.resources = new Resources(from, renderer, this.values);
    this.fill(this.values, from);
    this.materials.forEach((each, number) => this.fill(each, shaders[number]));
  }

  /** Set what a package says of a frame or a shader. */
  private fill(values: Values, from: Pick<PackagedShader, "values" | "buffers">): void {
    for (const [name, value] of Object.entries(from.values)) values.set(name, value);
    for (const row of values.declared.buffers) {
      const bytes = bytesOf(from.buffers[row.name] ?? "");
      values.count(row, bytes.length);
      // No API binds a buffer of no bytes.
      const buffer = this.renderer.makeBuffer(bytes.length ? bytes : new Uint8Array(row.stride));
      this.resources.buffers.set(hostBuffer(values.name, row.name), buffer);
    }
  }

  // --- what a page does ---

  /** Set something of the frame, `sun.direction` or `lamps[2].place`; or else of all shaders that
   * have it, such as a material's colour. */
  set(name: string, value: Value): void {
    const owners = [this.values, ...this.materials].filter((each) => each.has(name));
    if (!owners.length) throw new Error(`${this.plan.frame} has no parameter \`${name}\``);
    for (const each of owners[0] === this.values ? [this.values] : owners) each.set(name, value);
    this.given.add(name);
  }

  /** Look from elsewhere. What is left out stays as it is. */
  setCamera(camera: Partial<CameraRow>): void {
    this.camera = { ...this.camera, ...camera };
  }

  /** The width and height of what the frame draws, as far as it says no other size. */
  resize(width: number, height: number): void {
    if (!(width >= 1 && height >= 1)) {
      throw new Error(`a frame cannot have ${width} x ${height} pixels`);
    }
    this.size = [Math.floor(width), Math.floor(height)];
  }

  /** Draw the frame once; what it keeps goes on from the last time. */
  draw(): void {
    const told = { ...this.camera, size: this.size, number: this.drawn % NUMBERS };
    this.apply(this.values, this.from.roles, told, this.size[0] / this.size[1]);
    this.renderer.begin();
    this.isFirst = !this.resources.begin(this.isFirst);
    for (const step of this.plan.steps) {
      if (step.only_first && !this.isFirst) continue;
      if (step.kind === "draw") this.drawStep(step);
      else if (step.kind === "run") this.run(step);
      else {
        const [from, to] = [step.copied, step.into].map((end) => this.resources.texture(end.texture));
        this.renderer.copy(from, to);
      }
    }
    this.renderer.end();
    this.resources.end();
    this.isFirst = false;
    this.drawn += 1;
  }

  /** Put an output on the canvas, by default the first one that is a picture. */
  show(output?: string): void {
    this.renderer.show(this.outputOf(output));
  }

  /** The width and height of an output's first level. */
  sizeOf(output: string): [number, number] {
    const [width, height] = this.renderer.sizeOf(this.outputOf(output));
    return [width, height];
  }

  /** The elements of an output that is a buffer, as its row of `results` says how they lie. */
  async readElements(output: string): Promise<Uint8Array<ArrayBuffer>> {
    const row = this.plan.outputs.find((each) => each.name === output && each.texture === null);
    const buffer = row && this.resources.written(row.result);
    const { frame } = this.plan;
    if (!buffer) throw new Error(`\`${output}\` of ${frame} is no buffer, or was not written yet`);
    return (await this.renderer.readBuffer(buffer)).subarray(0, this.resources.bytesIn(buffer));
  }

  /** The numbers of an output's first level. */
  read(output: string): Promise<Pixels> {
    return this.renderer.read(this.outputOf(output));
  }

  /** Wait until all is drawn; an error tells what the API has refused of it. */
  finished(): Promise<void> {
    return this.renderer.finished();
  }

  /** Give everything back that the frame has made. */
  dispose(): void {
    this.renderer.dispose();
  }

  private outputOf(name?: string): Texture {
    const { outputs, frame } = this.plan;
    const row = outputs.find((each) =>
      name === undefined ? each.texture !== null : each.name === name,
    );
    const wanted = name === undefined ? "that is a picture" : `\`${name}\``;
    if (!row) throw new Error(`${frame} has no output ${wanted}`);
    const found = this.resources.shown(row.result, row.texture);
    if (!found) throw new Error(`\`${row.name}\` of ${frame} is no picture, or was not drawn yet`);
    return found;
  }

  /** Give values what they are of a scene, unless somebody has set them. */
  private apply(
    values: Values, roles: Record<string, string>, scene: Record<string, Value>, aspect: number,
  ): void {
    for (const [name, role] of Object.entries(roles)) {
      if (!(role in scene) || this.given.has(name)) continue;
      const value = scene[role];
      values.set(name, role === "view_projection" ? ofAspect(value as number[][], aspect) : value);
    }
  }

  // --- steps that draw ---

  private drawStep(step: DrawStep): void {
    const first = step.targets[0] ?? step.depth!;
    const sides = this.resources.sizeOf(first.texture).map((side) => halved(side, first.level));
    const { viewport, scissor, blend_constant: constant } = step;
    const settings = settingsOf(sides, ...[viewport, scissor, constant].map((value) =>
      value === null ? null : this.resources.number(value),
    ));
    const [, , wide, high] = settings.viewport;
    const calls = step.draws.flatMap((drawn) => this.calls(drawn, wide / high));
    const layers = first.layer === null ? this.plan.textures[first.texture].layers : 1;
    for (let layer = 0; layer < layers; layer++) {
      if (first.layer === null) this.tellLayer(calls, layer);
      const attachment = (target: AttachmentRow): Attachment<Texture> => ({
        target,
        texture: this.resources.texture(target.texture),
        layer: target.layer ?? layer,
        resolve: target.resolve && {
          ...target.resolve, texture: this.resources.texture(target.resolve.texture),
        },
        clear: this.cleared(target),
      });
      const depth = step.depth && attachment(step.depth);
      this.renderer.draw(step.targets.map(attachment), depth, calls, settings);
    }
  }

  /** What a target is cleared to, or a depth, which is within 0 and 1. */
  private cleared({ texture, clear }: AttachmentRow): number[] {
    const isDepths = this.plan.textures[texture].format.startsWith("depth");
    if (clear === null) return isDepths ? [1] : [0, 0, 0, 0];
    const found = this.resources.number(clear);
    return isDepths ? [Math.min(Math.max(found[0], 0), 1)] : found;
  }

  /** Tell shaders that draw each layer by itself which one it is. */
  private tellLayer(calls: DrawCall<Texture, Buffer>[], layer: number): void {
    for (const { shader, values } of calls) {
      const parameter = this.from.shaders[shader].reflection.draw!.layers?.parameter;
      if (parameter) values.set(parameter, layer);
    }
  }

  private calls(drawn: DrawnRow, aspect: number): DrawCall<Texture, Buffer>[] {
    const models = this.from.models.filter(({ tags }) => tags.includes(drawn.models!));
    return this.lights(drawn.light).flatMap((light) =>
      (drawn.models === null ? [null] : models).map((model) =>
        this.call(drawn, model, light, aspect),
      ),
    );
  }

  private meshOf({ vertices }: DrawnRow, shader: number, model: ModelRow | null) {
    if (!model) return this.vertices(shader, this.resources.number(vertices!)[0]);
    const number = model.geometries[shader];
    return this.known(`${number}`, () => unpacked(this.from.geometries[number]));
  }

  private vertices(shader: number, count: number) {
    if (!(count >= 0 && count <= NUMBERS)) throw new Error(`a step would draw ${count} vertices`);
    const { reflection } = this.from.shaders[shader];
    return this.known(`${count} vertices of ${shader}`, () => bareMesh(reflection, count));
  }

  private known(key: string, make: () => Mesh) {
    const known = this.meshes.get(key);
    if (known) return known;
    const mesh = make();
    const elements = mesh.elements.map(({ name, bytes }): [string, Buffer] => {
      return [name, this.renderer.makeBuffer(bytes)];
    });
    const found = { mesh, elements };
    this.meshes.set(key, found);
    return found;
  }

  /** The number of each light of an entry of the rig; null where it is a single one, or none is
   * meant. */
  private lights(entry: string | null): (number | null)[] {
    // Plans put the rig's name before it where it is that of something else as well.
    const { rig, lights } = this.plan;
    const row = lights.find(({ name }) => name === entry || name === `${rig}.${entry}`);
    if (!row || row.capacity === null) return [null];
    const lit = row.count === null ? row.capacity : (this.values.get(row.count) as number[])[0];
    return Array.from({ length: lit }, (_, number) => number);
  }

  private call(
    drawn: DrawnRow, model: ModelRow | null, light: number | null, aspect: number,
  ): DrawCall<Texture, Buffer> {
    const use = useFor(drawn, model);
    const shader = this.from.shaders[use.shader];
    const bound = this.bind(use, model);
    this.apply(bound.values, shader.roles, { ...model?.values, ...this.camera }, aspect);
    for (const [name, source] of Object.entries(shader.lights)) {
      bound.values.set(name, this.values.get(source.replace("[]", `[${light}]`)) as Value);
    }
    this.give(bound, use);
    checkLevels(shader, bound.values);
    const { mesh, elements } = this.meshOf(drawn, use.shader, model);
    for (const [name, buffer] of elements) this.giveBuffer(bound, name, buffer);
    return { ...bound, mesh };
  }

  // --- what shaders read ---

  /** A shader with the values of its material, and with what the host has for it. */
  private bind(use: Pick<UseRow, "shader">, model: ModelRow | null): Bound<Texture, Buffer> {
    const number = use.shader;
    const shader = this.from.shaders[number];
    const values = this.materials[number].copied();
    const { pictures, buffers: known } = this.resources;
    const textures = Object.entries(shader.textures).map(([name, picture]) => {
      const own = this.given.has(name) ? undefined : model?.textures[shader.texture_roles[name]];
      return [name, pictures[own ?? picture]] as const;
    });
    const buffers = values.declared.buffers.map(({ name }) =>
      [name, known.get(hostBuffer(values.name, name))!] as const,
    );
    return { shader: number, values, textures: new Map(textures), buffers: new Map(buffers) };
  }

  /** Give a shader what the frame sets. */
  private give(bound: Bound<Texture, Buffer>, { inputs }: { inputs: InputRow[] }): void {
    for (const { name, source: said } of inputs) {
      const isEarly = this.isFirst && said.kind === "previous" && said.initially;
      const source = isEarly || said;
      if (source.kind === "value") {
        bound.values.set(name, this.resources.number(source.value));
      } else if (source.kind === "host" && source.host in this.from.textures) {
        bound.textures.set(name, this.resources.pictures[this.from.textures[source.host]]);
      } else if (source.kind !== "host" && source.texture !== null) {
        bound.textures.set(name, this.resources.texture(source.texture));
      } else {
        const key = this.bufferOf(source);
        const buffer = this.resources.buffers.get(key);
        if (!buffer) throw new Error(`${this.plan.frame} reads ${key}, which nobody has written`);
        const count = this.giveBuffer(bound, name, buffer);
        const host = source.kind === "host" ? source.host : "";
        const row = this.plan.host_buffers.find((each) => each.name === host);
        if (row) bound.values.set(count, this.values.get(row.count) as Value);
      }
    }
  }

  private bufferOf(source: Exclude<InputRow["source"], { kind: "value" }>): string {
    if (source.kind === "host") return hostBuffer(this.plan.frame, source.host);
    return source.kind === "previous" ? previousOf(source.previous) : source.result;
  }

  /** Returns the name of the parameter that says how many elements it has. */
  private giveBuffer(bound: Bound<Texture, Buffer>, name: string, buffer: Buffer): string {
    const row = bound.values.declared.buffers.find((each) => each.name === name)!;
    bound.values.count(row, this.resources.bytesIn(buffer));
    bound.buffers.set(name, buffer);
    return row.count;
  }

  // --- kernels ---

  private run(step: RunStep): void {
    const { use } = step;
    const bound = this.bind(use, null);
    this.give(bound, use);
    const extent = this.resources.extent(step, bound);
    const { reflection } = this.from.shaders[use.shader];
    const images = step.images.map(({ texture }) => this.resources.texture(texture));
    if (images.length && !Object.keys(reflection.backends[this.renderer.profile].images).length) {
      // Where a kernel cannot write images it is drawn over all of them.
      const target = { level: 0, load: "clear", store: true, stencil: null } as const;
      const targets = images.map((texture) => ({
        target, texture, layer: 0, clear: [0, 0, 0, 0], resolve: null,
      }));
      const settings = settingsOf(this.resources.sizeOf(step.images[0].texture));
      const call = { ...bound, mesh: this.vertices(use.shader, 3).mesh };
      this.renderer.draw(targets, null, [call], settings);
      return;
    }
    this.resources.giveWritten(step, bound);
    const groups = reflection.work_group!.map((side, axis) =>
      Math.ceil(Math.max(extent[axis] ?? 1, 0) / side),
    );
    this.renderer.run(bound, images, groups);
  }
}

/** The shader of what is drawn for a model, or for vertices. */
function useFor({ uses, models }: DrawnRow, model: ModelRow | null): UseRow {
  const use = model ? uses.find(({ material }) => material === model.material) : uses[0];
  if (use) return use;
  const known = uses.map(({ material }) => material).join(", ");
  const wrong = `a model of \`${models}\` has the material ${model!.material}`;
  throw new Error(`${wrong}, and the frame draws ${known}`);
}

/** The columns of a projection for a picture that is `aspect` times as wide as high. */
const ofAspect = (columns: number[][], aspect: number) =>
  columns.map(([x, ...others]) => [x / aspect, ...others]);
