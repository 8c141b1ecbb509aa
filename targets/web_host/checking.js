// Checks a package before anything of it is used: its versions, its shape, and its numbers.

import { PACKAGE } from "./generated/shapes.js";

/** @import { Package } from "./generated/documents.js" */

/**
 * What a value may be, in words of JSON Schema. `of` names the list whose rows a number counts,
 * and `by` the member that tells alternatives apart.
 * @typedef {{
 *   $ref?: string, oneOf?: Shape[], by?: string, const?: unknown, enum?: unknown[],
 *   type?: string | string[], properties?: Record<string, Shape>, required?: string[],
 *   additionalProperties?: Shape | false,
 *   items?: Shape, minItems?: number, maxItems?: number, pattern?: string,
 *   minimum?: number, maximum?: number, multipleOf?: number, of?: string,
 * }} Shape
 */
/** The shape of a document. @typedef {Shape & { $defs: Record<string, Shape> }} Whole */
/** An object of JSON. @typedef {Record<string, unknown>} Members */
/** The number of rows of each list. @typedef {Record<string, number>} Counts */

/** The versions of documents that this host reads. @type {Record<string, number>} */
const VERSIONS = { packages: 2, plans: 2, reflections: 3 };
/** @type {Record<string, string>} */
const KINDS = {
  null: "null", boolean: "true or false", integer: "a whole number", number: "a number",
  string: "a text", array: "a list", object: "an object",
};

/**
 * Throws an error for a package that this host cannot draw; it names the place that is wrong.
 * @param {Package} from
 */
export function checkPackage(from) {
  const { package: version, plan, shaders, pictures, geometries } = membersOf(from);
  const { plan: ofPlan, textures, values } = membersOf(plan);
  const reflections = listOf(shaders).map((each) => membersOf(membersOf(each).reflection).format);
  const found = { packages: [version], plans: [ofPlan], reflections };
  for (const [what, versions] of Object.entries(found)) {
    const other = versions.find((each) => each !== undefined && each !== VERSIONS[what]);
    if (other === undefined) continue;
    const known = `this host knows ${what} of version ${VERSIONS[what]}`;
    const make = "make the package again with `frame_package`";
    throw new Error(`${known}, and this one is of version ${shown(other)}: ${make}`);
  }
  const lists = Object.entries({ textures, values, shaders, pictures, geometries });
  const counts = lists.map(([name, rows]) => [name, listOf(rows).length]);
  check(from, PACKAGE, "", Object.fromEntries(counts));
}

/**
 * The members of an object; none of another value.
 * @param {unknown} value
 * @returns {Members}
 */
const membersOf = (value) => (kindOf(value) === "object" ? /** @type {Members} */ (value) : {});

/** @type {(value: unknown) => unknown[]} */
const listOf = (value) => (Array.isArray(value) ? value : []);

/**
 * The kind of a value in JSON; numbers that JSON does not have are of none.
 * @param {unknown} value
 */
function kindOf(value) {
  if (value === null) return "null";
  if (Array.isArray(value)) return "array";
  if (typeof value !== "number") return typeof value;
  return Number.isInteger(value) ? "integer" : Number.isFinite(value) ? "number" : "none";
}

/** @type {(value: unknown) => string} */
const shown = (value) =>
  typeof value === "object" ? KINDS[kindOf(value)] : `${JSON.stringify(value)}`.slice(0, 60);

/** @type {(place: string, text: string) => never} */
function fail(place, text) {
  throw new Error(`${place || "/"}: ${text}`);
}

/**
 * Throws an error unless a value has a shape, in all of its parts.
 * @param {unknown} value
 * @param {Shape} shape
 * @param {string} place
 * @param {Counts} counts
 */
function check(value, shape, place, counts) {
  const kind = kindOf(value);
  if (shape.$ref) return check(value, defined(shape), place, counts);
  if (shape.oneOf) return check(value, chosen(value, shape, place), place, counts);
  const words = wordsOf(shape);
  if (words && !words.includes(value)) {
    fail(place, `${shown(value)} is not ${words.map(shown).join(" or ")}`);
  }
  const kinds = [shape.type ?? []].flat();
  const isOne = kinds.includes(kind) || (kind === "integer" && kinds.includes("number"));
  if (kinds.length && !isOne) {
    fail(place, `${shown(value)} is not ${kinds.map((each) => KINDS[each]).join(" or ")}`);
  }
  if (kind === "object") checkMembers(membersOf(value), shape, place, counts);
  if (Array.isArray(value)) checkList(value, shape, place, counts);
  if (typeof value === "number") checkNumber(value, shape, place);
  if (typeof value === "string" && shape.pattern && !new RegExp(shape.pattern, "u").test(value)) {
    fail(place, `${shown(value)} does not look like ${shape.pattern}`);
  }
  const rows = shape.of && counts[shape.of];
  if (rows === undefined || rows === "") return;
  for (const each of kind === "object" ? Object.values(membersOf(value)) : [value]) {
    if (typeof each === "number" && !(each >= 0 && each < rows)) {
      fail(place, `there is no ${each} among the ${rows} ${shape.of}`);
    }
  }
}

/** @type {(members: Members, shape: Shape, place: string, counts: Counts) => void} */
function checkMembers(members, { properties = {}, required = [], ...shape }, place, counts) {
  const missed = required.find((key) => !Object.hasOwn(members, key));
  if (missed !== undefined) fail(place, `there is no \`${missed}\``);
  for (const [key, value] of Object.entries(members)) {
    const known = Object.hasOwn(properties, key) ? properties[key] : shape.additionalProperties;
    if (known === false) fail(place, `there is ${shown(key)}, which has no meaning there`);
    if (known) check(value, known, `${place}/${key}`, counts);
  }
}

/** @type {(list: unknown[], shape: Shape, place: string, counts: Counts) => void} */
function checkList(list, { items = {}, minItems = 0, maxItems = Infinity }, place, counts) {
  const { length } = list;
  if (length < minItems || length > maxItems) fail(place, `it has ${length} elements`);
  list.forEach((each, number) => check(each, items, `${place}/${number}`, counts));
}

/** @type {(value: number, shape: Shape, place: string) => void} */
function checkNumber(value, { minimum = -Infinity, maximum = Infinity, multipleOf }, place) {
  if (value < minimum) fail(place, `${value} is less than ${minimum}`);
  if (value > maximum) fail(place, `${value} is more than ${maximum}`);
  if (multipleOf && value % multipleOf) fail(place, `${value} is no multiple of ${multipleOf}`);
}

/**
 * The one of several shapes that a value is meant to have: null, or the only other one, or the
 * record that has its word in the member that tells records apart.
 * @param {unknown} value
 * @param {Shape} shape
 * @param {string} place
 * @returns {Shape}
 */
function chosen(value, { oneOf = [], by }, place) {
  const records = oneOf.filter(({ type }) => type !== "null").map(defined);
  if (value === null && records.length < oneOf.length) return {};
  if (by === undefined) return records[0];
  const members = membersOf(value);
  if (members !== value) fail(place, `${shown(value)} is not an object`);
  if (!Object.hasOwn(members, by)) fail(place, `there is no \`${by}\``);
  /** @type {(shape: Shape) => boolean | undefined} */
  const isMeant = ({ properties }) => wordsOf(properties?.[by] ?? {})?.includes(members[by]);
  const found = records.find(isMeant);
  return found ?? fail(`${place}/${by}`, `${shown(members[by])} has no meaning there`);
}

/** @type {(shape: Shape) => Shape} */
const defined = (shape) => (shape.$ref ? PACKAGE.$defs[shape.$ref.split("/")[2]] : shape);

/** @type {(shape: Shape) => unknown[] | undefined} */
const wordsOf = (shape) => ("const" in shape ? [shape.const] : shape.enum);
