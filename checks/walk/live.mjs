export async function liveCases(home, runAll) { return runAll([]); }
