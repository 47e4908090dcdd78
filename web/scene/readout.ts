// Numbers over the view: time, height, thrust; and the scale of what is in the middle, and of the grid.

import { format } from "../page/numbers";
import type { BodyData, SceneData } from "./document";
import { make, nameOf } from "../page/elements";
import type { Foot, Ground } from "./objects/ground";
import { type Instant, scalarAt } from "./instant";

const DIGITS = 5; // of lengths
const EXACT = 1e-3; // m, of positions in float32 where a flight ends
const BAR = 0.2; // of the view's width, at most

export class Readout {
  readonly values = make("dl", { class: "scene-values" });
  readonly scale = make("div", { class: "scene-scale", "aria-hidden": "true" });
  private names: string[] = [];
  private cells: HTMLElement[] = [];
  private readonly bar = make("i");
  private readonly text = make("span");

  constructor(private readonly scene: SceneData) {
    this.scale.append(this.bar, this.text);
  }

  showValues(instant: Instant, body: BodyData, foot: Foot | null): void {
    const rows: [string, string][] = [["time", `${format(instant.time)} s`]];
    if (foot) rows.push([`height, ${body.name}`, metres(Math.round(foot.height / EXACT) * EXACT)]);
    for (const { label, values, unit } of body.thrusts ?? []) {
      rows.push([label, `${format(scalarAt(values, instant))} ${unit ?? ""}`.trim()]);
    }
    if (rows.some(([name], index) => name !== this.names[index]) || rows.length !== this.names.length) {
      this.names = rows.map(([name]) => name);
      this.cells = rows.map(() => make("dd"));
      const lines = this.names.map((name, index) => make("div", {}, make("dt", {}, nameOf(name)), this.cells[index]!));
      this.values.replaceChildren(...lines);
    }
    for (const [index, [, value]] of rows.entries()) this.cells[index]!.textContent = value;
  }

  // `metresPerPixel` is that of the middle of the view.
  showScale(metresPerPixel: number, width: number, ground: Ground | null): void {
    const largest = BAR * width * metresPerPixel;
    const decade = 10 ** Math.floor(Math.log10(largest));
    const length = decade * ([5, 2].find((factor) => factor * decade <= largest) ?? 1);
    this.bar.style.width = `${length / metresPerPixel}px`;
    const name = this.scene.ground?.name ?? "";
    const grid = ground ? `; grid on ${name}: ${metres(ground.spacing)}, heavy ${metres(10 * ground.spacing)}` : "";
    this.text.replaceChildren(metres(length), nameOf(grid));
  }
}

export function metres(length: number): string {
  return Math.abs(length) < 1e4 ? `${format(length, DIGITS)} m` : `${format(length / 1000, DIGITS)} km`;
}
