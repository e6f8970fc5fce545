// Short ways to make elements.

export function byId<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** An element with properties, such as make("button", { textContent: "Play" }). */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Partial<HTMLElementTagNameMap[K]> = {},
  children: (Node | string)[] = [],
): HTMLElementTagNameMap[K] {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

/** "12.3 mm", "0.123 m". */
export function lengthText(length_m: number | null | undefined): string {
  if (length_m === null || length_m === undefined) return "–";
  return length_m < 0.1 ? `${(1000 * length_m).toFixed(1)} mm` : `${length_m.toFixed(3)} m`;
}

/** A link's distance; where only unknown space touches it, also how far what is seen is. */
export function distanceText(link: { distance_m: number | null; obstacle_is: string | null; occupied: { distance_m: number | null } }): string {
  if (link.distance_m !== 0 || link.obstacle_is !== "unknown") return lengthText(link.distance_m);
  const seen = link.occupied.distance_m;
  return `unknown 0 m, ${seen === null ? "nothing seen" : `seen ${lengthText(seen)}`}`;
}

/** Buttons of which one is chosen at a time; arrows go from one to the next. */
export function tabs(row: HTMLElement, names: string[], choose: (index: number) => void): (index: number) => void {
  const buttons = names.map((name, index) => {
    const button = make("button", { textContent: name, onclick: () => show(index) });
    button.setAttribute("role", "tab");
    button.onkeydown = (event) => {
      const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      if (by === 0) return;
      event.stopPropagation();
      const next = (index + by + names.length) % names.length;
      show(next);
      buttons[next].focus();
    };
    return button;
  });
  const show = (index: number) => {
    buttons.forEach((button, i) => button.setAttribute("aria-selected", String(i === index)));
    choose(index);
  };
  row.replaceChildren(...buttons);
  return show;
}
