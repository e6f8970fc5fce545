// Distances over time. A click goes to an image.
import uPlot from "uplot";
import { cssOf, slowColor, stopColor, type Rgb } from "./colors";
import type { Scene, Timeline } from "./messages";

const warnColor: Rgb = [0xd9, 0x50, 0x00];

/** Of one link: what is sure, and what is rejected; null elsewhere. A rejected piece joins its neighbours. */
function split(distances: (number | null)[], rejected: boolean[]): [(number | null)[], (number | null)[]] {
  const sure = distances.map((distance, i) => (rejected[i] ? null : distance));
  const unsure = distances.map((distance, i) =>
    rejected[i] || rejected[i - 1] || rejected[i + 1] ? distance : null,
  );
  return [sure, unsure];
}

export class Plot {
  private plot?: uPlot;
  private scene?: Scene;
  private timeline?: Timeline;
  private times: number[] = [];
  private step = 0;
  private chosen = "";

  constructor(
    private readonly place: HTMLElement,
    private readonly go: (step: number) => void,
  ) {
    new ResizeObserver(() => this.resize()).observe(place);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.make());
  }

  setScene(scene: Scene): void {
    this.scene = scene;
    this.times = scene.steps.map((step) => step[2]);
    this.make();
  }

  setTimeline(timeline: Timeline): void {
    this.timeline = timeline;
    if (this.scene?.steps.length === 0) {
      // A running robot: the times are those of its answers.
      this.times = timeline.stamps_s;
      this.step = this.times.length - 1;
    }
    this.plot?.setData(this.data());
  }

  setStep(step: number): void {
    this.step = step;
    this.plot?.redraw(false);
  }

  choose(link: string): void {
    this.chosen = link;
    this.make();
  }

  private evaluated() {
    return this.scene!.links.filter((link) => link.is_evaluated).sort((a, b) => a.id - b.id);
  }

  private data(): uPlot.AlignedData {
    const missing = (values: (number | null)[]) => this.times.map((_, i) => values[i] ?? null);
    const curves = this.timeline?.links;
    const series = this.evaluated().flatMap((_, row) =>
      split(curves?.distance_m[row] ?? [], curves?.is_rejected[row] ?? []).map(missing),
    );
    return [this.times, ...series] as uPlot.AlignedData;
  }

  private make(): void {
    if (!this.scene) return;
    this.plot?.destroy();
    const ink = getComputedStyle(document.body);
    const axis = {
      stroke: ink.getPropertyValue("--faint"),
      grid: { stroke: ink.getPropertyValue("--line"), width: 1 },
      ticks: { show: false },
    };
    const series = this.evaluated().flatMap((link) => {
      const one: uPlot.Series = {
        label: link.name,
        stroke: link.color,
        width: link.name === this.chosen ? 4 : link.is_moved ? 2 : 1,
        points: { show: false },
      };
      return [one, { ...one, dash: [4, 4] }];
    });
    const options: uPlot.Options = {
      width: this.place.clientWidth || 300,
      height: this.place.clientHeight || 150,
      legend: { show: false },
      scales: { x: { time: false }, y: { range: (_, __, most) => [0, Math.max(0.05, most ?? 1)] } },
      cursor: { y: false, drag: { x: false, y: false } },
      axes: [
        { ...axis, size: 26, values: (_, values) => values.map((value) => `${value} s`) },
        { ...axis, size: 52, values: (_, values) => values.map((value) => `${value} m`) },
      ],
      series: [{}, ...series],
      hooks: { draw: [(plot) => this.drawMarks(plot)] },
    };
    this.plot = new uPlot(options, this.data(), this.place);
    this.plot.over.addEventListener("click", () => {
      const at = this.plot?.cursor.idx;
      if (at !== null && at !== undefined) this.go(at);
    });
  }

  /** The image that is shown, how fast the robot may go, and where some link that moves has no distance that holds. */
  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    const x = (step: number) => plot.valToPos(this.times[step], "x", true);
    ctx.fillStyle = cssOf(warnColor);
    const rows = this.evaluated().map((link, row) => ({ link, row })).filter(({ link }) => link.is_moved);
    const status = this.timeline?.links.status;
    for (let i = 0; status && i < (status[0]?.length ?? 0); ++i) {
      // What the robot has just taken up has no curve yet.
      if (rows.every(({ row }) => !status[row] || ["ok", "none_in_range"].includes(status[row][i]))) continue;
      ctx.fillRect(x(i) - 2, bbox.top + bbox.height - 7, 4, 7);
    }
    this.timeline?.speed?.state.forEach((state, i) => {
      if (state === "clear") return;
      ctx.fillStyle = cssOf(state === "stop" ? stopColor : slowColor);
      const end = i + 1 < this.times.length ? x(i + 1) : x(i) + 2;
      ctx.fillRect(x(i), bbox.top, Math.max(2, end - x(i)), 7);
    });
    ctx.fillStyle = getComputedStyle(document.body).getPropertyValue("--ink");
    if (this.step >= 0 && this.step < this.times.length) ctx.fillRect(x(this.step) - 1, bbox.top, 2, bbox.height);
    ctx.restore();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width > 0 && height > 0) this.plot?.setSize({ width, height });
  }
}
