// All settings, from the program's own list. A change is sent while it is made.
import type { Request } from "./connection";
import { make } from "./dom";
import type { CameraPose, SettingGroup, Settings, SettingText, Value } from "./messages";

const degree_rad = Math.PI / 180;
const poseNames = ["x", "y", "z", "roll", "pitch", "yaw"];

/** A step that changes the third digit or so. */
function stepOf(value: Value): number {
  const size = Math.abs(Number(value));
  return size > 0 ? 10 ** Math.floor(Math.log10(size) - 0.7) : 0.01;
}

const groupNames: Record<string, string> = {
  self_filter: "Self filter", sensor: "Sensor", space: "Unknown space", watch: "Watch of the camera", evaluation: "Evaluation", time: "Time", separation: "Separation",
};

/** One row: its input, and how it is set anew. */
interface Row {
  element: HTMLElement;
  show: (now: Value, file: Value, isChanged?: boolean) => void;
}

export class SettingsPanel {
  readonly element = make("div");
  private settings?: Settings;
  private camera: number | null = null;
  private rows = new Map<string, Row>();
  private shape = "";
  private readonly scope = make("select", { id: "setting-camera", onchange: () => this.chooseScope() });
  private readonly name = make("input", { id: "save-name", value: "changed.yaml" });
  private readonly groups = make("div");

  constructor(private readonly send: (request: Request) => void) {
    this.name.setAttribute("aria-label", "Name of the new scene file");
    const save = make("form", { className: "row", id: "save" }, [
      this.name,
      make("button", { textContent: "Save as" }),
      make("button", { id: "reset", type: "button", textContent: "All as in the file", onclick: () => this.send({ do: "reset" }) }),
    ]);
    save.onsubmit = (event) => {
      event.preventDefault();
      this.send({ do: "save", name: this.name.value });
    };
    const label = make("label", { className: "row" }, ["Settings of ", this.scope]);
    this.element.append(save, label, this.groups);
  }

  setSettings(settings: Settings): void {
    this.settings = settings;
    const names = settings.poses.map((pose) => pose.camera);
    const shape = JSON.stringify(names);
    if (shape !== this.shape) {
      this.shape = shape;
      const choices = ["all cameras", ...names].map((text, i) => make("option", { value: String(i - 1), textContent: text }));
      this.scope.replaceChildren(...choices);
      this.makeRows();
    }
    this.fill();
  }

  /** Shows this camera's settings, with the pose open. */
  showPose(camera: number): void {
    this.scope.value = String(camera);
    this.chooseScope();
    this.groups.querySelector("details")!.open = true;
    this.groups.scrollIntoView({ block: "nearest" });
  }

  private chooseScope(): void {
    const number = Number(this.scope.value);
    this.camera = number < 0 ? null : number;
    this.fill();
  }

  private makeRows(): void {
    this.rows.clear();
    const pose = this.group("pose", "Pose of the camera", poseNames.map((name, i) => this.poseRow(name, i)));
    const groups = this.settings!.groups.map((group) =>
      this.group(group.name, groupNames[group.name] ?? group.name, group.settings.map((setting) => this.settingRow(group, setting))),
    );
    this.groups.replaceChildren(pose, ...groups);
  }

  private group(name: string, title: string, rows: HTMLElement[]): HTMLElement {
    const details = make("details", { open: name === "self_filter" }, [make("summary", { textContent: title }), ...rows]);
    details.dataset.group = name;
    return details;
  }

  private row(key: string, label: string, input: HTMLInputElement | HTMLSelectElement, sentence: string, back: () => void): Row {
    input.id = key;
    const button = make("button", { textContent: "↺", title: "As in the file", onclick: back });
    const name = make("label", { textContent: label, htmlFor: key });
    const element = make("div", { className: "setting" }, [name, input, button, make("small", { textContent: sentence })]);
    const show = (now: Value, file: Value, isChanged = now !== file) => {
      element.classList.toggle("changed", isChanged);
      button.setAttribute("aria-label", `${label}: back to ${file ?? "none"}, as in the file`);
      if (input instanceof HTMLInputElement && input.type === "checkbox") input.checked = now === true;
      // What is being typed stays.
      else if (document.activeElement !== input || Number(input.value) !== now) input.value = now === null ? "" : String(now);
      if (input instanceof HTMLInputElement && input.type === "number" && document.activeElement !== input) {
        input.step = String(stepOf(now));
      }
    };
    const row = { element, show };
    this.rows.set(key, row);
    return row;
  }

  private settingRow(group: SettingGroup, setting: SettingText): HTMLElement {
    const key = `${group.name}.${setting.name}`;
    const set = (value: Value) =>
      this.send({ do: "set", group: group.name, key: setting.name, camera: group.by_camera ? this.camera : null, value });
    const label = setting.unit ? `${setting.name} [${setting.unit}]` : setting.name;
    const domain = setting.domain ? ` (${setting.domain})` : "";
    return this.row(key, label, inputOf(setting, set), `${setting.sentence}${domain}.`, () => set(null)).element;
  }

  private poseRow(name: string, i: number): HTMLElement {
    const input = make("input", { type: "number", step: "any" });
    input.oninput = () => this.sendPose();
    const label = i < 3 ? `${name} [m]` : `${name} [°]`;
    const sentence = i < 3 ? `the optical frame's ${name} in the parent link` : `turn about the parent's fixed ${"xyz"[i - 3]} axis`;
    return this.row(`pose.${name}`, label, input, sentence, () => {
      if (this.camera !== null) this.send({ do: "pose", camera: this.camera, xyz_m: null });
    }).element;
  }

  private sendPose(): void {
    if (this.camera === null) return;
    const texts = poseNames.map((name) => (document.getElementById(`pose.${name}`) as HTMLInputElement).value);
    if (texts.some((text) => text === "" || !Number.isFinite(Number(text)))) return;
    const values = texts.map(Number);
    this.send({
      do: "pose", camera: this.camera, xyz_m: values.slice(0, 3), rpy_rad: values.slice(3).map((value) => value * degree_rad),
    });
  }

  private fill(): void {
    if (!this.settings) return;
    this.settings.groups.forEach((group) => {
      // Of all cameras the first one's value stands there, marked where any has changed.
      const camera = group.by_camera ? (this.camera ?? 0) : 0;
      const shown = this.camera === null ? group.now.map((_, c) => c) : [camera];
      group.settings.forEach((setting, i) => {
        const isChanged = shown.some((c) => group.now[c][i] !== group.file[c][i]);
        this.rows.get(`${group.name}.${setting.name}`)!.show(group.now[camera][i], group.file[camera][i], isChanged);
      });
    });
    const pose: CameraPose = this.settings.poses[this.camera ?? 0];
    const numbers = (one: CameraPose["now"]) => [...one.xyz_m, ...one.rpy_rad.map((angle) => angle / degree_rad)].map((x) => Math.round(x * 1e4) / 1e4);
    const [now, file] = [numbers(pose.now), numbers(pose.file)];
    poseNames.forEach((name, i) => {
      this.rows.get(`pose.${name}`)!.show(now[i], file[i]);
      const input = document.getElementById(`pose.${name}`) as HTMLInputElement | null;
      if (!input) return;
      input.disabled = this.camera === null;
      input.step = i < 3 ? "0.01" : "0.5";
    });
  }
}

function inputOf(setting: SettingText, set: (value: Value) => void): HTMLInputElement | HTMLSelectElement {
  if (setting.kind === "choice") {
    const options = setting.choices!.map((name) => make("option", { value: name, textContent: name }));
    const select = make("select", {}, options);
    select.onchange = () => set(select.value);
    return select;
  }
  if (setting.kind === "bool") {
    const box = make("input", { type: "checkbox" });
    box.onchange = () => set(box.checked);
    return box;
  }
  const input = make("input", { type: "number", min: String(setting.least ?? ""), max: String(setting.most ?? ""), placeholder: "none" });
  input.oninput = () => {
    if (input.value === "" || !Number.isFinite(Number(input.value))) return;
    set(Number(input.value));
  };
  return input;
}
