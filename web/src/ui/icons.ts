// Icons as inline SVG: strokes on a grid of 24.

const SHAPES = {
  contours: '<path d="M3 14c2-6 6-9 9-9s8 3 9 8c.6 4-4 6-9 6s-10-1-9-5Z"/><path d="M7.5 13.5c1-3 3-5 5-5s4 2 4.5 4.5-2 3.5-4.5 3.5-5.5-.7-5-3Z"/>',
  mesh: '<path d="M4 5h16v14H4Z"/><path d="M4 5l8 14 8-14M4 19l8-14 8 14M4 12h16"/>',
  lamp: '<path d="M12 3v3"/><path d="M5 13a7 7 0 0 1 14 0Z"/><path d="M9.5 13a2.5 2.5 0 0 0 5 0"/><path d="M12 19v2M6.5 17.5L5 19M17.5 17.5L19 19"/>',
  solid: '<path d="M12 4v3"/><path d="M12 7c6 0 8 4 6.5 8S14 21 12 21s-5-2-6.5-6S6 7 12 7Z"/><path d="M12 7c-3 4-3 10 0 14M12 7c3 4 3 10 0 14"/>',
  grid: '<path d="M5 5h.01M12 5h.01M19 5h.01M5 12h.01M12 12h.01M19 12h.01M5 19h.01M12 19h.01M19 19h.01" stroke-width="3"/>',
  camera: '<path d="M3 8h11v9H3Z"/><path d="M14 11l7-3v9l-7-3Z"/>',
  orbit: '<circle cx="12" cy="12" r="3"/><path d="M20 9c2 4-2 8-8 8-5 0-9-2.2-9-5s4-5 9-5c2.4 0 4.6.5 6.2 1.3"/><path d="M19 4.5l-.6 4-4-.7"/>',
  walk: '<circle cx="13" cy="4.5" r="1.8"/><path d="M12.5 8.5l-1.5 6 3.5 2.5.5 4.5M11 14.5L8 21M12.5 8.5L8.5 10.5 7.5 13.5M12.5 8.5l3.5 3h3"/>',
  download: '<path d="M12 4v11M7 11l5 5 5-5M5 20h14"/>',
  picture: '<path d="M4 7h4l1.5-2h5L16 7h4v12H4Z"/><circle cx="12" cy="13" r="3.5"/>',
  link: '<path d="M10 14a4 4 0 0 0 6 .4l3-3a4 4 0 0 0-5.7-5.7L12 7"/><path d="M14 10a4 4 0 0 0-6-.4l-3 3a4 4 0 0 0 5.7 5.7L12 17"/>',
  help: '<circle cx="12" cy="12" r="9"/><path d="M9.5 9.5a2.5 2.5 0 1 1 3.5 2.3c-.7.4-1 .9-1 1.7M12 17h.01"/>',
  full: '<path d="M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"/>',
  theme: '<circle cx="12" cy="12" r="8.5"/><path d="M12 3.5a8.5 8.5 0 0 1 0 17Z" fill="currentColor"/>',
  close: '<path d="M6 6l12 12M18 6L6 18"/>',
  pin: '<path d="M12 21c-4-5-6-8-6-11a6 6 0 0 1 12 0c0 3-2 6-6 11Z"/><circle cx="12" cy="10" r="2.2"/>',
  ruler: '<path d="M3 16L16 3l5 5L8 21Z"/><path d="M7 12l2 2M10 9l2 2M13 6l2 2"/>',
  light: '<circle cx="12" cy="12" r="4"/><path d="M12 2.5v3M12 18.5v3M2.5 12h3M18.5 12h3M5.3 5.3l2.1 2.1M16.6 16.6l2.1 2.1M18.7 5.3l-2.1 2.1M7.4 16.6l-2.1 2.1"/>',
  map: '<circle cx="12" cy="12" r="9"/><path d="M12 11v5.5M12 7.5h.01"/>',
  run: '<path d="M4 19V5M4 19h16"/><path d="M7 8c2 6 6 8 12 8.5"/>',
  pause: '<path d="M8.5 5v14M15.5 5v14" stroke-width="2.5"/>',
  play: '<path d="M7 4.5l12 7.5-12 7.5Z"/>',
  stop: '<path d="M6 6h12v12H6Z"/>',
  copy: '<path d="M9 9h11v11H9Z"/><path d="M5 15H4V4h11v1"/>',
  more: '<path d="M5 12h.01M12 12h.01M19 12h.01" stroke-width="3"/>',
  down: '<path d="M7 10l5 5 5-5"/>',
  frame: '<path d="M4 11l8-7 8 7v9H4Z"/><path d="M10 20v-6h4v6"/>',
  gear: '<path d="M4 7h10M18 7h2M4 17h2M10 17h10"/><circle cx="16" cy="7" r="2"/><circle cx="8" cy="17" r="2"/>',
  compare: '<path d="M12 3v18"/><path d="M4 6h8v12H4Z" fill="currentColor" fill-opacity=".3"/><path d="M12 6h8v12h-8"/>',
  check: '<path d="M5 12.5l4.5 4.5L19 7.5"/>',
  eye: '<path d="M2.5 12C5 7.5 8.5 5.5 12 5.5s7 2 9.5 6.5c-2.5 4.5-6 6.5-9.5 6.5S5 16.5 2.5 12Z"/><circle cx="12" cy="12" r="2.8"/>',
} as const;

export type IconName = keyof typeof SHAPES;

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const set = { viewBox: '0 0 24 24', fill: 'none', stroke: 'currentColor', 'stroke-width': '1.7', 'stroke-linecap': 'round',
    'stroke-linejoin': 'round', 'aria-hidden': 'true', class: 'icon' };
  for (const [key, value] of Object.entries(set)) svg.setAttribute(key, value);
  svg.innerHTML = SHAPES[name];
  return svg;
}
