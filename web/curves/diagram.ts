// The block diagram of a page: a block or a line leads to its signals, and shows their values at the cursor.

import { definitions, moveBeside } from "../page/card";
import type { Page } from "../page/document";
import { make } from "../page/elements";
import type { SharedAxis } from "./axis";
import { Series } from "./series";

const MOST = 12; // signals that a card lists

interface Known {
  figure: number;
  chart: number; // of the figure
  position: number; // of the curve in the chart
}

export class Diagram {
  private readonly card = make("aside", { class: "card", hidden: "" });
  private readonly known = new Map<string, Known>();
  private readonly loaded = new Map<string, Promise<Series>>();
  private current: Element | null = null;
  private at = { clientX: 0, clientY: 0 }; // of the pointer

  constructor(
    picture: SVGElement,
    private readonly page: Page,
    private readonly time: SharedAxis,
  ) {
    document.body.append(this.card);
    page.figures.forEach((charts, figure) =>
      charts.forEach((chart, index) => {
        if (chart?.x.label !== time.label) return;
        chart.curves?.forEach(({ name }, position) => {
          if (name && !this.known.has(name)) this.known.set(name, { figure, chart: index, position });
        });
      }),
    );
    for (const element of picture.querySelectorAll<SVGElement>("[data-signals]")) this.listen(element);
    time.follow([Infinity, -Infinity], () => void this.show(), () => undefined);
  }

  private listen(element: SVGElement): void {
    element.addEventListener("pointermove", (event) => {
      event.stopPropagation();
      this.current = element;
      this.at = event;
      void this.show();
    });
    element.addEventListener("pointerleave", () => {
      this.current = null;
      this.card.hidden = true;
    });
    element.addEventListener("click", (event) => {
      event.stopPropagation();
      const signal = this.signalsOf(element).find((name) => this.known.has(name));
      if (signal) this.lead(this.known.get(signal)!.figure);
    });
  }

  // Of a line the signals that drive it; where an inner connector is not recorded those that it drives.
  private signalsOf(element: Element): string[] {
    const [sources, targets] = ["data-signals", "data-targets"].map(
      (name) => JSON.parse(element.getAttribute(name) ?? "[]") as string[],
    );
    return sources!.map((name, index) => (this.known.has(name) ? name : (targets![index] ?? name)));
  }

  private async show(): Promise<void> {
    const element = this.current;
    if (!element) return;
    const at = this.time.cursor;
    const all = this.signalsOf(element);
    const signals = all.filter((name) => this.known.has(name));
    const entries = signals
      .slice(0, MOST)
      .map(async (label) => ({ label, text: at === null ? "" : await this.valueOf(label, at) }));
    const list = definitions(await Promise.all(entries));
    if (element !== this.current) return;
    this.card.replaceChildren(list);
    if (signals.length > MOST) this.card.append(`and ${signals.length - MOST} more in figures`);
    if (!signals.length) this.card.append("In no figure: constant, or equal to other signals.");
    this.card.hidden = false;
    moveBeside(this.card, this.at);
  }

  private async valueOf(signal: string, at: number): Promise<string> {
    const series = await this.load(signal);
    const row = series.rowWithin(at);
    return row === null ? "\u2013" : `${series.text(row)} ${series.curve.unit ?? ""}`.trim();
  }

  private load(signal: string): Promise<Series> {
    let series = this.loaded.get(signal);
    if (!series) {
      const { figure, chart, position } = this.known.get(signal)!;
      series = Series.load(this.page.figures[figure]![chart]!.curves![position]!, this.page);
      this.loaded.set(signal, series);
    }
    return series;
  }

  private lead(figure: number): void {
    const elements = [...document.querySelectorAll(`[data-figure="${figure}"]`)];
    const folded = elements[0]?.closest("details");
    if (folded) folded.open = true;
    const visible = elements.find((each) => each.getClientRects().length) ?? elements[0];
    visible?.scrollIntoView({ block: "center" });
    visible?.parentElement?.querySelector<HTMLElement>(".chart")?.focus({ preventScroll: true });
  }
}
