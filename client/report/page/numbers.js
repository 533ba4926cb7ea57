// Numbers for people, round steps and interpolation.

// A number with `digits` significant digits, a true minus sign, powers of ten where they are shorter.
function fmt(value, digits = 4) {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(Math.max(digits - 2, 1)).split("e");
    const raised = (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)];
    const superscript = exponent.replace("+", "").replace(/[-0-9]/g, raised);
    if (value === Number(`1e${exponent}`)) return "10" + superscript;
    return mantissa.replace("-", "−") + "·10" + superscript;
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

const share = (fraction) => (fraction === null || fraction === undefined ? "–" : `${fmt(100 * fraction, 3)} %`);

// Round tick positions that cover [low, high].
function ticks(low, high, count) {
  const raw = (high - low) / Math.max(count, 1);
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const list = [];
  for (let i = Math.floor(low / step + 1e-9); i * step <= high + 0.999 * step; ++i)
    list.push(Number((i * step).toPrecision(12)));
  return list;
}

// Powers of ten that cover [low, high], both positive; every second, third … where there are many.
function powers(low, high) {
  const first = Math.floor(Math.log10(low) + 1e-9),
    last = Math.ceil(Math.log10(high) - 1e-9);
  const step = Math.ceil((last - first + 1) / 7),
    list = [];
  for (let i = first; i <= last + step - 1; i += step) list.push(Math.pow(10, i));
  return list.length > 1 ? list : [list[0], 10 * list[0]];
}

const known = (value) => value !== null && value !== undefined && isFinite(value);

// The value at a percentage of equally spaced values; null where a neighbour is unknown.
function valueAt(values, percent) {
  const place = Math.min(Math.max(percent / 100, 0), 1) * (values.length - 1);
  const index = Math.min(Math.floor(place), values.length - 2),
    part = place - index;
  if (part < 1e-9) return known(values[index]) ? values[index] : null;
  if (!known(values[index]) || !known(values[index + 1])) return null;
  return values[index] * (1 - part) + values[index + 1] * part;
}

// The whole range of the values, and one that a few spikes do not stretch: the middle 99 % with a margin.
function ranges(values) {
  const sorted = values.filter(known).sort((a, b) => a - b);
  if (!sorted.length) return { full: [0, 1], middle: [0, 1], spiky: false };
  const full = [Math.min(0, sorted[0]), Math.max(0, sorted[sorted.length - 1])];
  const at = (part) => sorted[Math.round(part * (sorted.length - 1))];
  const low = Math.min(0, at(0.005)),
    high = Math.max(0, at(0.995)),
    margin = 0.15 * (high - low);
  const middle = [Math.max(low - margin, full[0]), Math.min(high + margin, full[1])];
  return { full, middle, spiky: full[1] - full[0] > 1.5 * (middle[1] - middle[0]) };
}

// Rows as comma separated values; text with a comma or a quote is quoted.
function toCsv(rows) {
  const cell = (value) =>
    value === null || value === undefined || Number.isNaN(value)
      ? ""
      : typeof value === "number"
        ? String(value)
        : /[",\n]/.test(value)
          ? `"${value.replace(/"/g, '""')}"`
          : value;
  return rows.map((row) => row.map(cell).join(",")).join("\n") + "\n";
}

const fileName = (title) =>
  title
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_|_$/g, "");
