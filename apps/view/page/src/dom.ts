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

/** A distance: "0.123 m", as everywhere else in berth. */
export function lengthText(length_m: number | null | undefined): string {
  return length_m === null || length_m === undefined ? "–" : `${length_m.toFixed(3)} m`;
}

/** An error of a sensor or a model: "12.3 mm". */
export function errorText(error_m: number | null): string {
  return error_m === null ? "–" : `${(1000 * error_m).toFixed(1)} mm`;
}

interface Near {
  link: string;
  status: string;
  distance_m: number | null;
  obstacle_is: string | null;
  occupied: { distance_m: number | null };
}

/** A link's distance; where only unknown space touches it, also how far what is seen is. */
export function distanceText(link: Near): string {
  if (link.distance_m !== 0 || link.obstacle_is === "occupied") return lengthText(link.distance_m);
  const seen = link.occupied.distance_m;
  return `${link.obstacle_is} 0 m, ${seen === null ? "nothing seen" : `seen ${lengthText(seen)}`}`;
}

/** The same as a sentence. */
export function nearText(link: Near): string {
  if (link.distance_m === null) return `${link.link}: no distance, ${link.status.replaceAll("_", " ")}.`;
  if (link.distance_m === 0 && link.obstacle_is !== "occupied") return `${link.link}: ${distanceText(link)}.`;
  if (link.obstacle_is === "occupied") return `${link.link}: ${lengthText(link.distance_m)} to what is seen.`;
  const seen = link.occupied.distance_m;
  return `${link.link}: ${lengthText(link.distance_m)} to ${link.obstacle_is} space; ${seen === null ? "nothing is seen within the range" : `what is seen is ${lengthText(seen)} away`}.`;
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
