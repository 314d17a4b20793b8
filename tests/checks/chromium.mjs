// Debian's Chromium, headless and without network, for the checks of pages.
import { chromium } from 'playwright-core';

export async function open_browser() {
  return chromium.launch({
    executablePath: '/usr/bin/chromium',
    timeout: 120000,
    args: ['--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
}

let failures = 0;

export function expect(condition, what) {
  if (!condition) {
    ++failures;
    console.log('FAILED: ' + what);
  }
}

// As `expect`, of something in the page that may take a while on a busy machine: `seen` runs there with `argument`.
export async function expect_soon(page, seen, argument, what) {
  const came = await page.waitForFunction(seen, argument, { timeout: 60000 }).catch(() => null);
  expect(came, what);
}

export function finish() {
  process.exit(failures ? 1 : 0);
}
