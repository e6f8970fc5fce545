// Labels at places of the 3D view, none over another.

interface Label {
  span: HTMLElement;
  /** Pixels of the view. */
  at: [number, number];
}

interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const gap_px = 3;

function boxAt(x: number, y: number, width: number, height: number): Box {
  return { left: x - width / 2, top: y - height / 2, right: x + width / 2, bottom: y + height / 2 };
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right + gap_px && b.left < a.right + gap_px && a.top < b.bottom + gap_px && b.top < a.bottom + gap_px;
}

/** Above its place, or as near above or below as there is room within the view. */
function freeBox(label: Label, view: HTMLElement, taken: Box[]): Box {
  const { offsetWidth: width, offsetHeight: height } = label.span;
  const x = Math.min(Math.max(label.at[0], width / 2), view.clientWidth - width / 2);
  const y = Math.min(Math.max(label.at[1] - 1.2 * height, height / 2), view.clientHeight - height / 2);
  for (let i = 0; i < 2 * taken.length + 2; ++i) {
    for (const side of [-1, 1]) {
      const box = boxAt(x, y + side * i * (height + gap_px), width, height);
      const isInside = box.top >= 0 && box.bottom <= view.clientHeight;
      if (isInside && !taken.some((other) => overlap(box, other))) return box;
    }
  }
  return boxAt(x, y, width, height);
}

export function placeLabels(view: HTMLElement, labels: Label[]): void {
  view.replaceChildren(...labels.map((label) => label.span));
  const taken: Box[] = [];
  for (const label of labels) {
    const box = freeBox(label, view, taken);
    taken.push(box);
    label.span.style.left = `${box.left}px`;
    label.span.style.top = `${box.top}px`;
  }
}
