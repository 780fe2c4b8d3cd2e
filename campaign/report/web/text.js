// Numbers and durations as the program's own tables write them.

const noValue = "–";

function numberText(value, digits = 6) {
  if (value === null || value === undefined) return noValue;
  if (typeof value !== "number") return String(value);
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7) return Number(value.toPrecision(Math.min(digits, 4))).toExponential();
  return String(Number(value.toPrecision(digits)));
}

// Digits in groups of three.
function countText(count) {
  if (count === null || count === undefined) return noValue;
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

function percentText(fraction) {
  return (100 * fraction).toFixed(1) + " %";
}

// Two units at most, as in `campaign status`.
function durationText(seconds) {
  if (seconds === null || seconds === undefined) return noValue;
  if (seconds < 60) return (seconds < 1 ? seconds.toFixed(2) : seconds.toFixed(1)) + " s";
  const whole = Math.round(seconds);
  const two = (number) => String(number).padStart(2, "0");
  const s = whole % 60, m = Math.floor(whole / 60) % 60, h = Math.floor(whole / 3600);
  if (h === 0) return `${m}m ${two(s)}s`;
  if (h < 24) return `${h}h ${two(m)}m`;
  return `${Math.floor(h / 24)}d ${h % 24}h`;
}

function bytesText(bytes) {
  let unit = 0;
  for (; bytes >= 1000 && unit < 4; ++unit) bytes /= 1000;
  return `${Number(bytes.toPrecision(3))} ${["B", "kB", "MB", "GB", "TB"][unit]}`;
}

// A value with the digits that its error leaves it: 57.49 ± 1.14.
function valueWithError(value, error) {
  if (value === null || value === undefined) return noValue;
  if (!(error > 0)) return numberText(value, 5);
  const digits = Math.max(0, 1 - Math.floor(Math.log10(error)));
  if (digits > 12) return numberText(value);
  return `${value.toFixed(digits)} ± ${error.toFixed(digits)}`;
}

// Half the 68 % interval of a mean over so many realizations, by Student's t, over its standard
// error; Infinity for one.
function studentFactor(realizations) {
  const table = [Infinity, 1.837, 1.321, 1.197, 1.142, 1.111, 1.091, 1.077, 1.067, 1.059];
  const freedom = realizations - 1;
  return freedom < table.length ? table[Math.max(0, freedom)] : 1 + 0.53 / freedom;
}

function timeText(seconds) {
  const text = new Date(1000 * seconds).toISOString();
  return text.slice(0, 10) + " " + text.slice(11, 19) + " UTC";
}

// Rows as CSV (RFC 4180); the first row has the names.
function csvText(rows) {
  const field = (value) => {
    if (value === null || value === undefined) return "";
    if (value instanceof Uint8Array)
      return Array.from(value, (byte) => byte.toString(16).padStart(2, "0")).join("");
    const text = String(value);
    return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return rows.map((row) => row.map(field).join(",") + "\n").join("");
}
