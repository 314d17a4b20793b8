// The studio's page.
import type { Piece } from './bend';
import * as api from './api';
import { button, h } from './dom';
import { Layouts } from './layouts';
import { Making } from './make';
import { Panels } from './panels';
import { Store } from './store';
import { Tools } from './tools';
import { View } from './view';
import { language, setLanguage, t } from './words';

const $ = (id: string) => document.getElementById(id)!;
let quiet = 0;

function say(text: string, kind: 'info' | 'error' = 'info'): void {
  const notice = $('notice');
  notice.textContent = text;
  notice.classList.toggle('error', kind === 'error');
  notice.hidden = false;
  clearTimeout(quiet);
  quiet = window.setTimeout(() => { notice.hidden = true; }, kind === 'error' ? 9000 : 5000);
}

const firstSteps = ['Click a shape in the library, or drag it into the view.',
  'Drag a second shape so that it reaches into the first, step through the ways to join them, and join.',
  'Choose Pull, press on a vertex and drag: a limb grows.', 'Open makes room for the lamp holder, the cable and the bulb.',
  'Fabricate makes the kit. Everything is saved as you go; every step can be undone or changed in the history.'];

function help(): void {
  const keys: [string, string][] = [['V  E  O  F', `${t('Select')}, ${t('Pull')}, ${t('Open')}, ${t('Flip')}`], ['S', t('Symmetric')], ['G  R', `${t('Move')}, ${t('Turn')}`],
    ['Shift', `${t('Along the normal')}: ${t('hold Shift while pulling')}`], ['←  →', t('Next and previous way to join')], ['Enter', t('Join')], ['Esc', t('Leave')],
    ['Delete', t('Delete the chosen part')], ['Ctrl+Z', t('Undo')], ['Ctrl+Shift+Z', t('Redo')], ['Home', t('Everything fits the screen')], ['1  2  3', t('Front, side, top')],
    [t('drag, two fingers, arrow keys'), t('Turn the view')], [t('right drag, two fingers'), t('Shift the view')], [t('wheel, pinch, + and -'), t('Zoom')]];
  const dialog = h('dialog', { class: 'small', 'aria-label': t('Help') });
  dialog.append(h('div', {}, h('div', { class: 'head' }, h('strong', {}, t('Help')), h('span', { class: 'grow' }), button(t('Close'), 'remove', () => dialog.close())),
    h('div', { class: 'body' }, h('h2', {}, t('First steps')), h('ol', { class: 'steps' }, ...firstSteps.map(step => h('li', {}, t(step)))),
      h('h2', {}, t('Keyboard')), h('div', { class: 'keys' }, ...keys.flatMap(([key, text]) => [h('kbd', {}, key), h('span', {}, text)])))));
  dialog.addEventListener('close', () => dialog.remove());
  $('dialog').append(dialog);
  dialog.showModal();
}

function keyboard(store: Store, view: View, tools: Tools, panels: Panels): void {
  const turn = (x: number, y: number) => {
    const offset = view.camera.position.clone().sub(view.orbit.target), flat = Math.hypot(offset.x, offset.y);
    const yaw = Math.atan2(offset.y, offset.x) - x, pitch = Math.max(-1.5, Math.min(1.5, Math.atan2(offset.z, flat) + y)), r = offset.length();
    offset.set(r * Math.cos(pitch) * Math.cos(yaw), r * Math.cos(pitch) * Math.sin(yaw), r * Math.sin(pitch));
    view.camera.position.copy(view.orbit.target).add(offset);
    view.orbit.update();
    view.render();
  };
  const zoom = (f: number) => { view.camera.position.sub(view.orbit.target).multiplyScalar(f).add(view.orbit.target); view.orbit.update(); view.render(); };
  const { merging } = tools;
  const sideways = (d: number) => { if (merging.showing) void merging.next(d); else turn(0.12 * d, 0); };
  const keys: Record<string, () => void> = {
    v: () => tools.choose('select'), e: () => tools.choose('pull'), o: () => tools.choose('open'), f: () => tools.choose('flip'), s: () => panels.toggleSymmetric(),
    g: () => { tools.handles.mode = 'translate'; panels.update(); }, r: () => { tools.handles.mode = 'rotate'; panels.update(); },
    home: () => view.fit(), 1: () => view.look([0, -1, 0.05]), 2: () => view.look([1, 0, 0.05]), 3: () => view.look([0, -0.01, 1]), '?': help,
    arrowleft: () => sideways(-1), arrowright: () => sideways(1), arrowup: () => turn(0, 0.1), arrowdown: () => turn(0, -0.1), '+': () => zoom(0.88), '-': () => zoom(1.14),
    delete: () => void tools.deletePart(), backspace: () => void tools.deletePart(), enter: () => { if (merging.showing && !merging.reason) void merging.join(); },
    escape: () => { if (tools.pulling.active) tools.pulling.cancel(); merging.stop(); tools.choose('select'); },
  };
  addEventListener('keydown', e => {
    const target = e.target as HTMLElement;
    if (/^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName) || document.querySelector('dialog[open]') || e.altKey) return;
    const key = e.key.toLowerCase();
    if (e.ctrlKey || e.metaKey) {
      if (key !== 'z' && key !== 'y') return;
      e.preventDefault();
      if (!store.busy) void store.change(key === 'y' || e.shiftKey ? '/api/redo' : '/api/undo');
      return;
    }
    if (target.tagName === 'BUTTON' && (key === 'enter' || key === ' ')) return;
    const action = keys[key];
    if (!action || store.busy) return;
    e.preventDefault();
    action();
  });
}

async function start(): Promise<void> {
  setLanguage(language);
  document.documentElement.dataset.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  const store = new Store(), view = new View($('view') as HTMLCanvasElement);
  $('view').setAttribute('aria-label', t('Turn the view'));
  view.setTheme(document.documentElement.dataset.theme as 'dark' | 'light');
  store.say = say;
  const tools = new Tools(store, view), making = new Making(store);
  const layouts = new Layouts(store, view, () => tools.refresh());
  const panels = new Panels(store, view, tools, layouts, { make: () => void making.open(), help });
  keyboard(store, view, tools, panels);
  let piece = '';
  store.listeners.push(() => {
    const element = JSON.stringify(store.state.element);
    if (element === piece) return;
    piece = element;
    void api.get<Piece>('/api/piece').then(p => view.setPiece(p)).catch(problem => store.explain(problem));
  });
  Object.assign(window, { studio: { store, view, tools, layouts, panels } });
  try {
    await store.start();
    tools.symmetric = store.state.symmetry !== null;
    view.fit();
    await layouts.load();
    await panels.start();
  } catch (problem) {
    store.explain(problem);
  }
}

void start();
