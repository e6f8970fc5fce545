// Makes the pictures of docs/view.md and docs/gallery.md; with names, those alone: ctest's Page tests say which variables it needs.
//     BERTH=$PWD/build/release/berth BERTH_PAGE_WORK=$PWD/build/release/apps/view/page CHROMIUM=/usr/bin/chromium node docs/view/screenshots.mjs
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { openPage, startBerth, startBrowser, temporaryFolder, until } from "../../tests/view/page/browser.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const place = temporaryFolder();
const berth = await startBerth(["demo", "--view", "--port", "0"], place.folder);
const browser = await startBrowser();

const settled = async (page) => {
  for (let i = 0; i < 3; ++i) {
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    await page.waitForTimeout(700);
  }
};
const ask = (number) => (page) => page.locator(`#questions button:nth-child(${number})`).dispatchEvent("click");
const camera = (number) => (page) => page.locator(`#picture-tabs button:nth-child(${number})`).dispatchEvent("click");

const wanted = process.argv.slice(2);

async function shoot(name, doings, options = {}) {
  if (wanted.length > 0 && !wanted.includes(name)) return;
  const page = await openPage(browser, berth.url, options);
  await until(page, () => document.querySelector("#progress").classList.contains("done"));
  for (const doing of doings) {
    await doing(page);
    await settled(page);
  }
  await page.screenshot({ path: join(here, `${name}.png`) });
  await options.end?.(page);
  if (page.errors.length > 0) throw new Error(page.errors.join("\n"));
  await page.close();
}

await shoot("nearest", [ask(4)]);
await shoot("filtered", [ask(2)]);
await shoot("why", [ask(3)]);
await shoot("hidden", [ask(5)], { colorScheme: "dark" });
await shoot("pose", [
  ask(1),
  (page) => page.evaluate(() => {
    const input = document.getElementById("pose.x");
    input.value = String(Number(input.value) + 0.05);
    input.dispatchEvent(new Event("input"));
  }),
], { end: (page) => page.locator("#reset").dispatchEvent("click") });
await shoot("tablet", [], { viewport: { width: 820, height: 1180 }, colorScheme: "dark" });
await shoot("phone", [ask(4)], { viewport: { width: 390, height: 844 } });
await browser.close();
await berth.end();
place.remove();
