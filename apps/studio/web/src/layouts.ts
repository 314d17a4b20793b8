// The layout editor: elements drawn in the plane, joined side to side, seen in 3D at once (paper, Sec. 4.4).
import * as api from './api';
import { button, fill, h } from './dom';
import { reason } from './reasons';
import type { Store } from './store';
import type { View } from './view';
import { t } from './words';

export interface Drawn { x_mm: number; y_mm: number; rotation_deg: number; facing: 'front' | 'back'; }
export interface Join { element: number; side: number; to: number; to_side: number; }
export interface Saved { name: string; elements: Drawn[]; joins: Join[]; }

type Point = [number, number];

const rest = 150; // ms without a change before the 3D preview is asked for

const svg = (tag: string, attributes: Record<string, string | number>) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
};

export class Layouts {
  saved: Saved[] = [];
  listeners: (() => void)[] = [];
  private elements: Drawn[] = [];
  private joins: Join[] = [];
  private chosen = -1;
  private index = -1; // of the saved layout being edited
  private drawing: { from: { element: number; side: number }; at: Point } | null = null;
  private dragging: { element: number; turn: boolean; from: Point; start: Drawn } | null = null;
  private picture!: SVGSVGElement;
  private timer = 0;
  private asked = 0;
  private said = '';
  private bad = false;
  private works = false;
  private back: (() => void) | null = null; // to where the camera stood before
  private readonly panel = document.getElementById('layout')!;

  constructor(private readonly store: Store, private readonly view: View, private readonly done: () => void) {
    addEventListener('resize', () => { if (this.active) this.makeRoom(); });
  }

  get active(): boolean {
    return !this.panel.hidden;
  }

  async load(): Promise<void> {
    this.saved = (await api.get<{ layouts: Saved[] }>('/api/layouts')).layouts;
    for (const listener of this.listeners) listener();
  }

  open(index: number): void {
    const layout = this.saved[index];
    this.index = layout ? index : -1;
    this.elements = structuredClone(layout?.elements ?? []);
    this.joins = structuredClone(layout?.joins ?? []);
    this.chosen = -1;
    this.panel.hidden = false;
    document.getElementById('hint')!.hidden = true;
    if (!this.back) this.back = this.view.remember();
    this.build();
    this.makeRoom();
    if (this.elements.length === 0) this.add();
    this.changed();
  }

  close(): void {
    this.panel.hidden = true;
    document.getElementById('hint')!.hidden = false;
    this.view.cover(0, 0);
    ++this.asked;
    this.view.show(this.store.geometry);
    this.back?.();
    this.back = null;
    this.done();
  }

  // The scene is seen beside the drawing, or below it on a small screen.
  private makeRoom(): void {
    const panel = this.panel.getBoundingClientRect(), stage = this.panel.parentElement!.getBoundingClientRect();
    const wide = panel.width < stage.width - 1;
    this.view.cover(wide ? panel.width / stage.width : 0, wide ? 0 : panel.height / stage.height);
  }

  private build(): void {
    this.picture = svg('svg', { role: 'application', 'aria-label': t('Layout'), tabindex: 0 }) as SVGSVGElement;
    this.picture.addEventListener('pointerdown', e => this.down(e));
    this.picture.addEventListener('pointermove', e => this.moveTo(e));
    this.picture.addEventListener('pointerup', e => this.up(e));
    this.picture.addEventListener('keydown', e => this.key(e));
    const turn = (degrees: number) => () => this.turn(degrees);
    fill(this.panel, h('div', { class: 'tools' },
      button(t('Add element') + ' (A)', 'plus', () => this.add(), { 'data-do': 'add' }, true), button(t('Turn') + ' (R)', 'turn', turn(15)),
      button(t('Flip') + ' (F)', 'flip', () => this.flip()), button(t('Delete'), 'remove', () => this.remove()), h('span', { class: 'grow' }),
      button(t('Save to the library'), 'save', () => void this.save(), { 'data-do': 'save-layout' }),
      h('button', { type: 'button', class: 'main', 'data-do': 'place-layout', onclick: () => void this.place() }, t('Place in the scene')),
      button(t('Close'), 'remove', () => this.close(), { 'data-do': 'close-layout' })), this.picture, h('div', { class: 'say', role: 'status' }));
  }

  private add(): void {
    const k = this.elements.length, { la_mm } = this.store.state.element;
    const last = this.elements[k - 1];
    this.elements.push({ x_mm: last ? last.x_mm + 1.6 * la_mm : 0, y_mm: last ? last.y_mm : 0, rotation_deg: last?.rotation_deg ?? 0, facing: 'front' });
    this.chosen = k;
    this.changed();
  }

  private turn(degrees: number): void {
    const e = this.elements[this.chosen];
    if (e) e.rotation_deg = (e.rotation_deg + degrees + 360) % 360;
    this.changed();
  }

  private flip(): void {
    const e = this.elements[this.chosen];
    if (e) e.facing = e.facing === 'front' ? 'back' : 'front';
    this.changed();
  }

  private remove(): void {
    if (this.chosen < 0) return;
    const gone = this.chosen, shift = (k: number) => k > gone ? k - 1 : k;
    this.elements.splice(gone, 1);
    this.joins = this.joins.filter(j => j.element !== gone && j.to !== gone).map(j => ({ ...j, element: shift(j.element), to: shift(j.to) }));
    this.chosen = -1;
    this.changed();
  }

  // Corners counter-clockwise from the first, which starts a long side (core/design/planar_layout).
  private corners(e: Drawn): Point[] {
    const { la_mm, lb_mm, alpha_deg } = this.store.state.element, angle = (e.facing === 'front' ? alpha_deg : 180 - alpha_deg) * Math.PI / 180;
    const across: Point = [la_mm * Math.cos(angle), la_mm * Math.sin(angle)], turn = e.rotation_deg * Math.PI / 180;
    const middle: Point = [(lb_mm + across[0]) / 2, across[1] / 2];
    return ([[0, 0], [lb_mm, 0], [lb_mm + across[0], across[1]], across] as Point[]).map(([x, y]) => {
      const dx = x - middle[0], dy = y - middle[1];
      return [e.x_mm + dx * Math.cos(turn) - dy * Math.sin(turn), e.y_mm + dx * Math.sin(turn) + dy * Math.cos(turn)];
    });
  }

  private middleOf(element: number, side: number): Point {
    const c = this.corners(this.elements[element]), a = c[side], b = c[(side + 1) % 4];
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }

  private taken(element: number, side: number): boolean {
    return this.joins.some(j => (j.element === element && j.side === side) || (j.to === element && j.to_side === side));
  }

  private legal(from: { element: number; side: number }, element: number, side: number): boolean {
    return element !== from.element && side % 2 !== from.side % 2 && !this.taken(element, side);
  }

  private frame(): { x: number; y: number; w: number; h: number } {
    const points = this.elements.flatMap(e => this.corners(e)), { clientWidth, clientHeight } = this.picture;
    const xs = points.map(p => p[0]), ys = points.map(p => p[1]), pad = 90;
    const low = [Math.min(...xs, -150) - pad, Math.min(...ys, -110) - pad], high = [Math.max(...xs, 150) + pad, Math.max(...ys, 110) + pad];
    const aspect = clientWidth / Math.max(1, clientHeight) || 1.3;
    let w = high[0] - low[0], hh = high[1] - low[1];
    if (w / hh < aspect) w = hh * aspect;
    else hh = w / aspect;
    return { x: (low[0] + high[0] - w) / 2, y: (low[1] + high[1] - hh) / 2, w, h: hh };
  }

  private box = { x: 0, y: 0, w: 1, h: 1 };

  private draw(): void {
    if (!this.dragging && !this.drawing) this.box = this.frame();
    const { x, y, w, h: hh } = this.box;
    this.picture.setAttribute('viewBox', `${x} ${-y - hh} ${w} ${hh}`); // y up
    const pieces = this.elements.map((e, k) => this.piece(e, k));
    const joins = this.joins.map(j => {
      const a = this.middleOf(j.element, j.side), b = this.middleOf(j.to, j.to_side);
      return svg('line', { class: 'join', x1: a[0], y1: -a[1], x2: b[0], y2: -b[1] });
    });
    const extra: Element[] = [];
    if (this.drawing) {
      const a = this.middleOf(this.drawing.from.element, this.drawing.from.side);
      extra.push(svg('line', { class: 'drawing', x1: a[0], y1: -a[1], x2: this.drawing.at[0], y2: -this.drawing.at[1] }));
    }
    this.picture.replaceChildren(...pieces, ...joins, ...extra);
    const say = this.panel.querySelector('.say')!;
    say.textContent = this.said || t('Drag elements; drag from side to side to connect; R turns, F flips, Delete removes.');
    say.classList.toggle('bad', this.bad);
  }

  private piece(e: Drawn, k: number): Element {
    const group = svg('g', { class: `piece ${e.facing}${k === this.chosen ? ' on' : ''}` }), c = this.corners(e);
    group.append(svg('path', { class: 'body', 'data-element': k, d: 'M' + c.map(p => `${p[0]} ${-p[1]}`).join('L') + 'Z' }));
    for (let side = 0; side < 4; ++side) {
      const a = c[side], b = c[(side + 1) % 4], inset = 0.22;
      const ends = { x1: a[0] + inset * (b[0] - a[0]), y1: -a[1] - inset * (b[1] - a[1]), x2: b[0] - inset * (b[0] - a[0]), y2: -b[1] + inset * (b[1] - a[1]) };
      const legal = this.drawing && this.legal(this.drawing.from, k, side);
      group.append(svg('line', { class: side % 2 === 0 ? 'long' : 'short', ...ends }));
      group.append(svg('line', { class: `port${legal ? ' legal' : ''}${this.taken(k, side) ? ' taken' : ''}`, 'data-element': k, 'data-side': side, ...ends }));
    }
    const label = svg('text', { x: e.x_mm, y: -e.y_mm, 'text-anchor': 'middle', 'dominant-baseline': 'central', 'font-size': 16, fill: '#6d655a', 'pointer-events': 'none' });
    label.textContent = String(k);
    group.append(label);
    if (k === this.chosen) {
      const far = ((c[1][0] + c[2][0]) / 2 - e.x_mm), up = ((c[1][1] + c[2][1]) / 2 - e.y_mm), l = Math.hypot(far, up) || 1;
      group.append(svg('circle', { class: 'turn', 'data-turn': k, cx: e.x_mm + far * (1 + 26 / l), cy: -(e.y_mm + up * (1 + 26 / l)), r: 8 }));
    }
    return group;
  }

  private at(e: PointerEvent): Point {
    const r = this.picture.getBoundingClientRect();
    return [this.box.x + (e.clientX - r.left) / r.width * this.box.w, this.box.y + this.box.h - (e.clientY - r.top) / r.height * this.box.h];
  }

  private down(e: PointerEvent): void {
    const target = e.target as SVGElement, side = target.getAttribute('data-side'), element = Number(target.getAttribute('data-element') ?? -1);
    this.picture.focus();
    this.picture.setPointerCapture(e.pointerId);
    const at = this.at(e);
    if (side !== null) this.drawing = { from: { element, side: Number(side) }, at };
    else if (target.hasAttribute('data-turn')) this.dragging = { element: this.chosen, turn: true, from: at, start: { ...this.elements[this.chosen] } };
    else if (element >= 0) {
      this.chosen = element;
      this.dragging = { element, turn: false, from: at, start: { ...this.elements[element] } };
    } else this.chosen = -1;
    this.draw();
  }

  private moveTo(e: PointerEvent): void {
    const at = this.at(e);
    if (this.drawing) {
      this.drawing.at = at;
      this.draw();
    } else if (this.dragging) {
      const { element, turn, from, start } = this.dragging, drawn = this.elements[element];
      if (turn) {
        const angle = (p: Point) => Math.atan2(p[1] - start.y_mm, p[0] - start.x_mm) * 180 / Math.PI;
        drawn.rotation_deg = (Math.round((start.rotation_deg + angle(at) - angle(from)) / 3) * 3 + 720) % 360;
      } else {
        drawn.x_mm = Math.round(start.x_mm + at[0] - from[0]);
        drawn.y_mm = Math.round(start.y_mm + at[1] - from[1]);
      }
      this.draw();
    }
  }

  private up(e: PointerEvent): void {
    if (this.drawing) {
      const target = document.elementFromPoint(e.clientX, e.clientY), side = target?.getAttribute('data-side');
      const to = Number(target?.getAttribute('data-element') ?? -1), from = this.drawing.from;
      if (side != null && this.legal(from, to, Number(side))) this.joins.push({ element: from.element, side: from.side, to, to_side: Number(side) });
    }
    const edited = this.drawing !== null || this.dragging !== null;
    this.drawing = this.dragging = null;
    if (edited) this.changed();
  }

  private key(e: KeyboardEvent): void {
    const keys: Record<string, () => void> = { r: () => this.turn(e.shiftKey ? -15 : 15), f: () => this.flip(), a: () => this.add(), delete: () => this.remove(), backspace: () => this.remove(), escape: () => this.close() };
    const action = keys[e.key.toLowerCase()];
    if (!action || e.ctrlKey || e.metaKey) return;
    e.preventDefault();
    e.stopPropagation();
    action();
  }

  private operation(id: string): Record<string, unknown> & { op: string } {
    return { op: 'layout', id, elements: this.elements, joins: this.joins, position_mm: [0, 0, 0] };
  }

  private changed(): void {
    this.draw();
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.preview(), rest);
  }

  private async preview(): Promise<void> {
    const number = ++this.asked;
    this.works = false;
    if (this.elements.length === 0) return;
    try {
      const g = await api.geometry('/api/try', { revision: this.store.state.revision, alone: true, operation: this.operation('layout') });
      if (number !== this.asked) return;
      this.said = '';
      this.bad = false;
      this.works = true;
      this.view.show(g);
      this.view.fit();
    } catch (problem) {
      if (number !== this.asked) return;
      this.said = problem instanceof Error ? reason(problem.message) : '';
      this.bad = this.joins.length > 0;
    }
    this.draw();
  }

  private async place(): Promise<void> {
    const id = this.store.freshId(this.store.state.parts.length === 0 ? 'body' : 'layout');
    if (!await this.store.apply(this.operation(id))) return;
    this.close();
    this.view.fit();
  }

  private async save(): Promise<void> {
    const layout: Saved = { name: this.saved[this.index]?.name ?? `${t('Layout')} ${this.saved.length + 1}`, elements: this.elements, joins: this.joins };
    const next = this.index >= 0 ? this.saved.map((l, k) => k === this.index ? layout : l) : [...this.saved, layout];
    try {
      await api.post('/api/layouts', { layouts: next });
      this.index = this.index >= 0 ? this.index : next.length - 1;
      this.saved = structuredClone(next);
      this.said = this.works ? t('saved') : this.said;
      for (const listener of this.listeners) listener();
      this.draw();
    } catch (problem) {
      this.store.explain(problem);
    }
  }
}
