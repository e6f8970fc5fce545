// The table of links, all numbers of the chosen one, and what became of the pixels.
import { distanceText, lengthText, make } from "./dom";
import type { LinkResult, Result, Scene, Shown } from "./messages";

/** What became of a camera that is not as it should be; the page and `berth run` name it alike. */
function troubleOf(result: Result): string {
  const cameras = result.cameras.filter((camera) => !["ok", "hidden"].includes(camera.status));
  return cameras.map((camera) => `camera ${camera.camera} is ${camera.status.replaceAll("_", " ")}`).join(", ");
}

/** Why a result is not complete; empty where it is. */
export function statusText(result: Result): string {
  if (result.status === "ok") return "";
  const isLate = result.time.status !== "ok";
  const why = [...(isLate ? [result.time.status.replaceAll("_", " ")] : []), troubleOf(result)].filter((text) => text !== "").join(", ");
  if (result.status === "degraded") return `Degraded: ${why}; distances may be larger than with it.`;
  return `Stale: there is no answer${why ? `: ${why}` : ""}.`;
}

/** The words are those of `berth run`. */
const columns = [
  ["link", ""],
  ["distance [m]", "to what is seen or unknown, whichever is nearer"],
  ["nearest is", "occupied: a camera measured it; unknown: hidden, and seen free by no camera"],
  ["to occupied [m]", "to what a camera measured, alone"],
  ["status", ""],
];

function metres(length_m: number | null): string {
  return length_m === null ? "–" : length_m.toFixed(3);
}

export class DistancesPanel {
  readonly element = make("div");
  private scene?: Scene;
  private shown?: Shown;
  private chosen = "";

  constructor(private readonly choose: (link: string) => void) {}

  setScene(scene: Scene): void {
    this.scene = scene;
  }
  setShown(shown: Shown): void {
    this.shown = shown;
    this.fill();
  }
  setChosen(link: string): void {
    this.chosen = link;
    this.fill();
  }

  private fill(): void {
    if (!this.scene || !this.shown) return;
    const { links, separation } = this.shown.result;
    const problem = statusText(this.shown.result);
    const chosen = links.find((link) => link.link === this.chosen);
    const focused = (document.activeElement as HTMLElement)?.dataset?.link;
    const provisional = "Provisional: from this frame alone, until the curves have come here.";
    const lines = [
      ...(this.shown.is_provisional ? [make("p", { id: "provisional", className: "faint", textContent: provisional })] : []),
      ...(problem ? [make("p", { id: "result-status", className: "refused", textContent: problem })] : []),
      ...(separation ? [make("p", { id: "speed", textContent: `Speed: ${separation.text}` })] : []),
    ];
    this.element.replaceChildren(...lines, this.table(links), this.details(chosen), this.fates());
    if (focused) this.element.querySelector<HTMLElement>(`tr[data-link="${CSS.escape(focused)}"]`)?.focus();
  }

  private table(links: LinkResult[]): HTMLElement {
    const rows = links.map((link) => {
      const color = this.scene!.links.find((one) => one.name === link.link)!.color;
      const key = make("span", { className: "key" });
      key.style.cssText = `display: inline-block; background: ${color}`;
      const row = make("tr", { tabIndex: 0, className: link.link === this.chosen ? "chosen" : "" }, [
        make("td", {}, [key, ` ${link.link}`]),
        make("td", { textContent: metres(link.distance_m) }),
        make("td", { textContent: link.obstacle_is ?? "" }),
        make("td", { textContent: metres(link.occupied.distance_m) }),
        make("td", { textContent: link.status.replaceAll("_", " ") }),
      ]);
      row.dataset.link = link.link;
      row.onclick = () => this.choose(link.link);
      row.onkeydown = (event) => {
        if (event.key === "Enter") this.choose(link.link);
      };
      return row;
    });
    const head = make("tr", {}, columns.map(([textContent, title]) => make("th", { textContent, title })));
    return make("table", { id: "links" }, [make("thead", {}, [head]), make("tbody", {}, rows)]);
  }

  private details(link?: LinkResult): HTMLElement {
    if (!link) return make("p", { className: "faint", textContent: "Click a link or a line for its numbers." });
    const point = (p?: number[] | null) => (p ? `${p.map((x) => x.toFixed(3)).join(", ")} m` : "–");
    const percent = (share?: number | null) => (share === null || share === undefined ? "–" : `${(100 * share).toFixed(0)} %`);
    const lines: [string, string][] = [
      ["distance", distanceText(link)],
      ["certainly at least", lengthText(link.lower_bound_m)],
      ["obstacle is", link.obstacle_is === "unknown" ? "unknown: hidden, and seen free by no camera" : link.obstacle_is === "unobserved" ? "unobserved: in no image" : (link.obstacle_is ?? "–")],
      ["camera and pixel", link.camera ? `${link.camera} (${link.obstacle_pixel?.join(", ") ?? "no pixel"})` : "–"],
      ["point of the link", point(link.robot_point_base_m)],
      ["point of the obstacle", point(link.obstacle_point_base_m)],
      ["to occupied", lengthText(link.occupied.distance_m)],
      ["to known", link.known?.link ? `${lengthText(link.known.distance_m)}, ${link.known.link}` : "–"],
      ["seen of its surface", percent(link.visibility?.surface?.seen)],
      ["unseen space nearby", percent(link.visibility?.space_unknown)],
      ["rejected reading at", lengthText(link.visibility?.rejected_distance_m)],
    ];
    const list = make("dl", {}, lines.flatMap(([name, value]) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));
    return make("div", { id: "link-details" }, [make("h3", { textContent: link.link }), list]);
  }

  private fates(): HTMLElement {
    const { cameras } = this.shown!.result;
    const names = this.scene!.fates.map((fate) => fate.name).filter((name) => cameras.some((camera) => camera.self_filter?.[name]));
    const head = make("tr", {}, ["pixels", ...cameras.map((camera) => camera.camera)].map((text) => make("th", { textContent: text })));
    const status = make("tr", {}, ["camera is", ...cameras.map((camera) => camera.status.replaceAll("_", " "))].map((text) => make("td", { textContent: text })));
    const rows = names.map((name) =>
      make("tr", {}, [name.replaceAll("_", " "), ...cameras.map((camera) => String(camera.self_filter?.[name] ?? "–"))].map((text) => make("td", { textContent: text }))),
    );
    return make("div", {}, [
      make("h3", { textContent: "What the filter did" }),
      make("table", { id: "fates" }, [make("thead", {}, [head]), make("tbody", {}, [status, ...rows])]),
    ]);
  }
}
