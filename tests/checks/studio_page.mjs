// A person's hands in the studio: the mouse, and eyes for what is where.
import { expect, open_browser } from './chromium.mjs';

export async function open_studio(address, options = {}) {
  const browser = options.browser ?? await open_browser();
  const page = await browser.newPage({ viewport: { width: 1400, height: 860 }, reducedMotion: 'reduce', ...options.page });
  page.setDefaultTimeout(120000);
  page.on('console', m => expect(!['error', 'warning'].includes(m.type()) || /409|422|GL Driver/.test(m.text()), 'console: ' + m.text()));
  page.on('pageerror', e => expect(false, 'page: ' + e.message));
  page.on('request', r => expect(r.url().startsWith('blob:') || r.url().startsWith(address.replace(/#.*/, '')), 'request: ' + r.url()));
  await page.goto(address, { timeout: 120000 });
  await ready(page);
  return { browser, page };
}

export async function ready(page) {
  await page.waitForFunction(() => window.studio?.store.state && document.querySelector('.shape'), null, { timeout: 120000 });
  await idle(page);
}

export async function idle(page) {
  await page.waitForFunction(() => window.studio.store.busy === 0, null, { timeout: 120000 });
}

export const state = page => page.evaluate(() => window.studio.store.state);

// Drag from one point of the page to another.
export async function drag(page, from, to, steps = 8) {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + (to.x - from.x) / 2, from.y + (to.y - from.y) / 2, { steps });
  await page.mouse.move(to.x, to.y, { steps });
}

export async function click(page, selector) {
  const box = await page.locator(selector).first().boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
}

// Where a shape's card is; the wheel over the library brings it into sight.
export async function card(page, shape) {
  const look = () => page.evaluate(shape => {
    const r = document.querySelector(`[data-shape="${shape}"]`).getBoundingClientRect(), x = r.left + r.width / 2, y = r.top + r.height / 2;
    return { x, y, free: document.elementFromPoint(x, y)?.closest('.shape')?.dataset.shape === shape };
  }, shape);
  let now = await look(), steady = 0;
  if (!now.free) {
    const panel = await page.locator('#library').boundingBox();
    await page.mouse.move(panel.x + 60, panel.y + 200);
    await page.mouse.wheel(0, now.y - panel.y - 300);
  }
  while (!now.free || steady < 3) {
    await page.waitForTimeout(100);
    const next = await look();
    steady = next.y === now.y ? steady + 1 : 0;
    now = next;
  }
  return now;
}

export async function place(page, shape, at) {
  await drag(page, await card(page, shape), at);
  await page.mouse.up();
  await page.waitForTimeout(100);
  await idle(page);
}

// Where a point in mm is on the page.
export const where = (page, p) => page.evaluate(p => {
  const { view } = window.studio;
  view.camera.updateMatrixWorld();
  return view.project(view.camera.position.clone().set(...p));
}, p);

// The free vertex nearest to a point in mm that can be grasped where it is seen.
export const grasp = (page, p) => page.evaluate(p => {
  const { view, store } = window.studio, g = store.geometry, found = [];
  for (let v = 0; v < g.header.vertices; ++v) {
    if (g.opening[v]) continue;
    const q = view.vertex(v), at = view.project(q);
    if (document.elementFromPoint(at.x, at.y) === view.canvas && view.pickVertex(at.x, at.y, 16) === v) found.push({ v, x: at.x, y: at.y, d: q.distanceTo(q.clone().set(...p)), at: q.toArray() });
  }
  return found.sort((a, b) => a.d - b.d)[0];
}, p);

// Pull the vertex nearest to `from` by `by` (mm): press, drag, wait until the limb has come to rest, release.
export async function pull(page, from, by) {
  const start = await grasp(page, from);
  const end = await where(page, start.at.map((x, k) => x + by[k]));
  await drag(page, start, end, 10);
  await page.waitForFunction(() => window.studio.tools.pulling.rests || window.studio.tools.pulling.reason, null, { timeout: 60000 }).catch(() => null);
  const grown = await page.evaluate(() => ({ periods: window.studio.tools.pulling.periods, reason: window.studio.tools.pulling.reason }));
  await page.mouse.up();
  await page.waitForTimeout(50);
  await idle(page);
  return grown;
}
