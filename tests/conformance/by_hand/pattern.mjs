// Divides triangles and quads into equal steps, as "The pattern of a patch" in docs/reflection.md
// says.

const ONE = 65536;
const THIRD = 21845;

/** The only level of patches whose edges and insides are all divided alike. */
export function levelOf({ levels: { edges, inside } }, values) {
  const [first, ...others] = [...edges, ...inside].map((steps) => steps.reduce((found, step) => {
    const ways = {
      parameter: () => values[step.parameter], constant: () => step.value,
      call: () => Math.max(...step.args.map((arg) => found[arg])),
    };
    return [...found, ways[step.op]()];
  }, []).at(-1));
  if (others.some((other) => other !== first)) throw new Error("not all levels are the same");
  return Math.ceil(first);
}

/** The points on each side of a ring; along a side, one place rises and the other one falls. */
const SIDES = {
  quad: [
    (ring, rises, falls) => [ring, falls], (ring, rises) => [rises, ring],
    (ring, rises) => [ONE - ring, rises], (ring, rises, falls) => [falls, ONE - ring],
  ],
  triangle: [
    (ring, rises, falls) => [ring, falls, ONE - ring - falls],
    (ring, rises) => [rises, ring, ONE - ring - rises],
    (ring, rises, falls) => [falls, ONE - ring - falls, ring],
  ],
};

/** Where the points of a patch in `n` steps lie, and the numbers of those of each triangle. */
export function divided({ kind }, n) {
  const place = (i) => {
    if (2 * i === n) return ONE / 2;
    return 2 * i < n ? i * Math.round(ONE / n) : ONE - place(n - i);
  };
  const points = [], cells = [];
  let outer = [];
  for (let number = 0; 2 * number <= n; number++) {
    const steps = n - 2 * number, start = points.length;
    const sides = steps ? SIDES[kind] : SIDES[kind].slice(0, 1);
    const ring = kind === "quad" ? place(number) : Math.round((2 * THIRD * place(number)) / ONE);
    const off = kind === "quad" ? 0 : Math.ceil(ring / 2);
    for (const side of sides) {
      for (let i = 0; i < Math.max(steps, 1); i++) {
        const along = [place(number + i) - off, place(n - number - i) - off];
        points.push(side(ring, ...along).map((lane) => lane / ONE));
      }
    }
    const inner = SIDES[kind].map((_, side) => Array.from({ length: steps + 1 }, (_, i) =>
      start + ((side * steps + i) % (points.length - start))));
    outer.forEach((row, side) => cells.push(...between(row, inner[side])));
    outer = inner;
  }
  const [first, ...others] = n % 2 ? outer.map((row) => row[0]) : [];
  others.slice(1).forEach((last, i) => cells.push([first, others[i], last]));
  return { points, cells };
}

/** The triangles between two sides, walking along both. */
function between(outer, inner) {
  let i = 0, o = 0;
  const alongOuter = () => [outer[o], outer[++o], inner[i]];
  const alongInner = () => [inner[i], outer[o], inner[++i]];
  const cells = [alongOuter()], steps = inner.length - 1;
  for (let k = 0; k < steps; k++) {
    const isFirstHalf = 2 * k + 1 <= steps;
    cells.push(...(isFirstHalf ? [alongInner(), alongOuter()] : [alongOuter(), alongInner()]));
  }
  return [...cells, alongOuter()];
}
