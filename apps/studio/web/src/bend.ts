// Bent elements for the screen: the piece's outline on a smooth patch through the four corners. The edges are cubics
// that leave every vertex in its tangent plane, so neighbours share them; each point of the piece is a fixed mixture of
// the patch's twelve control points. Exact bending is the kit's business; this costs a millisecond per hundred elements.
import { vertexNormals, type Geometry } from './geometry';

export interface Piece {
  points: number[]; // u, v of each point; v0 (0, 0), v1 (1, 0), v2 (1, 1), v3 (0, 1)
  rim: number;
  triangles: number[];
  la_mm: number;
  lb_mm: number;
  alpha_deg: number;
  thickness_mm: number;
}

export interface Bent {
  positions: Float32Array;
  normals: Float32Array;
}

const controls = 12;

// Weights of the control points at (u, v): corners v0..v3, then two on each edge v0-v1, v1-v2, v3-v2, v0-v3.
function weights(u: number, v: number): number[] {
  const b = (t: number) => [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3];
  const w = new Array<number>(controls).fill(0);
  const U = b(u), V = b(v);
  const curve = (from: number, to: number, edge: number, B: number[], share: number) => {
    w[from] += share * B[0]; w[4 + 2 * edge] += share * B[1]; w[5 + 2 * edge] += share * B[2]; w[to] += share * B[3];
  };
  curve(0, 1, 0, U, 1 - v);
  curve(3, 2, 2, U, v);
  curve(0, 3, 3, V, 1 - u);
  curve(1, 2, 1, V, u);
  w[0] -= (1 - u) * (1 - v); w[1] -= u * (1 - v); w[2] -= u * v; w[3] -= (1 - u) * v;
  return w;
}

export class Bender {
  readonly points: number;
  readonly uv: Float32Array;
  readonly indices: Uint32Array;
  readonly rim: number;
  private readonly mix: Float32Array;
  private readonly alongU: Float32Array;
  private readonly alongV: Float32Array;
  private readonly lift: Float32Array;

  constructor(readonly piece: Piece) {
    const n = this.points = piece.points.length / 2;
    this.rim = piece.rim;
    this.uv = new Float32Array(piece.points);
    this.indices = new Uint32Array(piece.triangles);
    this.mix = new Float32Array(controls * n);
    this.alongU = new Float32Array(controls * n);
    this.alongV = new Float32Array(controls * n);
    this.lift = new Float32Array(n);
    const step = 1e-3;
    for (let i = 0; i < n; ++i) {
      const u = this.uv[2 * i], v = this.uv[2 * i + 1];
      this.mix.set(weights(u, v), controls * i);
      const cu = Math.min(1, Math.max(0, u)), cv = Math.min(1, Math.max(0, v));
      const difference = (du: number, dv: number) => {
        const a = weights(cu + du, cv + dv), b = weights(cu - du, cv - dv);
        return a.map((x, k) => (x - b[k]) / (2 * step));
      };
      this.alongU.set(difference(step, 0), controls * i);
      this.alongV.set(difference(0, step), controls * i);
      // Fingers lie on the neighbour's outside.
      const outside = Math.max(0, -u * piece.lb_mm, (u - 1) * piece.lb_mm, -v * piece.la_mm, (v - 1) * piece.la_mm);
      this.lift[i] = Math.min(outside * 0.4, Math.max(1.2, 2 * piece.thickness_mm));
    }
  }

  private readonly control = new Float32Array(3 * controls);

  private setControls(g: Geometry, N: Float32Array, f: number): void {
    const C = this.control, P = g.positions, first = g.first[f], step = g.facing[f] ? 3 : 1;
    const corner = (k: number) => 3 * g.quads[4 * f + (first + step * k) % 4];
    for (let k = 0; k < 4; ++k) for (let r = 0; r < 3; ++r) C[3 * k + r] = P[corner(k) + r];
    const edges = [[0, 1], [1, 2], [3, 2], [0, 3]];
    for (let e = 0; e < 4; ++e) {
      for (let end = 0; end < 2; ++end) {
        const a = edges[e][end], b = edges[e][1 - end], at = corner(a), to = 3 * (4 + 2 * e + end);
        const x = C[3 * b] - C[3 * a], y = C[3 * b + 1] - C[3 * a + 1], z = C[3 * b + 2] - C[3 * a + 2];
        const d = x * N[at] + y * N[at + 1] + z * N[at + 2];
        C[to] = C[3 * a] + (x - d * N[at]) / 3;
        C[to + 1] = C[3 * a + 1] + (y - d * N[at + 1]) / 3;
        C[to + 2] = C[3 * a + 2] + (z - d * N[at + 2]) / 3;
      }
    }
  }

  // Has element f moved by more than can be seen since it was bent last?
  private moved(at: number, facing: number): boolean {
    const C = this.control, B = this.before;
    let same = B[at + 3 * controls] === facing;
    for (let k = 0; same && k < 3 * controls; ++k) same = Math.abs(B[at + k] - C[k]) < 0.02;
    if (!same) {
      B.set(C, at);
      B[at + 3 * controls] = facing;
    }
    return !same;
  }

  private before = new Float32Array(0); // control points of every element as they were bent last
  private target: Float32Array | null = null;

  // Points of all elements, one after the other; elements that have not moved are left as they are.
  bend(g: Geometry, out: Bent): void {
    const N = vertexNormals(g), C = this.control, n = this.points, size = 3 * controls + 1;
    const { mix, alongU, alongV, lift } = this;
    if (this.target !== out.positions) {
      this.target = out.positions;
      this.before = new Float32Array(size * (out.positions.length / (3 * n))).fill(NaN);
    }
    for (let f = 0; f < g.header.elements; ++f) {
      this.setControls(g, N, f);
      if (!this.moved(f * size, g.facing[f])) continue;
      const side = g.facing[f] ? -1 : 1;
      for (let i = 0, to = 3 * n * f; i < n; ++i, to += 3) {
        let x = 0, y = 0, z = 0, ux = 0, uy = 0, uz = 0, vx = 0, vy = 0, vz = 0;
        for (let k = 0, w = controls * i, c = 0; k < controls; ++k, ++w, c += 3) {
          const cx = C[c], cy = C[c + 1], cz = C[c + 2], m = mix[w], a = alongU[w], b = alongV[w];
          x += m * cx; y += m * cy; z += m * cz;
          ux += a * cx; uy += a * cy; uz += a * cz;
          vx += b * cx; vy += b * cy; vz += b * cz;
        }
        let nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const l = side / (Math.sqrt(nx * nx + ny * ny + nz * nz) || 1), h = lift[i];
        nx *= l; ny *= l; nz *= l;
        out.positions[to] = x + h * nx; out.positions[to + 1] = y + h * ny; out.positions[to + 2] = z + h * nz;
        out.normals[to] = nx; out.normals[to + 1] = ny; out.normals[to + 2] = nz;
      }
    }
  }
}
