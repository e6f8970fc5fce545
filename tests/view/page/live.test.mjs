// A running robot, as Python shows it.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { endAll, openPage, start, startBrowser, until } from "./browser.mjs";

test("a running robot is shown as it comes", async () => {
  const script = join(process.env.BERTH_SOURCE_DIR, "tests/view/page/live_robot.py");
  const robot = await start(process.env.PYTHON, ["-B", script], ".");
  const browser = await startBrowser();
  try {
    const page = await openPage(browser, robot.url);
    const when = () => page.locator("#when").textContent();
    const first = await when();
    await until(page, (was) => document.querySelector("#when").textContent !== was, first);
    assert.match(await when(), /^\d\.\d{3} s$/);
    assert.equal(await page.locator("#links tbody tr").count(), 8);
    assert.equal(await page.locator("#play").isVisible(), false);
    assert.deepEqual(page.errors, []);
    await robot.end("SIGKILL");
    await until(page, () => /berth has ended/.test(document.getElementById("trouble").textContent));
  } finally {
    await browser.close();
    endAll();
  }
});
