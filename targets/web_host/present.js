// Values that are there although their types say that they may be missing.

/**
 * Returns its argument. Called where a value cannot be missing, because it was checked before or
 * because documents promise it; a value that is missing all the same is an error.
 * @template Value
 * @param {Value} value
 * @returns {NonNullable<Value>}
 */
export function present(value) {
  if (value === null || value === undefined) throw new Error("the host lacks a value it needs");
  return value;
}
