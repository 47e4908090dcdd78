// Axes: of the scene's frame in a corner of the view, and of bodies at the bodies.

import { ArrowHelper, Group, type PerspectiveCamera, Vector3 } from "three";
import { make, makeSvg } from "../../page/elements";
import { strokeOf } from "../theme";

const COLOURS = ["#d9480f", "#2b8a3e", "#1c6fd0"]; // x, y, z
const LENGTH = 30; // px
const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

// The axes of a body, of this length (m).
export function bodyAxes(length: number): Group {
  const group = new Group();
  for (const [index, axis] of AXES.entries()) {
    group.add(new ArrowHelper(axis, new Vector3(), length, COLOURS[index], 0.12 * length, 0.06 * length));
  }
  return group;
}

// The axes of the frame with their names, as the camera sees them.
export class Triad {
  readonly element: HTMLElement;
  private readonly lines: SVGElement[];
  private readonly labels: SVGElement[];

  constructor(names: string[]) {
    const svg = makeSvg("svg", { viewBox: "-70 -50 140 100", width: 140, height: 100 });
    this.lines = AXES.map((_, index) => makeSvg("line", { style: strokeOf(COLOURS[index]!), "stroke-width": 2 }));
    this.labels = names.map((name, index) => {
      const label = makeSvg("text", { style: strokeOf(COLOURS[index]!).replace("stroke", "fill"), "dominant-baseline": "middle" });
      const axis = "xyz"[index]!;
      label.textContent = name === axis ? axis : `${axis} ${name}`;
      return label;
    });
    svg.append(...this.lines, ...this.labels);
    this.element = make("div", { class: "scene-triad", "aria-hidden": "true" }, svg);
  }

  show(camera: PerspectiveCamera): void {
    const seen = AXES.map((axis, index) => ({ index, at: axis.clone().transformDirection(camera.matrixWorldInverse) }));
    for (const { index, at } of seen) {
      const [x, y] = [LENGTH * at.x, -LENGTH * at.y];
      for (const [name, value] of Object.entries({ x1: 0, y1: 0, x2: x, y2: y })) {
        this.lines[index]!.setAttribute(name, value.toFixed(1));
      }
      const label = this.labels[index]!;
      label.setAttribute("x", (1.25 * x).toFixed(1));
      label.setAttribute("y", (1.25 * y + (Math.abs(y) < 6 && Math.abs(x) < 6 ? 10 : 0)).toFixed(1));
      label.setAttribute("text-anchor", x < -4 ? "end" : x > 4 ? "start" : "middle");
      label.style.opacity = this.lines[index]!.style.opacity = at.z < -0.2 ? "0.55" : "1";
    }
  }
}
