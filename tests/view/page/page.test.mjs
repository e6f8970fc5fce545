// The page as its user sees it, with the bundled scene.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { endAll, isReady, isThere, openPage, startBerth, startBrowser, temporaryFolder, until } from "./browser.mjs";

let browser;
// All cameras, and one alone, which takes less time.
let berth;
let single;
let place;

before(async () => {
  place = temporaryFolder();
  berth = await startBerth(["demo", "--view", "--port", "0"], place.folder);
  const scene = join(process.env.BERTH_SOURCE_DIR, "data/bundled/one_camera.yaml");
  single = await startBerth(["view", scene, "--port", "0", "--save-to", place.folder], place.folder);
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  await berth?.end();
  await single?.end();
  endAll();
  place?.remove();
});

/** Clicks as the page's script sees it: waits for no frame to be drawn. */
const click = (page, selector) => page.locator(selector).dispatchEvent("click");
const text = (page, selector) => page.locator(selector).textContent();
const open = (where = single.url, options = {}) => openPage(browser, where, options);
const showSettings = (page) => click(page, "#panel-tabs button:nth-child(2)");

/** Types it, as a user who replaces what is there. */
async function type(page, key, value) {
  await page.evaluate(([id, typed]) => {
    const input = document.getElementById(id);
    input.value = typed;
    input.dispatchEvent(new Event("input"));
  }, [key, String(value)]);
}

test("shows the bundled scene", async () => {
  const page = await open(berth.url);
  assert.equal(await page.locator("#links tbody tr").count(), 8);
  assert.match(await text(page, "#legend"), /\d{5,} readings, 70468 triangles/);
  assert.match(await text(page, "#when"), /^frame 2: 0\.047 s, right's image 0$/);
  await until(page, () => document.querySelector("#progress").classList.contains("done"));
  const drawn = await page.evaluate(() => {
    const canvas = document.querySelector("#canvas-image");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(data).size;
  });
  assert.ok(drawn > 50, `${drawn} values in the image`);
  assert.deepEqual(page.errors, []);
  await page.close();
});

test("a knob changes the distance, and goes back", async () => {
  const page = await open();
  const isSettled = () => until(page, () => document.getElementById("provisional") === null && document.getElementById("links") !== null);
  await isSettled();
  const table = () => text(page, "#links");
  const original = await table();
  await showSettings(page);
  await type(page, "evaluation.range_m", 0.25);
  await until(page, () => document.getElementById("evaluation.range_m").closest(".changed") !== null);
  await click(page, "#panel-tabs button:nth-child(1)");
  await until(page, (was) => document.querySelector("#links").textContent !== was, original);
  await showSettings(page);
  await click(page, ".setting.changed button");
  await until(page, () => document.querySelector(".setting.changed") === null);
  await click(page, "#panel-tabs button:nth-child(1)");
  await until(page, (was) => document.querySelector("#links").textContent === was, original);
  await page.close();
});

test("a value that is refused says why, and the old one stays", async () => {
  const page = await open();
  await showSettings(page);
  const before_m = await page.inputValue("[id='self_filter.padding_m']");
  await type(page, "self_filter.padding_m", -1);
  await until(page, () => /^self_filter\.padding_m: -1; expected/.test(document.getElementById("notice").textContent));
  // It goes with its cause.
  await type(page, "self_filter.padding_m", 0.03);
  await until(page, () => document.getElementById("notice").textContent === "");
  assert.equal(await page.locator("#notice.refused").count(), 0);
  await click(page, "#reset");
  await until(page, () => document.querySelector(".setting.changed") === null);
  await page.reload();
  await isReady(page);
  await showSettings(page);
  assert.equal(await page.inputValue("[id='self_filter.padding_m']"), before_m);
  await page.close();
});

test("a long range works, and one that is too long is told", async () => {
  const page = await open();
  await showSettings(page);
  await type(page, "evaluation.range_m", 1000);
  await until(page, () => /^evaluation\.range_m: 1000; expected .*up to 50/.test(document.getElementById("notice").textContent));
  await type(page, "evaluation.range_m", 50);
  await until(page, () => document.getElementById("evaluation.range_m").closest(".changed") !== null);
  await click(page, "#questions button:nth-child(5)");
  await click(page, "#after");
  await until(page, () => document.getElementById("provisional") === null);
  await until(page, () => document.querySelector("#progress").classList.contains("done"));
  await click(page, "#reset");
  await until(page, () => document.querySelector(".setting.changed") === null);
  assert.deepEqual(page.errors, []);
  await page.close();
});

test("saves what berth run accepts, and nothing over a file that is there", async () => {
  const page = await open();
  await showSettings(page);
  await type(page, "evaluation.range_m", 0.8);
  await until(page, () => document.getElementById("evaluation.range_m").closest(".changed") !== null);
  await page.fill("#save-name", "mine.yaml");
  await page.locator("#save").dispatchEvent("submit");
  await until(page, () => document.getElementById("notice").textContent.startsWith("saved as"));
  const run = spawnSync(process.env.BERTH, ["run", "mine.yaml", "--format", "json"], { cwd: place.folder, maxBuffer: 1e8 });
  assert.equal(run.status, 0, String(run.stderr));
  assert.equal(JSON.parse(String(run.stdout).split("\n")[0]).range_m, 0.8);
  for (const name of ["mine.yaml", "../mine2.yaml", "mine.txt"]) {
    await page.fill("#save-name", name);
    await page.locator("#save").dispatchEvent("submit");
    // The refusal's own words: the notice before names the file, too.
    await until(page, (wanted) => {
      const notice = document.getElementById("notice").textContent;
      return notice.includes(wanted) && notice.includes("expected");
    }, name);
  }
  await click(page, "#reset");
  await until(page, () => document.querySelector(".setting.changed") === null);
  await page.close();
});

test("two pages show the same image and settings", async () => {
  const [one, two] = [await open(), await open()];
  const start = await one.evaluate(() => Number(document.body.dataset.step));
  await click(one, "#after");
  for (const page of [one, two]) await until(page, (step) => Number(document.body.dataset.step) === step, start + 1);
  await two.evaluate(() => document.activeElement.blur());
  await two.keyboard.press("ArrowLeft");
  for (const page of [one, two]) await until(page, (step) => Number(document.body.dataset.step) === step, start);
  await showSettings(one);
  await showSettings(two);
  await type(one, "self_filter.padding_m", 0.04);
  await until(two, () => document.getElementById("self_filter.padding_m").value === "0.04");
  await click(one, "#reset");
  await until(two, () => document.getElementById("self_filter.padding_m").value === "0.02");
  await one.close();
  await two.close();
});

test("each question has its answer a click away", async () => {
  const page = await open(berth.url);
  await until(page, () => document.querySelector("#progress").classList.contains("done"));
  const ask = (number) => click(page, `#questions button:nth-child(${number})`);
  const active = () => page.locator("#questions button[aria-pressed=true]").allTextContents();
  assert.deepEqual(await active(), []);
  await ask(1);
  assert.deepEqual(await active(), ["Is the pose right?"]);
  assert.equal(await page.locator("details[data-group=pose]").getAttribute("open"), "");
  // As in the report of a calibration: orange is in front, blue behind.
  const colors = await page.locator("#legend span").evaluateAll((all) =>
    all.filter((one) => one.querySelector("i")).map((one) => [one.textContent, one.querySelector("i").style.background]));
  const rgbOf = (words) => colors.find(([said]) => words.test(said))[1].match(/\d+/g).map(Number);
  const [front, behind] = [rgbOf(/in front of/), rgbOf(/behind it/)];
  assert.ok(front[0] > front[2] && behind[2] > behind[0], `${front}; ${behind}`);
  await ask(2);
  assert.ok((await page.locator("#fates tbody tr").count()) > 5);
  await ask(3);
  await isThere(page, "#link-details");
  assert.match(await text(page, "#said"), /^arm_link_\d: \d\.\d{3} m to /);
  await ask(4);
  await until(page, () => /^frame 48: 1\.713 s, /.test(document.getElementById("when").textContent));
  assert.deepEqual(await active(), ["When was it nearest?"]);
  assert.match(await text(page, "#link-details"), /arm_link_7.*0\.015 m.*unknown/s);
  // The line ends in unknown space, which is drawn for that.
  assert.equal(await text(page, "#said"), "Nearest, at 1.713 s: arm_link_7: 0.015 m to unknown space; what is seen is 0.078 m away.");
  assert.ok(await page.isChecked("#layer-hidden"));
  await click(page, "#after");
  await until(page, () => /^frame 49: /.test(document.getElementById("when").textContent));
  assert.deepEqual(await active(), []);
  await ask(5);
  assert.match(await text(page, "#legend"), /unknown space/);
  // Asked once more it is taken back.
  await ask(5);
  assert.deepEqual(await active(), []);
  assert.equal(await page.isChecked("#layer-hidden"), false);
  assert.deepEqual(page.errors, []);
  await page.close();
});

test("a scene of another method has no control for it", async () => {
  const page = await open();
  assert.equal(await page.locator("[id='evaluation.method']").count(), 0);
  await click(page, "#questions button:nth-child(5)");
  assert.match(await text(page, "#legend"), /unknown space/);
  await page.close();
});

test("a result that lacks a camera is marked on every panel", async () => {
  const folder = join(place.folder, "degraded");
  cpSync(join(process.env.BERTH_SOURCE_DIR, "data/bundled"), folder, { recursive: true });
  const file = join(folder, "scene.yaml");
  const wrong = readFileSync(file, "utf8").replace(/(name: left[^]*?depth_scale: )0.001/, (_, before_) => `${before_}0.01`);
  writeFileSync(file, wrong);
  const other = await startBerth(["view", "scene.yaml", "--port", "0"], folder);
  const page = await open(other.url);
  await until(page, () => document.getElementById("answer").textContent === "degraded");
  assert.match(await text(page, "#result-status"), /^Degraded: camera left is implausible; distances may be larger/);
  await showSettings(page);
  assert.ok(await page.locator("#answer").isVisible());
  await page.close();
  assert.equal(await other.end(), 0);
});

test("a monitored scene tells how fast the robot may go", async () => {
  const folder = join(place.folder, "monitored");
  cpSync(join(process.env.BERTH_SOURCE_DIR, "data/bundled"), folder, { recursive: true });
  const file = join(folder, "scene.yaml");
  writeFileSync(file, `${readFileSync(file, "utf8")}separation: {no_reading: ignore}\n`);
  const other = await startBerth(["view", "scene.yaml", "--port", "0"], folder);
  const page = await open(other.url);
  await until(page, () => /^Speed: stop: .*needs/.test(document.getElementById("speed")?.textContent));
  assert.match(await text(page, "#speed-key"), /slower.*stop/);
  await showSettings(page);
  assert.match(await text(page, "details[data-group=separation]"), /deceleration_m_s2 \[m\/s²\]/);
  await page.close();
  assert.equal(await other.end(), 0);
  const bare = await open(single.url);
  assert.equal(await bare.locator("#speed").count(), 0);
  await bare.close();
});

test("the table is in one unit and tells how far what is seen is", async () => {
  const page = await open(berth.url);
  const head = await page.locator("#links th").allTextContents();
  assert.deepEqual(head, ["link", "distance [m]", "nearest is", "to occupied [m]", "status"]);
  const rows = await page.locator("#links tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  for (const [, distance, , occupied] of rows) for (const cell of [distance, occupied]) assert.match(cell, /^(\d\.\d{3}|–)$/);
  const [room, wide] = await page.evaluate(() => ["panels", "links"].map((id) => document.getElementById(id).clientWidth));
  assert.ok(wide <= room, `${wide} pixels wide, in ${room}`);
  assert.ok(rows.some(([, distance, is, occupied]) => is === "unknown" && Number(occupied) > Number(distance)));
  await page.close();
});

test("where only unknown space touches, nothing says contact", async () => {
  const page = await open(berth.url);
  await page.evaluate(() => {
    const scrub = document.getElementById("scrub");
    scrub.value = "47";
    scrub.dispatchEvent(new Event("input"));
  });
  await until(page, () => document.body.dataset.step === "47" && document.getElementById("provisional") === null);
  await click(page, "#links tbody tr:nth-child(1)");
  await click(page, "#questions button:nth-child(3)");
  assert.match(await text(page, "#said"), /^arm_link_0: unknown 0 m, seen 0\.164 m\.$/);
  assert.match(await text(page, "#link-details"), /unknown 0 m, seen 0\.164 m/);
  await until(page, () => [...document.querySelectorAll("#labels span")].some((one) => one.textContent === "unknown 0 m, seen 0.164 m"));
  await click(page, "#links tbody tr:nth-child(2)");
  assert.match(await text(page, "#link-details"), /to known0\.\d{3} m, (table|arm_link_\d)/);
  assert.doesNotMatch(await text(page, "body"), /contact/i);
  await page.close();
});

test("a pixel tells its depth, fate and link", async () => {
  const page = await open();
  await page.evaluate(() => {
    const canvas = document.getElementById("canvas-image");
    const box = canvas.getBoundingClientRect();
    const at = { clientX: box.left + box.width / 2, clientY: box.top + box.height - 3 };
    canvas.dispatchEvent(new PointerEvent("pointermove", at));
  });
  assert.match(await text(page, "#pixel"), /^\(\d+, \d+\): .+, .+, .+/);
  await page.close();
});

test("a tablet and a dark room do", async () => {
  const page = await open(single.url, { viewport: { width: 820, height: 1100 }, colorScheme: "dark" });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 820, `${wide} pixels wide`);
  await page.close();
});

test("a phone shows the answer, and no box over it", async () => {
  for (const viewport of [{ width: 390, height: 844 }, { width: 844, height: 390 }]) {
    const page = await open(berth.url, { viewport });
    await until(page, () => document.querySelector("#progress").classList.contains("done"));
    await click(page, "#questions button:nth-child(4)");
    await until(page, () => document.getElementById("said").textContent.startsWith("Nearest"));
    const { wide, cut, covered, top, bottom, height } = await page.evaluate(() => {
      const box = (id) => document.getElementById(id).getBoundingClientRect();
      const [view, layers, said] = [box("canvas-3d"), box("layers"), box("said")];
      return {
        wide: document.documentElement.scrollWidth,
        cut: document.getElementById("links").clientWidth - document.getElementById("panels").clientWidth,
        covered: (layers.width * layers.height) / (view.width * view.height),
        top: view.top, bottom: said.bottom, height: innerHeight,
      };
    });
    assert.ok(wide <= viewport.width, `${wide} pixels wide`);
    assert.ok(cut <= 0, `${cut} pixels of the table are cut off`);
    assert.ok(covered < 0.1, `${covered} of the 3D view`);
    assert.ok(top >= -1 && bottom <= height + 1, `from ${top} to ${bottom} of ${height}`);
    await page.close();
  }
});

test("no label lies over another", async () => {
  const page = await open(berth.url, { viewport: { width: 420, height: 600 } });
  // Far away, so that all lines are near one another.
  await page.evaluate(() => {
    const canvas = document.getElementById("canvas-3d");
    for (let i = 0; i < 30; ++i) canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 120, bubbles: true, cancelable: true }));
  });
  await page.waitForTimeout(500);
  await until(page, () => document.querySelectorAll("#labels span").length >= 3);
  const boxes = await page.locator("#labels span").evaluateAll((all) => all.map((one) => one.getBoundingClientRect().toJSON()));
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(0, i)) {
      assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top, JSON.stringify([a, b]));
    }
  }
  await page.close();
});

/** Tells pages opened from now on to note the frame that they last asked for. */
const noteWhatIsAsked = () => {
  const { send } = WebSocket.prototype;
  WebSocket.prototype.send = function (text) {
    const asked = JSON.parse(text);
    if (asked.do === "show") document.body.dataset.asked = asked.step;
    send.call(this, text);
  };
};

test("keys work after any click", async () => {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.addInitScript(noteWhatIsAsked);
  await page.goto(single.url);
  await isReady(page);
  const step = () => page.evaluate(() => Number(document.body.dataset.step));
  /** Waits for the frame that was asked for, however long that takes. */
  const isShown = () => until(page, () => (document.body.dataset.asked ?? document.body.dataset.step) === document.body.dataset.step);
  const places = ["", "#after", "#canvas-3d", "#layers label:nth-of-type(2)", "#panel-tabs button:nth-child(1)", "#links tbody tr:nth-child(2)", "#picture-tabs button", "#plot", "#scrub"];
  for (const place of places) {
    if (place) await page.locator(place).click();
    await isShown();
    const now = await step();
    await page.keyboard.press(now > 10 ? "ArrowLeft" : "ArrowRight");
    await isShown();
    assert.equal(await step(), now > 10 ? now - 1 : now + 1, `after a click on ${place || "nothing"}`);
  }
  await page.keyboard.press(" ");
  assert.equal(await text(page, "#play"), "Pause");
  await page.keyboard.press(" ");
  await isShown();
  // What is written stays what is written.
  await showSettings(page);
  await page.locator("#save-name").click();
  const now = await step();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.type(" x");
  await page.waitForTimeout(300);
  assert.equal(await step(), now);
  assert.match(await page.inputValue("#save-name"), / x/);
  await page.close();
});

/** The page's messages come in the order that they must not rely on, the first ones after `hold_ms`. */
const shuffleMessages = (hold_ms) => {
  const Own = WebSocket;
  window.WebSocket = class extends Own {
    set onmessage(take) {
      let held = [];
      super.onmessage = (event) => (held ? held.push(event) : take(event));
      setTimeout(() => {
        const all = held.reverse();
        held = null;
        all.forEach((event) => take(event));
      }, hold_ms);
    }
  };
};

test("any order of messages will do, and the page says what it waits for", async () => {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.addInitScript(shuffleMessages, 3000);
  await page.goto(berth.url);
  assert.equal(await text(page, "#waiting"), "Waiting for berth.");
  assert.ok(await page.isVisible("#waiting"));
  assert.equal(await page.isVisible("#canvas-3d"), false);
  await isReady(page);
  assert.equal(await page.isVisible("#waiting"), false);
  assert.match(await text(page, "#legend"), /\d{5,} readings, 70468 triangles/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("a camera in the wrong place is told with its cause", async () => {
  const folder = join(place.folder, "wrong");
  cpSync(join(process.env.BERTH_SOURCE_DIR, "data/bundled"), folder, { recursive: true });
  const file = join(folder, "one_camera.yaml");
  const wrong = readFileSync(file, "utf8").replace(/depth_scale: 0.001/, "depth_scale: 0.01");
  writeFileSync(file, wrong);
  const other = await startBerth(["view", "one_camera.yaml", "--port", "0"], folder);
  const page = await open(other.url);
  await until(page, () => /depth_scale is 0.001/.test(document.getElementById("trouble").textContent));
  await page.close();
  assert.equal(await other.end(), 0);
});

test("a scene that cannot be read is told, and nothing is served", () => {
  writeFileSync(join(place.folder, "bad.yaml"), "robot: {urdf: nowhere.urdf}\ncameras: 7\njoints: joints.csv\n");
  const run = spawnSync(process.env.BERTH, ["view", "bad.yaml", "--port", "0"], { cwd: place.folder });
  assert.equal(run.status, 1);
  assert.equal(String(run.stdout), "");
  assert.match(String(run.stderr), /bad.yaml.*cameras.*expected/s);
});

test("a taken port is told with the next free one", () => {
  const port = new URL(berth.url).port;
  const run = spawnSync(process.env.BERTH, ["demo", "--view", "--port", port], { cwd: place.folder });
  assert.equal(run.status, 1);
  assert.equal(String(run.stdout), "");
  assert.match(String(run.stderr), new RegExp(`port ${port} of 127.0.0.1 is taken; expected a free one, such as --port \\d+`));
});

const data = process.env.BERTH_DATA ?? join(process.env.BERTH_SOURCE_DIR, "../shared/data");
const gripper = join(data, "recordings/lbr_med7_realsense/scene.yaml");

test("a gripper that no URDF has becomes a part of the robot by a click", { skip: !existsSync(gripper) && `${gripper} is missing` }, async () => {
  const other = await startBerth(["view", gripper, "--port", "0", "--save-to", place.folder], place.folder);
  const page = await open(other.url);
  const links = () => page.locator("#links tbody tr").count();
  const before = await links();
  await click(page, "#panel-tabs button:nth-child(3)");
  await click(page, "#calibrate");
  await isThere(page, "#is-part");
  assert.match(await text(page, "#attached-question"), /^lbr_link_7 carries something that its URDF does not have, \d+ x \d+ x \d+ cm/);
  await until(page, () => [...document.querySelectorAll("figure img")].some((image) => image.complete && image.naturalWidth > 100));
  await click(page, "#is-part");
  await isThere(page, "#take-calibration");
  await click(page, "#take-calibration");
  await until(page, () => /^Taken/.test(document.querySelector("#panels p:nth-child(2)")?.textContent));
  await click(page, "#panel-tabs button:nth-child(1)");
  await until(page, (count) => document.querySelectorAll("#links tbody tr").length > count, before);
  assert.equal(await links(), before + 1);
  await showSettings(page);
  await page.fill("#save-name", "with_gripper.yaml");
  await page.locator("#save").dispatchEvent("submit");
  await until(page, () => /^saved as/.test(document.getElementById("notice").textContent));
  assert.ok(existsSync(join(place.folder, "with_gripper.attached.lbr_link_7_attached.stl")));
  const run = spawnSync(process.env.BERTH, ["run", "with_gripper.yaml", "--format", "json"], { cwd: place.folder });
  assert.equal(run.status, 0, String(run.stderr));
  assert.match(String(run.stdout), /lbr_link_7_attached/);
  assert.deepEqual(page.errors, []);
  await page.close();
  await other.end();
});

test("Ctrl-C ends it at once, whatever it does", async () => {
  const other = await startBerth(["demo", "--view", "--port", "0"], place.folder);
  const page = await open(other.url);
  await click(page, "#panel-tabs button:nth-child(3)");
  await click(page, "#calibrate");
  await isThere(page, "#stop-calibration");
  const start_ms = performance.now();
  assert.equal(await other.end(), 0);
  const took_ms = performance.now() - start_ms;
  assert.ok(took_ms < 3000, `${took_ms} ms`);
  await page.close();
});

test("a program that ends leaves a message", async () => {
  const scene = join(process.env.BERTH_SOURCE_DIR, "data/bundled/one_camera.yaml");
  const other = await startBerth(["view", scene, "--port", "0"], place.folder);
  const page = await open(other.url);
  await other.end("SIGKILL");
  await until(page, () => /berth has ended/.test(document.getElementById("trouble").textContent));
  await page.close();
});
