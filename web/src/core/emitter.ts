// Calls those who want to know.

export class Emitter<Name extends string> {
  readonly #calls = new Map<Name, (() => void)[]>();

  on(name: Name, call: () => void): void {
    this.#calls.set(name, [...(this.#calls.get(name) ?? []), call]);
  }

  tell(name: Name): void {
    this.#calls.get(name)?.forEach((call) => call());
  }
}
