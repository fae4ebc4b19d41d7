// The run under way: how far it is, how long it will take, and what can be done about it.

import type { ErrorHistory, LiveState } from '../wire';
import { words } from './actions';
import { h, setText } from './dom';
import { count, share } from './format';
import { icon } from './icons';
import { liveChart } from './live-chart';
import { auditText, done, errorText, isOver, lossText, parseTarget, phaseText, seconds, timeLeft } from './predict';
import type { Ui } from './ui';

export interface Live {
  root: HTMLElement;
  /** A line over the view, while the panel is closed. */
  chip: HTMLElement;
}

export function live(ui: Ui): Live {
  const head = headline();
  const chart = liveChart();
  const facts = h('dl', { class: 'facts' });
  const audit = h('p', { class: 'audit', hidden: true });
  const end = h('p', { class: 'saved', hidden: true });
  const lost = h('p', { class: 'problem', role: 'status', hidden: true }, 'Connection lost, trying again.');
  const buttons = controls(ui);
  const chip = chipOf(ui);
  const root = h('div', {}, lost, head.root, end, audit, buttons.root, h('section', { class: 'block' }, h('h3', {}, 'Error against time'), chart.root),
    h('section', { class: 'block' }, h('h3', {}, 'Run'), facts));
  const show = (state: LiveState): void => {
    head.show(state);
    chart.state(state);
    facts.replaceChildren(...rows(state));
    audit.hidden = state.audit === null;
    if (state.audit) {
      setText(audit, `Audit: ${auditText(state.audit)}.`);
      audit.classList.toggle('bad', state.audit.contradicts);
    }
    end.hidden = !state.saved && !state.message;
    setText(end, [state.message, state.saved ? `Saved as ${state.saved}` : null].filter(Boolean).join('. '));
    end.classList.toggle('bad', state.phase === 'failed');
    buttons.show(state);
    chip.show(state);
  };
  ui.source.follow({
    state: (state) => {
      show(state);
      ui.viewer.refresh(state);
    },
    history: (past: ErrorHistory) => chart.history(past),
    connected: (is) => {
      lost.hidden = is;
      chip.connected(is);
    },
  });
  return { root, chip: chip.root };
}

/** The error, large, with a bar and the time left. */
function headline(): { root: HTMLElement; show(state: LiveState): void } {
  const phase = h('p', { class: 'phase', role: 'status' }, 'Connecting');
  const [now, of] = [h('b', {}, '…'), h('span', {})];
  const bar = h('div', { class: 'progress', role: 'progressbar', 'aria-label': 'Share of the time predicted', 'aria-valuemin': 0, 'aria-valuemax': 100 }, h('i'));
  const left = h('p', { class: 'row spread time' });
  const [remaining, elapsed] = [h('span'), h('span', { class: 'faint' })];
  left.append(remaining, elapsed);
  const show = (state: LiveState): void => {
    const error = errorText(state);
    setText(phase, phaseText(state));
    setText(now, error.now);
    setText(of, error.of);
    now.classList.toggle('unknown', state.error === null);
    const share = done(state);
    bar.style.setProperty('--done', `${100 * share}%`);
    bar.setAttribute('aria-valuenow', String(Math.round(100 * share)));
    bar.className = `progress ${state.phase}${state.paused ? ' paused' : ''}${share === 0 ? ' waiting' : ''}`;
    setText(remaining, state.paused ? 'paused' : timeLeft(state));
    setText(elapsed, `${seconds(state.elapsed_s)} so far`);
  };
  return { root: h('section', { class: 'headline' }, phase, h('p', { class: 'error-now' }, h('span', { class: 'symbol' }, 'error'), now, of), bar, left), show };
}

function rows(s: LiveState): HTMLElement[] {
  const list: [string, string][] = [
    ['Method', s.method], ['Rays', `${count(s.rays)}, ${count(s.rays_per_s)} a second`], ['Receivers', count(s.receivers)], ['Increments', count(s.increments)],
    ['Statistical error', share(s.error_statistical)], ['Error of elements', share(s.error_elements)],
  ];
  if (s.filtered_share !== null) list.push(['Filtered off', `${share(s.filtered_share)} of the detail`]);
  if (s.unshot !== null) list.push(['Unshot light', share(s.unshot)]);
  return list.flatMap(([name, text]) => [h('dt', {}, name), h('dd', {}, text)]);
}

function controls(ui: Ui): { root: HTMLElement; show(state: LiveState): void } {
  const send = async (what: Parameters<Ui['source']['control']>[0]): Promise<void> => {
    try {
      await ui.source.control(what);
    } catch (error) {
      ui.say(`The run did not take that: ${words(error)}`, 'bad');
    }
  };
  let paused = false;
  const pause = h('button', { type: 'button', onclick: () => void send({ action: paused ? 'resume' : 'pause' }) });
  const stop = h('button', { type: 'button', onclick: () => ask(true) }, icon('stop'), 'Stop and save');
  const sure = h('div', { class: 'sure', hidden: true, role: 'group', 'aria-label': 'Stop the run?' },
    h('p', {}, 'Stop here? The map so far is saved, with the error it has.'),
    h('div', { class: 'row' }, h('button', { type: 'button', class: 'primary', onclick: () => {
      ask(false);
      void send({ action: 'stop' });
    } }, 'Stop and save'), h('button', { type: 'button', onclick: () => ask(false) }, 'Go on')));
  const ask = (is: boolean): void => {
    sure.hidden = !is;
    stop.disabled = is;
    (is ? sure.querySelector('button') : stop)?.focus();
  };
  const target = targetForm((accuracy) => void send({ action: 'target', accuracy }), () => last);
  const root = h('section', { class: 'block' }, h('div', { class: 'row' }, pause, stop), sure, target.root);
  let last: LiveState | null = null;
  const show = (state: LiveState): void => {
    last = state;
    root.hidden = isOver(state.phase);
    if (pause.childElementCount === 0 || paused !== state.paused) {
      paused = state.paused;
      pause.replaceChildren(icon(paused ? 'play' : 'pause'), paused ? 'Go on' : 'Pause');
    }
    target.show(state);
  };
  return { root, show };
}

/** Another accuracy to reach; what is lost by it is said before. */
function targetForm(send: (accuracy: number) => void, now: () => LiveState | null): { root: HTMLElement; show(state: LiveState): void } {
  const input = h('input', { type: 'text', inputmode: 'decimal', class: 'percent', placeholder: '1%', 'aria-label': 'Error to reach', 'aria-describedby': 'target-problem' });
  const problem = h('p', { class: 'problem', id: 'target-problem', role: 'alert', hidden: true });
  const tell = (text: string): void => {
    setText(problem, text);
    problem.hidden = text === '';
    input.setAttribute('aria-invalid', String(text !== ''));
  };
  let wanted: number | null = null;
  const set = h('button', { type: 'submit' }, 'Set target');
  const lost = h('p', {});
  const anew = h('button', { type: 'button', class: 'primary', onclick: () => {
    const accuracy = wanted;
    ask(null);
    input.value = '';
    if (accuracy !== null) send(accuracy);
  } }, 'Begin anew');
  const keep = h('button', { type: 'button', onclick: () => {
    ask(null);
    set.focus();
  } }, 'Keep this run');
  const sure = h('div', { class: 'sure', hidden: true, role: 'group', 'aria-label': 'Begin the run anew?' },
    lost, h('div', { class: 'row' }, anew, keep));
  const ask = (accuracy: number | null): void => {
    wanted = accuracy;
    sure.hidden = accuracy === null;
    const state = now();
    if (accuracy === null || !state) return;
    setText(lost, lossText(state, accuracy));
    // A second Enter loses nothing.
    keep.focus();
  };
  const root = h('form', { class: 'target', onsubmit: (event) => {
    event.preventDefault();
    const parsed = parseTarget(input.value);
    tell('problem' in parsed ? parsed.problem : '');
    if ('accuracy' in parsed) ask(parsed.accuracy);
  } }, h('label', { class: 'row' }, h('span', {}, 'Anew for'), input, set), problem, sure);
  input.addEventListener('input', () => {
    tell('');
    ask(null);
  });
  return { root, show: (state) => {
    input.placeholder = state.target === null ? '1%' : share(state.target).replace(/\.0 |\s/g, '');
    if (wanted !== null) setText(lost, lossText(state, wanted));
  } };
}

function chipOf(ui: Ui): { root: HTMLElement; show(state: LiveState): void; connected(is: boolean): void } {
  const text = h('span', {}, 'Connecting');
  const range = h('span', { class: 'faint range' });
  const root = h('button', { type: 'button', class: 'live-chip card', title: 'Open the run', onclick: () => ui.panel.open('run') }, h('i', { class: 'live-dot' }), text, range);
  let last = '';
  const write = (connected: boolean): void => {
    root.classList.toggle('lost', !connected);
    setText(text, connected ? last || 'connected' : 'connection lost, trying again');
  };
  return { root, connected: write, show: (state) => {
    const error = errorText(state);
    const resting = isOver(state.phase) || state.paused;
    const [end = '', between = ''] = resting ? [phaseText(state).toLowerCase()] : timeLeft(state).split(', ');
    last = `error ${error.now} ${error.of}${end ? ` · ${end}` : ''}`;
    setText(range, between);
    root.classList.toggle('over', resting);
    write(true);
  } };
}
