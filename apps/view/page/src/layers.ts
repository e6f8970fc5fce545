// What is drawn: the boxes beside the 3D view, and the list of colours below it.
import { colorings, coloringTexts, cssOf, hiddenColor, slowColor, stopColor, unseenColor, type Coloring } from "./colors";
import { byId, make } from "./dom";
import type { Scene } from "./messages";
import { legend } from "./picture";

export interface Layers {
  robot: boolean;
  /** Links beside the chosen one as solid as it. */
  others: boolean;
  kept: boolean;
  filtered: boolean;
  distances: boolean;
  frusta: boolean;
  hidden: boolean;
  unseen: boolean;
  coloring: Coloring;
}

export const usualLayers: Layers = {
  robot: true, others: true, kept: true, filtered: false, distances: true, frusta: true, hidden: false, unseen: false, coloring: "filter",
};

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

/** The boxes; `change` gets what a user ticks. On a phone they are folded, since they would hide the view. */
export function makeLayerBoxes(change: (changed: Partial<Layers>) => void): void {
  const boxes = layerTexts.map(([key, text]) => {
    const box = make("input", { type: "checkbox", id: `layer-${key}` });
    box.onchange = () => change({ [key]: box.checked });
    return make("label", {}, [box, text]);
  });
  const select = make("select", { id: "coloring" }, colorings.map((one) => make("option", { value: one, textContent: coloringTexts[one] })));
  select.setAttribute("aria-label", "Colour of readings");
  select.onchange = () => change({ coloring: select.value as Coloring });
  byId("layer-boxes").append(...boxes, select);
  byId<HTMLDetailsElement>("layers").open = !matchMedia("(max-width: 600px), (max-height: 500px)").matches;
}

export function showLayerBoxes(layers: Layers): void {
  for (const [key] of layerTexts) byId<HTMLInputElement>(`layer-${key}`).checked = layers[key];
  byId<HTMLSelectElement>("coloring").value = layers.coloring;
}

function keyed(color: string, text: string): HTMLElement {
  const key = make("i", { className: "key" });
  key.style.background = color;
  return make("span", {}, [key, text]);
}

/** What the colours mean; `fates` are those that some image has. */
export function showLegend(layers: Layers, scene: Scene, fates: Set<number>, counts: { points: number; triangles: number }): void {
  const entries = legend(layers.coloring, scene, fates);
  if (layers.hidden) entries.push([hiddenColor, "unknown space"]);
  if (layers.unseen) entries.push([unseenColor, "seen by no camera"]);
  const count = make("span", { className: "faint", textContent: `${counts.points} readings, ${counts.triangles} triangles` });
  byId("legend").replaceChildren(...entries.map(([color, text]) => keyed(color, text)), count);
}

export function makeSpeedKey(): void {
  byId("speed-key").append(keyed(cssOf(slowColor), "slower"), keyed(cssOf(stopColor), "stop"));
}
