// Executes the plan of a frame, step by step, with the renderer of an API: see docs/plans.md.

import { bytesOf, halved } from "./bytes.js";
import type {
  Camera, FramePackage, Model, PackagedShader, Plan, PlanDraw, PlanDrawn, PlanInput, PlanRun,
  PlanTarget, PlanUse, Value,
} from "./generated/documents.js";
import { bareMesh, checkLevels, meshOf, type Mesh } from "./geometry.js";
import type { Attachment, Bound, DrawCall, DrawSettings, Pixels, Renderer } from "./renderer.js";
import { hostBuffer, previousOf, Resources } from "./resources.js";
import { settingsOf } from "./settings.js";
import { Values, type LightRow } from "./values.js";

const VERSION = 1;
/** How many frames are told apart, and how many vertices: as many as float32 can. */
const NUMBERS = 2 ** 24;

/** An error for a package that this host cannot draw. */
export function checkVersions({ package: version, plan, shaders }: FramePackage): void {
  const check = (what: string, found: unknown) => {
    if (found === VERSION) return;
    const known = `this host knows ${what} of version ${VERSION}`;
    throw new Error(`${known}, and this one is of version ${found}`);
  };
  check("packages", version);
  check("plans", plan.plan);
  shaders.forEach(({ reflection }) => check("reflections", reflection.format));
}

/** One light of an entry of the rig, for which a step draws. */
type Lit = { entry: string; number: number | null } | null;

/** A frame that is open: `openFrame` makes one. What cannot be done is an `Error` with a
 * sentence. */
export class PlanFrame<Texture, Buffer> {
  readonly plan: Plan;
  private readonly values: Values;
  private readonly materials: Values[];
  private readonly resources: Resources<Texture, Buffer>;
  private readonly given: Set<string>;
  private camera: Camera;
  private size: [number, number];
  private drawn = 0;
  private isFirst = true;
  private readonly meshes = new Map<string, Mesh>();
  private readonly elements = new WeakMap<Mesh, [string, Buffer][]>();

  constructor(
    private readonly from: FramePackage,
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
  setCamera(camera: Partial<Camera>): void {
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
        const [from, to] = [step.from, step.to].map((end) => this.resources.texture(end.texture!));
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
    const isWanted = (row: Plan["outputs"][0]) =>
      name === undefined ? row.texture !== null : row.name === name;
    const row = outputs.find(isWanted);
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

  private drawStep(step: PlanDraw): void {
    const first = step.targets[0] ?? step.depth!;
    const sides = this.resources.sizeOf(first.texture).map((side) => halved(side, first.level));
    const settings = this.settings(step, sides);
    const [, , wide, high] = settings.viewport;
    const calls = step.draws.flatMap((drawn) => this.calls(drawn, wide / high));
    const layers = first.layer === null ? this.plan.textures[first.texture].layers : 1;
    for (let layer = 0; layer < layers; layer++) {
      if (first.layer === null) this.tellLayer(calls, layer);
      const attachment = (target: PlanTarget): Attachment<Texture> => ({
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

  private settings(step: PlanDraw, [width, height]: number[]): DrawSettings {
    const { viewport, scissor, blend_constant } = step;
    const [seen, drawn, constant] = [viewport, scissor, blend_constant].map((value) =>
      value === null ? null : this.resources.number(value),
    );
    return settingsOf(width, height, seen, drawn, constant);
  }

  /** What a target is cleared to, or a depth, which is within 0 and 1. */
  private cleared({ texture, clear }: PlanTarget): number[] {
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

  private calls(drawn: PlanDrawn, aspect: number): DrawCall<Texture, Buffer>[] {
    const models = this.from.models.filter(({ tags }) => tags.includes(drawn.models!));
    return this.lights(drawn.light).flatMap((light) =>
      (drawn.models === null ? [null] : models).map((model) => {
        const use = useFor(drawn, model);
        return this.call(use, model, light, aspect, this.mesh(drawn, use.shader, model));
      }),
    );
  }

  private mesh({ vertices }: PlanDrawn, shader: number, model: Model | null): Mesh {
    if (model) {
      const number = model.geometries[shader];
      return this.known(`${number}`, () => meshOf(this.from.geometries[number]));
    }
    const [count] = this.resources.number(vertices!);
    if (!(count >= 0 && count <= NUMBERS)) throw new Error(`a step would draw ${count} vertices`);
    return this.vertices(shader, count);
  }

  private vertices(shader: number, count: number): Mesh {
    const { reflection } = this.from.shaders[shader];
    return this.known(`${count} vertices of ${shader}`, () => bareMesh(reflection, count));
  }

  private known(key: string, make: () => Mesh): Mesh {
    const found = this.meshes.get(key) ?? make();
    this.meshes.set(key, found);
    return found;
  }

  /** Each light of an entry of the rig. */
  private lights(entry: string | null): Lit[] {
    if (entry === null) return [null];
    const { capacity, count } = this.light(entry)!;
    if (capacity === null) return [{ entry, number: null }];
    const lit = count === null ? capacity : (this.values.get(count) as number[])[0];
    return Array.from({ length: lit }, (_, number) => ({ entry, number }));
  }

  /** The row of an entry of the rig. Plans, and shaders, put the rig's name before it where it is
   * that of something else as well. */
  private light(entry: string): LightRow | undefined {
    const { rig, lights } = this.plan;
    return lights.find(({ name }) => name === entry || name === `${rig}.${entry}`);
  }

  private call(
    use: PlanUse, model: Model | null, light: Lit, aspect: number, mesh: Mesh,
  ): DrawCall<Texture, Buffer> {
    const shader = this.from.shaders[use.shader];
    const bound = this.bind(use, model);
    this.apply(bound.values, shader.roles, { ...model?.values, ...this.camera }, aspect);
    this.shine(bound.values, shader, light);
    this.give(bound, use);
    checkLevels(shader, bound.values);
    for (const [name, buffer] of this.elementsOf(mesh)) this.giveBuffer(bound, name, buffer);
    return { ...bound, mesh };
  }

  /** The storage buffers that stand for vertex inputs. */
  private elementsOf(mesh: Mesh): [string, Buffer][] {
    const found = this.elements.get(mesh)
      ?? mesh.elements.map(([name, bytes]) => [name, this.renderer.makeBuffer(bytes)]);
    this.elements.set(mesh, found);
    return found;
  }

  // --- what shaders read ---

  /** A shader with the values of its material, and with what the host has for it. */
  private bind(use: Pick<PlanUse, "shader">, model: Model | null): Bound<Texture, Buffer> {
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

  /** Give a shader the lights of the frame; of a single one, that of its entry. */
  private shine(values: Values, { reflection }: PackagedShader, light: Lit): void {
    for (const row of reflection.lights) {
      const entry = row.name.replace(`${reflection.rig}.`, "");
      const own = this.light(entry);
      if (!own) continue;
      if (row.capacity !== null) {
        values.set(row.name, this.values.get(own.name) as Value);
        if (row.count !== null) values.set(row.count, this.values.get(own.count!) as Value);
        continue;
      }
      const number = light?.entry === entry ? light.number : null;
      const source = number === null ? own.name : `${own.name}[${number}]`;
      for (const name of row.parameters) {
        const member = name.slice(row.name.length);
        values.set(name, this.values.get(`${source}${member}`) as Value);
      }
    }
  }

  /** Give a shader what the frame sets. */
  private give(bound: Bound<Texture, Buffer>, { inputs }: { inputs: PlanInput[] }): void {
    for (const input of inputs) {
      const source: Omit<PlanInput, "name"> = (this.isFirst && input.initially) || input;
      const { value, texture, host, result, previous } = source;
      if (value !== undefined) {
        bound.values.set(input.name, this.resources.number(value));
      } else if (texture !== undefined && texture !== null) {
        bound.textures.set(input.name, this.resources.texture(texture));
      } else if (host !== undefined && host in this.from.textures) {
        bound.textures.set(input.name, this.resources.pictures[this.from.textures[host]]);
      } else {
        const left = result ?? previousOf(previous!);
        const key = host !== undefined ? hostBuffer(this.plan.frame, host) : left;
        const buffer = this.resources.buffers.get(key);
        if (!buffer) throw new Error(`${this.plan.frame} reads ${key}, which nobody has written`);
        const count = this.giveBuffer(bound, input.name, buffer);
        const row = this.plan.host_buffers.find((each) => each.name === host);
        if (row) bound.values.set(count, this.values.get(row.count) as Value);
      }
    }
  }

  /** Returns the name of the parameter that says how many elements it has. */
  private giveBuffer(bound: Bound<Texture, Buffer>, name: string, buffer: Buffer): string {
    const row = bound.values.declared.buffers.find((each) => each.name === name)!;
    bound.values.count(row, this.resources.bytesIn(buffer));
    bound.buffers.set(name, buffer);
    return row.count;
  }

  // --- kernels ---

  private run(step: PlanRun): void {
    const bound = this.bind(step, null);
    this.give(bound, step);
    const extent = this.resources.running(step.name, bound);
    const { reflection } = this.from.shaders[step.shader];
    const images = step.images.map(({ texture }) => this.resources.texture(texture));
    if (images.length && !Object.keys(reflection.backends[this.renderer.profile].images).length) {
      // Where a kernel cannot write images it is drawn over all of them.
      const target = { level: 0, load: "clear", store: true } as const;
      const targets = images.map((texture) => ({
        target, texture, layer: 0, clear: [0, 0, 0, 0], resolve: null,
      }));
      const [width, height] = this.resources.sizeOf(step.images[0].texture);
      const settings = settingsOf(width, height, null, null, null);
      const call = { ...bound, mesh: this.vertices(step.shader, 3) };
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
function useFor({ uses, models }: PlanDrawn, model: Model | null): PlanUse {
  const use = model ? uses.find(({ material }) => material === model.material) : uses[0];
  if (use) return use;
  const known = uses.map(({ material }) => material).join(", ");
  const wrong = `a model of \`${models}\` has the material ${model!.material}`;
  throw new Error(`${wrong}, and the frame draws ${known}`);
}

/** The columns of a projection for a picture that is `aspect` times as wide as high. */
const ofAspect = (columns: number[][], aspect: number) =>
  columns.map(([x, ...others]) => [x / aspect, ...others]);
