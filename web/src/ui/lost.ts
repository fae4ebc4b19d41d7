// Said while the graphics card is lost: browsers take it away when it fails, or is needed elsewhere, and mostly give it back.

import type { Viewer } from '../contract';
import { h } from './dom';

export function lostNote(viewer: Viewer): HTMLElement {
  const again = h('button', { type: 'button', class: 'primary', onclick: () => location.reload() }, 'Load the page again');
  const note = h('div', { class: 'lost card', role: 'alert', hidden: true },
    h('p', {}, h('b', {}, 'The graphics card has been lost.')),
    h('p', {}, 'The picture comes back by itself if the browser gets it again. If it does not, load the page again: view and pins are kept in its address.'), again);
  viewer.on('graphics', () => {
    note.hidden = !viewer.isLost();
  });
  return note;
}
