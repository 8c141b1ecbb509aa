// Executes the plan of a frame, step by step, with the renderer of an API: see docs/plans.md.
import { areasOf, USUAL } from "./areas.js";
import { bytesOf, formatOf } from "./bytes.js";
import { bareGeometry, checkLevels, geometryOf } from "./geometry.js";
import { Values } from "./values.js";
const VERSION = 1;
/** How many frames are told apart, and how many vertices: as many as float32 can. */
const NUMBERS = 2 ** 24;
/** An error for a package that this host cannot draw. */
export function checkVersions({ package: version, plan, shaders }) {
    const wanted = [
        ["packages", version],
        ["plans", plan?.plan],
        ...(shaders ?? []).map(({ reflection }) => ["reflections", reflection.format]),
    ];
    for (const [what, found] of wanted) {
        if (found !== VERSION) {
            throw new Error(`this host knows ${what} of version ${VERSION}, and this one is of version ${found}`);
        }
    }
}
export class PlanFrame {
    from;
    renderer;
    plan;
    values;
    materials;
    given;
    camera;
    size;
    drawn = 0;
    isFirst = true;
    pictures;
    textures = new Map();
    buffers = new Map();
    /** The values of the kernels that this frame has run, by step. */
    kernels = new Map();
    geometries = new Map();
    elements = new WeakMap();
    constructor(from, renderer) {
        this.from = from;
        this.renderer = renderer;
        const { plan, shaders } = from;
        this.plan = plan;
        this.values = new Values(plan.frame, { ...plan, blocks: [], derived: [], buffers: plan.host_buffers });
        this.materials = shaders.map(({ reflection }) => new Values(reflection.material, reflection));
        for (const [values, source] of [[this.values, from], ...this.materials.map((each, at) => [each, shaders[at]])]) {
            Object.entries(source.values).forEach(([name, value]) => values.set(name, value));
            for (const row of values.declared.buffers) {
                const bytes = bytesOf(source.buffers[row.name] ?? "");
                values.count(row, bytes.length);
                this.buffers.set(hostBuffer(values, row.name), renderer.makeBuffer(bytes.length ? bytes : new Uint8Array(row.stride)));
            }
        }
        this.given = new Set(from.given);
        this.camera = from.camera;
        this.size = from.size;
        this.pictures = from.pictures.map((picture) => renderer.makePicture(picture));
    }
    // --- what a page sets ---
    set(name, value) {
        const owners = this.values.has(name) ? [this.values] : this.materials.filter((each) => each.has(name));
        if (!owners.length)
            throw new Error(`${this.plan.frame} has no parameter \`${name}\``);
        for (const each of owners)
            each.set(name, value);
        this.given.add(name);
    }
    setCamera(camera) {
        this.camera = { ...this.camera, ...camera };
    }
    resize(width, height) {
        if (!(width >= 1 && height >= 1))
            throw new Error(`a frame cannot have ${width} x ${height} pixels`);
        this.size = [Math.floor(width), Math.floor(height)];
    }
    // --- frames ---
    draw() {
        this.tell("size", this.size);
        this.tell("number", this.drawn % NUMBERS);
        this.apply(this.values, this.from.roles, this.camera, this.size[0] / this.size[1]);
        this.isFirst ||= this.plan.kept.some((row) => row.previous !== null && !this.fits(row.previous));
        this.kernels = new Map();
        this.renderer.begin();
        if (this.isFirst)
            this.startAnew();
        for (const step of this.plan.steps) {
            if (this.isFirst || !step.only_first)
                this.execute(step);
        }
        this.renderer.end();
        for (const row of this.plan.kept)
            this.exchange(row);
        this.isFirst = false;
        this.drawn += 1;
    }
    show(output) {
        this.renderer.show(this.outputOf(output));
    }
    read(output) {
        return this.renderer.read(this.outputOf(output));
    }
    dispose() {
        this.renderer.dispose();
    }
    /** Set what hosts tell every frame, unless this one says it itself, or somebody has set it. */
    tell(name, value) {
        if (this.values.has(name) && !this.given.has(name))
            this.values.set(name, value);
    }
    /** Give values what they are of a scene. */
    apply(values, roles, scene, aspect) {
        for (const [name, role] of Object.entries(roles)) {
            if (!(role in scene) || this.given.has(name))
                continue;
            values.set(name, role === "view_projection" ? ofAspect(scene[role], aspect) : scene[role]);
        }
    }
    outputOf(name) {
        const row = this.plan.outputs.find((each) => (name === undefined ? each.texture !== null : each.name === name));
        const kept = this.plan.kept.find((each) => each.result === row?.result);
        const found = this.textures.get(kept?.previous ?? row?.texture ?? -1);
        if (!row)
            throw new Error(`${this.plan.frame} has no output${name === undefined ? "" : ` \`${name}\``}`);
        if (!found)
            throw new Error(`the output \`${row.name}\` of ${this.plan.frame} is no picture, or was not drawn yet`);
        return found.texture;
    }
    // --- textures ---
    number(value) {
        return this.values.evaluated(this.plan.values[value].steps, (name) => this.renderer.sizeOf(this.pictures[this.from.textures[name]]));
    }
    sizeOf(texture) {
        const { value, extent_of, level } = this.plan.textures[texture].size;
        const sides = value !== null ? this.number(value) : this.extent(this.kernels.get(extent_of), extent_of);
        if (!(Math.min(...sides) >= 1)) {
            throw new Error(`a texture of ${this.plan.frame} would have ${sides.join(" x ")} texels`);
        }
        return sides.map((side) => Math.max(side >> level, 1));
    }
    /** How many texels, or elements, a kernel writes. */
    extent(kernel, step) {
        if (!kernel)
            throw new Error(`the size of what \`${step}\` writes is needed before it is run`);
        const { extent } = this.from.shaders[kernel.shader].reflection;
        return kernel.values.evaluated(extent, (name) => this.renderer.sizeOf(kernel.textures.get(name)));
    }
    fits(texture) {
        const made = this.textures.get(texture);
        const [width, height] = this.sizeOf(texture);
        return made?.width === width && made.height === height;
    }
    /** A texture of the plan, which is made when it is needed first, and anew if its size changes. */
    texture(number) {
        const known = this.textures.get(number);
        if (known && this.fits(number))
            return known.texture;
        if (known)
            this.renderer.freeTexture(known.texture);
        const row = this.plan.textures[number];
        const [width, height] = this.sizeOf(number);
        const texture = this.renderer.makeTexture({
            ...row, format: formatOf(row.format), width, height, isImage: row.uses.includes("image"),
        });
        this.textures.set(number, { texture, width, height });
        return texture;
    }
    /** Forget what the last frame has left. */
    startAnew() {
        for (const { texture, previous } of this.plan.kept) {
            for (const number of [texture, previous]) {
                const known = number === null ? undefined : this.textures.get(number);
                if (known)
                    this.renderer.freeTexture(known.texture);
                if (number !== null)
                    this.textures.delete(number);
            }
        }
    }
    exchange({ result, texture, previous }) {
        const exchanged = (items, one, other) => {
            const [first, second] = [items.get(one), items.get(other)];
            if (second === undefined)
                items.delete(one);
            else
                items.set(one, second);
            if (first !== undefined)
                items.set(other, first);
        };
        if (texture === null)
            exchanged(this.buffers, result, previousOf(result));
        else
            exchanged(this.textures, texture, previous);
    }
    // --- steps ---
    execute(step) {
        if (step.kind === "copy")
            this.renderer.copy(this.texture(step.from.texture), this.texture(step.to.texture));
        else if (step.kind === "run")
            this.run(step);
        else
            this.drawStep(step);
    }
    drawStep(step) {
        const first = step.targets[0] ?? step.depth;
        const [width, height] = this.sizeOf(first.texture).map((side) => Math.max(side >> first.level, 1));
        const settings = this.settings(step);
        const [[, , wide, high]] = areasOf(settings, width, height);
        const calls = step.draws.flatMap((drawn) => this.calls(drawn, wide / high));
        const layers = first.layer === null ? this.plan.textures[first.texture].layers : 1;
        for (let layer = 0; layer < layers; layer++) {
            const attachment = (target) => ({
                target, texture: this.texture(target.texture), layer: target.layer ?? layer, clear: this.cleared(target),
            });
            for (const { shader, values } of first.layer === null ? calls : []) {
                const parameter = this.from.shaders[shader].reflection.draw.layers?.parameter;
                if (parameter)
                    values.set(parameter, layer);
            }
            this.renderer.draw(step.targets.map(attachment), step.depth && attachment(step.depth), calls, settings);
        }
    }
    settings(step) {
        const area = (value) => (value === null ? null : this.number(value));
        return {
            viewport: area(step.viewport),
            scissor: area(step.scissor),
            blendConstant: step.blend_constant === null ? USUAL.blendConstant : this.number(step.blend_constant),
        };
    }
    /** What a target is cleared to, or a depth, which is within 0 and 1. */
    cleared({ texture, clear }) {
        const isDepths = this.plan.textures[texture].format.startsWith("depth");
        if (clear === null)
            return isDepths ? [1] : [0, 0, 0, 0];
        const found = this.number(clear);
        return isDepths ? [Math.min(Math.max(found[0], 0), 1)] : found;
    }
    calls(drawn, aspect) {
        return this.lights(drawn.light).flatMap((light) => {
            if (drawn.models === null) {
                const count = this.number(drawn.vertices)[0];
                if (!(count >= 0 && count <= NUMBERS))
                    throw new Error(`a step would draw ${count} vertices`);
                const use = drawn.uses[0];
                return [this.call(use, null, light, aspect, (shader) => this.geometry(`${use.shader} ${count}`, () => bareGeometry(shader, count)))];
            }
            const { models, meshes } = this.from.scene;
            const tagged = models.filter((each) => each.tags.includes(drawn.models));
            return tagged.map((model) => {
                const use = drawn.uses.find((each) => each.material === model.material);
                if (!use) {
                    const known = drawn.uses.map((each) => each.material).join(", ");
                    throw new Error(`a model of \`${drawn.models}\` has the material ${model.material}, and the frame draws ${known}`);
                }
                const mesh = meshes[model.mesh];
                const primitives = model.primitives[use.shader];
                return this.call(use, model, light, aspect, (shader) => this.geometry(`${use.shader} ${model.mesh} ${primitives}`, () => geometryOf(shader, mesh, mesh.primitives[primitives])));
            });
        });
    }
    geometry(key, make) {
        const found = this.geometries.get(key) ?? make();
        this.geometries.set(key, found);
        return found;
    }
    /** The storage buffers that stand for vertex inputs. */
    elementsOf(geometry) {
        const made = ([name, bytes]) => [name, this.renderer.makeBuffer(bytes)];
        const found = this.elements.get(geometry) ?? new Map([...geometry.elements].map(made));
        this.elements.set(geometry, found);
        return found;
    }
    /** Each light of an entry of the rig. */
    lights(entry) {
        if (entry === null)
            return [null];
        const { capacity, count } = this.plan.lights.find((each) => each.name === entry);
        if (capacity === null)
            return [{ entry, number: null }];
        const lit = count === null ? capacity : this.values.get(count)[0];
        return Array.from({ length: lit }, (_, number) => ({ entry, number }));
    }
    call(use, model, light, aspect, geometryFor) {
        const shader = this.from.shaders[use.shader];
        const bound = this.bind(use, model);
        this.apply(bound.values, shader.roles, { ...model?.values, ...this.camera }, aspect);
        this.shine(bound.values, shader, light);
        this.give(bound, use);
        checkLevels(shader, bound.values);
        const geometry = geometryFor(shader);
        for (const [name, buffer] of this.elementsOf(geometry)) {
            const row = bound.values.declared.buffers.find((each) => each.name === name);
            bound.values.count(row, this.renderer.bytesIn(buffer));
            bound.buffers.set(name, buffer);
        }
        return { ...bound, geometry };
    }
    /** A shader with the values of its material, and with what the host has of textures. */
    bind({ shader: number }, model) {
        const shader = this.from.shaders[number];
        const values = this.materials[number].copied();
        const textures = new Map();
        for (const [name, picture] of Object.entries(shader.textures)) {
            const own = this.given.has(name) ? undefined : model?.textures[shader.texture_roles[name]];
            textures.set(name, this.pictures[own ?? picture]);
        }
        const rows = values.declared.buffers;
        const buffers = new Map(rows.map(({ name }) => [name, this.buffers.get(hostBuffer(values, name))]));
        return { shader: number, values, textures, buffers };
    }
    /** Give a shader the lights of the frame; of a single one, that of its entry. */
    shine(values, { reflection }, light) {
        const known = new Set(this.plan.lights.map((each) => each.name));
        for (const row of reflection.lights) {
            const own = row.name.replace(`${reflection.rig}.`, "");
            if (!known.has(own))
                continue;
            if (row.capacity !== null) {
                values.take(row.name, this.values, own);
                if (row.count !== null)
                    values.take(row.count, this.values, `${own}.count`);
                continue;
            }
            const source = light?.entry === own && light.number !== null ? `${own}[${light.number}]` : own;
            for (const name of row.parameters) {
                values.set(name, this.values.get(`${source}${name.slice(row.name.length)}`));
            }
        }
    }
    /** Give a shader what the frame sets. */
    give(bound, { inputs }) {
        for (const input of inputs) {
            const source = (this.isFirst && input.initially) || input;
            if (source.value !== undefined) {
                bound.values.set(input.name, this.number(source.value));
            }
            else if (source.texture !== undefined && source.texture !== null) {
                bound.textures.set(input.name, this.texture(source.texture));
            }
            else if (source.host !== undefined && source.host in this.from.textures) {
                bound.textures.set(input.name, this.pictures[this.from.textures[source.host]]);
            }
            else {
                this.giveBuffer(bound, input.name, source);
            }
        }
    }
    giveBuffer(bound, name, { host, result, previous }) {
        const key = host !== undefined ? hostBuffer(this.values, host) : result ?? previousOf(previous);
        const buffer = this.buffers.get(key);
        if (!buffer)
            throw new Error(`${this.plan.frame} reads ${key}, which nobody has written`);
        const row = bound.values.declared.buffers.find((each) => each.name === name);
        const bytes = host !== undefined
            ? bytesOf(this.from.buffers[host]).length
            : this.renderer.bytesIn(buffer);
        bound.values.count(row, bytes);
        bound.buffers.set(name, buffer);
    }
    run(step) {
        const bound = this.bind(step, null);
        this.give(bound, step);
        this.kernels.set(step.name, bound);
        const { reflection } = this.from.shaders[step.shader];
        const extent = this.extent(bound, step.name);
        if (!step.images.length) {
            this.results(step, bound);
            this.renderer.run(bound, [], groupsOf([Math.max(extent[0], 0)], reflection.work_group));
            return;
        }
        const images = step.images.map(({ texture }) => this.texture(texture));
        if (Object.keys(reflection.backends[this.renderer.profile].images).length) {
            this.renderer.run(bound, images, groupsOf(extent, reflection.work_group));
            return;
        }
        // Where a kernel cannot write images it is drawn over all of them.
        const target = { level: 0, load: "clear", store: true };
        const geometry = { attributes: [], indices: null, count: 3, instances: 1, elements: new Map() };
        const targets = images.map((texture) => ({ target, texture, layer: 0, clear: [0, 0, 0, 0] }));
        this.renderer.draw(targets, null, [{ ...bound, geometry }], USUAL);
    }
    /** Make the buffers that a kernel writes, or fill them again. */
    results(step, bound) {
        for (const { name, result } of step.buffers) {
            const row = this.from.shaders[step.shader].reflection.results.find((each) => each.name === name);
            const sizes = (texture) => this.renderer.sizeOf(bound.textures.get(texture));
            const [count] = bound.values.evaluated(row.count, sizes);
            const bytes = new Uint8Array(Math.max(count, 1) * row.stride);
            if (row.initial !== null)
                new Int32Array(bytes.buffer).fill(row.initial | 0);
            const known = this.buffers.get(result);
            if (known && this.renderer.bytesIn(known) === bytes.length) {
                if (row.initial !== null)
                    this.renderer.fill(known, bytes);
            }
            else {
                if (known)
                    this.renderer.freeBuffer(known);
                this.buffers.set(result, this.renderer.makeBuffer(bytes));
            }
            bound.buffers.set(name, this.buffers.get(result));
        }
    }
}
const previousOf = (result) => `previous(${result})`;
const hostBuffer = (values, name) => `${name} of ${values.name}, set by the host`;
const groupsOf = (extent, sides) => sides.map((side, axis) => Math.ceil((extent[axis] ?? 1) / side));
/** The columns of a projection for a picture that is `aspect` times as wide as high. */
const ofAspect = (columns, aspect) => columns.map(([x, ...others]) => [x / aspect, ...others]);
