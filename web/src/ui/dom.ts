// Small makers of elements.

export type Child = Node | string | null | undefined | false;
export type Attributes = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

/** An element with attributes, listeners (`onclick` and so on) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, String(value));
  }
  made.append(...children.filter((c): c is Node | string => c !== null && c !== undefined && c !== false));
  return made;
}

/** Sets text only where it is another: less work for the browser and for those who listen to it. */
export function setText(of: HTMLElement, text: string): void {
  if (of.textContent !== text) of.textContent = text;
}

export function replace(parent: Element, ...children: Child[]): void {
  parent.replaceChildren(...children.filter((c): c is Node | string => c !== null && c !== undefined && c !== false));
}

/** At most one call in a frame, with the newest arguments. */
export function perFrame<A extends unknown[]>(call: (...args: A) => void): (...args: A) => void {
  let waiting: A | null = null;
  return (...args) => {
    if (!waiting) {
      requestAnimationFrame(() => {
        const newest = waiting!;
        waiting = null;
        call(...newest);
      });
    }
    waiting = args;
  };
}

/** At most one call in so many milliseconds, the last one always made. */
export function throttled(call: () => void, every_ms: number): () => void {
  let timer: number | undefined;
  return () => {
    timer ??= window.setTimeout(() => {
      timer = undefined;
      call();
    }, every_ms);
  };
}

/** A labelled drop-down list. */
export function select(
  label: string, options: [value: string, text: string][], chosen: string, on: (value: string) => void,
): HTMLSelectElement {
  const list = h('select', { 'aria-label': label, onchange: () => on(list.value) },
    ...options.map(([value, text]) => h('option', { value, selected: value === chosen }, text)));
  return list;
}

/** A switch: a check box that looks like one. */
export function toggle(label: string, on: boolean, change: (on: boolean) => void): { row: HTMLElement; input: HTMLInputElement } {
  const input = h('input', { type: 'checkbox', role: 'switch', checked: on, onchange: () => change(input.checked) });
  return { row: h('label', { class: 'toggle' }, input, h('span', { class: 'track' }), h('span', {}, label)), input };
}

/** A row of buttons of which one is pressed. */
export function segments<T extends string>(
  label: string, options: readonly (readonly [T, string])[], chosen: T, on: (value: T) => void,
): { row: HTMLElement; show(value: T): void } {
  const buttons = options.map(([value, text]) =>
    h('button', { type: 'button', 'aria-pressed': String(value === chosen), onclick: () => on(value) }, text));
  const show = (value: T): void =>
    buttons.forEach((b, i) => b.setAttribute('aria-pressed', String(options[i]![0] === value)));
  return { row: h('div', { class: 'segments', role: 'group', 'aria-label': label }, ...buttons), show };
}

/** Whether somebody is writing: keys are theirs then. */
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !['checkbox', 'range', 'button', 'radio'].includes(target.type);
  return target.isContentEditable || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}
