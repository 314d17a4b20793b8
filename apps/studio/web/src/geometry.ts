// Surfaces as the server sends them (server/geometry.h).

export interface Header {
  vertices: number;
  elements: number;
  components: string[];
  revision: number;
  periods?: number;
  settled?: boolean;
  reason?: string;
  work_ms?: number;
  cpu_ms?: number;
  candidates?: Candidate[];
  complete?: boolean;
}

export interface Candidate {
  removed: number;
  max_stretch: number;
  seam: number;
  min_defect_deg: number;
  max_defect_deg: number;
  distance_mm: number;
}

export interface Geometry {
  header: Header;
  positions: Float32Array;
  defects: Float32Array; // degrees, NaN on openings
  strains: Float32Array;
  quads: Int32Array;
  first: Int32Array;
  facing: Int32Array;
  component: Int32Array;
  part: Int32Array;
  opening: Int32Array;
  partStart: number[]; // first vertex of each part
  faceStart: number[]; // first element of each part
}

export function decode(bytes: ArrayBuffer): Geometry {
  const size = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size))) as Header;
  let at = 4 + size;
  const floats = (n: number) => { const a = new Float32Array(bytes, at, n); at += 4 * n; return a; };
  const ints = (n: number) => { const a = new Int32Array(bytes, at, n); at += 4 * n; return a; };
  const V = header.vertices, F = header.elements;
  const g = {
    header, positions: floats(3 * V), defects: floats(V), strains: floats(F), quads: ints(4 * F), first: ints(F),
    facing: ints(F), component: ints(F), part: ints(F), opening: ints(V),
  };
  const partStart: number[] = [], faceStart: number[] = [];
  for (let f = 0; f < F; ++f) {
    const p = g.part[f];
    faceStart[p] ??= f;
    for (let k = 0; k < 4; ++k) partStart[p] = Math.min(partStart[p] ?? V, g.quads[4 * f + k]);
  }
  return { ...g, partStart, faceStart };
}

export function vertexRange(g: Geometry, part: number): [number, number] {
  return [g.partStart[part], g.partStart[part + 1] ?? g.header.vertices];
}

export function partOfVertex(g: Geometry, v: number): number {
  let part = 0;
  while (part + 1 < g.partStart.length && g.partStart[part + 1] <= v) ++part;
  return part;
}

export interface Box { low: [number, number, number]; high: [number, number, number]; }

export function bounds(g: Geometry): Box | null {
  if (g.header.vertices === 0) return null;
  const low: Box['low'] = [Infinity, Infinity, Infinity], high: Box['high'] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < g.positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], g.positions[i]);
    high[i % 3] = Math.max(high[i % 3], g.positions[i]);
  }
  return { low, high };
}

// Unit normals of the vertices, outward: the sum of the corners' cross products.
export function vertexNormals(g: Geometry): Float32Array {
  const N = new Float32Array(g.positions.length), P = g.positions, Q = g.quads;
  for (let f = 0; f < g.header.elements; ++f) {
    for (let k = 0; k < 4; ++k) {
      const a = 3 * Q[4 * f + (k + 3) % 4], b = 3 * Q[4 * f + k], c = 3 * Q[4 * f + (k + 1) % 4];
      const ux = P[c] - P[b], uy = P[c + 1] - P[b + 1], uz = P[c + 2] - P[b + 2];
      const vx = P[a] - P[b], vy = P[a + 1] - P[b + 1], vz = P[a + 2] - P[b + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, l = Math.hypot(x, y, z) || 1;
      N[b] += x / l; N[b + 1] += y / l; N[b + 2] += z / l;
    }
  }
  for (let i = 0; i < N.length; i += 3) {
    const l = Math.hypot(N[i], N[i + 1], N[i + 2]) || 1;
    N[i] /= l; N[i + 1] /= l; N[i + 2] /= l;
  }
  return N;
}
