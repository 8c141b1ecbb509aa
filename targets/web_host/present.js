// Values that are there although their types say that they may be missing.

/**
 * The same value. It is called where a value cannot be missing, because of what was checked before
 * or of what documents promise; if one is missing all the same, the error ends here.
 * @template Value
 * @param {Value} value
 * @returns {NonNullable<Value>}
 */
export function present(value) {
  if (value === null || value === undefined) throw new Error("the host lacks a value it needs");
  return value;
}
