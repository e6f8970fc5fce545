// One camera's readings as points, made from its depth image on the graphics processor.
import * as THREE from "three";
import { between, cameraColors, colorings, depthColors, noRobotColor, rgbOf, type Coloring, type Rgb } from "./colors";
import type { Camera, Image, Scene } from "./messages";

const vertexShader = `
in float depth;
in float fate;
in float behind;
uniform vec4 focal_centre;
uniform int width;
uniform float stride;
uniform int coloring;
uniform bool shows_kept;
uniform bool shows_filtered;
uniform vec3 fate_colors[FATES];
uniform bool is_kept[FATES];
uniform vec3 depth_colors[7];
uniform float misfits_mm[MISFITS];
uniform vec3 misfit_colors[MISFITS];
uniform vec3 no_robot_color;
uniform vec3 camera_color;
uniform float point_px;
flat out vec3 point_color;

vec3 color_of(int kind) {
  if (coloring == 0) return fate_colors[kind];
  if (coloring == 1) {
    float at = clamp((depth - 0.3) / 3.7, 0.0, 0.999) * 6.0;
    return mix(depth_colors[int(at)], depth_colors[int(at) + 1], fract(at));
  }
  if (coloring == 2) {
    if (behind < -32767.5) return no_robot_color;
    for (int i = 1; i < MISFITS; ++i) {
      float share = (behind - misfits_mm[i - 1]) / (misfits_mm[i] - misfits_mm[i - 1]);
      if (share < 1.0) return mix(misfit_colors[i - 1], misfit_colors[i], max(share, 0.0));
    }
    return misfit_colors[MISFITS - 1];
  }
  return camera_color;
}

void main() {
  int kind = int(fate + 0.5);
  bool is_drawn = depth > 0.0 && (is_kept[kind] ? shows_kept : shows_filtered);
  vec2 pixel = stride * vec2(float(gl_VertexID % width), float(gl_VertexID / width));
  vec3 p_C = vec3((pixel - focal_centre.zw) / focal_centre.xy * depth, depth);
  vec4 seen = modelViewMatrix * vec4(p_C, 1.0);
  gl_Position = is_drawn ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
  // As large as what the pixel covers.
  gl_PointSize = clamp(1.3 * stride * point_px * depth / focal_centre.x / -seen.z, 1.0, 8.0);
  point_color = color_of(kind);
}`;

const fragmentShader = `
flat in vec3 point_color;
out vec4 color;
void main() { color = vec4(point_color, 1.0); }`;

const unit = ([r, g, b]: Rgb) => new THREE.Vector3(r / 255, g / 255, b / 255);

export class CameraPoints {
  readonly points: THREE.Points<THREE.BufferGeometry, THREE.ShaderMaterial>;
  count = 0;
  /** Whether any of them is to be drawn. */
  isWanted = true;

  constructor(camera: Camera, number: number, { fates, misfits }: Scene) {
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      defines: { FATES: fates.length, MISFITS: misfits.length },
      vertexShader,
      fragmentShader,
      uniforms: {
        focal_centre: { value: new THREE.Vector4(camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px) },
        width: { value: 1 },
        stride: { value: 1 },
        coloring: { value: 0 },
        shows_kept: { value: true },
        shows_filtered: { value: true },
        fate_colors: { value: fates.map((fate) => unit(rgbOf(fate.color))) },
        is_kept: { value: fates.map((fate) => fate.is_kept) },
        depth_colors: { value: depthColors.map(unit) },
        misfits_mm: { value: misfits.map((one) => one.behind_mm) },
        misfit_colors: { value: misfits.map((one) => unit(rgbOf(one.color))) },
        no_robot_color: { value: unit(noRobotColor) },
        camera_color: { value: unit(cameraColors[number % cameraColors.length]) },
        point_px: { value: 1 },
      },
    });
    this.points = new THREE.Points(new THREE.BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.matrixAutoUpdate = false;
    this.points.visible = false;
  }

  set(image: Image): void {
    const { geometry } = this.points;
    geometry.setAttribute("depth", new THREE.BufferAttribute(image.depth_m, 1));
    geometry.setAttribute("fate", new THREE.BufferAttribute(image.fate, 1));
    geometry.setAttribute("behind", new THREE.BufferAttribute(image.behind_mm, 1));
    this.points.material.uniforms.width.value = image.width_px;
    this.points.material.uniforms.stride.value = image.stride;
    geometry.setDrawRange(0, image.depth_m.length);
    this.count = image.depth_m.reduce((count, depth) => count + (depth > 0 ? 1 : 0), 0);
  }

  color(coloring: Coloring): void {
    this.points.material.uniforms.coloring.value = colorings.indexOf(coloring);
  }

  show(kept: boolean, filtered: boolean): void {
    this.points.material.uniforms.shows_kept.value = kept;
    this.points.material.uniforms.shows_filtered.value = filtered;
    this.isWanted = kept || filtered;
  }
}

/** As the shader colours a reading. */
export function depthColor(depth_m: number): Rgb {
  return between(depthColors, (depth_m - 0.3) / 3.7);
}
