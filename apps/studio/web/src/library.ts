// The library: shapes and own layouts as cards; a card is pressed or carried into the scene.
import * as api from './api';
import { button, fill, h } from './dom';
import type { Layouts } from './layouts';
import type { Store } from './store';
import type { Tools } from './tools';
import { t } from './words';

interface Shape { name: string; summary: string; elements: number; open: boolean; }

const $ = (id: string) => document.getElementById(id)!;

export class Library {
  private shapes: Shape[] = [];
  private pictures = new Map<string, string>();
  private dropped = -1e9; // when a shape was let go

  constructor(private readonly store: Store, private readonly tools: Tools, private readonly layouts: Layouts,
    private readonly changed: () => void) {
    layouts.listeners.push(() => this.show());
  }

  get names(): string[] { return this.shapes.map(s => s.name); }

  async load(): Promise<void> {
    this.shapes = await api.get<Shape[]>('/api/shapes');
    this.show();
  }

  // The pictures, one after the other.
  async draw(): Promise<void> {
    for (const name of this.names) await this.picture(name);
  }

  // Show which card is the brush.
  mark(): void {
    for (const card of $('library').querySelectorAll<HTMLElement>('.shape')) {
      card.setAttribute('aria-pressed', String(card.dataset.shape === this.tools.brush));
    }
  }

  private async picture(name: string): Promise<void> {
    try {
      const address = await api.picture('/api/thumbnail?shape=' + encodeURIComponent(name));
      this.pictures.set(name, address);
      const blank = $('library').querySelector(`[data-shape="${name}"] .blank`);
      blank?.replaceWith(h('img', { src: address, alt: '' }));
    } catch {
      // A shape without a picture still has its name.
    }
  }

  show(): void {
    const card = (name: string, label: string, small: string, title: string, press: (e: MouseEvent) => void, carry: (e: PointerEvent) => void) => {
      const image = this.pictures.get(name);
      return h('button', { type: 'button', class: 'shape', title, 'data-shape': name, 'aria-pressed': String(this.tools.brush === name),
        onclick: ((e: MouseEvent) => { if (performance.now() - this.dropped > 300) press(e); }) as EventListener, onpointerdown: ((e: PointerEvent) => carry(e)) as EventListener },
      image ? h('img', { src: image, alt: '' }) : h('div', { class: 'blank' }), h('span', {}, label), h('small', {}, small));
    };
    const shapes = this.shapes.map(s => card(s.name, s.name, `${s.elements} ${t('elements')}`, s.summary,
      e => this.press(e, s.name), e => this.carry(e, s.name)));
    const own = this.layouts.saved.map((l, k) => card('layout:' + k, l.name, `${l.elements.length} ${t('elements')}`, l.name, () => this.layouts.open(k), e => this.carry(e, l.name, l)));
    const other = h('input', { class: 'other', placeholder: t('Other shape') + ': polar-3x8', 'aria-label': t('Other shape'), spellcheck: 'false',
      onchange: (() => void this.addShape(other.value.trim())) as EventListener });
    fill($('library'), h('h2', {}, t('Library')), h('div', { class: 'shapes', role: 'group', 'aria-label': t('Library') }, ...shapes), other,
      h('h2', {}, t('My layouts'), button(t('New layout'), 'draw', () => this.layouts.open(-1), { class: 'small', 'data-do': 'layout' })),
      h('div', { class: 'shapes' }, ...own));
  }

  // A click chooses the brush. Into an empty scene, from the keyboard and by a double click it places the shape.
  private press(e: MouseEvent, name: string): void {
    const empty = this.store.state.parts.length === 0;
    if (this.tools.tool !== 'pull' && (empty || e.detail === 0 || e.detail === 2) && !this.store.busy) {
      const stage = $('stage').getBoundingClientRect();
      void this.tools.place(name, stage.left + stage.width / 2, stage.top + stage.height / 2);
    } else {
      this.tools.brush = name;
      this.changed();
    }
  }

  // Families take any number they can build: a shape by its name.
  private async addShape(name: string): Promise<void> {
    if (!name || this.shapes.some(s => s.name === name)) return;
    try {
      const g = await api.geometry('/api/try', { revision: this.store.state.revision, alone: true, operation: { op: 'place', shape: name } });
      this.shapes = [{ name, summary: name, elements: g.header.elements, open: false }, ...this.shapes];
      this.tools.brush = name;
      this.show();
      $('library').scrollTop = 0;
      this.changed();
      await this.picture(name);
    } catch (problem) {
      this.store.explain(problem);
    }
  }

  // Carry a shape from the library into the scene.
  private carry(e: PointerEvent, name: string, layout?: { elements: unknown[]; joins: unknown[] }): void {
    if (e.button !== 0) return;
    const card = e.currentTarget as HTMLElement, from = { x: e.clientX, y: e.clientY };
    const image = card.querySelector('img');
    let carried: HTMLElement | null = null;
    card.setPointerCapture(e.pointerId);
    const move = (m: PointerEvent) => {
      if (!carried && Math.hypot(m.clientX - from.x, m.clientY - from.y) > 6) {
        carried = h('img', { class: 'carried', src: image?.src ?? '', alt: '' });
        document.body.append(carried);
      }
      if (carried) {
        carried.style.left = m.clientX + 'px';
        carried.style.top = m.clientY + 'px';
      }
    };
    const end = (m: PointerEvent) => {
      card.removeEventListener('pointermove', move);
      card.removeEventListener('pointerup', end);
      card.removeEventListener('pointercancel', end);
      const on = carried !== null && m.type === 'pointerup' && document.elementFromPoint(m.clientX, m.clientY)?.closest('#stage');
      if (carried) this.dropped = performance.now(); // the click that follows is none
      carried?.remove();
      if (on) void this.tools.place(name, m.clientX, m.clientY, layout && { elements: layout.elements, joins: layout.joins });
    };
    card.addEventListener('pointermove', move);
    card.addEventListener('pointerup', end);
    card.addEventListener('pointercancel', end);
  }
}
