// The page: opens the source, the view, and what people press.

import './style.css';
import { openSource } from './core/source';
import { createViewer } from './core/viewer';
import { startUi } from './ui/app';
import { showFailure, showLoading } from './ui/loading';

async function start(): Promise<void> {
  const need = (id: string): HTMLElement => document.getElementById(id)!;
  showLoading('Reading the map …');
  const source = await openSource();
  const viewer = await createViewer(need('view') as HTMLCanvasElement, need('overlay'), source);
  Object.assign(window, { isoluxViewer: viewer, isoluxSource: source });
  document.title = `${viewer.scene.name} – isolux`;
  if (source.hello.live) showLoading('Waiting for the first light …');
  startUi(need('ui'), viewer, source);
}

start().catch((error: unknown) => showFailure(error instanceof Error ? error.message : String(error)));
