// The document as this tab knows it: its state, its geometry, and the way to change it.
import * as api from './api';
import type { Geometry } from './geometry';
import { reason } from './reasons';
import { t } from './words';

export type Operation = Record<string, unknown> & { op: string };

export interface Part {
  id: string;
  elements: number;
  flipped: number;
  openings: number;
  problems: string[];
  settled: boolean;
  max_stretch: number;
  min_defect_deg: number;
  max_defect_deg: number;
  movable: boolean;
}

export interface Symmetry { mirror?: number[]; axis?: number[]; fold?: number; through_mm?: number[]; }

export interface State {
  revision: number;
  file: string;
  title: string;
  element: { la_mm: number; lb_mm: number; alpha_deg: number; thickness_mm: number };
  symmetry: Symmetry | null;
  can_undo: boolean;
  can_redo: boolean;
  operations: Operation[];
  texts: string[];
  parts: Part[];
}

const pollEvery = 900; // ms

export class Store {
  state!: State;
  geometry!: Geometry;
  busy = 0;
  listeners: (() => void)[] = [];
  say: (text: string, kind?: 'info' | 'error') => void = () => undefined;
  private lost = false;

  async load(): Promise<void> {
    this.state = await api.get<State>('/api/state');
    this.geometry = await api.geometry('/api/geometry');
    // A change by another tab between the two requests: ask again.
    if (this.geometry.header.revision !== this.state.revision) await this.load();
  }

  async start(): Promise<void> {
    await this.load();
    this.tell();
    setInterval(() => void this.poll(), pollEvery);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  private async poll(): Promise<void> {
    if (this.busy || document.hidden) return;
    try {
      const { revision } = await api.get<{ revision: number }>('/api/revision');
      this.lost = false;
      if (revision !== this.state.revision && !this.busy) {
        await this.load();
        this.tell();
        this.say(t('The document was changed elsewhere; you see the newest version now. Undo brings back the one before.'));
      }
    } catch (problem) {
      if (!this.lost) this.explain(problem);
      this.lost = true;
    }
  }

  explain(problem: unknown): void {
    this.say(this.explanation(problem), 'error');
  }

  explanation(problem: unknown): string {
    if (!(problem instanceof api.Refusal)) throw problem;
    return problem.status === 0 ? t('The studio does not answer. Start it again: everything up to the last step is saved.')
      : problem.status === 403 || problem.status === 421 ? t('This address belongs to an earlier run of the studio. Open the address that it printed.')
        : reason(problem.message);
  }

  // Change the document; false when it was refused, with the reason said.
  async change(path: string, body: Record<string, unknown> | ArrayBuffer = {}): Promise<boolean> {
    ++this.busy;
    this.tell();
    try {
      this.state = await api.post<State>(path, body instanceof ArrayBuffer ? body : { revision: this.state.revision, ...body });
      this.geometry = await api.geometry('/api/geometry');
      if (this.geometry.header.revision !== this.state.revision) await this.load();
      return true;
    } catch (problem) {
      if (problem instanceof api.Refusal && problem.status === 409) {
        await this.load();
        this.say(t('The document was changed elsewhere; you see the newest version now. Undo brings back the one before.'));
      } else {
        this.explain(problem);
      }
      return false;
    } finally {
      --this.busy;
      this.tell();
    }
  }

  apply(operation: Operation): Promise<boolean> {
    return this.change('/api/apply', { operation });
  }

  freshId(wish: string): string {
    const taken = new Set(this.state.operations.map(op => op.id));
    let id = wish;
    for (let k = 2; taken.has(id); ++k) id = `${wish} ${k}`;
    return id;
  }
}
