// The block diagram of a page: a block or a line leads to its signals, and shows their values at the cursor.

import type { Page } from "../page/document";
import type { SharedAxis } from "./axis";
import { Series } from "./series";

const MOST = 12; // signals that a card lists

interface Known {
  figure: number;
  chart: number; // of the figure
  position: number; // of the curve in the chart
}

export class Diagram {
  private readonly card = document.createElement("aside");
  private readonly known = new Map<string, Known>();
  private current: Element | null = null;

  constructor(
    picture: SVGElement,
    private readonly page: Page,
    private readonly time: SharedAxis,
  ) {
    this.card.className = "card";
    this.card.hidden = true;
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
      void this.show();
      Object.assign(this.card.style, { left: `${Math.min(event.clientX + 14, innerWidth - 280)}px`, top: `${event.clientY + 14}px` });
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
    const list = document.createElement("dl");
    const all = this.signalsOf(element);
    const signals = all.filter((name) => this.known.has(name));
    for (const signal of signals.slice(0, MOST)) {
      const [term, definition] = [document.createElement("dt"), document.createElement("dd")];
      term.textContent = signal;
      definition.textContent = at === null ? "" : await this.valueOf(signal, at);
      list.append(term, definition);
    }
    if (element !== this.current) return;
    this.card.replaceChildren(list);
    if (signals.length > MOST) this.card.append(`and ${signals.length - MOST} more in figures`);
    if (!signals.length) this.card.append(all.length ? "In no figure: constant, or equal to other signals." : "");
    this.card.hidden = false;
  }

  private async valueOf(signal: string, at: number): Promise<string> {
    const { figure, chart, position } = this.known.get(signal)!;
    const curve = this.page.figures[figure]![chart]!.curves![position]!;
    const series = await Series.load(curve, this.page);
    const row = series.rowWithin(at);
    return row === null ? "\u2013" : `${series.text(row)} ${curve.unit ?? ""}`.trim();
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
