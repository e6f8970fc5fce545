// A camera's image: depth, and what became of each pixel.
import { between, cameraColors, cssOf, noRobotColor, rgbOf, type Coloring, type Rgb } from "./colors";
import { errorText } from "./dom";
import type { Image, Misfit, Scene, Shown } from "./messages";
import { depthColor } from "./points";

const noRobot = -32768;
const dark: Rgb = [0x12, 0x13, 0x16];

export class Picture {
  private readonly context: CanvasRenderingContext2D;
  private scene?: Scene;
  private shown?: Shown;
  private images: (Image | undefined)[] = [];
  private camera = 0;
  private coloring: Coloring = "filter";
  private chosen = "";
  private hasPairs = true;
  private pointed: [number, number] | null = null;
  private isAsked = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly text: HTMLElement,
  ) {
    this.context = canvas.getContext("2d")!;
    canvas.addEventListener("pointermove", (event) => this.point(event));
    canvas.addEventListener("pointerleave", () => {
      this.pointed = null;
      this.tell();
    });
  }

  setScene(scene: Scene): void {
    this.scene = scene;
  }
  setShown(shown: Shown): void {
    this.shown = shown;
    this.draw();
  }
  setImage(image: Image): void {
    this.images[image.camera] = image;
    if (image.camera === this.camera) this.draw();
  }
  setCamera(camera: number): void {
    this.camera = camera;
    this.draw();
  }
  setLayers(coloring: Coloring, hasPairs: boolean): void {
    this.coloring = coloring;
    this.hasPairs = hasPairs;
    this.draw();
  }
  choose(link: string): void {
    this.chosen = link;
    this.draw();
  }

  /** Once, before the screen is drawn next. */
  private draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.drawNow();
      this.tell();
    });
  }

  private drawNow(): void {
    const image = this.images[this.camera];
    if (!image || !this.scene) return;
    this.canvas.width = image.width_px;
    this.canvas.height = image.height_px;
    const pixels = this.context.createImageData(image.width_px, image.height_px);
    const color = this.colorer(image);
    for (let i = 0; i < image.depth_m.length; ++i) {
      const [r, g, b] = color(i);
      pixels.data[4 * i] = r;
      pixels.data[4 * i + 1] = g;
      pixels.data[4 * i + 2] = b;
      pixels.data[4 * i + 3] = 255;
    }
    this.context.putImageData(pixels, 0, 0);
    if (this.hasPairs) this.drawPairs(image);
  }

  private colorer(image: Image): (i: number) => Rgb {
    const fates = this.scene!.fates.map((fate) => ({ rgb: rgbOf(fate.color), isKept: fate.is_kept, name: fate.name }));
    const camera = cameraColors[this.camera % cameraColors.length];
    const misfits = this.scene!.misfits.map((one) => ({ behind_mm: one.behind_mm, rgb: rgbOf(one.color) }));
    return (i) => {
      const depth_m = image.depth_m[i];
      if (!(depth_m > 0)) return dark;
      if (this.coloring === "depth") return depthColor(depth_m);
      // Near is bright.
      const light = Math.max(0.35, Math.min(1, 1.25 - depth_m / 4));
      if (this.coloring === "camera") return camera.map((value) => light * value) as Rgb;
      if (this.coloring === "fit") {
        const behind_mm = image.behind_mm[i];
        if (behind_mm === noRobot) return noRobotColor.map((value) => 0.7 * light * value) as Rgb;
        return misfitColor(misfits, behind_mm);
      }
      const { rgb, name } = fates[image.fate[i]];
      const grey = 225 * light;
      return name === "obstacle" ? [grey, grey, grey] : (rgb.map((value) => 0.25 * grey + 0.75 * value) as Rgb);
    };
  }

  /** The closest points, where this camera would see them. */
  private drawPairs(image: Image): void {
    const rows = this.shown?.cameras?.[this.camera];
    if (!rows) return;
    const camera = this.scene!.cameras[this.camera];
    const pixelOf = (p: [number, number, number]) => {
      const d = p.map((value, i) => value - rows[4 * i + 3]);
      const [x, y, z] = [0, 1, 2].map((column) => d[0] * rows[column] + d[1] * rows[4 + column] + d[2] * rows[8 + column]);
      return z > 0 ? [((camera.fx_px * x) / z + camera.cx_px) / image.stride, ((camera.fy_px * y) / z + camera.cy_px) / image.stride] : null;
    };
    this.context.lineCap = "round";
    for (const link of this.shown!.result.links) {
      if (!link.robot_point_base_m || !link.obstacle_point_base_m) continue;
      const [a, b] = [pixelOf(link.robot_point_base_m), pixelOf(link.obstacle_point_base_m)];
      if (!a || !b) continue;
      const color = this.scene!.links.find((one) => one.name === link.link)!.color;
      const width = (link.link === this.chosen ? 5 : 2.5) * (image.width_px / 640);
      for (const [stroke, more] of [["#000", 2], [color, 0]] as const) {
        this.context.strokeStyle = stroke;
        this.context.lineWidth = width + more;
        this.context.beginPath();
        this.context.moveTo(a[0], a[1]);
        this.context.lineTo(b[0], b[1]);
        this.context.stroke();
      }
    }
  }

  private point(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    const u = Math.floor(((event.clientX - box.left) / box.width) * this.canvas.width);
    const v = Math.floor(((event.clientY - box.top) / box.height) * this.canvas.height);
    this.pointed = [u, v];
    this.tell();
  }

  private tell(): void {
    const image = this.images[this.camera];
    if (!image || !this.scene || !this.pointed) {
      this.text.textContent = image ? `Image ${image.frame}. Point at a pixel.` : "No image yet.";
      return;
    }
    const [u, v] = this.pointed;
    const i = v * image.width_px + u;
    if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px) return;
    const depth = image.depth_m[i] > 0 ? `${image.depth_m[i].toFixed(3)} m` : "no reading";
    const link = this.scene.links.find((one) => one.id === image.link[i] && image.link[i] !== 0)?.name ?? "no link";
    const behind = image.behind_mm[i];
    const fit = behind === noRobot ? "" : `, ${errorText(Math.abs(behind) / 1000)} ${behind < 0 ? "in front of" : "behind"} the model`;
    this.text.textContent = `(${u * image.stride}, ${v * image.stride}): ${depth}, ${this.scene.fates[image.fate[i]].name}, ${link}${fit}`;
  }
}

/** As the shader colours a reading. */
function misfitColor(misfits: { behind_mm: number; rgb: Rgb }[], behind_mm: number): Rgb {
  const next = misfits.findIndex((one) => behind_mm < one.behind_mm);
  if (next === 0) return misfits[0].rgb;
  if (next < 0) return misfits[misfits.length - 1].rgb;
  const [low, high] = [misfits[next - 1], misfits[next]];
  return between([low.rgb, high.rgb], (behind_mm - low.behind_mm) / (high.behind_mm - low.behind_mm));
}

function misfitText({ behind_mm }: Misfit, i: number, all: Misfit[]): string {
  if (behind_mm === 0) return "on it";
  const length = `${Math.abs(behind_mm)} mm`;
  if (i === 0) return `${length} in front of the robot's model`;
  return i === all.length - 1 ? `${length} behind it` : length;
}

/** What the colours mean. */
export function legend(coloring: Coloring, scene: Scene, fates: Set<number>): [string, string][] {
  if (coloring === "filter") {
    return scene.fates
      .filter((fate, i) => fate.name !== "no_reading" && (fates.has(i) || fate.name === "obstacle"))
      .map((fate) => [fate.color, fate.name.replaceAll("_", " ")]);
  }
  if (coloring === "depth") {
    return [0.5, 1, 2, 3, 4].map((depth_m) => [cssOf(depthColor(depth_m)), `${depth_m} m`]);
  }
  if (coloring === "fit") {
    return [...scene.misfits.map((one, i): [string, string] => [one.color, misfitText(one, i, scene.misfits)]), [cssOf(noRobotColor), "no robot there"]];
  }
  return scene.cameras.map((camera, i) => [cssOf(cameraColors[i % cameraColors.length]), camera.name]);
}
