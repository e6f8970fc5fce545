// Calibration: run it, see what it found, take it or not.
import type { Request } from "./connection";
import { errorText, make } from "./dom";
import type { CalibrationData } from "./messages";

export class CalibrationPanel {
  readonly element = make("div");

  constructor(private readonly send: (request: Request) => void) {
    this.setState({ type: "calibration_data", state: "none", error: "" });
  }

  setState(found: CalibrationData): void {
    const button = (id: string, text: string, request: string) =>
      make("button", { id, textContent: text, onclick: () => this.send({ do: request }) });
    const start = button("calibrate", "Run the calibration", "calibration_data");
    const text = make("p", {
      textContent:
        "Finds the cameras' poses, clocks and filter settings from these images: the arm in five poses or more, and nobody else moves.",
    });
    if (found.state === "runs") {
      const wait = make("p", {}, [make("progress"), " It runs; this takes a minute or so."]);
      return this.element.replaceChildren(text, wait, button("stop-calibration", "Stop", "drop_calibration_data"));
    }
    if (found.state === "asks") return this.element.replaceChildren(text, ...this.question(found));
    if (found.state === "failed") {
      return this.element.replaceChildren(text, make("p", { className: "refused", textContent: found.error }), start);
    }
    if (found.state === "taken") {
      return this.element.replaceChildren(text, make("p", { textContent: "Taken: see what is marked in the settings; save it from there." }), start);
    }
    if (found.state !== "found") return this.element.replaceChildren(text, start);
    this.element.replaceChildren(
      text,
      ...(found.warnings ?? []).map((warning) => make("p", { className: "refused", textContent: warning })),
      this.residuals(found),
      make("div", { className: "row" }, [button("take-calibration", "Take it", "take_calibration_data"), button("drop-calibration", "Leave it", "drop_calibration_data")]),
      make("details", {}, [make("summary", { textContent: "The whole report" }), make("pre", { textContent: found.report ?? "" })]),
    );
  }

  /** Whether the robot carries what was found. */
  private question(found: CalibrationData): HTMLElement[] {
    const answer = (id: string, textContent: string, is_taken: boolean) =>
      make("button", { id, textContent, onclick: () => this.send({ do: "answer_calibration_data", part: found.part, is_taken }) });
    const pictures = found.pictures!.map(({ camera, frame, png }) => {
      const image = make("img", { src: URL.createObjectURL(new Blob([png as BlobPart], { type: "image/png" })), alt: `what was found, seen by ${camera}` });
      image.onload = () => URL.revokeObjectURL(image.src);
      return make("figure", {}, [image, make("figcaption", { textContent: `${camera}, image ${frame}` })]);
    });
    return [
      make("p", { id: "attached-question", textContent: found.question! }),
      make("p", { textContent: "Is what is drawn in orange the robot's in each image, and nothing of the room? What is taken by mistake is never seen as an obstacle again." }),
      make("div", { className: "row" }, [answer("is-part", "It is a part of the robot", true), answer("is-no-part", "It is not", false)]),
      ...pictures,
    ];
  }

  private residuals(found: CalibrationData): HTMLElement {
    const head = make("tr", {}, ["readings of the robot lie off its surface by", "before", "after"].map((text) => make("th", { textContent: text })));
    const rows = found.cameras!.flatMap((camera) => [
      make("tr", {}, [make("th", { textContent: `${camera.name}: ${camera.headline}`, colSpan: 3 })]),
      ...(["median_m", "p90_m"] as const).map((key) =>
        make("tr", {}, [key === "median_m" ? "in the median" : "90 % of them, at most", errorText(camera.before[key]), errorText(camera.after[key])].map((text) => make("td", { textContent: text }))),
      ),
    ]);
    return make("table", { id: "residuals" }, [make("thead", {}, [head]), make("tbody", {}, rows)]);
  }
}
