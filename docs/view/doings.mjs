// What the pictures and the film of the page do with it.
import { until } from "../../tests/view/page/browser.mjs";

/** Clicks as the page's script sees it: waits for no frame to be drawn. */
export const click = (page, selector) => page.locator(selector).dispatchEvent("click");
export const question = (number) => `#questions button:nth-child(${number})`;

/** Waits until all frames are computed. */
export const computed = (page) => until(page, () => document.querySelector("#progress").classList.contains("done"));

/** Waits until what was sent is drawn. */
export async function drawn(page, wait_ms) {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await page.waitForTimeout(wait_ms);
}

export async function settled(page) {
  for (let i = 0; i < 3; ++i) await drawn(page, 700);
}

/** Types it into the setting of this key. */
export const type = (page, key, value) => page.evaluate(([id, typed]) => {
  const input = document.getElementById(id);
  input.value = typed;
  input.dispatchEvent(new Event("input"));
}, [key, String(value)]);

/** Moves the first camera along x from where it is. */
export async function moveCamera(page, x_m) {
  await type(page, "pose.x", Number(await page.inputValue("[id='pose.x']")) + x_m);
}
