// What the pointer does in the view: choose, move, pull, open, flip, place.
import * as THREE from 'three';
import * as api from './api';
import { partOfVertex, vertexRange, type Geometry } from './geometry';
import { Handles } from './handles';
import { Merging } from './merging';
import { Pulling } from './pulling';
import type { Store, Symmetry } from './store';
import { t } from './words';
import type { Pick, View } from './view';

export type Tool = 'select' | 'pull' | 'open' | 'flip';

const clickReach = 5; // pixels that a click may move

function mirrorPlane(symmetry: Symmetry): THREE.Plane {
  return new THREE.Plane().setFromNormalAndCoplanarPoint(new THREE.Vector3(...symmetry.mirror!).normalize(), new THREE.Vector3(...(symmetry.through_mm ?? [0, 0, 0])));
}

// Move a point near the mirror onto it.
function snapToMirror(p: THREE.Vector3, symmetry: Symmetry | null, reach: number): boolean {
  if (!symmetry?.mirror) return false;
  const plane = mirrorPlane(symmetry), distance = plane.distanceToPoint(p);
  if (Math.abs(distance) > reach) return false;
  p.addScaledVector(plane.normal, -distance);
  return true;
}

function isOwnImage(g: Geometry, symmetry: Symmetry, reach: number): boolean {
  const plane = mirrorPlane(symmetry), points = Array.from({ length: g.header.vertices }, (_, v) => new THREE.Vector3().fromArray(g.positions, 3 * v));
  return points.every(p => {
    const image = p.clone().addScaledVector(plane.normal, -2 * plane.distanceToPoint(p));
    return points.some(q => q.distanceTo(image) < reach);
  });
}

export class Tools {
  tool: Tool = 'select';
  brush = 'rhombic-12';
  symmetric = false;
  part = -1; // chosen
  element = -1; // chosen
  vertex = -1; // chosen
  openings = new Set<number>();
  listeners: (() => void)[] = [];
  readonly merging: Merging;
  readonly pulling: Pulling;
  readonly handles: Handles;
  private press: { x: number; y: number; hit: Pick | null; moved: boolean; mode: 'none' | 'orbit' | 'move' | 'pull'; from: THREE.Vector3; id: number } | null = null;

  constructor(readonly store: Store, readonly view: View) {
    this.merging = new Merging(store, view);
    this.pulling = new Pulling(store, view);
    this.handles = new Handles(view, motion => void this.release(motion));
    this.handles.onMove = motion => this.merging.move(this.part, motion);
    const canvas = view.canvas;
    // Before the orbit controls, so that a drag that edits does not turn the view.
    canvas.addEventListener('pointerdown', e => this.down(e), { capture: true });
    canvas.addEventListener('pointermove', e => this.moveTo(e));
    canvas.addEventListener('pointerup', e => void this.up(e));
    canvas.addEventListener('pointercancel', e => void this.up(e, true));
    canvas.addEventListener('pointerleave', () => { if (!this.press) view.hover(-1); });
    store.listeners.push(() => this.refresh());
  }

  choose(tool: Tool): void {
    this.tool = tool;
    this.openings.clear();
    this.merging.stop();
    this.view.hover(-1);
    this.refresh();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  // After every change: show the document and what is chosen in it.
  refresh(): void {
    const { view, store } = this;
    if (!store.geometry) return;
    if (this.part >= store.state.parts.length) this.part = -1;
    if (this.element >= store.geometry.header.elements) this.element = -1;
    if (this.vertex >= store.geometry.header.vertices) this.vertex = -1;
    if (!this.pulling.active && !this.merging.showing && !store.busy) view.show(store.geometry);
    this.mark();
    this.tell();
  }

  mark(): void {
    const { view, store } = this, g = store.geometry;
    view.marked = this.openings;
    view.chosen = new Set();
    if (this.tool === 'select' && this.part >= 0 && store.state.parts.length > 1 && !this.merging.showing) {
      for (let f = 0; f < g.header.elements; ++f) if (g.part[f] === this.part) view.chosen.add(f);
    }
    if (this.element >= 0 && this.tool === 'select') view.chosen.add(this.element);
    view.repaint();
    const movable = this.tool === 'select' && this.part >= 0 && !this.merging.showing && store.state.parts[this.part]?.movable && store.state.parts.length > 1;
    this.handles.attach(movable ? this.partMiddle(this.part) : null);
  }

  private partMiddle(part: number): THREE.Vector3 {
    const [from, to] = vertexRange(this.store.geometry, part), sum = new THREE.Vector3();
    for (let v = from; v < to; ++v) sum.add(this.view.vertex(v, this.store.geometry));
    return sum.divideScalar(to - from);
  }

  // A vertex of the scene as its part and number in it.
  inPart(v: number, g: Geometry = this.store.geometry): { on: string; vertex: number } {
    const part = partOfVertex(g, v);
    return { on: this.store.state.parts[part].id, vertex: v - g.partStart[part] };
  }

  private down(e: PointerEvent): void {
    if (this.handles.grabbed || this.press || e.button !== 0 || !e.isPrimary) return;
    const hit = this.view.pick(e.clientX, e.clientY);
    this.press = { x: e.clientX, y: e.clientY, hit, moved: false, mode: 'orbit', from: hit?.point ?? new THREE.Vector3(), id: e.pointerId };
    const g = this.store.geometry;
    if (this.store.busy || this.merging.showing) return;
    if (this.tool === 'pull') {
      const v = this.view.pickVertex(e.clientX, e.clientY, 16);
      if (v >= 0 && !g.opening[v]) {
        this.press.mode = 'pull';
        const { on, vertex } = this.inPart(v);
        this.pulling.begin({ on, vertex, brush: this.brush, symmetric: this.symmetric && this.store.state.symmetry !== null }, v);
      }
    } else if (this.tool === 'select' && hit && this.store.state.parts.length > 1 && g.part[hit.face] === this.part && this.store.state.parts[this.part].movable) {
      this.press.mode = 'move';
    }
    if (this.press.mode !== 'orbit') {
      this.view.orbit.enabled = false;
      this.view.canvas.setPointerCapture(e.pointerId);
    }
  }

  private moveTo(e: PointerEvent): void {
    const press = this.press;
    if (!press) {
      this.view.canvas.classList.toggle('editing', false);
      if (this.tool === 'pull' && e.pointerType !== 'touch' && !this.store.busy) {
        const v = this.view.pickVertex(e.clientX, e.clientY, 16);
        this.view.hover(v >= 0 && !this.store.geometry.opening[v] ? v : -1);
      }
      return;
    }
    if (e.pointerId !== press.id) return;
    press.moved ||= Math.hypot(e.clientX - press.x, e.clientY - press.y) > clickReach;
    if (!press.moved) return;
    if (press.mode === 'pull') this.pulling.drag(e.clientX, e.clientY, e.shiftKey);
    if (press.mode === 'move') {
      const motion = new THREE.Matrix4().makeTranslation(this.view.onPlane(e.clientX, e.clientY, press.from).sub(press.from));
      this.merging.move(this.part, motion);
      this.handles.attach(null);
    }
  }

  private async up(e: PointerEvent, cancelled = false): Promise<void> {
    const press = this.press;
    if (!press || e.pointerId !== press.id) return;
    this.press = null;
    this.view.orbit.enabled = true;
    if (press.mode === 'pull') {
      if (cancelled || !press.moved) this.pulling.cancel();
      else await this.pulling.release();
      this.refresh();
    } else if (press.mode === 'move' && press.moved) {
      const motion = new THREE.Matrix4().makeTranslation(this.view.onPlane(e.clientX, e.clientY, press.from).sub(press.from));
      if (cancelled) this.merging.stop();
      else await this.release(motion);
    } else if (!press.moved && !cancelled) {
      await this.click(press.hit);
    }
  }

  // A part of a mirrored design that is let go near the plane comes to lie on it.
  private async release(motion: THREE.Matrix4): Promise<void> {
    if (this.store.state.symmetry?.mirror && this.symmetric) {
      const here = this.partMiddle(this.part).applyMatrix4(motion), onPlane = here.clone();
      if (snapToMirror(onPlane, this.store.state.symmetry, 0.25 * this.store.state.element.la_mm)) {
        motion.premultiply(new THREE.Matrix4().makeTranslation(onPlane.sub(here)));
      }
    }
    await this.merging.release(this.part, motion);
    this.refresh();
  }

  private async click(hit: Pick | null): Promise<void> {
    const g = this.store.geometry;
    if (this.store.busy || this.merging.showing) return;
    if (this.tool === 'select') {
      this.part = hit ? g.part[hit.face] : -1;
      this.element = hit?.face ?? -1;
      this.vertex = hit?.vertex ?? -1;
    } else if (hit && this.tool === 'open') {
      if (!this.openings.delete(hit.face)) this.openings.add(hit.face);
    } else if (hit && this.tool === 'flip') {
      await this.flip(hit.face);
    }
    this.mark();
    this.tell();
  }

  private elementOf(face: number): { on: string; element: number } {
    const g = this.store.geometry, part = g.part[face];
    return { on: this.store.state.parts[part].id, element: face - g.faceStart[part] };
  }

  private marked(): boolean {
    return this.symmetric && this.store.state.symmetry !== null;
  }

  async flip(face: number): Promise<void> {
    const { on, element } = this.elementOf(face);
    await this.store.apply({ op: 'flip', on, element: { element }, ...(this.marked() && { symmetric: true }) });
  }

  async open(purpose: string): Promise<void> {
    const faces = [...this.openings].sort((a, b) => a - b), g = this.store.geometry;
    if (faces.length === 0) return;
    const part = g.part[faces[0]];
    if (faces.some(f => g.part[f] !== part)) {
      this.store.say(t('Choose elements of one part.'), 'error');
      return;
    }
    const elements = faces.map(f => ({ element: f - g.faceStart[part] }));
    const operation = { op: 'open', on: this.store.state.parts[part].id, elements, purpose, ...(this.marked() && { symmetric: true }) };
    if (await this.store.apply(operation)) this.openings.clear();
    this.refresh();
  }

  async deletePart(): Promise<void> {
    const part = this.store.state.parts[this.part];
    if (!part) return;
    this.part = this.element = this.vertex = -1;
    if (await this.store.change('/api/delete', { part: part.id })) this.store.say(`${part.id}: ${t('deleted. Undo brings it back.')}`);
  }

  // Put a shape where the pointer is: onto the mirror, or onto the plane through the middle of the scene.
  async place(shape: string, x: number, y: number, layout?: { elements: unknown[]; joins: unknown[] }): Promise<void> {
    const { symmetry, element, parts } = this.store.state, first = parts.length === 0;
    const at = first ? new THREE.Vector3() : (this.symmetric && this.onMirror(x, y)) || this.view.onPlane(x, y, this.view.centre());
    const snapped = snapToMirror(at, symmetry, 0.5 * element.la_mm);
    const position = [at.x, at.y, at.z].map(c => Math.round(c * 10) / 10);
    const id = this.store.freshId(first ? 'body' : shape.replace(/-.*/, ''));
    ++this.store.busy;
    const turn = snapped && !layout ? await this.symmetricTurn(shape, position) : 0;
    --this.store.busy;
    const done = await this.store.apply(layout ? { op: 'layout', id, position_mm: position, ...layout }
      : { op: 'place', id, shape, position_mm: position, rotation_deg: [0, 0, turn] });
    if (!done) return;
    this.part = this.store.state.parts.findIndex(p => p.id === id);
    this.element = this.vertex = -1;
    this.tool = 'select';
    if (first) this.view.fit();
    this.view.settleGrid();
    this.refresh();
    if (!first) await this.merging.ask(this.part);
    this.refresh();
  }

  // Where the pointer is on the mirror, unless that is seen edge-on.
  private onMirror(x: number, y: number): THREE.Vector3 | null {
    const { symmetry } = this.store.state;
    if (!symmetry?.mirror) return null;
    const plane = mirrorPlane(symmetry), ray = this.view.ray(x, y);
    return Math.abs(ray.direction.dot(plane.normal)) < 0.12 ? null : ray.intersectPlane(plane, new THREE.Vector3());
  }

  // The turn about z (degrees) with which the shape is its own mirror image; 0 when none is.
  private async symmetricTurn(shape: string, position_mm: number[]): Promise<number> {
    const { revision, symmetry, element } = this.store.state;
    for (const turn of [0, 90, 180, 270, 30, 45, 60]) {
      try {
        const g = await api.geometry('/api/try', { revision, alone: true, operation: { op: 'place', shape, position_mm, rotation_deg: [0, 0, turn] } });
        if (isOwnImage(g, symmetry!, 0.05 * element.la_mm)) return turn;
      } catch {
        return 0; // the placing itself will say why
      }
    }
    return 0;
  }
}
