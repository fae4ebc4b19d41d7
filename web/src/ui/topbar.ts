// The bar at the top: what is shown and how.

import { LUMINAIRE_NAMES, type Action } from './actions';
import { h } from './dom';
import { icon } from './icons';
import { keyText } from './keys';
import { menuButton, type Item, type MenuButton } from './menu';
import { chooseTheme, isDark, onTheme } from './theme';
import { MODE_NAMES, type Ui } from './ui';

export function topBar(ui: Ui, actions: Action[]): HTMLElement {
  const { viewer } = ui;
  const by = (id: string): Action => actions.find((a) => a.id === id)!;
  const switches = ['contours', 'mesh', 'luminaires', 'grids'].map((id) => ({ action: by(id), button: button(by(id)) }));
  const outputs = ['snapshot', 'link', 'full', 'help'].map((id) => button(by(id)));
  const mode = modeMenu(ui, actions);
  const walk = navigation(ui);
  const refresh = (): void => {
    mode.label(MODE_NAMES[viewer.settings.mode]);
    for (const { action, button: b } of switches) b.setAttribute('aria-pressed', String(action.on?.() ?? false));
    const lamps = switches[2]!.button;
    lamps.title = `${LUMINAIRE_NAMES[viewer.settings.luminaires]} (L)`;
    lamps.replaceChildren(icon(viewer.settings.luminaires === 'solids' ? 'solid' : 'lamp'));
    walk.refresh();
  };
  viewer.on('settings', refresh);
  viewer.on('navigation', refresh);
  refresh();
  return h('header', { class: 'top-bar' },
    title(ui), mode.root,
    h('div', { class: 'bar-group wide', role: 'group', 'aria-label': 'Shown with it' }, ...switches.map((s) => s.button)),
    h('div', { class: 'bar-group' }, cameraMenu(ui, by('frame')).root, walk.root),
    h('div', { class: 'bar-space' }),
    h('div', { class: 'bar-group wide' }, ...outputs, themeButton()),
    overflow(switches.map((s) => s.action), [...['snapshot', 'link', 'full', 'help'].map(by)]).root);
}

function title({ viewer, source }: Ui): HTMLElement {
  const { name, file } = viewer.scene;
  return h('div', { class: 'title' },
    h('span', { class: 'mark-dot', 'aria-hidden': 'true' }),
    h('h1', { title: `${name} ${file}` }, name || source.hello.worlds[0]?.name || 'isolux'), file ? h('span', { class: 'file' }, file) : null);
}

function button(action: Action): HTMLButtonElement {
  const made = h('button', {
    type: 'button', class: 'bar-button', 'aria-label': action.label, title: `${action.label} (${keyText(action.key)})`,
    onclick: () => action.run(), 'aria-pressed': action.on && action.id !== 'full' ? String(action.on()) : null,
  });
  if (action.icon) made.append(icon(action.icon));
  return made;
}

function item(action: Action, divided = false): Item {
  const made: Item = { label: action.label, hint: keyText(action.key), divided, act: () => action.run() };
  if (action.on && action.id !== 'full') made.checked = action.on();
  return made;
}

function modeMenu(ui: Ui, actions: Action[]): MenuButton {
  const modes = actions.filter((a) => a.id.startsWith('mode-'));
  return menuButton({
    name: 'Shown', icon: 'eye', text: MODE_NAMES[ui.viewer.settings.mode], arrow: true,
    items: () => modes.map((a, i) => item(a, i === 1 || i === 5)),
  });
}

function cameraMenu({ viewer }: Ui, frame: Action): MenuButton {
  return menuButton({
    name: 'Cameras', icon: 'camera', arrow: true,
    items: () => [item(frame), ...viewer.scene.cameras.map((camera, i) => ({
      label: camera.name || `Camera ${i + 1}`, divided: i === 0, act: () => viewer.goToCamera(i, true),
    }))],
  });
}

/** Orbit or walk, and how to do it. */
function navigation({ viewer, say }: Ui): { root: HTMLElement; refresh(): void } {
  const make = (how: 'orbit' | 'walk', text: string, hint: string): HTMLButtonElement =>
    h('button', { type: 'button', 'aria-label': text, title: `${text}: ${hint} (V changes)`, onclick: () => viewer.setNavigation(how) }, icon(how));
  const touch = matchMedia('(pointer: coarse)').matches;
  const hints = touch
    ? { orbit: 'one finger turns, two move', walk: 'left half moves, right half looks' }
    : { orbit: 'drag turns, right drag moves, wheel goes nearer', walk: 'click the view, then W A S D and the mouse; Esc frees the pointer' };
  const orbit = make('orbit', 'Orbit', hints.orbit);
  const walk = make('walk', 'Walk', hints.walk);
  let last = viewer.navigation;
  const refresh = (): void => {
    orbit.setAttribute('aria-pressed', String(viewer.navigation === 'orbit'));
    walk.setAttribute('aria-pressed', String(viewer.navigation === 'walk'));
    if (viewer.navigation !== last) say(`${viewer.navigation === 'walk' ? 'Walk' : 'Orbit'}: ${hints[viewer.navigation]}.`);
    last = viewer.navigation;
  };
  return { root: h('div', { class: 'segments', role: 'group', 'aria-label': 'Moving' }, orbit, walk), refresh };
}

function themeButton(): HTMLButtonElement {
  const made = h('button', { type: 'button', class: 'bar-button', onclick: () => chooseTheme(isDark() ? 'light' : 'dark') }, icon('theme'));
  const refresh = (): void => {
    const text = isDark() ? 'Light colours' : 'Dark colours';
    made.setAttribute('aria-label', text);
    made.title = text;
  };
  onTheme(refresh);
  refresh();
  return made;
}

/** All that has no room in the bar of a phone. */
function overflow(switches: Action[], outputs: Action[]): MenuButton {
  const made = menuButton({
    name: 'More', icon: 'more', end: true,
    items: () => [...switches.map((a) => item(a)), ...outputs.map((a, i) => item(a, i === 0)),
      { label: isDark() ? 'Light colours' : 'Dark colours', act: () => chooseTheme(isDark() ? 'light' : 'dark') }],
  });
  made.root.classList.add('narrow');
  return made;
}
