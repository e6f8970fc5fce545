// The page: what comes from the program goes to all its parts, so that they show the same frame.
import { CalibrationPanel } from "./calibration_panel";
import { Connection } from "./connection";
import { DistancesPanel, statusText } from "./distances_panel";
import { byId, make, nearText, tabs } from "./dom";
import { Inbox } from "./inbox";
import { listenToKeys } from "./keys";
import { makeLayerBoxes, makeSpeedKey, showLayerBoxes, showLegend, usualLayers, type Layers } from "./layers";
import type { Image, LinkResult, Message, Scene, Shown, Timeline } from "./messages";
import { Picture } from "./picture";
import { Plot } from "./plot";
import { Scene3d } from "./scene3d";
import { SettingsPanel } from "./settings_panel";

let layers: Layers = { ...usualLayers };
let scene: Scene | undefined;
let shown: Shown | undefined;
let timeline: Timeline | undefined;
let chosen = "";
let camera = 0;
let isPlaying = false;
/** The question whose answer is on show; -1: none. */
let asked = -1;
/** The step of the least distance, once somebody asked for it, and whether its image is still to come. */
let nearestStep = -1;
let isSought = false;
const fates = new Map<number, Set<number>>();

const view = new Scene3d(byId<HTMLCanvasElement>("canvas-3d"), byId("labels"), askWhy);
const picture = new Picture(byId<HTMLCanvasElement>("canvas-image"), byId("pixel"));
const plot = new Plot(byId("plot"), (step) => goTo(step));
const distances = new DistancesPanel(askWhy);
const inbox = new Inbox(take, (text) => (byId("waiting").textContent = text));
const connection = new Connection((message) => inbox.put(message), () => {
  byId("status").textContent = "not connected";
  trouble("berth has ended, or cannot be reached. Start it again, then load this page again.");
});
const settings = new SettingsPanel((request) => connection.send(request));
const calibration = new CalibrationPanel((request) => connection.send(request));

const panels = [distances.element, settings.element, calibration.element];
const showPanel = tabs(byId("panel-tabs"), ["Distances", "Settings", "Calibration"], (index) => {
  if (panels[index].isConnected) return;
  byId("panels").replaceChildren(panels[index]);
  byId("panels").scrollTop = 0;
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
  else if (message.type === "notice") tell(message.text, message.is_refused);
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
  byId("scene-name").textContent = scene.file.replace(/.*\//, "");
  byId("scene-name").title = scene.file;
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
  showAnswerToQuestion();
  showStatus();
  if (isLive()) {
    byId("when").textContent = `${message.result.stamp_s.toFixed(3)} s`;
    return;
  }
  const [which, frame, stamp_s] = scene!.steps[message.step];
  byId("when").textContent = `frame ${message.result.frame}: ${stamp_s.toFixed(3)} s, ${scene!.cameras[which].name}'s image ${frame}`;
  const scrub = byId<HTMLInputElement>("scrub");
  if (document.activeElement !== scrub || isPlaying) scrub.value = String(message.step);
  document.body.dataset.step = String(message.step);
  if (isPlaying) playOn();
}

function setImage(image: Image): void {
  // NaN is no number that every graphics processor knows.
  for (let i = 0; i < image.depth_m.length; ++i) if (!(image.depth_m[i] > 0)) image.depth_m[i] = 0;
  fates.set(image.camera, new Set(image.fate));
  view.setImage(image);
  picture.setImage(image);
  showColors();
  showStatus();
}

/** What is still to come of the cameras that have an image. */
function showStatus(): void {
  const missing = scene!.cameras.filter((_, i) => shown?.cameras[i] && !fates.has(i)).map((one) => one.name);
  byId("status").textContent = missing.length > 0 ? `waiting for the image of ${missing.join(", ")}` : "connected";
}

function showColors(): void {
  if (!scene) return;
  showLegend(layers, scene, new Set([...fates.values()].flatMap((one) => [...one])), view.counts());
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
  showAnswerToQuestion();
}

/** A link that was clicked: when it was nearest is another question. */
function askWhy(link: string): void {
  if (asked === whenQuestion) asked = whyQuestion;
  choose(link);
}

function goTo(step: number): void {
  if (!scene || isLive()) return;
  connection.send({ do: "show", step: Math.max(0, Math.min(scene.steps.length - 1, step)) });
}

function stepBy(by: number): void {
  if (shown) goTo(shown.step + by);
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

function setLayers(changed: Partial<Layers>): void {
  const had = layers.hidden || layers.unseen;
  layers = { ...layers, ...changed };
  view.setLayers(layers);
  picture.setLayers(layers.coloring, layers.distances);
  showLayerBoxes(layers);
  const has = layers.hidden || layers.unseen;
  if (has !== had) connection.send({ do: "space", on: has });
  showColors();
}

/** The image and link of the least distance of all. */
function nearestOfAll(): { step: number; link: string } | undefined {
  if (!scene || !timeline || isLive()) return undefined;
  let best: { step: number; link: string; distance_m: number } | undefined;
  timeline.nearest.forEach((row, step) => {
    if (row === null) return;
    const distance_m = timeline!.links.distance_m[row][step]!;
    const link = scene!.links.find((one) => one.id === row + 1)?.name;
    if (link !== undefined && distance_m < (best?.distance_m ?? Infinity)) best = { step, link, distance_m };
  });
  return best;
}

const questions: [string, string, () => void][] = [
  ["Is the pose right?", "Readings coloured by how they fit the robot, and the camera's pose", () => {
    setLayers({ ...usualLayers, filtered: true, distances: false, coloring: "fit" });
    if (isLive()) return;
    showPanel(1);
    settings.showPose(camera);
  }],
  ["What is filtered?", "All readings, coloured by what the filter did", () => {
    setLayers({ ...usualLayers, filtered: true, robot: false, distances: false });
    showPanel(0);
    view.lookAtAll();
  }],
  ["Why this distance?", "The nearest link, its line and its numbers", () => {
    const link = chosen || shown?.result.nearest;
    if (!link) return;
    setLayers({ ...usualLayers, others: false });
    choose(link);
    view.lookAt(link);
  }],
  ["When was it nearest?", "The image with the least distance of all", () => {
    play(false);
    const nearest = nearestOfAll();
    nearestStep = nearest?.step ?? -1;
    if (!nearest) return;
    isSought = true;
    setLayers({ ...usualLayers, others: false });
    choose(nearest.link);
    goTo(nearest.step);
  }],
  ["What is hidden?", "The space behind readings that no camera sees", () => {
    setLayers({ ...usualLayers, hidden: true });
    view.lookAtAll();
  }],
];
const whyQuestion = 2;
const whenQuestion = 3;

/** The one that is asked already is taken back. */
function ask(question: number): void {
  if (!scene) return;
  asked = question === asked ? -1 : question;
  if (asked < 0) setLayers(usualLayers);
  else questions[asked][2]();
  showAnswerToQuestion();
  byId("space").scrollIntoView({ block: "nearest" });
}

/** Which question is asked, and its answer where that is a distance; unknown space is drawn where that is what is near. */
function showAnswerToQuestion(): void {
  if (asked === whenQuestion && shown?.step === nearestStep && isSought) {
    isSought = false;
    view.lookAt(chosen);
  }
  if (asked === whenQuestion && !isSought && nearestStep >= 0 && shown?.step !== nearestStep) asked = -1;
  const isOfDistance = asked === whyQuestion || asked === whenQuestion;
  const link = shown?.result.links.find((one) => one.link === chosen);
  const isUnknown = link?.obstacle_is === "unknown" && !isLive();
  if (isOfDistance && layers.hidden !== isUnknown) setLayers({ hidden: isUnknown });
  byId("said").textContent = isOfDistance && !isSought ? sentence(link) : "";
  byId("questions").querySelectorAll("button").forEach((button, i) => button.setAttribute("aria-pressed", String(i === asked)));
}

function sentence(link?: LinkResult): string {
  if (asked === whyQuestion) return link ? nearText(link) : "No link that moves has a distance here.";
  if (nearestStep < 0 || !link) return "No distance is known yet.";
  const isWhole = timeline!.done === timeline!.total;
  return `${isWhole ? "Nearest" : "Nearest so far"}, at ${scene!.steps[nearestStep][2].toFixed(3)} s: ${nearText(link)}`;
}

byId("questions").append(...questions.map(([textContent, title], i) => make("button", { textContent, title, onclick: () => ask(i) })));
makeLayerBoxes(setLayers);
makeSpeedKey();
setLayers({});
showPanel(0);
byId("play").onclick = () => play(!isPlaying);
byId("before").onclick = () => stepBy(-1);
byId("after").onclick = () => stepBy(1);
byId<HTMLInputElement>("scrub").oninput = (event) => goTo(Number((event.target as HTMLInputElement).value));
listenToKeys({ play: () => play(!isPlaying), step: stepBy });
