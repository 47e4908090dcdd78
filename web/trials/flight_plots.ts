// The signals of one trial over time, a small plot for each quantity, with a cursor that the page's scene shares.

import { SharedAxis } from "../curves/axis";
import { describePlot } from "../curves/readout";
import { Plot } from "../curves/plot";
import { listen, listenToKeys } from "../curves/pointer";
import type { Page } from "../page/document";
import { make, nameOf } from "../page/elements";
import { announceTime, followTime } from "../page/time";
import type { Titled } from "./flights";

const NAME = "flight"; // of these plots in events
const HEIGHT = 96; // px
const POINT = 1.25; // px of a pt
const MARGINS: [number, number, number, number] = [6, 10, 22, 60]; // px

export class FlightPlots {
  readonly element = make("div", { class: "flight" });
  private axis: SharedAxis | null = null;
  private isFollowing = false;

  constructor(private readonly page: Page) {
    followTime(NAME, (at) => {
      this.isFollowing = true;
      this.axis?.goTo(at);
      this.isFollowing = false;
    });
  }

  async show(charts: Titled[]): Promise<void> {
    const axis = new SharedAxis("time, s", false);
    this.axis = axis;
    const plots = await Promise.all(charts.map((chart) => this.load(chart, axis)));
    if (axis !== this.axis) return; // another trial was chosen in the meantime
    this.element.replaceChildren(...plots.map(({ section }) => section));
    const width = plots[0]?.frame.clientWidth ?? 0;
    for (const { plot } of plots) plot.place({ left: 0, top: 0, width, height: HEIGHT, margins: MARGINS, isNarrow: false, point: POINT });
    axis.followCursor(() => {
      if (axis === this.axis && axis.cursor !== null && !this.isFollowing) announceTime(axis.cursor, NAME);
    });
  }

  hide(): void {
    this.axis = null;
    this.element.replaceChildren();
  }

  private async load({ title, chart }: Titled, axis: SharedAxis) {
    const plot = await Plot.load(chart, this.page, () => axis, () => axis);
    const values = make("output");
    const frame = make("div", { class: "live", style: `height: ${HEIGHT}px` }, plot.root);
    plot.isNear = true;
    plot.root.setAttribute("role", "application");
    plot.root.setAttribute("aria-label", `${title}; arrow keys move the cursor, plus and minus zoom, 0 shows the whole range`);
    listen(plot, () => plot.root.focus(), null);
    listenToKeys(plot, () => undefined, () => false);
    axis.followCursor(() => {
      const entries = axis.cursor === null ? [] : describePlot(plot, axis.cursor);
      values.replaceChildren(
        ...entries.map(([text, colour]) => make("span", { style: `border-color: ${colour}` }, nameOf(text))),
      );
    });
    return { plot, frame, section: make("section", {}, make("h4", {}, nameOf(title)), values, frame) };
  }
}
