// Named cases, a line each.

/** Runs cases one after another, all of them; the count of those that fail. */
export async function runAll(cases) {
  let failed = 0;
  for (const [name, test] of cases) {
    const started = Date.now();
    const { ok, told } = await test().then((told) => ({ ok: true, told }), (error) => ({ ok: false, told: firstLine(error) }));
    failed += ok ? 0 : 1;
    console.log(`${ok ? 'ok   ' : 'FAILS'} ${name}: ${told} [${((Date.now() - started) / 1000).toFixed(1)} s]`);
  }
  return failed;
}

const firstLine = (error) => String(error?.message ?? error).trim().split('\n')[0];

export function require(holds, message) {
  if (!holds) throw new Error(message);
}

/** A figure with its limit, which it must not exceed. */
export function atMost(what, value, limit) {
  const text = `${what} ${value.toFixed(3)}`;
  require(value <= limit, `${text}, more than ${limit}`);
  return `${text} (at most ${limit})`;
}
