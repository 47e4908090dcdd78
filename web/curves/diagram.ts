// The block diagram of a page: a block or a line leads to its signals, and shows their values at the cursor.

import { definitions, moveBeside } from "../page/card";
import type { Page } from "../page/document";
import { make } from "../page/elements";
import { reveal } from "../page/folding";
import type { SharedAxis } from "./axis";
import { Series } from "../chart/series";

const MOST = 12; // signals that a card lists

const STEPS: Record<string, number> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

interface Point {
  clientX: number;
  clientY: number;
}

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
  private point: Point = { clientX: 0, clientY: 0 }; // beside which the card is
  private readonly elements: SVGElement[];

  constructor(
    picture: SVGElement,
    private readonly page: Page,
    private readonly time: SharedAxis,
    private readonly attachVisible: () => Promise<void>,
  ) {
    document.body.append(this.card);
    page.figures.forEach((charts, figure) =>
      charts.forEach((chart, index) => {
        if (chart.x.label !== time.label) return;
        chart.curves?.forEach(({ name, signal }, position) => {
          const known = signal ?? name;
          if (known && !this.known.has(known)) this.known.set(known, { figure, chart: index, position });
        });
      }),
    );
    const keys = "arrow keys move between blocks and lines, Enter opens the figure";
    picture.setAttribute("role", "application");
    picture.setAttribute("aria-label", `${picture.getAttribute("aria-label")}; ${keys}`);
    this.elements = [...picture.querySelectorAll<SVGElement>("[data-signals]")];
    for (const [index, element] of this.elements.entries()) this.listen(element, index);
    document.addEventListener("pointerdown", (event) => {
      if (!(event.target as Element).closest("[data-signals]")) this.hide();
    });
    time.followCursor(() => void this.show());
  }

  private listen(element: SVGElement, index: number): void {
    element.tabIndex = index === 0 ? 0 : -1;
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", this.signalsOf(element).join(", "));
    element.addEventListener("pointermove", (event) => {
      event.stopPropagation();
      if (event.pointerType !== "touch") void this.show(element, event);
    });
    element.addEventListener("pointerleave", (event) => {
      if (event.pointerType !== "touch") this.hide();
    });
    // A first tap shows, a second one leads to the figure.
    element.addEventListener("click", (event) => {
      event.stopPropagation();
      if ((event as PointerEvent).pointerType === "touch" && this.current !== element) void this.show(element, event);
      else void this.lead(element);
    });
    element.addEventListener("focus", () => {
      const { right: clientX, bottom: clientY } = element.getBoundingClientRect();
      if (element.matches(":focus-visible")) void this.show(element, { clientX, clientY });
    });
    element.addEventListener("blur", () => this.hide());
    element.addEventListener("keydown", (event) => {
      const step = STEPS[event.key];
      const next = step && this.elements[index + step];
      if (event.key === "Enter" || event.key === " ") void this.lead(element);
      else if (event.key === "Escape") this.hide();
      else if (next) {
        element.tabIndex = -1;
        next.tabIndex = 0;
        next.focus();
      } else return;
      event.preventDefault();
    });
  }

  private hide(): void {
    this.current = null;
    this.card.hidden = true;
  }

  // Of a line the signals that drive it; where an inner connector is not recorded those that it drives.
  private signalsOf(element: Element): string[] {
    const [sources, targets] = ["data-signals", "data-targets"].map(
      (name) => JSON.parse(element.getAttribute(name) ?? "[]") as string[],
    );
    return sources!.map((name, index) => (this.known.has(name) ? name : (targets![index] ?? name)));
  }

  // Shows what an element's signals are at the cursor; without one, of what is shown already.
  private async show(element = this.current, at: Point = this.point): Promise<void> {
    if (!element) return;
    this.current = element;
    this.point = { clientX: at.clientX, clientY: at.clientY };
    const time = this.time.cursor;
    const all = this.signalsOf(element);
    const signals = all.filter((name) => this.known.has(name));
    const entries = signals
      .slice(0, MOST)
      .map(async (label) => ({ label, text: time === null ? "" : await this.valueOf(label, time) }));
    const list = definitions(await Promise.all(entries));
    if (element !== this.current) return;
    this.card.replaceChildren(list);
    if (signals.length > MOST) this.card.append(`and ${signals.length - MOST} more in figures`);
    if (!signals.length) this.card.append("Not in any figure, since the signals are constant or equal to others.");
    this.card.hidden = false;
    moveBeside(this.card, this.point);
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

  // Goes to the first figure that has one of an element's signals.
  private async lead(element: Element): Promise<void> {
    const signal = this.signalsOf(element).find((name) => this.known.has(name));
    if (!signal) return;
    const { figure } = this.known.get(signal)!;
    const elements = [...document.querySelectorAll(`[data-figure="${figure}"]`)];
    if (elements[0]) reveal(elements[0]);
    await this.attachVisible();
    const visible = elements.find((each) => each.getClientRects().length) ?? elements[0];
    visible?.scrollIntoView({ block: "center" });
    visible?.parentElement?.querySelector<HTMLElement>(".chart")?.focus({ preventScroll: true });
  }
}
