// A browser and a berth for the tests of the page. Ends both.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const require = createRequire(join(process.env.BERTH_PAGE_WORK, "here.js"));
const { chromium } = require("playwright-core");

const started = new Set();

/** Ends what a test that failed has left. */
export function endAll() {
  for (const process_ of started) process_.kill("SIGKILL");
}

/** `berth ...` with a page. */
export const startBerth = (words, folder) => start(process.env.BERTH, words, folder);

/** A program that serves a page: its url, and end() for its end. */
export async function start(command, words, folder) {
  const process_ = spawn(command, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  started.add(process_);
  process_.on("exit", () => started.delete(process_));
  let text = "";
  let errors = "";
  process_.stderr.on("data", (data) => (errors += data));
  const ended = new Promise((resolve) => process_.on("exit", resolve));
  const url = await new Promise((resolve, reject) => {
    process_.stdout.on("data", (data) => {
      text += data;
      const found = text.match(/http:\S+/);
      if (found) resolve(found[0]);
    });
    ended.then((status) => reject(new Error(`${command} ended with ${status}: ${errors}`)));
  });
  return {
    url,
    async end(signal = "SIGINT") {
      process_.kill(signal);
      return ended;
    },
  };
}

/** With OpenGL by software, where there is no graphics processor. */
export function startBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM,
    // Mesa's is ten times as fast as the browser's own.
    args: ["--no-sandbox", "--ignore-gpu-blocklist", "--use-gl=angle", "--use-angle=gl-egl"],
  });
}

/** A page of this size that has shown its first frame; its errors are kept in `errors`. */
export async function openPage(browser, url, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  page.errors = [];
  page.on("pageerror", (error) => page.errors.push(String(error)));
  page.on("console", (message) => message.type() === "error" && page.errors.push(message.text()));
  await page.goto(url);
  await isReady(page);
  return page;
}

/**
 * Waits until this is true in the page, for half a minute of a machine that has time for it: what counts is how often it
 * was looked at, since a busy machine may stop all for longer. The page's Content-Security-Policy forbids waitForFunction.
 */
export async function until(page, isTrue, value) {
  for (let tries = 600; !(await page.evaluate(isTrue, value)); --tries) {
    if (tries === 0) throw new Error(`never: ${isTrue}, ${value}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Waits until such an element is there, drawn or not. */
export const isThere = (page, selector) => until(page, (wanted) => document.querySelector(wanted) !== null, selector);

/** Waits for the first frame and its images. */
export async function isReady(page) {
  await until(page, () => /[1-9]\d* readings/.test(document.querySelector("#legend")?.textContent));
  await isThere(page, "#links tbody tr");
}

export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), "berth_page_"));
  return { folder, remove: () => rmSync(folder, { recursive: true, force: true }) };
}
