// A canvas with axes on which trials are drawn, and the area in it that a brush marks by pointer, touch and keys.

import { DIGITS, format } from "../page/numbers";
import { make } from "../page/elements";
import { colour, type ShadeName } from "./elements";
import type { Scale } from "./scale";

const FONT = "11px 'DejaVu Sans', Verdana, sans-serif";
const CLICK = 4; // px, up to which a drag is a click

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface Span {
  x: [number, number]; // fractions of the area
  y: [number, number]; // from the bottom
}

export interface Brushing {
  brush(span: Span): void;
  click(x: number, y: number): void;
  point(x: number | null, y: number): void; // null: the pointer has left
  press(key: string, extend: boolean): boolean;
}

export class Canvas {
  readonly element = make("canvas", { tabindex: "0", role: "application" });
  readonly context = this.element.getContext("2d")!;
  box: Box = { left: 0, top: 0, width: 1, height: 1 };
  marked: Span | null = null; // while it is dragged
  private begin: { x: number; y: number } | null = null;

  constructor(
    private readonly margins: Box, // width and height: right and bottom
    private readonly brushing: Brushing,
    private readonly redraw: () => void,
  ) {
    new ResizeObserver(() => redraw()).observe(this.element);
    this.element.addEventListener("pointerdown", (event) => this.onDown(event));
    this.element.addEventListener("pointermove", (event) => this.onMove(event));
    this.element.addEventListener("pointerup", (event) => this.onUp(event));
    this.element.addEventListener("pointercancel", () => this.cancel());
    this.element.addEventListener("pointerleave", () => this.brushing.point(null, 0));
    this.element.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (this.brushing.press(event.key, event.shiftKey)) event.preventDefault();
    });
  }

  // Clears the canvas; what is drawn from here on is in px of the page.
  start(): CanvasRenderingContext2D {
    const { clientWidth, clientHeight } = this.element;
    const ratio = devicePixelRatio;
    this.element.width = Math.round(clientWidth * ratio);
    this.element.height = Math.round(clientHeight * ratio);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { left, top, width, height } = this.margins;
    this.box = { left, top, width: Math.max(1, clientWidth - left - width), height: Math.max(1, clientHeight - top - height) };
    this.context.font = FONT;
    return this.context;
  }

  xAxis(scale: Scale, factor: number, title = ""): void {
    const { left, top, width, height } = this.box;
    this.context.textAlign = "center";
    this.context.textBaseline = "top";
    let end = -Infinity;
    const ticks = scale.ticks(factor);
    const digits = digitsOf(ticks);
    for (const tick of ticks) {
      const x = left + scale.fraction(tick) * width;
      this.line(x, top, x, top + height, "grid");
      const text = format(tick * factor, digits);
      const half = this.context.measureText(text).width / 2;
      const middle = Math.max(half, Math.min(x, this.element.clientWidth - half));
      if (middle - half < end + 8) continue;
      this.context.fillStyle = colour("faint");
      this.context.fillText(text, middle, top + height + 5);
      end = middle + half;
    }
    this.line(left, top + height, left + width, top + height, "faint");
    this.context.fillStyle = colour("note");
    this.context.fillText(this.shorten(title, width), left + width / 2, top + height + 22);
  }

  // The title stands above the axis.
  yAxis(scale: Scale, factor: number, title = ""): void {
    const { left, top, width, height } = this.box;
    this.context.textAlign = "right";
    this.context.textBaseline = "middle";
    const ticks = scale.ticks(factor);
    const digits = digitsOf(ticks);
    for (const tick of ticks) {
      const y = top + (1 - scale.fraction(tick)) * height;
      this.line(left, y, left + width, y, "grid");
      this.context.fillStyle = colour("faint");
      this.context.fillText(format(tick * factor, digits), left - 5, y);
    }
    this.line(left, top, left, top + height, "faint");
    this.context.fillStyle = colour("note");
    this.context.textAlign = "left";
    this.context.textBaseline = "bottom";
    this.context.fillText(this.shorten(title, left + width - 2), 2, top - 9);
  }

  // A text cut where it is wider.
  private shorten(text: string, width: number): string {
    if (this.context.measureText(text).width <= width) return text;
    let end = text.length;
    while (end && this.context.measureText(`${text.slice(0, end)}\u2026`).width > width) end--;
    return `${text.slice(0, end)}\u2026`;
  }

  // What is selected, or marked by a drag.
  drawSpan({ x, y }: Span): void {
    const { left, top, width, height } = this.box;
    const area = [left + x[0] * width, top + (1 - y[1]) * height, (x[1] - x[0]) * width, (y[1] - y[0]) * height] as const;
    this.context.fillStyle = colour("brush");
    this.context.fillRect(...area);
    this.context.strokeStyle = colour("ink");
    this.context.lineWidth = 1;
    this.context.strokeRect(...area);
  }

  line(x0: number, y0: number, x1: number, y1: number, name: ShadeName): void {
    this.context.strokeStyle = colour(name);
    this.context.lineWidth = 1;
    this.context.beginPath();
    this.context.moveTo(x0, y0);
    this.context.lineTo(x1, y1);
    this.context.stroke();
  }

  private at(event: PointerEvent): { x: number; y: number } {
    const bounds = this.element.getBoundingClientRect();
    const { left, top, width, height } = this.box;
    const within = (fraction: number) => Math.min(Math.max(fraction, 0), 1);
    return { x: within((event.clientX - bounds.left - left) / width), y: within(1 - (event.clientY - bounds.top - top) / height) };
  }

  private onDown(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.begin = this.at(event);
    this.element.setPointerCapture(event.pointerId);
  }

  private onMove(event: PointerEvent): void {
    const to = this.at(event);
    this.brushing.point(to.x, to.y);
    if (!this.begin) return;
    this.marked = spanOf(this.begin, to);
    this.redraw();
  }

  private onUp(event: PointerEvent): void {
    const [begin, to] = [this.begin, this.at(event)];
    this.cancel();
    if (!begin) return;
    const dragged = Math.max(Math.abs(to.x - begin.x) * this.box.width, Math.abs(to.y - begin.y) * this.box.height);
    if (dragged <= CLICK) this.brushing.click(to.x, to.y);
    else this.brushing.brush(spanOf(begin, to));
  }

  private cancel(): void {
    this.begin = this.marked = null;
    this.redraw();
  }
}

// Significant digits with which all ticks differ.
function digitsOf(ticks: number[]): number {
  const step = Math.min(...ticks.slice(1).map((tick, index) => tick - ticks[index]!));
  const greatest = Math.max(...ticks.map(Math.abs));
  return Number.isFinite(step) ? Math.min(Math.max(DIGITS, 2 + Math.ceil(Math.log10(greatest / step))), 15) : DIGITS;
}

function spanOf(one: { x: number; y: number }, other: { x: number; y: number }): Span {
  return {
    x: [Math.min(one.x, other.x), Math.max(one.x, other.x)],
    y: [Math.min(one.y, other.y), Math.max(one.y, other.y)],
  };
}
