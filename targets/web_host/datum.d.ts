// The type of values while they are computed. JSDoc has no types that contain themselves.

/** Lanes of a number or a vector, columns, elements, or members by name. */
export type Datum = number[] | Datum[] | { [member: string]: Datum };
