// The 3D view: draws geometry as bent elements, looks round, picks.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Bender, type Piece } from './bend';
import { paint, type Overlay, type Rgb, type Tints } from './colours';
import { bounds, vertexNormals, type Geometry } from './geometry';

export interface Pick { face: number; vertex: number; point: THREE.Vector3; }

interface Theme { top: string; bottom: string; line: string; grid: string; tints: Tints; }

const themes: Record<'light' | 'dark', Theme> = {
  light: { top: '#e9ebee', bottom: '#c9ced5', line: '#6d655a', grid: '#9aa3ae',
    tints: { front: [0.95, 0.92, 0.86], back: [0.93, 0.69, 0.48], chosen: [0.2, 0.5, 0.95], marked: [0.85, 0.2, 0.15] } },
  dark: { top: '#33363d', bottom: '#1a1c20', line: '#4a443c', grid: '#5b626c',
    tints: { front: [0.93, 0.9, 0.84], back: [0.89, 0.62, 0.4], chosen: [0.3, 0.6, 1], marked: [0.9, 0.3, 0.22] } },
};

function sameNumbers(a: Int32Array, b: Int32Array): boolean {
  return a.length === b.length && a.every((x, k) => x === b[k]);
}

function keepRecent(times: number[], ms: number): void {
  times.push(ms);
  if (times.length > 4000) times.splice(0, 2000);
}

export class View {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(30, 1, 1, 1e5);
  readonly renderer: THREE.WebGLRenderer;
  readonly orbit: OrbitControls;
  readonly timing = { bend: [] as number[], draw: [] as number[] }; // ms of this page per frame
  overlay: Overlay = 'none';
  shown: Geometry | null = null;
  chosen = new Set<number>();
  marked = new Set<number>();
  onFrame: (() => void)[] = [];
  private bender: Bender | null = null;
  private mesh = new THREE.Mesh(new THREE.BufferGeometry(),
    new THREE.MeshStandardMaterial({ vertexColors: true, side: THREE.DoubleSide, roughness: 0.72, metalness: 0 }));
  private rims = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.75 }));
  private ghost = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x3b82f6, transparent: true, opacity: 0.9 }));
  private dot = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.MeshBasicMaterial({ color: 0x2f6fed, depthTest: false, transparent: true, opacity: 0.92 }));
  private arrow = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x2f6fed, depthTest: false, transparent: true }));
  private grid = new THREE.GridHelper(4000, 40);
  private plane = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({ color: 0x3b82f6, transparent: true, opacity: 0.06, side: THREE.DoubleSide, depthWrite: false }));
  private tints = themes.light.tints;
  private dirty = true;
  private touched = -1;
  private radius = 200;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(620, -820, 480);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.orbit.dampingFactor = 0.16;
    this.orbit.zoomToCursor = true;
    this.orbit.addEventListener('change', () => this.render());
    this.scene.add(new THREE.HemisphereLight(0xf6f8ff, 0x9a8c7c, 2.0));
    const key = new THREE.DirectionalLight(0xfff4e4, 2.1), fill = new THREE.DirectionalLight(0xe2ebff, 0.6);
    this.camera.add(key, key.target, fill, fill.target);
    key.position.set(0.5, 0.8, 0.6);
    fill.position.set(-0.9, -0.1, 0.3);
    this.grid.rotation.x = Math.PI / 2;
    this.dot.renderOrder = this.arrow.renderOrder = 10;
    this.dot.visible = this.arrow.visible = this.ghost.visible = this.plane.visible = false;
    this.mesh.visible = this.rims.visible = false; // without normals the material would be compiled for flat facets
    this.mesh.frustumCulled = this.rims.frustumCulled = this.ghost.frustumCulled = this.arrow.frustumCulled = false;
    (this.mesh.material as THREE.Material).polygonOffset = true;
    (this.mesh.material as THREE.Material).polygonOffsetFactor = 1;
    (this.mesh.material as THREE.Material).polygonOffsetUnits = 2;
    this.scene.add(this.camera, this.grid, this.mesh, this.rims, this.ghost, this.plane, this.dot, this.arrow);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.setTheme('light');
    const loop = () => {
      requestAnimationFrame(loop);
      if (this.orbit.enableDamping) this.orbit.update();
      if (this.dirty) this.draw();
    };
    loop();
  }

  setTheme(name: 'light' | 'dark'): void {
    const theme = themes[name];
    this.tints = theme.tints;
    const size = 64, canvas = document.createElement('canvas');
    canvas.width = 2;
    canvas.height = size;
    const context = canvas.getContext('2d')!, gradient = context.createLinearGradient(0, 0, 0, size);
    gradient.addColorStop(0, theme.top);
    gradient.addColorStop(1, theme.bottom);
    context.fillStyle = gradient;
    context.fillRect(0, 0, 2, size);
    const texture = new THREE.CanvasTexture(canvas);
    texture.colorSpace = THREE.SRGBColorSpace;
    this.scene.background = texture;
    (this.rims.material as THREE.LineBasicMaterial).color.set(theme.line);
    const material = this.grid.material as THREE.LineBasicMaterial;
    material.vertexColors = false;
    material.color.set(theme.grid);
    material.transparent = true;
    material.opacity = 0.28;
    material.depthWrite = false;
    material.needsUpdate = true;
    this.repaint();
  }

  setPiece(piece: Piece): void {
    this.bender = new Bender(piece);
    this.allocate(0);
    this.dot.userData.size = piece.la_mm;
    if (this.shown) this.show(this.shown);
  }

  // Elements drawn as `geometry` until the next call.
  show(geometry: Geometry): void {
    const began = performance.now();
    this.shown = geometry;
    if (!this.bender) return;
    const F = geometry.header.elements;
    this.allocate(F);
    const position = this.mesh.geometry.getAttribute('position') as THREE.BufferAttribute;
    const normal = this.mesh.geometry.getAttribute('normal') as THREE.BufferAttribute;
    this.bender.bend(geometry, { positions: position.array as Float32Array, normals: normal.array as Float32Array });
    position.needsUpdate = normal.needsUpdate = true;
    this.mesh.geometry.setDrawRange(0, F * this.bender.indices.length);
    this.rims.geometry.setDrawRange(0, F * 2 * this.bender.rim);
    const painted = JSON.stringify([F, this.overlay]);
    if (this.overlay === 'defect' || this.overlay === 'strain' || painted !== this.painted || !sameNumbers(geometry.facing, this.paintedFacing)) this.repaint();
    this.render();
    keepRecent(this.timing.bend, performance.now() - began);
  }

  private painted = '';
  private paintedFacing: Int32Array = new Int32Array(0);

  repaint(): void {
    if (this.bender && this.shown && this.capacity >= this.shown.header.elements && this.capacity > 0) {
      this.painted = JSON.stringify([this.shown.header.elements, this.overlay]);
      this.paintedFacing = this.shown.facing;
      const colour = this.mesh.geometry.getAttribute('color') as THREE.BufferAttribute;
      paint(this.shown, this.bender, this.overlay, this.tints, this.chosen, this.marked, colour.array as Float32Array);
      colour.needsUpdate = true;
    }
    this.render();
  }

  private capacity = 0;

  // Buffers for at least so many elements; kept while dragging.
  private allocate(elements: number): void {
    if (!this.bender || (elements <= this.capacity && elements > 0 && this.mesh.geometry.hasAttribute('position'))) return;
    const count = Math.max(64, Math.ceil(elements * 1.3)), n = this.bender.points, rim = this.bender.rim;
    this.capacity = count;
    this.painted = ''; // the new colours are all black
    const geometry = new THREE.BufferGeometry(), attribute = () => {
      const a = new THREE.BufferAttribute(new Float32Array(3 * n * count), 3);
      a.setUsage(THREE.DynamicDrawUsage);
      return a;
    };
    const position = attribute();
    geometry.setAttribute('position', position);
    geometry.setAttribute('normal', attribute());
    geometry.setAttribute('color', attribute());
    const one = this.bender.indices, index = new Uint32Array(one.length * count), lines = new Uint32Array(2 * rim * count);
    for (let f = 0; f < count; ++f) {
      for (let k = 0; k < one.length; ++k) index[one.length * f + k] = one[k] + n * f;
      for (let k = 0; k < rim; ++k) {
        lines[2 * (rim * f + k)] = n * f + k;
        lines[2 * (rim * f + k) + 1] = n * f + (k + 1) % rim;
      }
    }
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    const rims = new THREE.BufferGeometry();
    rims.setAttribute('position', position);
    rims.setIndex(new THREE.BufferAttribute(lines, 1));
    this.mesh.geometry.dispose();
    this.rims.geometry.dispose();
    this.mesh.geometry = geometry;
    this.rims.geometry = rims;
    this.mesh.visible = this.rims.visible = true;
    geometry.setDrawRange(0, 0);
    rims.setDrawRange(0, 0);
  }

  // The edges of some elements as a wire frame: where a part would be.
  showGhost(g: Geometry | null, part = -1): void {
    this.ghost.visible = g !== null;
    if (g) {
      const points: number[] = [];
      for (let f = 0; f < g.header.elements; ++f) {
        if (part >= 0 && g.part[f] !== part) continue;
        for (let k = 0; k < 4; ++k) {
          for (const v of [g.quads[4 * f + k], g.quads[4 * f + (k + 1) % 4]]) points.push(...g.positions.subarray(3 * v, 3 * v + 3));
        }
      }
      this.ghost.geometry.dispose();
      this.ghost.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    }
    this.render();
  }

  showDot(at: THREE.Vector3 | null, to: THREE.Vector3 | null = null): void {
    this.dot.visible = at !== null;
    this.arrow.visible = at !== null && to !== null;
    if (at) this.dot.position.copy(to ?? at);
    if (at && to) this.arrow.geometry.setFromPoints([at, to]);
    this.render();
  }

  // The plane of a mirror, or null.
  showPlane(normal: THREE.Vector3 | null, through = new THREE.Vector3()): void {
    this.plane.visible = normal !== null;
    if (normal) {
      this.plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal.clone().normalize());
      const centre = this.centre();
      const n = normal.clone().normalize();
      this.plane.position.copy(centre).addScaledVector(n, through.clone().sub(centre).dot(n));
      this.plane.scale.setScalar(this.radius * 2.3);
    }
    this.render();
  }

  centre(): THREE.Vector3 {
    const box = this.shown && bounds(this.shown);
    return box ? new THREE.Vector3(...box.low).add(new THREE.Vector3(...box.high)).multiplyScalar(0.5) : new THREE.Vector3();
  }

  // Move the camera so that everything is seen; the direction stays.
  fit(): void {
    const box = this.shown && bounds(this.shown);
    const low = new THREE.Vector3(...(box?.low ?? [-150, -150, -150])), high = new THREE.Vector3(...(box?.high ?? [150, 150, 150]));
    this.radius = Math.max(60, low.distanceTo(high) / 2);
    const centre = low.clone().add(high).multiplyScalar(0.5);
    const way = this.camera.position.clone().sub(this.orbit.target).normalize();
    const free = { across: 1 - this.covered.left, down: 1 - this.covered.top };
    const half = Math.atan(Math.tan(this.camera.fov * Math.PI / 360) * Math.min(free.down, this.camera.aspect * free.across));
    this.orbit.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(way, this.radius / Math.sin(half) * 1.08);
    this.grid.position.set(0, 0, box ? low.z : -150);
    this.orbit.update();
    this.render();
  }

  look(direction: [number, number, number]): void {
    const distance = this.camera.position.distanceTo(this.orbit.target);
    this.camera.position.copy(this.orbit.target).addScaledVector(new THREE.Vector3(...direction).normalize(), distance);
    this.fit();
  }

  private covered = { left: 0, top: 0 };

  // The shares of the view, on the left and at the top, that something else covers: the scene moves out of the way.
  cover(left: number, top: number): void {
    this.covered = { left, top };
    this.uncover();
    this.render();
  }

  private uncover(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas.parentElement!, { left, top } = this.covered;
    if (left > 0 || top > 0) this.camera.setViewOffset(w, h, -w * left / 2, -h * top / 2, w, h);
    else this.camera.clearViewOffset();
  }

  // Where the camera stands; the function that is returned brings it back.
  remember(): () => void {
    const position = this.camera.position.clone(), target = this.orbit.target.clone(), floor = this.grid.position.z, { radius } = this;
    return () => {
      this.camera.position.copy(position);
      this.orbit.target.copy(target);
      this.grid.position.z = floor;
      this.radius = radius;
      this.orbit.update();
      this.render();
    };
  }

  settleGrid(): void {
    const box = this.shown && bounds(this.shown);
    if (box) this.grid.position.z = box.low[2];
    this.radius = Math.max(60, box ? new THREE.Vector3(...box.low).distanceTo(new THREE.Vector3(...box.high)) / 2 : 200);
  }

  render(): void {
    this.dirty = true;
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas.parentElement!;
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / Math.max(1, h);
    this.uncover();
    this.camera.updateProjectionMatrix();
    this.render();
  }

  private draw(): void {
    const began = performance.now();
    this.dirty = false;
    const distance = this.camera.position.distanceTo(this.orbit.target);
    this.camera.near = Math.max(1, distance / 100);
    this.camera.far = distance * 20 + 8000;
    this.camera.updateProjectionMatrix();
    this.dot.scale.setScalar(this.camera.position.distanceTo(this.dot.position) * 0.0065 + 1);
    for (const f of this.onFrame) f();
    this.renderer.render(this.scene, this.camera);
    keepRecent(this.timing.draw, performance.now() - began);
  }

  // Screen positions, in pixels of the page.
  project(p: THREE.Vector3): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect(), q = p.clone().project(this.camera);
    return { x: box.left + (q.x + 1) / 2 * box.width, y: box.top + (1 - q.y) / 2 * box.height };
  }

  ray(x: number, y: number): THREE.Ray {
    const box = this.canvas.getBoundingClientRect(), caster = new THREE.Raycaster();
    this.camera.updateMatrixWorld();
    caster.setFromCamera(new THREE.Vector2(2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height), this.camera);
    return caster.ray;
  }

  vertex(v: number, g = this.shown!): THREE.Vector3 {
    return new THREE.Vector3().fromArray(g.positions, 3 * v);
  }

  normal(v: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(vertexNormals(this.shown!), 3 * v);
  }

  // The element under the pointer and the nearest of its corners on the screen.
  pick(x: number, y: number): Pick | null {
    const g = this.shown;
    if (!g || g.header.elements === 0) return null;
    const ray = this.ray(x, y), corner = [0, 1, 2, 3].map(() => new THREE.Vector3()), hit = new THREE.Vector3();
    let best: Pick | null = null, nearest = Infinity;
    for (let f = 0; f < g.header.elements; ++f) {
      for (let k = 0; k < 4; ++k) corner[k].fromArray(g.positions, 3 * g.quads[4 * f + k]);
      for (const [a, b, c] of [[0, 1, 2], [0, 2, 3]]) {
        if (!ray.intersectTriangle(corner[a], corner[b], corner[c], false, hit)) continue;
        const d = hit.distanceTo(ray.origin);
        if (d < nearest) {
          nearest = d;
          best = { face: f, vertex: -1, point: hit.clone() };
        }
      }
    }
    if (!best) return null;
    let closest = Infinity;
    for (let k = 0; k < 4; ++k) {
      const v = g.quads[4 * best.face + k], p = this.project(this.vertex(v)), d = Math.hypot(p.x - x, p.y - y);
      if (d < closest) {
        closest = d;
        best.vertex = v;
      }
    }
    return best;
  }

  // The nearest vertex on the screen within `reach` pixels that faces the camera; for vertices on the outline.
  pickVertex(x: number, y: number, reach: number): number {
    const hit = this.pick(x, y);
    if (hit) return hit.vertex;
    const g = this.shown;
    let best = -1, closest = reach;
    for (let v = 0; g && v < g.header.vertices; ++v) {
      const p = this.project(this.vertex(v)), d = Math.hypot(p.x - x, p.y - y);
      if (d < closest) {
        closest = d;
        best = v;
      }
    }
    return best;
  }

  // Where the pointer is on the plane through `through` that faces the camera.
  onPlane(x: number, y: number, through: THREE.Vector3): THREE.Vector3 {
    const normal = this.camera.getWorldDirection(new THREE.Vector3());
    const hit = this.ray(x, y).intersectPlane(new THREE.Plane().setFromNormalAndCoplanarPoint(normal, through), new THREE.Vector3());
    return hit ?? through.clone();
  }

  hover(vertex: number): void {
    if (vertex === this.touched && this.dot.visible === vertex >= 0) return;
    this.touched = vertex;
    this.showDot(vertex >= 0 ? this.vertex(vertex) : null);
  }
}

export type { Rgb };
