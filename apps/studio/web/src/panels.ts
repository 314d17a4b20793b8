// The panels round the view: top bar, parts, history, status; the library has its own file.
import * as api from './api';
import { button, fill, h, icon, menu } from './dom';
import { bounds } from './geometry';
import { historyPanel } from './history';
import { overlayLimits, type Overlay } from './colours';
import type { Layouts } from './layouts';
import { Library } from './library';
import { pieceRow } from './piece';
import { reason } from './reasons';
import type { Store, Symmetry } from './store';
import type { Tool, Tools } from './tools';
import type { View } from './view';
import { language, number, setLanguage, t } from './words';

interface Figures { count: number; sheets: number; minutes: number; mass_g: number; }

const $ = (id: string) => document.getElementById(id)!;

const hints: Record<Tool, string> = {
  select: 'Click chooses, drag moves the chosen part, drag beside it turns the view.',
  pull: 'Press on a vertex and pull: the limb grows. Choose the brush in the library.',
  open: 'Click elements to take out, then choose what for.',
  flip: 'Click an element to turn it over.',
};

const symmetries: [string, Symmetry | null][] = [
  ['No symmetry', null], ['Mirror left and right', { mirror: [1, 0, 0] }], ['Mirror front and back', { mirror: [0, 1, 0] }],
  ['Axis', { axis: [0, 0, 1], fold: 3 }]];

const buildableStretch = 0.01; // more cannot be fabricated
const largestUpload = 8_000_000; // bytes, as the server has it
const folds = [2, 3, 4, 5, 6, 8];

export class Panels {
  private readonly library: Library;
  private figures: Figures | null = null;
  private figuresFor = '';

  constructor(private readonly store: Store, private readonly view: View, private readonly tools: Tools,
    layouts: Layouts, private readonly actions: { make(): void; help(): void }) {
    store.listeners.push(() => this.update());
    tools.listeners.push(() => this.update());
    tools.merging.listeners.push(() => this.update());
    tools.pulling.listeners.push(() => this.choice());
    this.library = new Library(store, tools, layouts, () => this.update());
  }

  async start(): Promise<void> {
    await this.library.load();
    this.update();
    await this.library.draw();
  }

  update(): void {
    if (!this.store.state) return;
    this.bar();
    this.side();
    this.status();
    this.choice();
    this.legend();
    const empty = this.store.state.parts.length === 0;
    $('hint').textContent = t(empty ? 'Click a shape in the library, or drag it into this view, to begin.' : hints[this.tools.tool]);
    this.library.mark();
    document.title = (this.store.state.title || t('Untitled')) + ' – rhombloom';
  }

  private bar(): void {
    const { store, tools, view } = this, focus = document.activeElement?.getAttribute('aria-label');
    if (document.activeElement?.classList.contains('title')) return;
    const tool = (name: Tool, label: string, key: string) => button(`${t(label)} (${key})`, name, () => tools.choose(name),
      { 'aria-pressed': String(tools.tool === name), class: 'tool', 'data-tool': name });
    const labelled = (b: HTMLButtonElement, text: string) => { b.append(h('span', { class: 'label' }, t(text))); return b; };
    fill($('bar'),
      button(t('History'), 'menu', () => $('side').classList.toggle('shown'), { class: 'only-small' }),
      h('span', { class: 'brand' }, 'rhombloom'),
      h('input', { class: 'title', 'aria-label': t('Title'), value: store.state.title, placeholder: t('Untitled'), maxlength: 80,
        onchange: ((e: Event) => void store.change('/api/document', { title: (e.target as HTMLInputElement).value })) as EventListener }),
      button(t('Undo') + ' (Ctrl+Z)', 'undo', () => void store.change('/api/undo'), { disabled: !store.state.can_undo || store.busy > 0, 'data-do': 'undo' }),
      button(t('Redo') + ' (Ctrl+Shift+Z)', 'redo', () => void store.change('/api/redo'), { disabled: !store.state.can_redo || store.busy > 0, 'data-do': 'redo' }),
      h('span', { class: 'gap' }),
      labelled(tool('select', 'Select', 'V'), 'Select'), labelled(tool('pull', 'Pull', 'E'), 'Pull'),
      labelled(tool('open', 'Open', 'O'), 'Open'), labelled(tool('flip', 'Flip', 'F'), 'Flip'),
      h('span', { class: 'gap' }), this.symmetryMenu(),
      button(`${t('Symmetric')} (S)`, 'mirror', () => this.toggleSymmetric(),
        { 'aria-pressed': String(tools.symmetric && store.state.symmetry !== null), disabled: store.state.symmetry === null, 'data-do': 'symmetric' }),
      h('span', { class: 'grow' }), this.overlayMenu(),
      button(t('Fit') + ' (Home)', 'fit', () => view.fit()),
      button(t('Dark or light'), 'sun', () => this.toggleTheme(), { 'data-do': 'theme' }),
      button(`${t('Language')}: ${language === 'de' ? 'English' : 'Deutsch'}`, null, () => this.toggleLanguage(), { class: 'small', 'data-do': 'language' }, false),
      button(t('Help') + ' (?)', 'help', () => this.actions.help()),
      h('button', { type: 'button', class: 'main', 'data-do': 'make', disabled: store.state.parts.length !== 1, onclick: () => this.actions.make() }, icon('make'), h('span', { class: 'label' }, t('Fabricate'))));
    $('bar').querySelector('[data-do=language]')!.textContent = language === 'de' ? 'EN' : 'DE';
    if (focus) $('bar').querySelector<HTMLElement>(`[aria-label="${CSS.escape(focus)}"]`)?.focus();
  }

  private symmetryMenu(): HTMLElement {
    const { symmetry } = this.store.state;
    const same = (a: Symmetry | null) => JSON.stringify([a?.mirror, a?.axis && a.fold]) === JSON.stringify([symmetry?.mirror, symmetry?.axis && symmetry.fold]);
    const choices = [...symmetries.slice(0, 3), ...folds.map(fold => [`Axis`, { ...symmetries[3][1], fold }] as [string, Symmetry])];
    const entries = choices.map(([label, wanted]) => ({
      label: t(label) + (wanted?.fold ? ` ${wanted.fold}×` : ''), on: same(wanted),
      act: () => void this.store.change('/api/document', { symmetry: wanted && { ...wanted, through_mm: [0, 0, 0] } }).then(ok => {
        if (ok) this.tools.symmetric = wanted !== null;
        this.showPlane();
        this.update();
      }),
    }));
    return menu(t('Symmetry'), entries.find(e => e.on)?.label ?? t('Symmetry'), 'symmetry', entries);
  }

  private overlayMenu(): HTMLElement {
    const choices: [Overlay, string][] = [['none', 'Sides'], ['part', 'Components'], ['defect', 'Defect'], ['strain', 'Strain']];
    const entries = choices.map(([value, label]) => ({
      label: t(label), on: this.view.overlay === value,
      act: () => {
        this.view.overlay = value;
        this.view.repaint();
        this.update();
      },
    }));
    return menu(t('Colours'), entries.find(e => e.on)!.label, 'overlay', entries);
  }

  toggleSymmetric(): void {
    this.tools.symmetric = !this.tools.symmetric;
    this.showPlane();
    this.update();
  }

  showPlane(): void {
    const { symmetry } = this.store.state;
    const v = this.view.centre().constructor as new (...p: number[]) => ReturnType<View['centre']>;
    this.view.showPlane(this.tools.symmetric && symmetry?.mirror ? new v(...symmetry.mirror) : null, new v(...(symmetry?.through_mm ?? [0, 0, 0])));
  }

  toggleTheme(): void {
    const next = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
    document.documentElement.dataset.theme = next;
    this.view.setTheme(next);
  }

  private toggleLanguage(): void {
    setLanguage(language === 'de' ? 'en' : 'de');
    this.library.show();
    this.update();
  }

  private side(): void {
    if ($('side').contains(document.activeElement) && document.activeElement?.closest('.form')) return;
    const { state } = this.store;
    const rows = state.parts.map((part, k) => h('li', { class: k === this.tools.part ? 'on' : '' },
      h('span', { class: 'what', onclick: () => this.choosePart(k), role: 'button', tabindex: 0, onkeydown: ((e: KeyboardEvent) => { if (e.key === 'Enter') this.choosePart(k); }) as EventListener },
        part.id, h('small', { class: part.problems.length || !part.settled || part.max_stretch > buildableStretch ? 'bad' : '' },
          part.problems[0] !== undefined ? reason(part.problems[0]) : `${part.elements} ${t('elements')}, ${part.flipped} ${t('flipped')}, ${number(part.max_stretch * 100, 2)} %`)),
      state.parts.length > 1 && button(t('Delete'), 'remove', () => { this.tools.part = k; void this.tools.deletePart(); }, { class: 'small' })));
    fill($('side'), h('h2', {}, t('Parts'), this.fileButtons()), h('ul', { class: 'rows' }, ...rows), this.picked(),
      h('h2', {}, t('Element')), pieceRow(this.store, () => this.view.fit()), h('h2', {}, t('History')), historyPanel(this.store, this.library.names));
  }

  private fileButtons(): HTMLElement {
    const pick = h('input', { type: 'file', accept: '.json,application/json', hidden: true, onchange: (async () => {
      const file = pick.files?.[0];
      if (!file) return;
      try {
        await this.replace(JSON.parse(await file.text()));
      } catch {
        this.store.say(`${file.name}: ${t('this is no design file.')}`, 'error');
      }
      pick.value = ''; // the same file can be opened again
    }) as EventListener });
    const save = async () => {
      const address = URL.createObjectURL(new Blob([await api.text('/api/design')], { type: 'application/json' }));
      h('a', { href: address, download: this.store.state.file }).click();
      setTimeout(() => URL.revokeObjectURL(address), 5000);
    };
    const mesh = h('input', { type: 'file', accept: '.obj,.ply,.stl,.off,.glb', hidden: true, onchange: (() => {
      const file = mesh.files?.[0];
      if (file) this.importMesh(file);
      mesh.value = '';
    }) as EventListener });
    return h('span', {}, pick, mesh, button(t('Import a mesh'), 'mesh', () => mesh.click(), { class: 'small' }),
      button(t('New'), 'plus', () => void this.replace({ rhombloom: 1, operations: [] }), { class: 'small' }),
      button(t('Open file'), 'file', () => pick.click(), { class: 'small' }), button(t('Save a copy'), 'save', () => void save(), { class: 'small' }));
  }

  private async replace(design: unknown): Promise<void> {
    const { revision, parts } = this.store.state;
    if (!await this.store.change('/api/replace', { design })) return;
    this.view.fit();
    if (parts.length > 0 && this.store.state.revision > revision) this.store.say(t('Another design is open now. Undo brings the one before it back.'));
  }

  // Ask how many elements, then let the server find a network of them near the mesh.
  private importMesh(file: File): void {
    const count = h('input', { type: 'number', min: 6, max: 3000, value: 300, 'aria-label': t('How many elements') });
    if (file.size > largestUpload) {
      this.store.say(`${file.name}: ${t('larger than 8 MB. Simplify the mesh first, or use rhombloom import in a terminal.')}`, 'error');
      return;
    }
    const dialog = h('dialog', { class: 'small', 'aria-label': t('Import a mesh') }), body = h('div', { class: 'body' });
    const go = async () => {
      fill(body, h('p', { class: 'progress', role: 'status' }, h('span', { class: 'spinner' }), t('Looking for a network of elements near the mesh. This may take a minute.')));
      const query = new URLSearchParams({ revision: String(this.store.state.revision), elements: count.value, name: file.name });
      const done = await this.store.change(`/api/import?${query}`, await file.arrayBuffer());
      dialog.close();
      if (done) this.view.fit();
    };
    dialog.append(h('div', {}, h('div', { class: 'head' }, h('strong', {}, `${t('Import a mesh')}: ${file.name}`)),
      body));
    fill(body, h('label', {}, t('How many elements') + ' ', count), ' ',
      h('button', { type: 'button', class: 'main', onclick: () => void go() }, t('Apply')), h('button', { type: 'button', class: 'quiet', onclick: () => dialog.close() }, t('Cancel')));
    dialog.addEventListener('close', () => dialog.remove());
    document.getElementById('dialog')!.append(dialog);
    dialog.showModal();
  }

  private choosePart(k: number): void {
    this.tools.part = k;
    this.tools.element = this.tools.vertex = -1;
    this.tools.tool = 'select';
    this.tools.refresh();
  }

  // What is chosen, with its measures.
  private picked(): HTMLElement | null {
    const g = this.store.geometry, { element, vertex } = this.tools;
    if (element < 0 || this.tools.tool !== 'select') return null;
    const part = g.part[element], rows: [string, string][] = [
      [t('element'), String(element - g.faceStart[part])], ['', g.facing[element] ? t('flipped') : t('front')],
      [t('Components'), g.header.components[g.component[element]]], [t('strain'), number(g.strains[element] * 100, 2) + ' %']];
    if (vertex >= 0) {
      const valence = g.quads.reduce((sum, v) => sum + (v === vertex ? 1 : 0), 0);
      rows.push([t('vertex'), String(vertex - g.partStart[part])], [t('valence'), String(valence)],
        [t('defect'), g.opening[vertex] ? t('opening') : number(g.defects[vertex], 1) + '°']);
    }
    return h('dl', { class: 'facts' }, ...rows.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
  }

  private status(): void {
    const g = this.store.geometry, box = bounds(g), count = g.header.elements, figures = this.figures?.count === count ? this.figures : null;
    const item = (value: string, unit: string) => h('span', {}, h('b', {}, value), ' ' + unit);
    const size = box ? [0, 1, 2].map(k => number(box.high[k] - box.low[k])).join(' × ') : '–';
    fill($('status'), item(size, 'mm'), item(number(count), t('elements')), item(figures ? '≈ ' + number(figures.sheets) : '–', t('sheets')),
      item(figures ? '≈ ' + number(Math.ceil(figures.minutes)) : '–', t('min')), item(figures ? number(figures.mass_g) : '–', 'g'), h('span', { class: 'grow' }),
      this.store.busy > 0 && h('span', { class: 'spinner', role: 'progressbar', 'aria-label': t('working') }),
      h('span', {}, `${this.store.state.file}: ${this.store.busy ? t('working') : t('saved')}`));
    void this.ask(count);
  }

  private async ask(count: number): Promise<void> {
    const key = count + JSON.stringify(this.store.state.element);
    if (key === this.figuresFor) return;
    this.figuresFor = key;
    try {
      const figures = await api.get<Figures>('/api/figures?count=' + count);
      if (key !== this.figuresFor) return;
      this.figures = figures;
      this.status();
    } catch {
      this.figures = null;
    }
  }

  private legend(): void {
    const { overlay } = this.view, card = $('legend');
    card.hidden = overlay !== 'defect' && overlay !== 'strain';
    if (card.hidden) return;
    const limit = overlay === 'defect' ? overlayLimits.defect + '°' : overlayLimits.strain * 100 + ' %';
    const ends = overlay === 'defect' ? [t('saddle'), t('flat'), t('peak')] : [t('compressed'), '0', t('stretched')];
    fill(card, h('b', {}, t(overlay === 'defect' ? 'Defect' : 'Strain')), h('div', { class: 'scale' }),
      h('div', { class: 'ends' }, h('span', {}, '−' + limit), h('span', {}, '0'), h('span', {}, '+' + limit)),
      h('div', { class: 'ends' }, ...ends.map(e => h('span', {}, e))));
  }

  // The card at the bottom: what is about to happen.
  private choice(): void {
    const { merging, pulling, tool, openings } = this.tools, card = $('choice');
    const show = (...children: (Node | string | null | false)[]) => { card.hidden = false; fill(card, ...children); };
    if (pulling.active) {
      show(pulling.reason ? h('span', { class: 'bad' }, reason(pulling.reason)) : h('span', {}, `${this.tools.brush}: ${pulling.periods}× ${t('grown')}`));
    } else if (merging.showing && !merging.reason) {
      const c = merging.candidates[merging.index];
      show(button(t('Next and previous way to join') + ' ←', 'left', () => void merging.next(-1), { 'data-do': 'previous' }),
        h('span', {}, merging.complete ? `${merging.index + 1} ${t('of')} ${merging.candidates.length}` : `${t('Way')} ${merging.index + 1}`, c ? h('small', { class: c.max_stretch > buildableStretch ? 'bad' : '' }, `  −${c.removed} ${t('elements')}, ${t('strain')} ${number(c.max_stretch * 100, 2)} %`) : null),
        button(t('Next and previous way to join') + ' →', 'right', () => void merging.next(1), { 'data-do': 'next' }),
        h('button', { class: 'main', type: 'button', 'data-do': 'join', disabled: this.store.busy > 0, onclick: () => void merging.join() }, t('Join')),
        h('button', { class: 'quiet', type: 'button', 'data-do': 'apart', onclick: () => { merging.stop(); this.tools.refresh(); } }, t('Keep apart')));
    } else if (merging.showing) {
      this.choiceHint(show);
    } else if (tool === 'open' && openings.size > 0) {
      const purpose = h('select', { 'aria-label': t('Purpose') }, ...['lamp holder', 'bulb hatch', 'cable'].map(p => h('option', { value: p }, t(p))));
      show(`${openings.size} ${t('elements')}`, purpose, h('button', { class: 'main', type: 'button', 'data-do': 'take-out', onclick: () => void this.tools.open(purpose.value) }, t('Take out')));
    } else if (tool === 'select' && this.tools.part >= 0 && this.store.state.parts.length > 1) {
      const { handles } = this.tools;
      show(button(t('Move') + ' (G)', 'move', () => { handles.mode = 'translate'; this.choice(); }, { 'aria-pressed': String(handles.mode === 'translate') }),
        button(t('Turn') + ' (R)', 'turn', () => { handles.mode = 'rotate'; this.choice(); }, { 'aria-pressed': String(handles.mode === 'rotate') }),
        h('button', { class: 'quiet', type: 'button', 'data-do': 'try-join', onclick: () => void this.tools.merging.ask(this.tools.part).then(() => this.tools.refresh()) }, t('Join') + ' …'));
    } else {
      card.hidden = true;
    }
  }

  private choiceHint(show: (...children: (Node | string | null | false)[]) => void): void {
    const { merging } = this.tools, hint = merging.hint;
    const words: Record<string, string> = { closer: 'move closer by', apart: 'move apart by', aside: 'move aside by', turn: 'turn by' };
    const apart = h('button', { class: 'quiet', type: 'button', 'data-do': 'apart', onclick: () => { merging.stop(); this.tools.refresh(); } }, t('Keep apart'));
    const why = h('span', {}, reason(merging.reason));
    if (merging.looking) show(why, h('span', { class: 'spinner' }), t('Looking for a pose that works'), apart);
    else if (hint?.kind === 'none') show(why, t('No pose nearby works'), apart);
    else if (hint) {
      show(why, h('b', {}, `${t(words[hint.kind])} ${number(Math.abs(hint.amount))} ${hint.kind === 'turn' ? '°' : 'mm'}`),
        h('button', { class: 'main', type: 'button', 'data-do': 'follow', onclick: () => void merging.follow() }, t('Do it')), apart);
    } else {
      show(why, h('button', { class: 'main', type: 'button', 'data-do': 'suggest', onclick: () => void merging.suggest() }, t('Suggest')), apart);
    }
  }
}
