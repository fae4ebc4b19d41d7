// Numbers as people read them: no more digits than the error leaves, and plain words where nothing is known.

const THIN = '\u202f';
/** More digits than that say nothing about light. */
const MOST_DIGITS = 7;

/** Places after the point with which `error` has so many significant digits; negative for tens, hundreds and so on. */
export function decimalsFor(error: number, digits = 2): number {
  const rounded = Number(Math.abs(error).toPrecision(digits));
  return digits - 1 - Math.floor(Math.log10(rounded));
}

/** Rounded to so many decimals, with thin spaces between thousands from 10,000 on. */
export function rounded(value: number, decimals: number): string {
  const unit = 10 ** Math.max(0, -decimals);
  const text = (Math.round(value / unit) * unit).toFixed(0);
  return grouped(unsigned(decimals > 0 ? value.toFixed(Math.min(decimals, 12)) : text));
}

/** With so many significant digits, and never an exponent. */
export function significant(value: number, digits: number): string {
  if (!Number.isFinite(value)) return 'not known';
  return value === 0 ? '0' : rounded(value, decimalsFor(value, digits));
}

/** A value by itself: three significant digits. */
export function quantity(value: number | null | undefined, unit: string): string {
  return isKnown(value) ? joined(significant(value, 3), unit) : 'not known';
}

/** `512.3 ± 6.2 lx`: the error has two significant digits, the value as many decimals. */
export function withError(value: number | null | undefined, error: number | null | undefined, unit: string): string {
  const parts = valueAndError(value, error);
  if (parts.error === null) return parts.value === null ? 'not known' : `${joined(parts.value, unit)}, error not known`;
  return joined(`${parts.value} ± ${parts.error}`, unit);
}

/** The same in two texts; null: not known. */
export function valueAndError(
  value: number | null | undefined, error: number | null | undefined,
): { value: string | null; error: string | null } {
  if (!isKnown(value)) return { value: null, error: null };
  if (!isKnown(error)) return { value: significant(value, 3), error: null };
  if (error === 0) return { value: significant(value, 4), error: '0' };
  const most = value === 0 ? 6 : decimalsFor(value, MOST_DIGITS);
  const decimals = Math.min(decimalsFor(error), Math.max(most, 0));
  return { value: rounded(value, decimals), error: rounded(Math.abs(error), decimals) };
}

/** `480 to 520`: one digit of half the width, two where it begins with less than 5. */
export function intervalText(low: number, high: number): string {
  const half = (high - low) / 2;
  if (!(half > 0)) return significant(low, 3);
  const leading = Number(half.toExponential(3).slice(0, 5));
  const decimals = decimalsFor(half, leading < 5 ? 2 : 1);
  return `${rounded(low, decimals)} to ${rounded(high, decimals)}`;
}

/** A share as per cent with two significant digits: `0.95 %`. */
export function share(value: number | null | undefined, digits = 2): string {
  return isKnown(value) ? `${significant(100 * value, digits)} %` : 'not known';
}

/** `3.1 M`. */
export function count(value: number): string {
  const units: [number, string][] = [[1e12, ' T'], [1e9, ' G'], [1e6, ' M'], [1e4, ' k']];
  const [scale, unit] = units.find(([least]) => value >= least) ?? [1, ''];
  if (scale === 1) return rounded(value, 0);
  return significant(value / (scale === 1e4 ? 1e3 : scale), 3) + unit;
}

/** `86 MB`. */
export function bytes(value: number): string {
  const units: [number, string][] = [[1e9, 'GB'], [1e6, 'MB'], [1e3, 'kB']];
  const [scale, unit] = units.find(([least]) => value >= least) ?? [1, 'bytes'];
  return scale === 1 ? `${value} ${unit}` : `${significant(value / scale, 3)} ${unit}`;
}

/** A number of a scale: as short as it can be. */
export function tick(value: number): string {
  return grouped(unsigned(String(Number(value.toPrecision(4)))));
}

export function isKnown(value: number | null | undefined): value is number {
  return value !== null && value !== undefined && Number.isFinite(value);
}

function joined(number: string, unit: string): string {
  return unit ? `${number} ${unit}` : number;
}

function grouped(text: string): string {
  if (text.includes('e')) return text;
  const [whole = '', rest] = text.split('.');
  const long = whole.replace('-', '').replace('−', '').length > 4;
  const spaced = long ? whole.replace(/\B(?=(\d{3})+$)/g, THIN) : whole;
  return rest === undefined ? spaced : `${spaced}.${rest}`;
}

/** A real minus sign, and none before zero. */
function unsigned(text: string): string {
  return /^-[0.]*$/.test(text) ? text.slice(1) : text.replace('-', '−');
}
