// Moving a part and joining it to another: what they would become is shown as soon as the pointer rests.
import * as THREE from 'three';
import * as api from './api';
import { vertexRange, type Candidate, type Geometry } from './geometry';
import type { Store } from './store';
import type { View } from './view';

export interface Hint { kind: string; amount: number; move_mm?: number[]; turn?: number[]; }

interface Motion { move_mm: number[]; turn: number[]; [key: string]: unknown; }

const rest = 110; // ms without movement before the live preview is asked for

function motionOf(matrix: THREE.Matrix4): Motion {
  const p = new THREE.Vector3(), q = new THREE.Quaternion(), s = new THREE.Vector3();
  matrix.decompose(p, q, s);
  return { move_mm: p.toArray(), turn: q.toArray() };
}

export class Merging {
  showing = false; // candidates are on the screen, waiting for a choice
  candidates: Candidate[] = [];
  complete = false;
  index = 0;
  reason = '';
  hint: Hint | null = null;
  looking = false;
  on = '';
  with = '';
  listeners: (() => void)[] = [];
  private timer = 0;
  private asking = 0;

  constructor(private readonly store: Store, private readonly view: View) {}

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  private moved(part: number, motion: THREE.Matrix4): Geometry {
    const g = this.store.geometry, positions = g.positions.slice(), p = new THREE.Vector3();
    const [from, to] = vertexRange(g, part);
    for (let v = from; v < to; ++v) p.fromArray(positions, 3 * v).applyMatrix4(motion).toArray(positions, 3 * v);
    return { ...g, positions };
  }

  // While dragging: the part follows; when it rests, the join appears.
  move(part: number, motion: THREE.Matrix4): void {
    const g = this.moved(part, motion);
    this.view.show(g);
    this.view.showGhost(null);
    clearTimeout(this.timer);
    const number = ++this.asking;
    this.timer = window.setTimeout(() => void this.preview(part, motion, g, number), rest);
  }

  private async preview(part: number, motion: THREE.Matrix4, posed: Geometry, number: number): Promise<void> {
    const other = this.partner(part, posed);
    if (other < 0) return;
    try {
      const g = await api.geometry('/api/merge', { revision: this.store.state.revision, on: this.store.state.parts[other].id,
        with: this.store.state.parts[part].id, ...motionOf(motion) });
      if (number !== this.asking) return;
      this.view.show(g);
      this.view.showGhost(posed, part);
    } catch {
      // No way to join here: the reason is told on release.
    }
  }

  // The part whose box overlaps most with that of `part`; -1 when none does.
  partner(part: number, g: Geometry): number {
    const box = (p: number) => {
      const [from, to] = vertexRange(g, p), b = new THREE.Box3();
      for (let v = from; v < to; ++v) b.expandByPoint(new THREE.Vector3().fromArray(g.positions, 3 * v));
      return b;
    };
    const mine = box(part), size = new THREE.Vector3();
    let best = -1, most = 0;
    this.store.state.parts.forEach((_, p) => {
      const common = p === part ? new THREE.Box3() : box(p).intersect(mine);
      if (common.isEmpty()) return;
      common.getSize(size);
      const volume = (size.x + 1) * (size.y + 1) * (size.z + 1);
      if (volume > most) {
        most = volume;
        best = p;
      }
    });
    return best;
  }

  async release(part: number, motion: THREE.Matrix4): Promise<void> {
    clearTimeout(this.timer);
    ++this.asking;
    this.view.showGhost(null);
    const id = this.store.state.parts[part]?.id;
    if (id === undefined) return;
    if (!await this.store.change('/api/move', { part: id, ...motionOf(motion) })) {
      this.view.show(this.store.geometry);
      return;
    }
    await this.ask(this.store.state.parts.findIndex(p => p.id === id));
  }

  // Ways to join the part where it stands, if it touches another.
  async ask(part: number): Promise<void> {
    const other = part < 0 ? -1 : this.partner(part, this.store.geometry);
    if (other < 0) return;
    const [first, second] = [Math.min(part, other), Math.max(part, other)];
    this.on = this.store.state.parts[first].id;
    this.with = this.store.state.parts[second].id;
    this.index = 0;
    this.hint = null;
    await this.step(0);
  }

  // Show candidate `index`.
  async step(index: number): Promise<void> {
    const number = ++this.asking;
    ++this.store.busy;
    this.tell();
    try {
      const g = await api.geometry('/api/merge', { revision: this.store.state.revision, on: this.on, with: this.with, candidate: index });
      if (number !== this.asking) return;
      this.candidates = g.header.candidates ?? [];
      this.complete = g.header.complete === true;
      this.index = index;
      this.reason = '';
      this.showing = true;
      this.view.chosen = new Set();
      this.view.show(g);
    } catch (problem) {
      if (number !== this.asking) return;
      if (index > 0) {
        this.complete = true;
      } else {
        this.reason = problem instanceof Error ? problem.message : '';
        // Boxes overlap before surfaces touch: nothing to complain about yet.
        this.showing = !this.reason.includes('do not touch');
        this.candidates = [];
        this.view.show(this.store.geometry);
      }
    } finally {
      --this.store.busy;
      this.tell();
    }
  }

  async next(step: number): Promise<void> {
    const wanted = this.index + step;
    if (wanted < 0) return this.step(Math.max(0, this.candidates.length - 1));
    if (wanted >= this.candidates.length && this.complete) return this.step(0);
    await this.step(wanted);
    if (this.index !== wanted) await this.step(0);
  }

  async join(): Promise<void> {
    const operation = { op: 'merge', on: this.on, with: this.with, candidate: this.index };
    this.showing = false;
    if (!await this.store.apply(operation)) this.view.show(this.store.geometry);
    this.stop();
  }

  async suggest(): Promise<void> {
    this.looking = true;
    this.tell();
    try {
      this.hint = await api.post<Hint>('/api/hint', { revision: this.store.state.revision, on: this.on, with: this.with });
    } catch (problem) {
      this.store.explain(problem);
    }
    this.looking = false;
    this.tell();
  }

  async follow(): Promise<void> {
    if (!this.hint?.move_mm) return;
    const { move_mm, turn } = this.hint, part = this.with;
    this.stop();
    if (await this.store.change('/api/move', { part, move_mm, turn })) {
      await this.ask(this.store.state.parts.findIndex(p => p.id === part));
    }
  }

  stop(): void {
    clearTimeout(this.timer);
    ++this.asking;
    this.showing = false;
    this.reason = '';
    this.hint = null;
    this.candidates = [];
    this.view.showGhost(null);
    if (this.store.geometry) this.view.show(this.store.geometry);
    this.tell();
  }
}
