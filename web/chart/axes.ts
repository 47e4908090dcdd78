// The axes of a chart on its canvas: grid, strokes of ticks, texts, and the lines at the left and at the bottom.

import type { Axis, Chart } from "../generated/charts";
import { FIGURE } from "../generated/colours";
import type { Frame } from "./frame";
import type { Tick } from "./ticks";

const [STROKE, GAP] = [3.5, 3.5]; // px: of a tick, from there to its text

export function fontOf(size: number, weight = "normal"): string {
  return `${weight} ${size}px "DejaVu Sans", Verdana, sans-serif`;
}

// The width (px) of the widest text at the ticks of an axis as drawn.
export function widthOf(axis: Axis, context: CanvasRenderingContext2D, point: number): number {
  context.font = fontOf(axis.size * point);
  return Math.max(0, ...(axis.ticks ?? []).map(([, text]) => context.measureText(text).width));
}

// ``point``: px of a pt of the figure.
export function drawAxes(context: CanvasRenderingContext2D, { width, height, x, y }: Frame, axes: Chart, ticks: { x: Tick[]; y: Tick[] }, point: number): void {
  const upright = (each: Tick, from: number, to: number): Line => [x.place(each.at), from, x.place(each.at), to];
  const level = (each: Tick, from: number, to: number): Line => [from, y.place(each.at), to, y.place(each.at)];
  const [linedX, linedY] = [axes.x.grid ? ticks.x : [], axes.y.grid ? ticks.y : []].map((all) => all.filter((each) => each.hasLine));
  strokeCrisp(context, FIGURE.grid, 0.6 * point, [
    ...linedX!.map((each) => upright(each, 0, height)),
    ...linedY!.map((each) => level(each, 0, width)),
  ]);
  strokeCrisp(context, FIGURE.faint, 0.7 * point, [
    ...(axes.x.marked ? ticks.x : []).map((each) => upright(each, height, height + STROKE)),
    ...(axes.y.marked ? ticks.y : []).map((each) => level(each, -STROKE, 0)),
  ]);
  context.fillStyle = FIGURE.ink;
  context.font = fontOf(axes.x.size * point);
  [context.textAlign, context.textBaseline] = ["center", "top"];
  for (const each of ticks.x) context.fillText(each.text, x.place(each.at), height + textOffset(axes.x));
  context.font = fontOf(axes.y.size * point);
  [context.textAlign, context.textBaseline] = ["right", "middle"];
  for (const each of ticks.y) context.fillText(each.text, -textOffset(axes.y), y.place(each.at));
}

// Over the grid, whose lines may end there.
export function drawSpines(context: CanvasRenderingContext2D, { width, height }: Frame, point: number): void {
  strokeCrisp(context, FIGURE.faint, 0.7 * point, [[0, 0, 0, height], [0, height, width, height]]);
}

function textOffset(axis: Axis): number {
  return (axis.marked ? STROKE : 0) + GAP;
}

type Line = [x0: number, y0: number, x1: number, y1: number];

// Strokes level and upright lines, their edges where pixels have theirs.
function strokeCrisp(context: CanvasRenderingContext2D, colour: string, width: number, lines: Line[]): void {
  const crisp = (at: number) => Math.round((at - width / 2) * devicePixelRatio) / devicePixelRatio + width / 2;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash([]);
  context.beginPath();
  for (const [x0, y0, x1, y1] of lines) {
    const [dx, dy] = x0 === x1 ? [crisp(x0) - x0, 0] : [0, crisp(y0) - y0];
    context.moveTo(x0 + dx, y0 + dy);
    context.lineTo(x1 + dx, y1 + dy);
  }
  context.stroke();
}
