// The page: what comes from the program goes to all its parts, so that they show the same frame.
import { colorings, coloringTexts, cssOf, hiddenColor, slowColor, stopColor, unseenColor, type Coloring } from "./colors";
import { Connection } from "./connection";
import { DistancesPanel, statusText } from "./distances_panel";
import { byId, make, tabs } from "./dom";
import type { Image, Message, Scene, Shown, Timeline } from "./messages";
import { legend, Picture } from "./picture";
import { Plot } from "./plot";
import { Scene3d, type Layers } from "./scene3d";
import { SettingsPanel } from "./settings_panel";
import { CalibrationPanel } from "./calibration_panel";

const layerTexts: [Exclude<keyof Layers, "coloring">, string][] = [
  ["robot", "Robot"],
  ["others", "Other links"],
  ["kept", "Obstacles"],
  ["filtered", "Filtered away"],
  ["distances", "Distances"],
  ["frusta", "Cameras"],
  ["hidden", "Unknown space"],
  ["unseen", "Seen by no camera"],
];
const usual: Layers = {
  robot: true, others: true, kept: true, filtered: false, distances: true, frusta: true, hidden: false, unseen: false, coloring: "filter",
};

let layers: Layers = { ...usual };
let scene: Scene | undefined;
let shown: Shown | undefined;
let timeline: Timeline | undefined;
let chosen = "";
let camera = 0;
let isPlaying = false;
/** Whether the view goes to the chosen link once its image is there. */
let isSought = false;
const fates = new Map<number, Set<number>>();

const view = new Scene3d(byId<HTMLCanvasElement>("canvas-3d"), byId("labels"), choose);
const picture = new Picture(byId<HTMLCanvasElement>("canvas-image"), byId("pixel"));
const plot = new Plot(byId("plot"), (step) => goTo(step));
const distances = new DistancesPanel(choose);
const connection = new Connection(take, () => {
  byId("status").textContent = "not connected";
  trouble("berth has ended, or cannot be reached. Start it again, then load this page again.");
});
const settings = new SettingsPanel((request) => connection.send(request));
const calibration = new CalibrationPanel((request) => connection.send(request));

const panels = [distances.element, settings.element, calibration.element];
const showPanel = tabs(byId("panel-tabs"), ["Distances", "Settings", "Calibration"], (index) => {
  byId("panels").replaceChildren(panels[index]);
});
let showCamera: (index: number) => void = () => {};

function take(message: Message): void {
  if (message.type === "scene") setScene(message);
  else if (message.type === "mesh") view.setMesh(message);
  else if (message.type === "shown") setShown(message);
  else if (message.type === "image") setImage(message);
  else if (message.type === "space") view.setSpace(message);
  else if (message.type === "settings") settings.setSettings(message);
  else if (message.type === "timeline") setTimeline(message);
  else if (message.type === "calibration_data") calibration.setState(message);
  else tell(message.text, message.is_refused);
}

/** What became of a request; of those before this page's first one it need not know. */
function tell(text: string, isRefused: boolean): void {
  if (!connection.hasAsked) return;
  byId("notice").textContent = text;
  byId("notice").classList.toggle("refused", isRefused);
}

/** Whether it is a running robot, which has no images to go to and no settings to turn. */
function isLive(): boolean {
  return scene?.steps.length === 0;
}

function setScene(message: Scene): void {
  scene = message;
  document.body.classList.toggle("live", isLive());
  document.body.classList.remove("waiting");
  byId("status").textContent = "connected";
  byId("scene-name").textContent = scene.file.replace(/.*\//, "");
  byId("scene-name").title = scene.file;
  byId("scene-note").textContent = scene.note;
  document.title = `berth: ${scene.robot}`;
  byId<HTMLInputElement>("scrub").max = String(scene.steps.length - 1);
  view.setScene(scene);
  picture.setScene(scene);
  plot.setScene(scene);
  distances.setScene(scene);
  showCamera = tabs(byId("picture-tabs"), scene.cameras.map((one) => one.name), (index) => {
    camera = index;
    picture.setCamera(index);
  });
  if (isLive()) showPanel(0);
  showCamera(Math.min(camera, scene.cameras.length - 1));
}

function setShown(message: Shown): void {
  shown = message;
  view.setShown(message);
  picture.setShown(message);
  if (!isLive()) plot.setStep(message.step);
  distances.setShown(message);
  showAnswer(message);
  if (isLive()) {
    byId("when").textContent = `${message.result.stamp_s.toFixed(3)} s`;
    return;
  }
  const [which, frame, stamp_s] = scene!.steps[message.step];
  byId("when").textContent = `${message.step + 1} of ${scene!.steps.length}: ${stamp_s.toFixed(3)} s, ${scene!.cameras[which].name} ${frame}`;
  const scrub = byId<HTMLInputElement>("scrub");
  if (document.activeElement !== scrub || isPlaying) scrub.value = String(message.step);
  document.body.dataset.step = String(message.step);
  if (isSought) view.lookAt(chosen);
  isSought = false;
  if (isPlaying) playOn();
}

function setImage(image: Image): void {
  // NaN is no number that every graphics processor knows.
  for (let i = 0; i < image.depth_m.length; ++i) if (!(image.depth_m[i] > 0)) image.depth_m[i] = 0;
  fates.set(image.camera, new Set(image.fate));
  view.setImage(image);
  picture.setImage(image);
  showLegend();
}

function setTimeline(message: Timeline): void {
  timeline = message;
  plot.setTimeline(message);
  byId("speed-key").hidden = message.speed === null;
  const progress = byId<HTMLProgressElement>("progress");
  progress.value = message.total > 0 ? message.done / message.total : 0;
  progress.classList.toggle("done", isLive() || message.done === message.total || message.error !== "");
  trouble([message.error, ...message.warnings].filter((text) => text !== "").join("\n"));
}

/** How good the result is, where every panel sees it. */
function showAnswer({ result, is_provisional }: Shown): void {
  const answer = byId("answer");
  answer.textContent = [result.status === "ok" ? "" : result.status, is_provisional ? "provisional" : ""].filter((text) => text !== "").join(", ");
  answer.title = statusText(result);
  answer.className = result.status;
}

function trouble(text: string): void {
  byId("trouble").textContent = text;
  byId("trouble").hidden = text === "";
}

function choose(link: string): void {
  chosen = link;
  view.choose(link);
  picture.choose(link);
  plot.choose(link);
  distances.setChosen(link);
  showPanel(0);
}

function goTo(step: number): void {
  if (!scene || isLive()) return;
  connection.send({ do: "show", step: Math.max(0, Math.min(scene.steps.length - 1, step)) });
}

function playOn(): void {
  const next = shown!.step + 1;
  if (next >= scene!.steps.length) return play(false);
  const wait_s = Math.min(1, Math.max(0, scene!.steps[next][2] - scene!.steps[next - 1][2]));
  setTimeout(() => isPlaying && goTo(next), 1000 * wait_s);
}

function play(on: boolean): void {
  if (isLive()) return;
  isPlaying = on;
  byId("play").textContent = on ? "Pause" : "Play";
  byId("play").setAttribute("aria-pressed", String(on));
  if (!on || !shown || !scene) return;
  if (shown.step + 1 < scene.steps.length) goTo(shown.step + 1);
  else goTo(0);
}

function showLegend(): void {
  if (!scene) return;
  const all = new Set([...fates.values()].flatMap((one) => [...one]));
  const entries = legend(layers.coloring, scene, all);
  if (layers.hidden) entries.push([hiddenColor, "unknown space"]);
  if (layers.unseen) entries.push([unseenColor, "seen by no camera"]);
  const spans = entries.map(([color, text]) => {
    const key = make("i", { className: "key" });
    key.style.background = color;
    return make("span", {}, [key, text]);
  });
  const { points, triangles } = view.counts();
  const count = make("span", { className: "faint", textContent: `${points} readings, ${triangles} triangles` });
  byId("legend").replaceChildren(...spans, count);
}

function setLayers(changed: Partial<Layers>): void {
  const had = layers.hidden || layers.unseen;
  layers = { ...layers, ...changed };
  view.setLayers(layers);
  picture.setLayers(layers.coloring, layers.distances);
  for (const [key] of layerTexts) byId<HTMLInputElement>(`layer-${key}`).checked = layers[key];
  byId<HTMLSelectElement>("coloring").value = layers.coloring;
  const has = layers.hidden || layers.unseen;
  if (has !== had) connection.send({ do: "space", on: has });
  showLegend();
}

function makeLayers(): void {
  const boxes = layerTexts.map(([key, text]) => {
    const box = make("input", { type: "checkbox", id: `layer-${key}` });
    box.onchange = () => setLayers({ [key]: box.checked });
    return make("label", {}, [box, text]);
  });
  const select = make("select", { id: "coloring" }, colorings.map((one) => make("option", { value: one, textContent: coloringTexts[one] })));
  select.setAttribute("aria-label", "Colour of readings");
  select.onchange = () => setLayers({ coloring: select.value as Coloring });
  byId("layers").append(...boxes, select);
}

/** The image and link of the least distance of all. */
function nearestOfAll(): { step: number; link: string } | undefined {
  if (!scene || !timeline || isLive()) return undefined;
  let best: { step: number; link: string; distance_m: number } | undefined;
  timeline.nearest.forEach((row, step) => {
    if (row === null) return;
    const distance_m = timeline!.links.distance_m[row][step]!;
    const link = scene!.links.find((one) => one.id === row + 1)!.name;
    if (distance_m < (best?.distance_m ?? Infinity)) best = { step, link, distance_m };
  });
  return best;
}

const questions: [string, string, () => void][] = [
  ["Is the pose right?", "Readings coloured by how they fit the robot, and the camera's pose", () => {
    setLayers({ ...usual, filtered: true, distances: false, coloring: "fit" });
    if (isLive()) return;
    showPanel(1);
    settings.showPose(camera);
  }],
  ["What is filtered?", "All readings, coloured by what the filter did", () => {
    setLayers({ ...usual, filtered: true, robot: false, distances: false });
    showPanel(0);
    view.lookAtAll();
  }],
  ["Why this distance?", "The nearest link, its line and its numbers", () => {
    const link = chosen || shown?.result.nearest;
    if (!link) return;
    setLayers({ ...usual, others: false });
    choose(link);
    view.lookAt(link);
  }],
  ["When was it nearest?", "The image with the least distance of all", () => {
    const nearest = nearestOfAll();
    if (!nearest) return;
    setLayers({ ...usual, others: false });
    choose(nearest.link);
    isSought = true;
    goTo(nearest.step);
  }],
  ["What is hidden?", "The space behind readings that no camera sees", () => {
    setLayers({ ...usual, hidden: true });
    view.lookAtAll();
  }],
];

byId("questions").append(...questions.map(([textContent, title, onclick]) => make("button", { textContent, title, onclick })));
makeLayers();
byId("speed-key").append(
  ...([["slower", slowColor], ["stop", stopColor]] as const).map(([text, color]) => {
    const key = make("i", { className: "key" });
    key.style.background = cssOf(color);
    return make("span", {}, [key, text]);
  }),
);
setLayers({});
showPanel(0);
byId("play").onclick = () => play(!isPlaying);
byId("before").onclick = () => shown && goTo(shown.step - 1);
byId("after").onclick = () => shown && goTo(shown.step + 1);
byId<HTMLInputElement>("scrub").oninput = (event) => goTo(Number((event.target as HTMLInputElement).value));
document.addEventListener("keydown", (event) => {
  const target = event.target as HTMLElement;
  if (target.closest("input, select, button, #canvas-3d") && !(target.id === "canvas-3d" && event.key === " ")) return;
  if (event.key === " ") play(!isPlaying);
  else if (event.key === "ArrowLeft" && shown) goTo(shown.step - 1);
  else if (event.key === "ArrowRight" && shown) goTo(shown.step + 1);
  else return;
  event.preventDefault();
});
