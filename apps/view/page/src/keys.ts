// The keys: space plays, the arrows step. What was clicked keeps no focus, so that they work after any click.

/** What is written into. */
const texts = "input:not([type=checkbox]):not([type=range])";

export function listenToKeys(keys: { play: () => void; step: (by: number) => void }): void {
  let isPointing = false;
  const leave = () => {
    const focused = document.activeElement;
    if (focused instanceof HTMLElement && !focused.matches(texts)) focused.blur();
  };
  document.addEventListener("pointerdown", () => (isPointing = true), true);
  document.addEventListener("keydown", () => (isPointing = false), true);
  // A click that a key makes has no detail. A list is left once something was chosen.
  document.addEventListener("click", (event) => {
    if (event.detail > 0 && !(event.target as HTMLElement).closest("select")) leave();
  });
  document.addEventListener("change", (event) => {
    if (isPointing && (event.target as HTMLElement).matches("select")) leave();
  });
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (target.closest(`${texts}, select`) || event.ctrlKey || event.altKey || event.metaKey) return;
    // Who came here by keys presses what has the focus, and turns the 3D view by arrows.
    const isPressed = target.closest("button, input, summary, tr") !== null;
    if (event.key === " " && !isPressed) keys.play();
    else if (event.key === "ArrowLeft" && target.id !== "canvas-3d") keys.step(-1);
    else if (event.key === "ArrowRight" && target.id !== "canvas-3d") keys.step(1);
    else return;
    event.preventDefault();
  });
}
