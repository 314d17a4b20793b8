// Colours of the elements: front and flipped, or a quantity as an overlay.
import type { Bender } from './bend';
import type { Geometry } from './geometry';

export type Overlay = 'none' | 'defect' | 'strain' | 'part';
export type Rgb = [number, number, number];

export interface Tints { front: Rgb; back: Rgb; chosen: Rgb; marked: Rgb; }

export const overlayLimits = { defect: 120, strain: 0.01 }; // degrees; relative

// Blue below zero, pale at zero, red above: readable with every kind of colour vision.
export function diverging(t: number): Rgb {
  const x = Math.max(-1, Math.min(1, t)), pale: Rgb = [0.93, 0.92, 0.9], end: Rgb = x < 0 ? [0.13, 0.4, 0.72] : [0.75, 0.2, 0.14];
  const s = Math.abs(x) ** 0.85;
  return [0, 1, 2].map(k => pale[k] + (end[k] - pale[k]) * s) as Rgb;
}

const palette: Rgb[] = [[0.9, 0.87, 0.8], [0.56, 0.72, 0.82], [0.87, 0.68, 0.5], [0.66, 0.76, 0.55], [0.8, 0.62, 0.72],
  [0.82, 0.8, 0.5], [0.6, 0.66, 0.8], [0.72, 0.58, 0.46]];

const linear = (c: number) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;

export function paint(g: Geometry, bender: Bender, overlay: Overlay, tints: Tints, chosen: Set<number>, marked: Set<number>,
  out: Float32Array): void {
  const n = bender.points, uv = bender.uv;
  const put = (to: number, c: Rgb) => { out[to] = linear(c[0]); out[to + 1] = linear(c[1]); out[to + 2] = linear(c[2]); };
  for (let f = 0; f < g.header.elements; ++f) {
    let flat: Rgb = g.facing[f] ? tints.back : tints.front;
    if (overlay === 'strain') flat = diverging(g.strains[f] / overlayLimits.strain);
    if (overlay === 'part') flat = palette[g.component[f] % palette.length];
    if (marked.has(f)) flat = tints.marked;
    else if (chosen.has(f)) flat = flat.map((c, k) => 0.55 * c + 0.45 * tints.chosen[k]) as Rgb;
    const step = g.facing[f] ? 3 : 1;
    const corner = [0, 1, 2, 3].map(k => g.defects[g.quads[4 * f + (g.first[f] + step * k) % 4]]);
    for (let i = 0, to = 3 * n * f; i < n; ++i, to += 3) {
      if (overlay !== 'defect' || marked.has(f)) {
        put(to, flat);
        continue;
      }
      const u = Math.min(1, Math.max(0, uv[2 * i])), v = Math.min(1, Math.max(0, uv[2 * i + 1]));
      const share = [(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v];
      let value = 0;
      for (let k = 0; k < 4; ++k) value += Number.isNaN(corner[k]) ? 0 : share[k] * corner[k];
      put(to, diverging(value / overlayLimits.defect));
    }
  }
}
