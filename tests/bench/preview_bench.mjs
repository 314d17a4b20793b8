// usage: node preview_bench.mjs PROGRAM BENCH_PREVIEW DESIGN...   (first: npm ci in this folder)
// preview.glb against the optimisers of preview-plain.glb: element names kept, largest position error at most 0.05 mm.
// What "encoded" measures, best of five each: ours inside the process, from the bent elements in memory to the bytes of
// preview.glb (bench_preview; reading them back to measure the error stands apart, for no rival does that); theirs the
// whole process, from file to file as a person calls it, and in brackets without its start, which is the time of a call
// that only prints the version.
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const [program, bench, ...designs] = process.argv.slice(2);
const bin = path.join(path.dirname(fileURLToPath(import.meta.url)), 'node_modules', '.bin');
const tolerance = 0.05e-3;

function timed(command, args, allowed = [0]) {
  let best = Infinity;
  for (let run = 0; run < 5; ++run) {
    const start = process.hrtime.bigint();
    const { status } = spawnSync(command, args, { stdio: 'ignore' });
    best = Math.min(best, Number(process.hrtime.bigint() - start) / 1e9);
    if (!allowed.includes(status)) throw new Error(`exit code ${status}`);
  }
  return best;
}

function document_of(file) {
  const bytes = fs.readFileSync(file);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
}

// The widest mesh decides the bits, as for our own files.
function bits_for(file) {
  const json = document_of(file);
  const extents = json.meshes.flatMap(m => m.primitives).map(p => json.accessors[p.attributes.POSITION]).map(a => Math.max(...a.max.map((v, k) => v - a.min[k])));
  return Math.ceil(Math.log2(Math.max(...extents) * Math.sqrt(3) / (2 * tolerance) + 1));
}

for (const design of designs) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'preview-bench-'));
  execFileSync(program, ['fabricate', design, '-o', path.join(folder, 'kit'), '--only', 'preview'], { stdio: 'ignore' });
  const seconds = JSON.parse(execFileSync(bench, [design]));
  const size = fs.statSync(path.join(folder, 'kit', 'preview.glb')).size;
  const plain = path.join(folder, 'kit', 'preview-plain.glb'), out = path.join(folder, 'out.glb');
  const bits = String(bits_for(plain)), wide = String(Math.min(16, +bits + 3));
  const count = document_of(plain).nodes.length;
  console.log(`${path.basename(design)}: ${count} elements, preview-plain.glb ${fs.statSync(plain).size} bytes; ${bits} bits per coordinate and element`);
  console.log(`  ${'rhombloom'.padEnd(26)} ${String(size).padStart(9)} bytes ${seconds.encode.toFixed(3).padStart(7)} s   (read back and measured in ${seconds.check.toFixed(3)} s more; all preview files ${seconds.all.toFixed(2)} s)`);
  const rivals = [
    ['gltf-transform draco', 'gltf-transform', ['draco', plain, out, '--quantize-position', bits, '--quantize-normal', '8', '--encode-speed', '0', '--decode-speed', '0']],
    ['gltf-transform meshopt', 'gltf-transform', ['meshopt', plain, out, '--level', 'high', '--quantize-position', bits, '--quantize-normal', '8']],
    ['gltfpack -cc -kn -ke', 'gltfpack', ['-i', plain, '-o', out, '-cc', '-kn', '-ke', '-vp', wide, '-vn', '8']],
    ['gltf-pipeline -d', 'gltf-pipeline', ['-i', plain, '-o', out, '-d', '--draco.compressionLevel', '10', '--draco.quantizePositionBits', bits, '--draco.quantizeNormalBits', '8']],
  ];
  for (const [name, tool, args] of rivals) {
    let line;
    try {
      const time = timed(path.join(bin, tool), args);
      const start = timed(path.join(bin, tool), [tool === 'gltfpack' ? '-h' : '--version'], [0, 1]);
      const bytes = fs.statSync(out).size;
      line = `${String(bytes).padStart(9)} bytes ${time.toFixed(3).padStart(7)} s   ${(bytes / size).toFixed(1)} x the size, ${(time / seconds.encode).toFixed(1)} x the time (${((time - start) / seconds.encode).toFixed(1)} x without its start of ${start.toFixed(2)} s)`;
      fs.rmSync(out);
    } catch (error) {
      line = 'failed: ' + String(error.message).split('\n')[0];
    }
    console.log('  ' + name.padEnd(26) + ' ' + line);
  }
  fs.rmSync(folder, { recursive: true });
}
