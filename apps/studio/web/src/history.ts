// The list of operations; each can be changed or removed, and the rest is carried out again.
import { button, h } from './dom';
import type { Operation, Store } from './store';
import { t } from './words';

let open = -1; // the step being changed

type Field = { key: string; label: string; kind: 'point' | 'number' | 'shape' | 'text' | 'flag' };

const fields: Record<string, Field[]> = {
  place: [{ key: 'shape', label: 'Shape', kind: 'shape' }, { key: 'position_mm', label: 'Position (mm)', kind: 'point' },
    { key: 'rotation_deg', label: 'Rotation (degrees)', kind: 'point' }],
  extrude: [{ key: 'brush', label: 'Brush', kind: 'shape' }, { key: 'by_mm', label: 'Pull by (mm)', kind: 'point' },
    { key: 'candidate', label: 'Candidate', kind: 'number' }, { key: 'symmetric', label: 'Symmetric', kind: 'flag' }],
  merge: [{ key: 'candidate', label: 'Candidate', kind: 'number' }],
  open: [{ key: 'purpose', label: 'Purpose', kind: 'text' }, { key: 'symmetric', label: 'Symmetric', kind: 'flag' }],
  flip: [{ key: 'symmetric', label: 'Symmetric', kind: 'flag' }],
  layout: [{ key: 'position_mm', label: 'Position (mm)', kind: 'point' }, { key: 'rotation_deg', label: 'Rotation (degrees)', kind: 'point' }],
};

// An operation in two lines: what was done, and where.
export function describe(op: Operation): [string, string] {
  const round = (p: unknown) => Array.isArray(p) ? `(${(p as number[]).map(x => Math.round(x)).join(', ')}) mm` : '';
  const mirrored = op.symmetric ? `, ${t('Symmetric')}` : '', count = Array.isArray(op.elements) ? op.elements.length : 0;
  switch (op.op) {
    case 'place': return [`${t('Place')} ${String(op.shape)}`, String(op.id)];
    case 'merge': return [`${t('Join')} ${String(op.with)}`, `${t('to')} ${String(op.on)}`];
    case 'extrude': return [`${t('Pull')} ${String(op.brush)}`, `${t('by')} ${round(op.by_mm)}${mirrored}`];
    case 'open': return [`${t('Open')}: ${t(String(op.purpose ?? ''))}`, `${count} ${t(count === 1 ? 'element' : 'elements')}${mirrored}`];
    case 'flip': return [t('Flip'), `${t('element')}${mirrored}`];
    case 'layout': return [t('Layout'), `${count} ${t('elements')}`];
    default: return [op.op, String(op.id ?? '')];
  }
}

function input(field: Field, value: unknown, set: (value: unknown) => void, shapes: string[]): HTMLElement {
  if (field.kind === 'point') {
    const point = Array.isArray(value) ? [...value as number[]] : [0, 0, 0];
    return h('span', { class: 'three' }, ...[0, 1, 2].map(k => h('input', { type: 'number', step: 'any', value: String(Math.round(point[k] * 100) / 100), 'aria-label': `${t(field.label)} ${'xyz'[k]}`,
      onchange: ((e: Event) => { point[k] = Number((e.target as HTMLInputElement).value); set(point); }) as EventListener })));
  }
  if (field.kind === 'shape') {
    const names = shapes.includes(String(value)) ? shapes : [String(value), ...shapes];
    return h('select', { onchange: ((e: Event) => set((e.target as HTMLSelectElement).value)) as EventListener },
      ...names.map(name => h('option', { selected: name === value }, name)));
  }
  if (field.kind === 'flag') {
    return h('input', { type: 'checkbox', checked: value === true, onchange: ((e: Event) => set((e.target as HTMLInputElement).checked)) as EventListener });
  }
  const kind = field.kind === 'number' ? 'number' : 'text';
  return h('input', { type: kind, min: 0, step: 1, value: String(value ?? (kind === 'number' ? 0 : '')),
    onchange: ((e: Event) => { const v = (e.target as HTMLInputElement).value; set(kind === 'number' ? Number(v) : v); }) as EventListener });
}

function form(store: Store, index: number, shapes: string[]): HTMLElement {
  const changed: Operation = structuredClone(store.state.operations[index]);
  const rows = (fields[changed.op] ?? []).map(field => h('label', { class: field.kind === 'flag' ? 'check' : '' },
    ...(field.kind === 'flag' ? [input(field, changed[field.key], v => { changed[field.key] = v; }, shapes), t(field.label)]
      : [t(field.label), input(field, changed[field.key], v => { changed[field.key] = v; }, shapes)])));
  const leave = () => {
    open = -1;
    (document.activeElement as HTMLElement | null)?.blur();
    for (const listener of store.listeners) listener();
  };
  return h('form', { class: 'form', onsubmit: ((e: Event) => {
    e.preventDefault();
    void store.change('/api/edit', { index, operation: changed }).then(ok => { if (ok) leave(); });
  }) as EventListener }, ...rows, h('span', { class: 'ends' },
    h('button', { type: 'button', class: 'quiet small', onclick: leave }, t('Cancel')), h('button', { class: 'main small' }, t('Apply'))));
}

export function historyPanel(store: Store, shapes: string[]): HTMLElement {
  const { operations } = store.state, texts = operations.map(op => describe(op).join(' '));
  if (open >= operations.length) open = -1;
  const rows = operations.flatMap((op, k) => {
    const row = h('li', { class: k === open ? 'on' : '', 'data-step': k },
      h('span', { class: 'number' }, String(k + 1)), h('span', { class: 'what', title: texts[k] }, describe(op)[0], h('small', {}, describe(op)[1])),
      button(`${t('Change this step')}: ${texts[k]}`, 'edit', () => {
        (document.activeElement as HTMLElement | null)?.blur();
        open = open === k ? -1 : k;
        for (const listener of store.listeners) listener();
      }, { class: 'small' }),
      button(`${t('Remove this step')}: ${texts[k]}`, 'remove', () => {
        open = -1;
        (document.activeElement as HTMLElement | null)?.blur();
        void store.change('/api/remove', { index: k });
      }, { class: 'small' }));
    return k === open ? [row, form(store, k, shapes)] : [row];
  });
  return h('ol', { class: 'rows' }, ...rows);
}
