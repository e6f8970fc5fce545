// What the program sends; apps/view/*_message*.cpp write it.

export interface Link {
  name: string;
  id: number;
  is_evaluated: boolean;
  is_moved: boolean;
  color: string;
}

export interface Camera {
  name: string;
  width_px: number;
  height_px: number;
  fx_px: number;
  fy_px: number;
  cx_px: number;
  cy_px: number;
}

export interface Fate {
  name: string;
  color: string;
  is_kept: boolean;
}

export interface Scene {
  type: "scene";
  file: string;
  robot: string;
  links: Link[];
  cameras: Camera[];
  /** Camera, number of its image, time in seconds. */
  steps: [number, number, number][];
  fates: Fate[];
  /** How far behind the robot's surface a reading lies, from the nearest to the farthest, and its colour; linear between them. */
  misfits: Misfit[];
}

export interface Misfit {
  behind_mm: number;
  color: string;
}

export type Point = [number, number, number];

/** Closest points; null where none are known. */
export interface Pair {
  distance_m: number | null;
  lower_bound_m: number | null;
  camera: string | null;
  obstacle_pixel: [number, number] | null;
  robot_point_base_m: Point | null;
  obstacle_point_base_m: Point | null;
}

export interface Known {
  distance_m: number | null;
  lower_bound_m: number | null;
  robot_point_base_m: Point | null;
  obstacle_point_base_m: Point | null;
  link: string | null;
}

export interface LinkResult extends Pair {
  id: number;
  link: string;
  is_moved: boolean;
  status: string;
  obstacle_is: "occupied" | "unknown" | "unobserved" | null;
  /** To what a camera measured, alone. */
  occupied: Pair;
  /** To the environment, the robot's other links and other robots; no camera has to see them. */
  known?: Known;
  visibility?: {
    surface: { seen: number } | null;
    space_unknown: number | null;
    rejected_distance_m: number | null;
  };
}

export interface CameraResult {
  camera: string;
  frame: number | null;
  age_s: number | null;
  status: string;
  self_filter: Record<string, number> | null;
}

/** Schema berth/result/3; src/berth/results writes it. */
export interface Result {
  frame: number;
  stamp_s: number;
  status: "ok" | "degraded" | "stale";
  time: { status: string };
  /** The nearest link that a joint moves. */
  nearest: string | null;
  /** Where a separation monitor watches. */
  separation?: { state: string; text: string };
  cameras: CameraResult[];
  links: LinkResult[];
}

export interface Shown {
  type: "shown";
  step: number;
  /** The run in the background has not come here: the result is that of this frame alone. */
  is_provisional: boolean;
  result: Result;
  /** Poses in the root link's frame, rows of the matrix. */
  links: number[][] | null;
  cameras: (number[] | null)[];
}

export type Value = number | boolean | string | null;

export interface SettingText {
  name: string;
  unit: string;
  sentence: string;
  kind: "number" | "whole" | "bool" | "choice";
  choices?: string[];
  least?: number;
  most?: number;
  domain?: string;
}

export interface SettingGroup {
  name: string;
  by_camera: boolean;
  settings: SettingText[];
  /** One list of values for each camera, or one alone. */
  now: Value[][];
  file: Value[][];
}

export interface XyzRpy {
  xyz_m: Point;
  rpy_rad: Point;
}

export interface CameraPose {
  camera: string;
  parent: string;
  now: XyzRpy;
  file: XyzRpy;
}

export interface Settings {
  type: "settings";
  groups: SettingGroup[];
  poses: CameraPose[];
}

export interface Timeline {
  type: "timeline";
  done: number;
  total: number;
  error: string;
  warnings: string[];
  stamps_s: number[];
  /** Rows are links, columns are steps. */
  links: {
    distance_m: (number | null)[][];
    status: string[][];
    is_rejected: boolean[][];
  };
  /** Of each step, the row of the nearest link that a joint moves. */
  nearest: (number | null)[];
  /** Where a separation monitor watches, of each step. */
  speed: { scale: number[]; state: string[] } | null;
}

interface Spread {
  median_m: number | null;
  p90_m: number | null;
}

export interface CalibrationData {
  type: "calibration_data";
  state: "none" | "runs" | "asks" | "found" | "failed" | "taken";
  error: string;
  /** What it asks about: whether this is a part of the robot, with an image of each camera that shows it. */
  part?: string;
  question?: string;
  pictures?: { camera: string; frame: number; bytes: number; png: Uint8Array }[];
  cameras?: { name: string; headline: string; before: Spread; after: Spread }[];
  warnings?: string[];
  report?: string;
}

/** Before a scene comes: how many images were read. */
export interface Loading {
  type: "loading";
  images: number;
}

export interface Notice {
  type: "notice";
  number: number;
  is_refused: boolean;
  text: string;
}

export interface Mesh {
  type: "mesh";
  corners: number[];
  triangles: number[];
  corner_m: Float32Array;
  triangle: Uint32Array;
}

export interface Image {
  type: "image";
  camera: number;
  frame: number;
  /** Of what is shown: every stride-th pixel of the camera's image. */
  width_px: number;
  height_px: number;
  stride: number;
  depth_m: Float32Array;
  fate: Uint8Array;
  link: Uint16Array;
  /** -32768: no reading or no robot. */
  behind_mm: Int16Array;
}

export interface Space {
  type: "space";
  corner_m: Point;
  edge_m: number;
  cells: [number, number, number];
  /** 0: seen, 1: hidden, 2: unseen. */
  sight: Uint8Array;
}

export type Message =
  | Scene
  | Loading
  | Shown
  | Settings
  | Timeline
  | CalibrationData
  | Notice
  | Mesh
  | Image
  | Space;

function sum(values: number[]): number {
  return values.reduce((all, one) => all + one, 0);
}

/** Where the next array begins: they are filled up to four bytes. */
function filled(length: number): number {
  return Math.ceil(length / 4) * 4;
}

export function readBinary(data: ArrayBuffer): Message {
  const length = new DataView(data).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  let at = 4 + length;
  const take = <T>(array: new (data: ArrayBuffer, at: number, count: number) => T, bytes: number, count: number): T => {
    const values = new array(data, at, count);
    at += filled(bytes * count);
    return values;
  };
  if (header.type === "mesh") {
    header.corner_m = take(Float32Array, 4, 3 * sum(header.corners));
    header.triangle = take(Uint32Array, 4, 3 * sum(header.triangles));
  } else if (header.type === "image") {
    const pixels = header.width_px * header.height_px;
    header.depth_m = take(Float32Array, 4, pixels);
    header.fate = take(Uint8Array, 1, pixels);
    header.link = take(Uint16Array, 2, pixels);
    header.behind_mm = take(Int16Array, 2, pixels);
  } else if (header.type === "space") {
    const [x, y, z] = header.cells;
    header.sight = take(Uint8Array, 1, x * y * z);
  } else if (header.type === "calibration_data") {
    for (const picture of header.pictures) picture.png = take(Uint8Array, 1, picture.bytes);
  }
  return header;
}
