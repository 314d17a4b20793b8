// usage: gltf_check.mjs KIT: is what stands in preview.glb and preview-plain.glb what other programs see?
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import validator from 'gltf-validator';
import draco3d from 'draco3dgltf';
import { NodeIO } from '@gltf-transform/core';
import { KHRDracoMeshCompression, KHRMeshQuantization } from '@gltf-transform/extensions';
import { expect, finish, open_browser } from './chromium.mjs';

const kit = process.argv[2];
const read = name => fs.readFileSync(path.join(kit, name));
const tolerance_mm = 0.05;

for (const name of ['preview.glb', 'preview-plain.glb']) {
  const { issues } = await validator.validateBytes(new Uint8Array(read(name)), { maxIssues: 0 });
  console.log(`  ${name}: ${read(name).length} bytes, gltf-validator ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
  expect(issues.numErrors === 0 && issues.numWarnings === 0, JSON.stringify(issues.messages.filter(m => m.severity < 2).slice(0, 5)));
}

// A second decoder: draco3dgltf, and glTF's own rules for morph targets and nodes.
const io = new NodeIO().registerExtensions([KHRDracoMeshCompression, KHRMeshQuantization])
  .registerDependencies({ 'draco3d.decoder': await draco3d.createDecoderModule() });

function world_points(node, primitive) {
  const m = node.getWorldMatrix(), position = primitive.getAttribute('POSITION'), weights = node.getWeights();
  const points = [], p = [], d = [];
  for (let i = 0; i < position.getCount(); ++i) {
    position.getElement(i, p);
    primitive.listTargets().forEach((target, k) => {
      if (weights[k]) {
        target.getAttribute('POSITION').getElement(i, d);
        for (let r = 0; r < 3; ++r) p[r] += weights[k] * d[r];
      }
    });
    points.push([0, 1, 2].map(r => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]));
  }
  return points;
}

// Element name -> its points and extras, for either way of storing elements.
async function elements_of(name) {
  const root = (await io.readBinary(new Uint8Array(read(name)))).getRoot();
  const found = new Map();
  const nodes = [];
  root.getDefaultScene().traverse(node => nodes.push(node)); // not the target of an import, which has a scene of its own
  for (const node of nodes.filter(n => n.getMesh())) {
    for (const primitive of node.getMesh().listPrimitives()) {
      const points = world_points(node, primitive), ids = primitive.getAttribute('_ELEMENT_ID');
      if (!ids) {
        const group = node.getParentNode() ? node.getParentNode().getExtras() : {};
        found.set(node.getName(), { points, extras: { ...group, ...node.getExtras() } });
        continue;
      }
      const table = node.getExtras();
      points.forEach((p, i) => {
        const e = ids.getScalar(i), key = table.names[e];
        if (!found.has(key)) found.set(key, { points: [], extras: { step: table.steps[e], side: table.flipped.includes(e) ? 'back' : 'front', component: table.components[table.component[e]] } });
        found.get(key).points.push(p);
      });
    }
  }
  return found;
}

function farthest(from, to) {
  let worst = 0;
  for (const a of from) {
    let best = Infinity;
    for (const b of to) best = Math.min(best, (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2);
    worst = Math.max(worst, best);
  }
  return Math.sqrt(worst) * 1000;
}

const plain = await elements_of('preview-plain.glb'), small = await elements_of('preview.glb');
let worst = 0;
for (const [name, element] of plain) {
  const other = small.get(name);
  expect(other, name + ' is missing in preview.glb');
  if (!other) continue;
  for (const key of ['step', 'side', 'component']) expect(other.extras[key] === element.extras[key] && element.extras[key] !== undefined, `${name}: ${key}`);
  worst = Math.max(worst, farthest(other.points, element.points), farthest(element.points, other.points));
}
console.log(`  ${plain.size} elements decoded by draco3dgltf: largest distance ${worst.toFixed(4)} mm`);
expect(plain.size > 0 && small.size === plain.size, 'the same elements');
expect(worst <= tolerance_mm, `decoded points within ${tolerance_mm} mm`);

// three.js: the same silhouette as our own picture. Files are served by the browser's request hook, not by a network.
const three = path.dirname(path.dirname(createRequire(import.meta.url).resolve('three')));
const browser = await open_browser();
const page = await browser.newPage({ viewport: { width: 800, height: 800 } });
page.on('console', m => expect(m.type() !== 'error', 'console: ' + m.text()));
page.on('pageerror', e => expect(false, 'page: ' + e.message));
await page.route('**/*', route => {
  const where = new URL(route.request().url()).pathname;
  if (where === '/') return route.fulfill({ contentType: 'text/html', body: '<script type="importmap">{"imports":{"three":"/three/build/three.module.js"}}</script>' });
  const file = where.startsWith('/three/') ? path.join(three, where.slice(7)) : path.join(kit, where);
  if (!fs.existsSync(file)) return route.fulfill({ status: where.endsWith('favicon.ico') ? 204 : 404 });
  const type = file.endsWith('.js') ? 'text/javascript' : file.endsWith('.wasm') ? 'application/wasm' : 'application/octet-stream';
  return route.fulfill({ contentType: type, body: fs.readFileSync(file) });
});
await page.goto('http://localhost/');
for (const name of ['preview.glb', 'preview-plain.glb']) {
  const overlap = await page.evaluate(async name => {
    const THREE = await import('three');
    const { GLTFLoader } = await import('/three/examples/jsm/loaders/GLTFLoader.js');
    const { DRACOLoader } = await import('/three/examples/jsm/loaders/DRACOLoader.js');
    const loader = new GLTFLoader().setDRACOLoader(new DRACOLoader().setDecoderPath('/three/examples/jsm/libs/draco/gltf/'));
    const { scene } = await loader.loadAsync('/' + name);
    scene.updateMatrixWorld(true);
    const points = [];
    scene.traverse(o => {
      if (!o.isMesh) return;
      o.material = new THREE.MeshBasicMaterial({ color: 0xffffff, side: THREE.DoubleSide });
      o.frustumCulled = false;
      const count = o.geometry.attributes.position.count;
      for (let i = 0; i < count; ++i) points.push(o.getVertexPosition(i, new THREE.Vector3()).applyMatrix4(o.matrixWorld));
    });
    // The thumbnail's camera (thumbnail.h), from the points alone; its z is glTF's y.
    const picture = await createImageBitmap(await (await fetch('/thumbnail.png')).blob()), size = picture.width;
    const back = new THREE.Vector3(0.75, 0.55, 1).normalize(), right = new THREE.Vector3(0, 1, 0).cross(back).normalize();
    const up = back.clone().cross(right), centre = new THREE.Box3().setFromPoints(points).getCenter(new THREE.Vector3());
    const tangent = Math.tan(12 * Math.PI / 180) * 0.88;
    let distance = 0;
    for (const p of points) {
      const r = p.clone().sub(centre);
      distance = Math.max(distance, Math.max(Math.abs(r.dot(right)), Math.abs(r.dot(up))) / tangent + r.dot(back));
    }
    const camera = new THREE.PerspectiveCamera(24, 1, distance / 50, distance * 10);
    camera.position.copy(centre).addScaledVector(back, distance);
    camera.lookAt(centre);
    const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
    renderer.setSize(size, size, false);
    renderer.render(scene, camera);
    const pixels = source => {
      const canvas = new OffscreenCanvas(size, size), c = canvas.getContext('2d', { willReadFrequently: true });
      c.drawImage(source, 0, 0);
      return c.getImageData(0, 0, size, size).data;
    };
    const seen = pixels(renderer.domElement), ours = pixels(picture);
    // The picture's backdrop is a spot of light (thumbnail.cpp): what differs from it belongs to the elements.
    const encode = v => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
    const soft = v => v < 0.7 ? v : 0.7 + 0.3 * (1 - Math.exp(-(v - 0.7) / 0.3));
    let both = 0, any = 0;
    for (let y = 0; y < size; ++y) for (let x = 0; x < size; ++x) {
      const i = 4 * (y * size + x), spot = Math.exp(-4 * (((x + .5) / size - .5) ** 2 + ((y + .5) / size - .46) ** 2));
      const wall = [.40 + spot * .40, .42 + spot * .39, .45 + spot * .38].map(v => encode(soft(v)));
      const a = seen[i] > 127, b = wall.some((w, k) => Math.abs(w - ours[i + k]) > 4);
      both += a && b;
      any += a || b;
    }
    return both / any;
  }, name);
  console.log(`  ${name} in three.js: silhouette overlap with the thumbnail ${overlap.toFixed(4)}`);
  expect(overlap >= 0.97, name + ': silhouette overlap of at least 0.97');
}
await browser.close();
finish();
