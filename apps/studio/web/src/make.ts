// Fabricating: choices, progress, then the kit's sheets, booklet and player.
import * as api from './api';
import { button, fill, h } from './dom';
import { reason } from './reasons';
import type { Store } from './store';
import { number, t } from './words';

interface Named { name: string; title: string; }
interface KitState {
  running: boolean; doing: string; error: string; id?: string; revision?: number; files?: string[];
  figures?: { elements: number; sheets: number; cut_length_m: number; minutes: number; mass_g: number; steps: number; building_minutes: number; warnings: string[] };
}

const pollEvery = 300; // ms

// The operation being carried out is named in the program's own words; its number says as much.
const doing = (text: string) => t(text.replace(/^(\d+\/\d+) .*/, '$1'));

type Tab = 'Sheets' | 'Booklet' | 'Player' | 'Files';

// A cut file on the screen: hairlines, which lasers want, are drawn so wide that they can be seen.
function drawing(address: string, name: string): HTMLElement {
  const image = h('img', { alt: name });
  void fetch(address).then(r => r.text()).then(text => {
    image.src = URL.createObjectURL(new Blob([text.replaceAll(/stroke-width="0\.[0-9]+"/g, 'stroke-width="0.8"')], { type: 'image/svg+xml' }));
    image.onload = () => URL.revokeObjectURL(image.src);
  });
  return image;
}

export class Making {
  private dialog: HTMLDialogElement | null = null;
  private tab: Tab = 'Sheets';
  private choices: { materials: Named[]; machines: Named[] } = { materials: [], machines: [] };
  private wish = { material: '', machine: '', paper: 'a4' };

  constructor(private readonly store: Store) {}

  async open(): Promise<void> {
    let kit: KitState;
    try {
      kit = await api.get<KitState>('/api/kit');
      if (this.choices.materials.length === 0) this.choices = await api.get('/api/choices');
    } catch (problem) {
      this.store.explain(problem);
      return;
    }
    this.dialog?.remove();
    const dialog = this.dialog = h('dialog', { 'aria-label': t('Fabricate') });
    document.getElementById('dialog')!.append(dialog);
    dialog.addEventListener('close', () => { dialog.remove(); if (this.dialog === dialog) this.dialog = null; });
    dialog.showModal();
    this.show(kit);
    if (kit.running) void this.follow();
  }

  private select(label: string, key: 'material' | 'machine' | 'paper', options: Named[]): HTMLElement {
    return h('label', {}, t(label) + ' ', h('select', { onchange: ((e: Event) => { this.wish[key] = (e.target as HTMLSelectElement).value; }) as EventListener },
      ...options.map(o => h('option', { value: o.name, selected: o.name === this.wish[key] }, o.title))));
  }

  private show(kit: KitState): void {
    if (!this.dialog) return;
    const ready = kit.id !== undefined && !kit.running, fresh = ready && kit.revision === this.store.state.revision;
    const tabs = (['Sheets', 'Booklet', 'Player', 'Files'] as Tab[]).map(tab => h('button', { type: 'button', role: 'tab', 'aria-selected': String(tab === this.tab), 'data-tab': tab,
      onclick: () => { this.tab = tab; this.show(kit); } }, t(tab)));
    const head = h('div', { class: 'head' }, h('strong', {}, t('Fabricate')),
      this.select('Material', 'material', [{ name: '', title: t('by thickness') }, ...this.choices.materials]),
      this.select('Machine', 'machine', [{ name: '', title: t('none in particular') }, ...this.choices.machines]),
      this.select('Paper', 'paper', [{ name: 'a4', title: 'A4' }, { name: 'letter', title: 'Letter' }]),
      h('button', { type: 'button', class: fresh ? 'quiet' : 'main', 'data-do': 'start', disabled: kit.running, onclick: () => void this.start() }, t('Make the kit')),
      h('span', { class: 'grow' }), button(t('Close'), 'remove', () => this.dialog?.close(), { 'data-do': 'close' }));
    const body = h('div', { class: 'body' });
    if (kit.running) fill(body, h('p', { class: 'progress', role: 'status' }, h('span', { class: 'spinner' }), `${t('Making')}: ${doing(kit.doing)}`));
    else if (kit.error) fill(body, h('p', { class: 'bad', role: 'alert' }, reason(kit.error)));
    else if (ready) fill(body, ...this.content(kit));
    else fill(body, h('p', {}, t('Makes the sheets to cut, the booklet that shows every step, a film of the assembly and everything else as one file to download.')));
    if (ready && !kit.error && !fresh) body.prepend(h('p', { class: 'bad', role: 'status' }, t('The design has changed since this kit was made.')));
    const bar = ready && !kit.error ? h('div', { class: 'head', role: 'tablist' }, ...tabs, h('span', { class: 'grow' }), this.summary(kit),
      h('a', { href: `/kit/${kit.id}/kit.zip`, download: 'kit.zip' }, h('button', { type: 'button', class: 'main', 'data-do': 'download', tabindex: -1 }, t('Download kit')))) : null;
    fill(this.dialog, h('div', {}, head, bar, body));
  }

  private summary(kit: KitState): HTMLElement {
    const f = kit.figures!;
    return h('span', {}, `${f.elements} ${t('pieces')} · ${f.sheets} ${t('sheets')} · ${number(f.cut_length_m, 1)} m · ${number(Math.ceil(f.minutes))} ${t('min')} ${t('to cut')} · ${number(Math.ceil(f.building_minutes))} ${t('min')} ${t('to build')}`);
  }

  private content(kit: KitState): Node[] {
    const address = (name: string) => `/kit/${kit.id}/${name}`, files = kit.files ?? [];
    const notes = kit.figures!.warnings.map(w => h('p', {}, w));
    if (this.tab === 'Booklet') return [h('iframe', { src: address('booklet.pdf'), title: t('Booklet') })];
    if (this.tab === 'Player') return [h('iframe', { src: address('preview.html'), title: t('Player'), sandbox: 'allow-scripts' })];
    if (this.tab === 'Files') return [...notes, h('ul', {}, ...files.map(f => h('li', {}, h('a', { href: address(f), download: f.replace(/.*\//, '') }, f))))];
    const sheets = files.filter(f => /^cut\/.*\.svg$/.test(f)).sort((a, b) => Number(b.includes('sheet')) - Number(a.includes('sheet')) || a.localeCompare(b));
    return [h('div', { class: 'gallery' }, ...sheets.map(f => h('figure', {}, drawing(address(f), f), h('figcaption', {}, f))))];
  }

  private async start(): Promise<void> {
    const { material, machine, paper } = this.wish;
    try {
      await api.post('/api/fabricate', { revision: this.store.state.revision, ...(material && { material }), ...(machine && { machine }), paper });
      await this.follow();
    } catch (problem) {
      this.fail(problem);
    }
  }

  // The dialog covers the notices of the page.
  private fail(problem: unknown): void {
    this.show({ running: false, doing: '', error: this.store.explanation(problem) });
  }

  private async follow(): Promise<void> {
    try {
      await this.poll();
    } catch (problem) {
      this.fail(problem);
    }
  }

  private async poll(): Promise<void> {
    for (;;) {
      const kit = await api.get<KitState>('/api/kit');
      this.show(kit);
      if (!kit.running || !this.dialog) return;
      await new Promise(done => setTimeout(done, pollEvery));
    }
  }
}
