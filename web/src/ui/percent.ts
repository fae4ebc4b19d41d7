// What somebody writes into the box of a dimmer.

/** The greatest factor of a dimmer. */
export const MOST = 1.5;

/** The factor that was written, or what is wrong with it: `75`, `75 %`, `0,5 %`, `off`. */
export function parsePercent(text: string): { factor: number } | { problem: string } {
  const clean = text.trim().toLowerCase();
  if (clean === 'off') return { factor: 0 };
  const match = /^(-?(?:\d+(?:[.,]\d*)?|[.,]\d+))\s*%?$/.exec(clean.replace('−', '-'));
  if (!match) return { problem: clean === '' ? 'Write a percentage.' : `"${text.trim().slice(0, 20)}" is not a percentage.` };
  const factor = Number(match[1]!.replace(',', '.')) / 100;
  return factor >= 0 && factor <= MOST ? { factor } : { problem: `Write 0 to ${100 * MOST} %.` };
}

/** As the box shows it. */
export const percentText = (factor: number): string => (factor === 0 ? 'off' : `${Math.round(factor * 100)} %`);
