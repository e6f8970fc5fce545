// Makes the film of docs/gallery.md, docs/view/film.webm; run like screenshots.mjs, and ffmpeg is needed, too.
// How long a picture stays is written here, so that a slow computer makes the same film.
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { openPage, startBerth, startBrowser, temporaryFolder, until } from "../../tests/view/page/browser.mjs";
import { click, computed, drawn, moveCamera, question, settled, type } from "./doings.mjs";

if (spawnSync("ffmpeg", ["-version"]).error) throw new Error("ffmpeg is missing; on Debian: apt-get install ffmpeg");
const place = temporaryFolder();
const pictures = [];

async function show(page, duration_s) {
  const file = join(place.folder, `${pictures.length}.png`);
  await page.screenshot({ path: file });
  pictures.push({ file, duration_s });
}

/** Writes what is shown above the page. */
const caption = (page, words) => page.evaluate((text) => {
  let line = document.getElementById("caption");
  if (!line) {
    line = document.createElement("p");
    line.id = "caption";
    line.style.cssText = "margin:0; padding:.45rem .75rem; background:#1b1f24; color:#fff; font:600 20px/1.3 sans-serif; flex:none";
    document.body.prepend(line);
  }
  line.textContent = text;
}, words);

/** Shows this part of the page with a frame around it: what the next click or value is for, or what the caption is about. */
async function point(page, selector, duration_s = 1.2) {
  const frame = (style) => page.locator(selector).evaluate((element, outline) => {
    element.scrollIntoView({ block: "center" });
    element.style.outline = outline;
  }, style);
  await frame("4px solid #e0218a");
  await show(page, duration_s);
  await frame("");
}

async function press(page, selector) {
  await point(page, selector);
  await click(page, selector);
  await settled(page);
}

async function set(page, key, value) {
  await point(page, `[id='${key}']`);
  await type(page, key, value);
  await settled(page);
}

/** Turns the 3D view as a drag of the mouse does. */
async function turn(page, by_px, pictureCount) {
  const box = await page.locator("#canvas-3d").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= pictureCount; ++i) {
    await page.mouse.move(x + (by_px * i) / pictureCount, y);
    await drawn(page, 100);
    await show(page, 0.2);
  }
  await page.mouse.up();
}

async function scrubTo(page, step) {
  await page.evaluate((value) => {
    const scrub = document.getElementById("scrub");
    scrub.value = String(value);
    scrub.dispatchEvent(new Event("input"));
  }, step);
  await until(page, (value) => document.body.dataset.step === String(value) && !document.getElementById("provisional"), step);
  await drawn(page, 300);
}

async function showQuestions(page) {
  await caption(page, "berth: how far is each link of the robot from what the cameras see, and do not see?");
  await show(page, 5);
  await turn(page, 240, 12);
  await turn(page, -240, 12);
  await caption(page, "Is the pose right? Readings on the robot are light where it is");
  await press(page, question(1));
  await show(page, 4);
  await caption(page, "With the camera moved by 5 cm, they are orange in front of the robot, blue behind it");
  await point(page, "[id='pose.x']");
  await moveCamera(page, 0.05);
  await settled(page);
  await show(page, 4.5);
  await click(page, "#reset");
  await settled(page);
  await computed(page);
  await caption(page, "What is filtered? Blue readings are the robot's own, brown ones the table's");
  await press(page, question(2));
  await show(page, 4);
  await point(page, "#fates", 3);
  await caption(page, "Why this distance? One link's line, its camera and pixel, and what is certain");
  await press(page, question(3));
  await show(page, 4);
  await point(page, "#link-details", 5);
  await caption(page, "When was it nearest? 15 mm from space that no camera sees, 78 mm from what is seen");
  await press(page, question(4));
  await show(page, 6);
  await caption(page, "What is hidden? Nobody knows what is behind the person and the boxes");
  await press(page, question(5));
  await show(page, 3);
  await turn(page, 240, 10);
  await press(page, question(5));
}

async function play(page) {
  await caption(page, "The whole scene, three times slower: each link's line to what is nearest");
  for (let step = 0; step <= 100; step += 2) {
    await scrubTo(page, step);
    await show(page, 0.22);
  }
}

async function change(page) {
  await caption(page, "Any setting can be changed: the range is 25 cm now, and the curves follow");
  await scrubTo(page, 48);
  await press(page, "#panel-tabs button:nth-child(2)");
  await page.locator("details[data-group=evaluation]").evaluate((group) => (group.open = true));
  await set(page, "evaluation.range_m", 0.25);
  await computed(page);
  await settled(page);
  await show(page, 4.5);
  await caption(page, "A value that makes no sense is refused, with what was expected; the old one stays");
  await set(page, "evaluation.range_m", 1000);
  await show(page, 4.5);
  await caption(page, "One click takes it back");
  await press(page, ".setting.changed button");
  await computed(page);
  await settled(page);
  await show(page, 3);
}

/** Its page is beside this one, and a picture of it is laid into the film. */
async function showPhone(browser, url) {
  const phone = await openPage(browser, url, { viewport: { width: 390, height: 750 } });
  await computed(phone);
  await click(phone, question(4));
  await settled(phone);
  const picture = (await phone.screenshot()).toString("base64");
  await phone.close();
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.setContent(`<body style="margin:0; background:#d5d9de"><img style="display:block; margin:auto" src="data:image/png;base64,${picture}">`);
  await caption(page, "The same page on a phone");
  await show(page, 6);
}

function writeFilm(file) {
  const list = join(place.folder, "pictures.txt");
  const lines = [...pictures, { file: pictures.at(-1).file, duration_s: 0 }].map((one) => `file '${one.file}'\nduration ${one.duration_s}\n`);
  writeFileSync(list, lines.join(""));
  const encoder = ["-c:v", "libvpx-vp9", "-crf", "42", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-g", "300", "-threads", "1"];
  const made = spawnSync("ffmpeg", ["-y", "-loglevel", "error", "-f", "concat", "-safe", "0", "-i", list, "-vf", "fps=10,format=yuv420p", ...encoder, file]);
  if (made.status !== 0) throw new Error(`ffmpeg: ${made.stderr}`);
}

const berth = await startBerth(["demo", "--view", "--port", "0"], place.folder);
const browser = await startBrowser();
const page = await openPage(browser, berth.url);
await computed(page);
await showQuestions(page);
await play(page);
await change(page);
await showPhone(browser, berth.url);
if (page.errors.length > 0) throw new Error(page.errors.join("\n"));
await browser.close();
await berth.end();
writeFilm(fileURLToPath(new URL("film.webm", import.meta.url)));
console.log(`${pictures.length} pictures, ${pictures.reduce((sum, one) => sum + one.duration_s, 0).toFixed(1)} s`);
place.remove();
