// Makes the pictures of docs/view.md and docs/gallery.md; with names, those alone: ctest's Page tests say which variables it needs.
//     BERTH=$PWD/build/release/berth BERTH_PAGE_WORK=$PWD/build/release/apps/view/page CHROMIUM=/usr/bin/chromium node docs/view/screenshots.mjs
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { openPage, startBerth, startBrowser, temporaryFolder } from "../../tests/view/page/browser.mjs";
import { click, computed, moveCamera, question, settled } from "./doings.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const place = temporaryFolder();
const berth = await startBerth(["demo", "--view", "--port", "0"], place.folder);
const browser = await startBrowser();

const ask = (number) => (page) => click(page, question(number));

const wanted = process.argv.slice(2);

async function shoot(name, doings, options = {}) {
  if (wanted.length > 0 && !wanted.includes(name)) return;
  const page = await openPage(browser, berth.url, options);
  await computed(page);
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
await shoot("pose", [ask(1), (page) => moveCamera(page, 0.05)], { end: (page) => click(page, "#reset") });
await shoot("tablet", [], { viewport: { width: 820, height: 1180 }, colorScheme: "dark" });
await shoot("phone", [ask(4)], { viewport: { width: 390, height: 844 } });
await browser.close();
await berth.end();
place.remove();
