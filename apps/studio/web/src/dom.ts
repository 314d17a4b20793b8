// Small helpers for building the page's elements.
export type Child = Node | string | null | false | undefined;
type Attributes = Record<string, string | number | boolean | EventListener | undefined | null>;

// h('button', { class: 'main', 'aria-label': 'Close', onclick: close }, 'Close')
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren(...children.filter((c): c is Node | string => Boolean(c)));
}

const strokes: Record<string, string> = {
  undo: 'M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3', redo: 'm15 14 5-5-5-5M20 9H10a6 6 0 0 0 0 12h3',
  select: 'M5 3l6 17 2.5-7L20 10z', pull: 'M12 21v-8M12 3v4M8 7l4-4 4 4M4 21c3-6 13-6 16 0', open: 'M12 3 4 8v8l8 5 8-5V8zM9 12h6',
  flip: 'M4 12a8 8 0 0 1 14-5l2 2M20 4v5h-5M20 12a8 8 0 0 1-14 5l-2-2M4 20v-5h5', mirror: 'M12 3v18M9 6 3 18h6zM15 6l6 12h-6z',
  fit: 'M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5', help: 'M9 9a3 3 0 1 1 4 3c-1 .5-1 1-1 2M12 18v.5', sun: 'M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8M12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.5 1.5M17.5 17.5 19 19M5 19l1.5-1.5M17.5 6.5 19 5',
  make: 'M4 20h16M6 20V10l6-6 6 6v10M10 20v-6h4v6', edit: 'M4 20h4L19 9l-4-4L4 16z', remove: 'M6 6l12 12M18 6 6 18', menu: 'M4 7h16M4 12h16M4 17h16',
  left: 'M15 5l-7 7 7 7', right: 'M9 5l7 7-7 7', plus: 'M12 5v14M5 12h14', file: 'M6 3h8l4 4v14H6zM14 3v4h4', move: 'M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3',
  mesh: 'M4 18 12 4l8 14zM8 11h8M12 18l-4-7M12 18l4-7',
  turn: 'M20 12a8 8 0 1 1-3-6M20 3v5h-5', draw: 'M4 17 10 7l10 0-6 10z', save: 'M12 4v11M8 11l4 4 4-4M4 20h16', colours: 'M12 3a9 9 0 1 0 0 18c2 0 2-2 1-3s0-3 2-3h3a3 3 0 0 0 3-3c0-5-4-9-9-9M8 10v.1M12 7v.1M16 10v.1',
};

export function icon(name: string): SVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg'), path = document.createElementNS(svg.namespaceURI, 'path');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('aria-hidden', 'true');
  path.setAttribute('d', strokes[name]);
  svg.append(path);
  return svg as SVGElement;
}

export function button(label: string, image: string | null, action: () => void, attributes: Attributes = {}, showLabel = image === null): HTMLButtonElement {
  return h('button', { type: 'button', title: label, 'aria-label': label, onclick: () => action(), ...attributes },
    image && icon(image), showLabel && h('span', { class: 'label' }, label));
}

export interface Entry { label: string; on: boolean; act: () => void; }

// A button that opens a list of choices.
export function menu(title: string, label: string, name: string, entries: Entry[]): HTMLElement {
  const opener = h('button', { type: 'button', class: 'quiet chooser', title, 'aria-label': `${title}: ${label}`, 'aria-haspopup': 'menu', 'aria-expanded': 'false', 'data-menu': name }, label);
  opener.addEventListener('click', () => {
    const list = h('div', { class: 'menu', role: 'menu', 'aria-label': title }), box = opener.getBoundingClientRect();
    const close = () => {
      list.remove();
      removeEventListener('pointerdown', outside, true);
      removeEventListener('keydown', keys, true);
    };
    const outside = (e: PointerEvent) => { if (!list.contains(e.target as Node)) close(); };
    const keys = (e: KeyboardEvent) => {
      const items = [...list.querySelectorAll('button')], at = items.indexOf(document.activeElement as HTMLButtonElement);
      if (e.key === 'Escape' || e.key === 'Tab') close();
      else if (e.key === 'ArrowDown') items[(at + 1) % items.length].focus();
      else if (e.key === 'ArrowUp') items[(at + items.length - 1) % items.length].focus();
      else return;
      e.preventDefault();
      e.stopPropagation();
    };
    for (const entry of entries) {
      list.append(h('button', { type: 'button', role: 'menuitemradio', 'aria-checked': String(entry.on), onclick: () => { close(); entry.act(); } }, entry.label));
    }
    document.body.append(list);
    list.style.top = `${box.bottom + 4}px`;
    list.style.left = `${Math.max(4, Math.min(box.left, innerWidth - list.offsetWidth - 8))}px`;
    addEventListener('pointerdown', outside, true);
    addEventListener('keydown', keys, true);
    (list.querySelector<HTMLElement>('[aria-checked=true]') ?? list.querySelector('button'))?.focus();
  });
  return opener;
}
