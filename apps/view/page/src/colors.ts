// Colours that are no link's and no fate's.

export type Rgb = [number, number, number];

export function rgbOf(hex: string): Rgb {
  const number = parseInt(hex.slice(1), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/** What points and pixels tell by their colour; the order is the shader's. */
export const colorings = ["filter", "depth", "fit", "camera"] as const;
export type Coloring = (typeof colorings)[number];

export const coloringTexts: Record<Coloring, string> = {
  filter: "by what the filter did",
  depth: "by depth",
  fit: "by how they fit the robot",
  camera: "by camera",
};

/** Of the strip above the curves: where the robot has to go slower, and where it has to stop. */
export const slowColor: Rgb = [0xe6, 0x9f, 0x00];
export const stopColor: Rgb = [0x9b, 0x2d, 0x6f];

export const hiddenColor = "#cc79a7";
export const unseenColor = "#56b4e9";

/** Viridis, near to far; a seventh of it each. */
export const depthColors: Rgb[] = [
  [253, 231, 37], [144, 215, 67], [53, 183, 121], [33, 145, 140], [49, 104, 142], [68, 57, 131], [68, 1, 84],
];

/** Of a reading without a robot to fit. */
export const noRobotColor: Rgb = [0x80, 0x84, 0x8a];

export function between(colors: Rgb[], share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (colors.length - 1);
  const low = Math.min(Math.floor(at), colors.length - 2);
  const mixed = colors[low].map((value, i) => value + (at - low) * (colors[low + 1][i] - value));
  return mixed as Rgb;
}

export const cameraColors: Rgb[] = [
  [0xe6, 0x9f, 0x00], [0x56, 0xb4, 0xe9], [0x00, 0x9e, 0x73], [0xcc, 0x79, 0xa7],
  [0xf0, 0xe4, 0x42], [0x00, 0x72, 0xb2], [0xd5, 0x5e, 0x00], [0xb8, 0xe6, 0xd0],
];

export function cssOf([r, g, b]: Rgb): string {
  return `rgb(${Math.round(r)}, ${Math.round(g)}, ${Math.round(b)})`;
}
