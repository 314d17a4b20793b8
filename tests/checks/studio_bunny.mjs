// usage: studio_bunny.mjs ADDRESS SCREENSHOTS FOLDER: a bunny by mouse alone.
import fs from 'node:fs';
import { expect, expect_soon, finish } from './chromium.mjs';
import { card, click, drag, grasp, idle, open_studio, place, pull, ready, state, where } from './studio_page.mjs';

const [address, shots, folder] = process.argv.slice(2);
let { browser, page } = await open_studio(address);
let shotsTaken = 0;
const shot = name => page.screenshot({ path: `${shots}/studio-${String(++shotsTaken).padStart(2, '0')}-${name}.png` });
const middle = { x: 676, y: 480 };

expect((await state(page)).parts.length === 0, 'starts empty');
await shot('empty');
// Mirrored from the start: what is placed comes to lie on the plane, turned so that it is its own image.
await click(page, '[data-menu=symmetry]');
await page.locator('.menu button', { hasText: /Mirror left/ }).click();
await expect_soon(page, () => window.studio.store.state.symmetry?.mirror?.[0] === 1, null, 'mirrored left and right');
await idle(page);
await place(page, 'ball-90', middle);
await expect_soon(page, n => window.studio.store.state.parts.length === n, 1, 'the body is placed');
await page.mouse.move(middle.x, middle.y);
for (let k = 0; k < 3; ++k) await page.mouse.wheel(0, 240);
await page.waitForTimeout(200);

// The head: dropped half inside the body, joined.
await place(page, 'ball-30', await where(page, [0, 0, 240]));
await expect_soon(page, n => window.studio.store.state.parts.length === n, 2, 'the head is placed');
await shot('head');
await page.waitForSelector('[data-do=suggest], [data-do=join]');
if (await page.isVisible('[data-do=suggest]')) {
  await click(page, '[data-do=suggest]');
  await page.waitForSelector('[data-do=follow]');
  await click(page, '[data-do=follow]');
}
await expect_soon(page, () => document.querySelector('[data-do=join]'), null, 'ways to join are offered: ' + await page.textContent('#choice'));
await idle(page);
await click(page, '[data-do=next]');
await expect_soon(page, () => window.studio.tools.merging.index === 1, null, 'the next way to join');
await idle(page);
await click(page, '[data-do=previous]');
await expect_soon(page, () => window.studio.tools.merging.index === 0, null, 'the way before');
await idle(page);
await shot('join');
await click(page, '[data-do=join]');
await expect_soon(page, n => window.studio.store.state.parts.length === n, 1, 'joined');
await idle(page);

// Ears: one pull, both grow.
await click(page, '[data-tool=pull]');
const brush = await card(page, 'polar-3x7');
await page.mouse.click(brush.x, brush.y);
await expect_soon(page, () => window.studio.tools.brush === 'polar-3x7', null, 'a brush is chosen');
const elements = () => page.evaluate(() => window.studio.store.geometry.header.elements);
let count = await elements();
const ear = await pull(page, [70, -60, 320], [60, 0, 260]);
expect(ear.periods >= 1, `the ear grows while it is pulled: ${JSON.stringify(ear)}`);
await expect_soon(page, n => window.studio.store.geometry.header.elements > n, count, `the ears have grown beyond ${count} elements`);
let after = await elements();
await shot('ears');

// Reload in between: the same document.
const before = await state(page);
await page.reload();
await ready(page);
const reloaded = await state(page);
expect(JSON.stringify(reloaded.operations) === JSON.stringify(before.operations), 'the reloaded document is the same');
expect(reloaded.revision === before.revision, 'the same revision after the reload');

// Arms, undo and redo by their buttons.
await click(page, '[data-tool=pull]');
const small = await card(page, 'polar-4x3');
await page.mouse.click(small.x, small.y);
count = after;
await pull(page, [150, -110, 20], [60, -120, 0]);
await expect_soon(page, n => window.studio.store.geometry.header.elements > n, count, `the arms have grown beyond ${count} elements`);
after = await elements();
await click(page, '[data-do=undo]');
await expect_soon(page, n => window.studio.store.geometry.header.elements === n, count, 'undone');
await idle(page);
await click(page, '[data-do=redo]');
await expect_soon(page, n => window.studio.store.geometry.header.elements === n, after, 'done again');
await idle(page);

// A drag beside the design turns the view.
await drag(page, { x: 260, y: 780 }, { x: 620, y: 760 });
await page.mouse.up();
await page.waitForTimeout(200);
await shot('turned');

// An opening for the lamp holder: one element, not its image.
await click(page, '[data-do=symmetric]');
await click(page, '[data-tool=open]');
const bottom = await page.evaluate(() => {
  const { view, store } = window.studio, g = store.geometry, found = [];
  for (let f = 0; f < g.header.elements; ++f) {
    const c = [0, 1, 2, 3].map(k => view.vertex(g.quads[4 * f + k])).reduce((a, b) => a.add(b)).multiplyScalar(0.25), at = view.project(c);
    if (document.elementFromPoint(at.x, at.y) === view.canvas && view.pick(at.x, at.y)?.face === f) found.push({ z: c.z, ...at });
  }
  return found.sort((a, b) => a.z - b.z)[0];
});
await page.mouse.click(bottom.x, bottom.y);
await click(page, '[data-do=take-out]');
await expect_soon(page, () => window.studio.store.state.operations.at(-1).op === 'open', null, 'opened');
await idle(page);
await shot('open');

// A second tab sees the same and every change of the first; an old change is not taken.
const second = (await open_studio(address, { browser })).page;
expect((await state(second)).revision === (await state(page)).revision, 'the second tab shows the present document');
const has_operations = (tab, n) => expect_soon(tab, n => window.studio.store.state.operations.length === n, n, `${n} operations`);
const made = (await state(page)).operations.length;
await click(page, '[data-tool=select]');
await click(page, '[data-do=undo]');
await has_operations(page, made - 1);
await idle(page);
await has_operations(second, made - 1);
await expect_soon(second, () => document.querySelector('#notice').textContent.length > 10, null, 'and is told');
await click(page, '[data-do=redo]');
await has_operations(page, made);
await idle(page);
await has_operations(second, made);
const stale = await second.evaluate(async () => { const s = window.studio.store; s.state.revision = 1; const done = await s.change('/api/undo'); return [done, s.state.revision]; });
expect(stale[0] === false && stale[1] === (await state(page)).revision, 'an old change of the second tab is refused, and it shows the present document: ' + stale);
await second.close();

// Overlays with their legend.
await click(page, '[data-menu=overlay]');
await page.locator('.menu button', { hasText: 'Defect' }).click();
await page.waitForSelector('#legend', { state: 'visible' });
await shot('defect');
await click(page, '[data-menu=overlay]');
await page.locator('.menu button', { hasText: 'Sides' }).click();

// Drawing a layout leaves the view as it was; the narrow rest of the stage still shows all of it.
const camera = () => page.evaluate(() => { const c = window.studio.view.camera; return [...c.position.toArray(), c.view?.enabled ? 1 : 0]; });
const stood = await camera();
await page.evaluate(() => window.studio.layouts.open(-1));
await page.waitForFunction(() => window.studio.layouts.works, null, { timeout: 120000 });
await expect_soon(page, () => {
  const { view } = window.studio, stage = view.canvas.getBoundingClientRect(), left = document.getElementById('layout').getBoundingClientRect().right;
  view.camera.updateMatrixWorld();
  return [0, 1, 2, 3].map(v => view.project(view.vertex(v))).every(p => p.x > left && p.x < stage.right && p.y > stage.top && p.y < stage.bottom);
}, null, 'the element drawn is seen whole beside the drawing');
await click(page, '[data-do=close-layout]');
const stands = await camera();
expect(stands.every((x, k) => Math.abs(x - stood[k]) < 0.01), `the view is as it was: ${stood} ${stands}`);

// In German too the reasons are told in one language.
await click(page, '[data-do=language]');
await page.evaluate(() => window.studio.store.apply({ op: 'place', id: 'x', shape: 'nonsense' }));
expect(/^Schritt \d+: Die Form „nonsense“/.test(await page.textContent('#notice')), 'a reason in German: ' + await page.textContent('#notice'));
await click(page, '[data-do=language]');

// The element: half as large, and the design with it.
const lengths = async () => (await state(page)).operations.filter(op => op.by_mm).map(op => Math.hypot(...op.by_mm));
const long = await lengths();
await click(page, '[data-do=piece]');
for (const [name, value] of [['la_mm', '40'], ['lb_mm', '44']]) await page.fill(`dialog [name=${name}]`, value);
await click(page, '[data-do=apply-piece]');
await expect_soon(page, () => window.studio.store.state.element.la_mm === 40, null, 'a smaller element');
await idle(page);
const halved = await lengths();
expect(halved.every((l, k) => Math.abs(2 * l - long[k]) < 1e-3), `everything is half as long: ${long} ${halved}`);
await click(page, '[data-do=undo]');
await expect_soon(page, () => window.studio.store.state.element.la_mm === 80, null, 'the element as it was');
await idle(page);

// Fabricate, look, download.
await click(page, '[data-do=make]');
await page.waitForSelector('[data-do=start]');
await click(page, '[data-do=start]');
await page.waitForSelector('[data-do=download], dialog [role=alert]', { timeout: 240000 });
expect(await page.isVisible('[data-do=download]'), 'the kit is made: ' + (await page.textContent('dialog .body')).slice(0, 300));
await page.waitForFunction(() => document.querySelector('.gallery img') && [...document.querySelectorAll('.gallery img')].every(i => i.complete && i.naturalWidth > 0), null, { timeout: 120000 });
await shot('sheets');
await click(page, '[data-tab=Player]');
const player = page.frameLocator('iframe[title=Player]');
await player.locator('#label').waitFor({ timeout: 60000 });
await page.waitForTimeout(500);
await shot('player');
const [download] = await Promise.all([page.waitForEvent('download'), click(page, '[data-do=download]')]);
await download.saveAs(`${folder}/kit.zip`);
await click(page, '[data-do=close]');
const final = await state(page);
fs.writeFileSync(`${folder}/recorded.json`, JSON.stringify({ operations: final.operations, elements: await page.evaluate(() => window.studio.store.geometry.header.elements) }));
await grasp(page, [0, 0, 0]);
await shot('done');
await browser.close();
finish();
