// The table of links, all numbers of the chosen one, and what became of the pixels.
import { lengthText, make } from "./dom";
import type { LinkResult, Scene, Shown } from "./messages";

export class DistancesPanel {
  readonly element = make("div");
  private scene?: Scene;
  private shown?: Shown;
  private chosen = "";
  private speed = "";

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
  /** What the separation monitor says; empty where there is none. */
  setSpeed(text: string): void {
    if (text === this.speed) return;
    this.speed = text;
    this.fill();
  }

  private fill(): void {
    if (!this.scene || !this.shown) return;
    const { links } = this.shown.result;
    const chosen = links.find((link) => link.link === this.chosen);
    const focused = (document.activeElement as HTMLElement)?.dataset?.link;
    const speed = this.speed ? [make("p", { id: "speed", textContent: `Speed: ${this.speed}` })] : [];
    this.element.replaceChildren(...speed, this.table(links), this.details(chosen), this.fates());
    if (focused) this.element.querySelector<HTMLElement>(`tr[data-link="${CSS.escape(focused)}"]`)?.focus();
  }

  private table(links: LinkResult[]): HTMLElement {
    const rows = links.map((link) => {
      const color = this.scene!.links.find((one) => one.name === link.link)!.color;
      const key = make("span", { className: "key" });
      key.style.cssText = `display: inline-block; background: ${color}`;
      const row = make("tr", { tabIndex: 0, className: link.link === this.chosen ? "chosen" : "" }, [
        make("td", {}, [key, ` ${link.link}`]),
        make("td", { textContent: link.status.replaceAll("_", " ") }),
        make("td", { textContent: lengthText(link.distance_m) }),
        make("td", { textContent: link.obstacle_is ?? "" }),
      ]);
      row.dataset.link = link.link;
      row.onclick = () => this.choose(link.link);
      row.onkeydown = (event) => {
        if (event.key === "Enter") this.choose(link.link);
      };
      return row;
    });
    const head = make("tr", {}, ["link", "status", "distance", "to what is"].map((text) => make("th", { textContent: text })));
    return make("table", { id: "links" }, [make("thead", {}, [head]), make("tbody", {}, rows)]);
  }

  private details(link?: LinkResult): HTMLElement {
    if (!link) return make("p", { className: "faint", textContent: "Click a link or a line for its numbers." });
    const point = (p?: number[] | null) => (p ? `${p.map((x) => x.toFixed(3)).join(", ")} m` : "–");
    const percent = (share?: number | null) => (share === null || share === undefined ? "–" : `${(100 * share).toFixed(0)} %`);
    const lines: [string, string][] = [
      ["distance", lengthText(link.distance_m)],
      ["certainly at least", lengthText(link.lower_bound_m)],
      ["obstacle is", link.obstacle_is === "hidden" ? "hidden behind a reading" : (link.obstacle_is ?? "–")],
      ["camera and pixel", link.camera ? `${link.camera} (${link.obstacle_pixel?.join(", ")})` : (link.obstacle_pixel?.join(", ") ?? "–")],
      ["point of the link", point(link.robot_point_base_m)],
      ["point of the obstacle", point(link.obstacle_point_base_m)],
      ["to readings alone", lengthText(link.reading_distance_m)],
      ["seen of its surface", percent(link.visibility?.surface?.seen)],
      ["not known around it", percent(link.visibility?.space_unknown)],
      ["doubtful reading at", lengthText(link.visibility?.doubtful_distance_m)],
    ];
    const list = make("dl", {}, lines.flatMap(([name, value]) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));
    return make("div", { id: "link-details" }, [make("h3", { textContent: link.link }), list]);
  }

  private fates(): HTMLElement {
    const { result } = this.shown!;
    const cameras = result.cameras.map((camera) => ({ ...camera, counts: camera.self_filter ?? result.self_filter }));
    const names = this.scene!.fates.map((fate) => fate.name).filter((name) => cameras.some((camera) => camera.counts?.[name]));
    const head = make("tr", {}, ["pixels", ...cameras.map((camera) => camera.camera)].map((text) => make("th", { textContent: text })));
    const status = make("tr", {}, ["camera is", ...cameras.map((camera) => camera.status)].map((text) => make("td", { textContent: text })));
    const rows = names.map((name) =>
      make("tr", {}, [name.replaceAll("_", " "), ...cameras.map((camera) => String(camera.counts?.[name] ?? "–"))].map((text) => make("td", { textContent: text }))),
    );
    return make("div", {}, [
      make("h3", { textContent: "What the filter did" }),
      make("table", { id: "fates" }, [make("thead", {}, [head]), make("tbody", {}, [status, ...rows])]),
    ]);
  }
}
