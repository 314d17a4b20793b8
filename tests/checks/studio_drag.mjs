// usage: studio_drag.mjs ADDRESS SCREENSHOTS: a limb follows the mouse on 588 elements. Says how fast; a busy machine is no failure.
import { expect, expect_soon, finish } from './chromium.mjs';
import { card, click, drag, grasp, idle, open_studio, where } from './studio_page.mjs';

const [address, shots] = process.argv.slice(2);
const { browser, page } = await open_studio(address);
const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))] ?? NaN;
const elements = await page.evaluate(() => window.studio.store.geometry.header.elements);
expect(elements === 588, `588 elements: ${elements}`);
await click(page, '[data-tool=pull]');
for (const [brush, from, by] of [['ball-30', [0, 0, 400], [60, -40, 330]], ['polar-5x4', [260, -260, 0], [170, -130, 90]]]) {
  const at = await card(page, brush);
  await page.mouse.click(at.x, at.y);
  const start = await grasp(page, from);
  const path = [0.3, 1, 0.7].map(s => start.at.map((x, k) => x + s * by[k]));
  await drag(page, start, await where(page, path[0]), 10);
  for (const point of path.slice(1)) {
    const to = await where(page, point);
    await page.mouse.move(to.x, to.y, { steps: 14 });
    await expect_soon(page, () => window.studio.tools.pulling.rests, null, `${brush}: the limb follows to (${point.map(Math.round)})`);
  }
  await page.screenshot({ path: `${shots}/studio-drag-${brush}.png` });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await idle(page);
}
const measured = await page.evaluate(() => ({ work: window.studio.tools.pulling.work, cpu: window.studio.tools.pulling.cpu, latency: window.studio.tools.pulling.latency,
  bend: window.studio.view.timing.bend, draw: window.studio.view.timing.draw }));
const say = (name, values) => console.log(`  ${name}: ${values.length} frames, median ${quantile(values, 0.5).toFixed(1)} ms, 95 % ${quantile(values, 0.95).toFixed(1)} ms`);
say('server, computing', measured.cpu);
say('server, on the clock', measured.work);
say('page, bending and colours', measured.bend);
say('page, handing over to draw', measured.draw);
say('from asking to seeing', measured.latency);
await browser.close();
finish();
