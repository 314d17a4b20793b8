// Extruding by dragging: one request in flight, the limb grows with every reply; release makes it exact.
import * as THREE from 'three';
import * as api from './api';
import type { Store } from './store';
import type { View } from './view';

export interface PullStart { on: string; vertex: number; brush: string; symmetric: boolean; }

let pulls = Math.floor(Math.random() * 1e9);

export class Pulling {
  active = false;
  periods = 0;
  reason = '';
  listeners: (() => void)[] = [];
  readonly work: number[] = []; // ms on the server, per frame
  readonly cpu: number[] = []; // of that, ms of computing
  readonly latency: number[] = []; // ms from request to picture
  private start!: PullStart;
  private apex = new THREE.Vector3();
  private outward = new THREE.Vector3();
  private by = new THREE.Vector3();
  private asked: THREE.Vector3 | null = null;
  private settled = false;
  private flying = false;
  private number = 0;

  constructor(private readonly store: Store, private readonly view: View) {}

  begin(start: PullStart, vertex: number): void {
    this.start = start;
    this.apex = this.view.vertex(vertex);
    this.outward = this.view.normal(vertex);
    this.by.set(0, 0, 0);
    this.asked = null;
    this.settled = false;
    this.active = true;
    this.periods = 0;
    this.reason = '';
    this.number = ++pulls;
    this.view.showDot(this.apex);
  }

  drag(x: number, y: number, straight: boolean): void {
    this.by.copy(this.view.onPlane(x, y, this.apex)).sub(this.apex);
    if (straight) this.by.copy(this.outward.clone().multiplyScalar(Math.max(0, this.by.dot(this.outward))));
    this.by.set(Math.round(this.by.x * 10) / 10, Math.round(this.by.y * 10) / 10, Math.round(this.by.z * 10) / 10);
    this.view.showDot(this.apex, this.apex.clone().add(this.by));
    void this.ask();
  }

  // The limb seen is the one that belongs to where the pointer is, at rest.
  get rests(): boolean { return this.settled && !!this.asked?.equals(this.by); }

  private async ask(): Promise<void> {
    if (this.flying || !this.active || this.rests) return;
    this.flying = true;
    const by = this.by.clone(), number = this.number, began = performance.now();
    try {
      const g = await api.geometry('/api/pull', { pull: number, revision: this.store.state.revision, ...this.start, by_mm: by.toArray() });
      if (this.active && number === this.number) {
        this.settled = g.header.settled === true;
        this.periods = g.header.periods ?? 0;
        this.reason = g.header.reason ?? '';
        this.view.show(g);
        this.work.push(g.header.work_ms ?? 0);
        this.cpu.push(g.header.cpu_ms ?? 0);
        this.latency.push(performance.now() - began);
        for (const listener of this.listeners) listener();
      }
    } catch (problem) {
      if (number === this.number) this.reason = problem instanceof Error ? problem.message : '';
      for (const listener of this.listeners) listener();
    }
    this.asked = by;
    this.flying = false;
    if (this.active && !this.reason) requestAnimationFrame(() => void this.ask());
  }

  async release(): Promise<void> {
    const long = this.by.length() > 0.25 * this.store.state.element.la_mm;
    const { on, vertex, brush, symmetric } = this.start;
    if (long) {
      await this.store.apply({ op: 'extrude', on, apex: { vertex }, brush, by_mm: this.by.toArray(), ...(symmetric && { symmetric }) });
    }
    this.cancel();
  }

  cancel(): void {
    this.active = false;
    ++pulls;
    this.number = pulls;
    this.view.showDot(null);
    for (const listener of this.listeners) listener();
  }
}
