// Cells of one kind as a body: the faces towards cells of another kind.
import * as THREE from "three";
import type { Space } from "./messages";

/** Of each side: the step to the neighbour, and the face's corners in a cell of edge 1. */
const sides: [number, number, number, number[]][] = [
  [1, 0, 0, [1, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1]],
  [-1, 0, 0, [0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0]],
  [0, 1, 0, [0, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 0]],
  [0, -1, 0, [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1]],
  [0, 0, 1, [0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1]],
  [0, 0, -1, [0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0]],
];

export function bodyOf(space: Space, kind: number): THREE.BufferGeometry {
  const [columns, rows, layers] = space.cells;
  const is = (x: number, y: number, z: number) =>
    x >= 0 && y >= 0 && z >= 0 && x < columns && y < rows && z < layers &&
    space.sight[(z * rows + y) * columns + x] === kind;
  const corners: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (let z = 0; z < layers; ++z) {
    for (let y = 0; y < rows; ++y) {
      for (let x = 0; x < columns; ++x) {
        if (!is(x, y, z)) continue;
        for (const [dx, dy, dz, face] of sides) {
          if (is(x + dx, y + dy, z + dz)) continue;
          const first = corners.length / 3;
          for (let i = 0; i < face.length; i += 3) {
            corners.push(
              space.corner_m[0] + space.edge_m * (x + face[i]),
              space.corner_m[1] + space.edge_m * (y + face[i + 1]),
              space.corner_m[2] + space.edge_m * (z + face[i + 2]),
            );
            normals.push(dx, dy, dz);
          }
          indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
        }
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setIndex(indices);
  return geometry;
}
