// Numbers as text.

/** The shortest decimal number that is this float32 and no other; NaN and infinities by name. */
export function float32(value) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "+Inf" : "-Inf";
  if (Object.is(value, -0)) return "-0";
  for (let digits = 1; digits < 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}

/** A measured figure with few digits; a dash when there is none. */
export function figure(value, digits = 3) {
  if (value === undefined || value === null || value === "") return "–";
  if (typeof value !== "number") return String(value);
  if (!Number.isFinite(value)) return float32(value);
  if (Number.isInteger(value)) return count(value);
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e6 ? value.toExponential(digits - 1).replace(/\.?0+e/, "e") : String(Number(value.toPrecision(digits + 1)));
}

export function count(value) {
  return typeof value === "number" ? value.toLocaleString("en-US") : "–";
}

export function seconds(value) {
  const sum = typeof value === "object" && value !== null ? Object.values(value).reduce((a, b) => a + b, 0) : value;
  return typeof sum === "number" ? `${sum < 10 ? sum.toFixed(2) : sum.toFixed(0)} s` : "–";
}

export function words(key) {
  return key.replaceAll("_", " ");
}
