// The 3D view: robot, readings, distances, cameras and unknown space in the root link's frame.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { cameraColors, cssOf, hiddenColor, unseenColor } from "./colors";
import { distanceText, make } from "./dom";
import { placeLabels } from "./labels";
import type { Layers } from "./layers";
import type { Camera, Image, LinkResult, Mesh, Point, Scene, Shown, Space } from "./messages";
import { CameraPoints } from "./points";
import { bodyOf } from "./space_body";

const frustumLength_m = 0.25;
/** How near to a line a click has to be, in pixels of the page. */
const reach_px = 9;

function matrixOf(rows: number[]): THREE.Matrix4 {
  return new THREE.Matrix4().fromArray(rows).transpose();
}

/** Five lines from the camera's centre around its image. */
function frustumOf(camera: Camera, color: string): THREE.LineSegments {
  const corner = (u: number, v: number) =>
    [(u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1].map((x) => frustumLength_m * x);
  const [a, b, c, d] = [
    corner(0, 0), corner(camera.width_px, 0), corner(camera.width_px, camera.height_px), corner(0, camera.height_px),
  ];
  const o = [0, 0, 0];
  const geometry = new THREE.BufferGeometry();
  const ends = [o, a, o, b, o, c, o, d, a, b, b, c, c, d, d, a].flat();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
  const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color }));
  lines.matrixAutoUpdate = false;
  lines.visible = false;
  return lines;
}

export class Scene3d {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly world = new THREE.Scene();
  private readonly eye = new THREE.PerspectiveCamera(45, 1, 0.02, 100);
  private readonly controls: OrbitControls;
  private readonly light = new THREE.DirectionalLight(0xffffff, 2);
  private scene?: Scene;
  private links: THREE.Mesh<THREE.BufferGeometry, THREE.MeshLambertMaterial>[] = [];
  private cameras: CameraPoints[] = [];
  private frusta: THREE.LineSegments[] = [];
  /** Thin, to what no camera has to see. */
  private knownLines = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineDashedMaterial({ color: 0x888888, dashSize: 0.02, gapSize: 0.01, depthTest: false }),
  );
  private lines = new LineSegments2(
    new LineSegmentsGeometry(),
    new LineMaterial({ linewidth: 3, vertexColors: true, depthTest: false }),
  );
  /** Whether a camera has an image, and so a place. */
  private isPosed: boolean[] = [];
  private hidden = this.body(hiddenColor);
  private unseen = this.body(unseenColor);
  private pairs: { link: LinkResult; ends: [THREE.Vector3, THREE.Vector3]; color: string }[] = [];
  private chosen = "";
  private layers?: Layers;
  private isAsked = false;
  private hasLooked = false;

  /** `choose` gets the name of a link that was clicked. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly labels: HTMLElement,
    choose: (link: string) => void,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.eye.up.set(0, 0, 1);
    this.eye.position.set(1.6, -1.8, 1.4);
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.target.set(0, 0, 0.4);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.listenToKeyEvents(canvas);
    this.controls.update();
    this.lines.renderOrder = 2;
    this.lines.frustumCulled = false;
    this.knownLines.renderOrder = 2;
    this.knownLines.frustumCulled = false;
    this.eye.add(this.light);
    this.world.add(new THREE.HemisphereLight(0xffffff, 0x8a8f96, 1.4), this.eye);
    this.world.add(new THREE.AxesHelper(0.2), this.lines, this.knownLines, this.hidden, this.unseen);
    new ResizeObserver(() => this.resize()).observe(canvas);
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      const link = this.linkAt(event.offsetX, event.offsetY);
      if (link) choose(link);
    });
  }

  private body(color: string): THREE.Mesh {
    const material = new THREE.MeshLambertMaterial({ color, transparent: true, opacity: 0.28, depthWrite: false });
    const mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    mesh.visible = false;
    mesh.renderOrder = 1;
    return mesh;
  }

  setScene(scene: Scene): void {
    this.scene = scene;
    this.world.remove(...this.cameras.map((one) => one.points), ...this.frusta);
    this.cameras = scene.cameras.map((camera, i) => new CameraPoints(camera, i, scene));
    this.isPosed = scene.cameras.map(() => false);
    this.frusta = scene.cameras.map((camera, i) => frustumOf(camera, cssOf(cameraColors[i % cameraColors.length])));
    this.world.add(...this.cameras.map((one) => one.points), ...this.frusta);
    this.resize();
    if (this.layers) this.setLayers(this.layers);
  }

  setMesh(mesh: Mesh): void {
    this.world.remove(...this.links);
    let corner = 0;
    let triangle = 0;
    this.links = mesh.corners.map((corners, i) => {
      const geometry = new THREE.BufferGeometry();
      const corner_m = mesh.corner_m.subarray(3 * corner, 3 * (corner + corners));
      geometry.setAttribute("position", new THREE.BufferAttribute(corner_m, 3));
      const indices = mesh.triangle.subarray(3 * triangle, 3 * (triangle + mesh.triangles[i]));
      geometry.setIndex(new THREE.BufferAttribute(indices, 1));
      const link = this.scene!.links[i];
      const material = new THREE.MeshLambertMaterial({
        color: link.color, flatShading: true, side: THREE.DoubleSide, transparent: true,
      });
      const one = new THREE.Mesh(geometry, material);
      one.name = link.name;
      one.matrixAutoUpdate = false;
      one.visible = false;
      corner += corners;
      triangle += mesh.triangles[i];
      return one;
    });
    this.world.add(...this.links);
  }

  setShown(shown: Shown): void {
    shown.links?.forEach((rows, i) => {
      if (!this.links[i]) return;
      this.links[i].matrix.copy(matrixOf(rows));
      this.links[i].visible = this.layers?.robot ?? true;
    });
    shown.cameras?.forEach((rows, i) => {
      const camera = this.cameras[i];
      if (!camera) return;
      camera.points.visible = this.isDrawn(i, rows !== null);
      this.isPosed[i] = rows !== null;
      this.frusta[i].visible = rows !== null && (this.layers?.frusta ?? true);
      if (!rows) return;
      camera.points.matrix.copy(matrixOf(rows));
      this.frusta[i].matrix.copy(matrixOf(rows));
    });
    this.setPairs(shown.result.links);
    this.setKnownPairs(shown.result.links);
    if (!this.hasLooked && shown.links) this.lookAtAll();
    this.draw();
  }

  setImage(image: Image): void {
    const camera = this.cameras[image.camera];
    camera?.set(image);
    if (camera) camera.points.visible = this.isDrawn(image.camera, true);
    this.draw();
  }

  setSpace(space: Space): void {
    for (const [mesh, kind] of [[this.hidden, 1], [this.unseen, 2]] as const) {
      mesh.geometry.dispose();
      mesh.geometry = bodyOf(space, kind);
    }
    this.draw();
  }

  setLayers(layers: Layers): void {
    this.layers = layers;
    this.showLinks();
    for (const camera of this.cameras) {
      camera.color(layers.coloring);
      camera.show(layers.kept, layers.filtered);
    }
    this.cameras.forEach((camera, i) => (camera.points.visible = this.isDrawn(i, this.isPosed[i])));
    this.frusta.forEach((frustum, i) => (frustum.visible = layers.frusta && this.isPosed[i]));
    this.lines.visible = this.knownLines.visible = layers.distances;
    this.hidden.visible = layers.hidden;
    this.unseen.visible = layers.unseen;
    this.draw();
  }

  choose(link: string): void {
    this.chosen = link;
    this.showLinks();
    if (this.scene) this.setPairs(this.pairs.map((pair) => pair.link));
    this.draw();
  }

  private showLinks(): void {
    if (!this.layers) return;
    const { robot, others, coloring } = this.layers;
    for (const link of this.links) {
      const isChosen = link.name === this.chosen;
      const isFaded = coloring === "fit" || (!others && this.chosen !== "" && !isChosen);
      link.visible = robot;
      link.material.emissive.set(isChosen ? 0x333333 : 0);
      link.material.opacity = isFaded ? 0.3 : 1;
      link.material.depthWrite = !isFaded;
    }
  }

  /** Goes to where this link and what it is near to fill the view. */
  lookAt(link: string): void {
    const pair = this.pairs.find((one) => one.link.link === link);
    if (!pair) return;
    const [a, b] = pair.ends;
    const middle = a.clone().add(b).multiplyScalar(0.5);
    const along = b.clone().sub(a).normalize();
    // From the side, so that the line is seen in its length.
    const aside = this.eye.position.clone().sub(middle);
    aside.addScaledVector(along, -aside.dot(along));
    if (aside.length() < 1e-3) aside.set(1, 0, 0.3);
    const away_m = Math.max(0.4, 4 * a.distanceTo(b));
    this.eye.position.copy(middle).addScaledVector(aside.normalize(), away_m);
    this.controls.target.copy(middle);
    this.controls.update();
    this.draw();
  }

  /** How many readings and triangles are drawn. */
  counts(): { points: number; triangles: number } {
    const points = this.cameras.reduce((sum, one) => sum + (one.points.visible ? one.count : 0), 0);
    const triangles = this.links.reduce((sum, one) => sum + (one.geometry.index?.count ?? 0) / 3, 0);
    return { points, triangles };
  }

  /** Back to where the robot fills the view. */
  lookAtAll(): void {
    const box = new THREE.Box3();
    this.links.forEach((link, i) => {
      if (!this.scene!.links[i].is_evaluated || !link.geometry.index?.count) return;
      link.geometry.computeBoundingBox();
      box.union(link.geometry.boundingBox!.clone().applyMatrix4(link.matrix));
    });
    if (box.isEmpty()) return;
    this.hasLooked = true;
    const middle = box.getCenter(new THREE.Vector3());
    const away_m = 1.9 * Math.max(0.5, box.getSize(new THREE.Vector3()).length());
    this.controls.target.copy(middle);
    this.eye.position.copy(middle).add(new THREE.Vector3(0.62, -0.62, 0.48).multiplyScalar(away_m));
    this.controls.update();
  }

  private isDrawn(camera: number, isPosed: boolean): boolean {
    return isPosed && this.cameras[camera].count > 0 && this.cameras[camera].isWanted;
  }

  private setPairs(links: LinkResult[]): void {
    const point = (p: Point) => new THREE.Vector3(...p);
    this.pairs = [];
    const ends: number[] = [];
    const colors: number[] = [];
    for (const link of links) {
      const { robot_point_base_m: from, obstacle_point_base_m: to } = link;
      if (!from || !to) continue;
      const color = this.scene!.links.find((one) => one.name === link.link)!.color;
      const rgb = new THREE.Color(color);
      this.pairs.push({ link, ends: [point(from), point(to)], color });
      ends.push(...from, ...to);
      colors.push(...rgb.toArray(), ...rgb.toArray());
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new LineSegmentsGeometry();
    if (ends.length > 0) {
      this.lines.geometry.setPositions(ends);
      this.lines.geometry.setColors(colors);
    }
    this.lines.visible = ends.length > 0 && (this.layers?.distances ?? true);
  }

  private setKnownPairs(links: LinkResult[]): void {
    const ends = links.flatMap(({ known }) => {
      const from = known?.robot_point_base_m, to = known?.obstacle_point_base_m;
      return from && to ? [new THREE.Vector3(...from), new THREE.Vector3(...to)] : [];
    });
    this.knownLines.geometry.dispose();
    this.knownLines.geometry = new THREE.BufferGeometry().setFromPoints(ends);
    this.knownLines.computeLineDistances();
  }

  private onScreen(p: THREE.Vector3): [number, number] | null {
    const q = p.clone().project(this.eye);
    if (q.z > 1) return null;
    return [((q.x + 1) / 2) * this.canvas.clientWidth, ((1 - q.y) / 2) * this.canvas.clientHeight];
  }

  private isInView([x, y]: [number, number]): boolean {
    return x >= 0 && y >= 0 && x <= this.canvas.clientWidth && y <= this.canvas.clientHeight;
  }

  private linkAt(x: number, y: number): string | undefined {
    for (const pair of this.layers?.distances ? this.pairs : []) {
      const [a, b] = pair.ends.map((end) => this.onScreen(end));
      if (!a || !b) continue;
      const length2 = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2;
      const along = ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / (length2 || 1);
      const t = Math.min(1, Math.max(0, along));
      const away = Math.hypot(a[0] + t * (b[0] - a[0]) - x, a[1] + t * (b[1] - a[1]) - y);
      if (away <= reach_px) return pair.link.link;
    }
    const at = new THREE.Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.eye);
    return ray.intersectObjects(this.links.filter((link) => link.visible))[0]?.object.name;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.eye.aspect = width / height;
    this.eye.updateProjectionMatrix();
    const point_px = (height * this.renderer.getPixelRatio()) / (2 * Math.tan((this.eye.fov * Math.PI) / 360));
    for (const camera of this.cameras) camera.points.material.uniforms.point_px.value = point_px;
    this.draw();
  }

  /** Once, before the screen is drawn next. */
  private draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.renderer.render(this.world, this.eye);
      this.drawLabels();
    });
  }

  /** Lengths at the lines: of the chosen link, and of the nearest three that move. */
  private drawLabels(): void {
    const nearest = this.pairs
      .filter((pair) => pair.link.is_moved)
      .sort((a, b) => a.link.distance_m! - b.link.distance_m!)
      .slice(0, 3);
    const labelled = this.pairs.filter((pair) => nearest.includes(pair) || pair.link.link === this.chosen);
    const spans = (this.layers?.distances ? labelled : []).map((pair) => {
      const at = this.onScreen(pair.ends[0].clone().add(pair.ends[1]).multiplyScalar(0.5));
      const span = make("span", { textContent: distanceText(pair.link) });
      span.style.borderColor = pair.color;
      return at && this.isInView(at) ? [{ span, at }] : [];
    });
    placeLabels(this.labels, spans.flat());
  }
}
