// usage: preview_check.mjs PAGE: use preview.html as a person does.
import fs from 'node:fs';
import { expect, finish, open_browser } from './chromium.mjs';

const file = process.argv[2];
const address = 'file://' + file;
const browser = await open_browser();
const requests = [];

async function open(hash = '', options = {}) {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 }, reducedMotion: 'reduce', ...options });
  page.on('console', m => expect(!['error', 'warning'].includes(m.type()), 'console: ' + m.text()));
  page.on('pageerror', e => expect(false, 'page: ' + e.message));
  page.on('request', r => requests.push(r.url()));
  if (options.script) await page.addInitScript(options.script);
  await page.goto(address + hash, { timeout: 120000 });
  if (!options.script) await page.waitForFunction(() => window.rhombloom, null, { timeout: 120000 });
  return page;
}
const label = page => page.textContent('#label');
// What is drawn: the colours of a hundredth of the pixels, and how many of all are the red of the next element, which
// may be a speck of a large model.
const drawn = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => {
  const gl = document.getElementById('view').getContext('webgl2');
  window.dispatchEvent(new Event('resize'));
  requestAnimationFrame(() => {
    const { width, height } = gl.canvas, pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const found = new Set();
    let red = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      const [r, g, b] = [pixels[i] >> 4, pixels[i + 1] >> 4, pixels[i + 2] >> 4];
      if (i % 400 === 0 && pixels[i + 3]) found.add(r << 8 | g << 4 | b);
      red += r > 7 && g < 5 && b < 5;
    }
    done({ colours: found.size, red });
  });
})));

// Finished at first; something is drawn.
let page = await open();
expect(/^Finished: \d+ elements$/.test(await label(page)), 'starts finished: ' + await label(page));
const finished = await drawn(page);
expect(finished.colours > 10, 'the model is drawn');
expect(finished.red === 0, 'nothing is red when all is finished: ' + finished.red);
const count = await page.evaluate(() => +document.getElementById('step').max - 1);
console.log(`  ${count} steps`);

// The slider and the address.
await page.evaluate(() => { const s = document.getElementById('step'); s.value = 3; s.dispatchEvent(new Event('input', { bubbles: true })); });
expect((await label(page)).startsWith(`Step 3 of ${count}: `), 'slider: ' + await label(page));
expect(page.url().endsWith('#step=3'), 'the address follows: ' + page.url());
const { red } = await drawn(page);
console.log(`  ${red} pixels of the next element at step 3`);
expect(red >= 8, 'the next element is red');

// The keyboard.
await page.focus('#view');
await page.keyboard.press('ArrowRight');
expect((await label(page)).startsWith('Step 4 of'), 'arrow right: ' + await label(page));
await page.keyboard.press('ArrowLeft');
await page.keyboard.press('ArrowLeft');
expect((await label(page)).startsWith('Step 2 of'), 'arrow left: ' + await label(page));
await page.keyboard.press('End');
expect((await label(page)).startsWith('Finished'), 'End');
const before = await page.evaluate(() => ({ ...rhombloom.camera }));
await page.keyboard.press('ArrowUp');
await page.keyboard.press('+');
const after = await page.evaluate(() => ({ ...rhombloom.camera }));
expect(after.pitch > before.pitch && after.distance < before.distance, 'arrow up turns, plus zooms');
await page.keyboard.press('0');
await page.keyboard.press('l');
expect(await page.getAttribute('#lamp', 'aria-pressed') === 'true', 'L lights the lamp');
await page.keyboard.press('l');

// The mouse: a drag turns, a click chooses.
const box = await page.locator('#view').boundingBox();
await page.mouse.move(500, 250);
await page.mouse.down();
await page.mouse.move(560, 260, { steps: 3 });
await page.mouse.up();
expect(await page.evaluate(() => rhombloom.camera.yaw) !== before.yaw, 'a drag turns');
expect(await page.isHidden('#info'), 'a drag chooses nothing');
for (const [x, y] of [[500, 250], [470, 290], [540, 300], [520, 210]]) {
  await page.mouse.click(box.x + x, box.y + y);
  if (await page.isVisible('#info')) break;
}
const info = await page.textContent('#info');
expect(/Element [ET]\d+/.test(info) && /(front|flipped)/.test(info) && /Inserted in step \d+/.test(info) && /Neighbours: /.test(info), 'click: ' + info);
const chosen = await page.evaluate(() => rhombloom.state.chosen);
const shown = () => page.evaluate(() => { let k = 0; for (let e = 0; e < 1e4; ++e) k += rhombloom.visible(e) ? 1 : 0; return k; });
const all = await shown();
await page.keyboard.press('i');
expect(await shown() <= 5, 'isolate shows the element and its neighbours');
await page.keyboard.press('i');
await page.keyboard.press('h');
expect(await shown() === all - 1, 'hide hides one');
await page.click('#all');
expect(await shown() === all, 'show all');
await page.evaluate(e => rhombloom.choose(e), chosen);
await page.click('#info p button');
expect(await page.evaluate(() => rhombloom.state.chosen) !== chosen, 'a neighbour can be chosen');
await page.click('#play');
await page.waitForTimeout(1700);
expect((await label(page)).startsWith('Step '), 'play starts at the first step');
await page.close();

// Deep link, wrong link, phone, no WebGL.
page = await open('#step=7');
expect((await label(page)).startsWith('Step 7 of'), 'deep link: ' + await label(page));
await page.evaluate(() => { location.hash = '#step=999999'; });
await page.waitForTimeout(200);
expect((await label(page)).startsWith('Finished'), 'a step too far is the end');
await page.close();
page = await open('', { viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });
expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling on a phone');
expect((await drawn(page)).colours > 10, 'drawn on a phone');
await page.touchscreen.tap(180, 200);
await page.close();
page = await open('', { script: 'HTMLCanvasElement.prototype.getContext = () => null;' });
await page.waitForSelector('#fallback:visible');
expect(/WebGL/.test(await page.textContent('#fallback')), 'a message without WebGL');
await page.close();

expect(requests.every(url => url.split('#')[0] === address), 'requests: ' + requests.filter(url => url.split('#')[0] !== address).slice(0, 3));
console.log(`  ${requests.length} page loads, no other request`);
expect(!/https?:\/\//.test(fs.readFileSync(file, 'latin1')), 'no address in the page');
await browser.close();
finish();
