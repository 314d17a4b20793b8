// The one element that everything is built from: its measures, and how to change them.
import * as api from './api';
import { button, h } from './dom';
import type { Store } from './store';
import { number, t } from './words';

type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
type Measures = { la_mm: number; lb_mm: number; alpha_deg: number; thickness_mm: number };

const rows: [keyof Measures, string][] = [['la_mm', 'Short side (mm)'], ['lb_mm', 'Long side (mm)'], ['alpha_deg', 'Acute angle (degrees)'], ['thickness_mm', 'Thickness (mm)']];

// Every length of a design times a factor.
function scaled(value: Json, factor: number, length = false): Json {
  if (typeof value === 'number') return length ? Math.round(value * factor * 1e6) / 1e6 : value;
  if (Array.isArray(value)) return value.map(v => scaled(v, factor, length));
  if (value === null || typeof value !== 'object') return value;
  return Object.fromEntries(Object.entries(value).map(([key, v]) => [key, scaled(v, factor, length || key.endsWith('_mm'))]));
}

export function pieceRow(store: Store, done: () => void): HTMLElement {
  const { la_mm, lb_mm, alpha_deg, thickness_mm } = store.state.element;
  return h('ul', { class: 'rows' }, h('li', { class: 'still' },
    h('span', { class: 'what' }, `${number(la_mm, 1)} × ${number(lb_mm, 1)} mm`, h('small', {}, `${number(alpha_deg, 1)}°, ${number(thickness_mm, 2)} mm ${t('thick')}`)),
    button(t('Change the element'), 'edit', () => changePiece(store, done), { class: 'small', 'data-do': 'piece' })));
}

function changePiece(store: Store, done: () => void): void {
  const wish: Measures = { ...store.state.element };
  const grow = h('input', { type: 'checkbox', checked: true });
  const dialog = h('dialog', { class: 'small', 'aria-label': t('Change the element') });
  const apply = async () => {
    dialog.close();
    try {
      const design = JSON.parse(await api.text('/api/design')) as { [key: string]: Json };
      const factor = grow.checked ? wish.la_mm / store.state.element.la_mm : 1;
      const { operations, symmetry = null, ...rest } = design;
      const next = { ...rest, ...(symmetry && { symmetry: scaled(symmetry, factor) }), element: wish, operations: scaled(operations, factor) };
      if (await store.change('/api/replace', { design: next })) done();
    } catch (problem) {
      store.explain(problem);
    }
  };
  const fields = rows.map(([key, label]) => h('label', {}, t(label), h('input', { type: 'number', step: 'any', min: 0, required: true, name: key, value: String(Math.round(wish[key] * 1000) / 1000),
    onchange: ((e: Event) => { wish[key] = Number((e.target as HTMLInputElement).value); }) as EventListener })));
  dialog.append(h('div', {}, h('div', { class: 'head' }, h('strong', {}, t('Change the element')), h('span', { class: 'grow' }), button(t('Close'), 'remove', () => dialog.close())),
    h('div', { class: 'body' }, h('form', { class: 'form', onsubmit: ((e: Event) => { e.preventDefault(); void apply(); }) as EventListener }, ...fields,
      h('label', { class: 'check' }, grow, t('The whole design grows or shrinks with the short side')),
      h('span', { class: 'ends' }, h('button', { type: 'button', class: 'quiet', onclick: () => dialog.close() }, t('Cancel')), h('button', { class: 'main', 'data-do': 'apply-piece' }, t('Apply')))))));
  dialog.addEventListener('close', () => dialog.remove());
  document.getElementById('dialog')!.append(dialog);
  dialog.showModal();
}
