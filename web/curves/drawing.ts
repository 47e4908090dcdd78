// The lines, areas, rules and notes of a chart on uPlot's canvas, as the figure of the page has them.

import type uPlot from "uplot";

import type { Chart, Page, Rule, Values } from "../page/document";
import { type Series, lowerBound } from "./series";

const POINT = 1.25; // px of a pt, as figures fill the page
const NEAR = 0.4; // px, nearer points of a path are one

export type Shape = { x: Values; y: Values };

export async function loadShapes(chart: Chart, page: Page): Promise<Shape[]> {
  return Promise.all(
    (chart.areas ?? []).map(async (area) => ({ x: await page.column(area.x), y: await page.column(area.y) })),
  );
}

// Positions on the canvas (its px) of abscissas and ordinates, of the data or as fractions of the axes.
export class Positions {
  readonly x: (value: number, ofAxes?: boolean) => number;
  readonly y: (value: number, ofAxes?: boolean) => number;

  constructor(plot: uPlot) {
    const { left, top, width, height } = plot.bbox;
    this.x = placing(plot.scales.x!, left, width);
    this.y = placing(plot.scales.y!, top + height, -height);
  }
}

function placing(scale: uPlot.Scale, begin: number, length: number): (value: number, ofAxes?: boolean) => number {
  const logarithmic = scale.distr === 3;
  const [low, high] = [scale.min!, scale.max!].map((end) => (logarithmic ? Math.log10(end) : end)) as [number, number];
  const slope = length / (high - low);
  return (value, ofAxes = false) =>
    ofAxes ? begin + value * length : begin + ((logarithmic ? Math.log10(value) : value) - low) * slope;
}

export function drawBelow(plot: uPlot, chart: Chart, shapes: Shape[]): void {
  clipped(plot, (context, ratio) => {
    const to = new Positions(plot);
    (chart.areas ?? []).forEach((area, index) => {
      const { x, y } = shapes[index]!;
      context.globalAlpha = area.opacity;
      context.beginPath();
      for (let row = 0; row < x.length; row++) {
        const place: [number, number] = [to.x(x[row]!, area.of_axes[0]), to.y(y[row]!, area.of_axes[1])];
        if (row === 0 || (area.stroke > 0 && row % 2 === 0)) context.moveTo(...place);
        else context.lineTo(...place);
      }
      if (area.stroke > 0) {
        context.strokeStyle = area.colour;
        context.lineWidth = area.stroke * POINT * ratio;
        context.stroke();
      } else {
        context.fillStyle = area.colour;
        context.fill();
      }
    });
    context.globalAlpha = 1;
    for (const rule of chart.rules ?? []) drawRule(context, plot, to, rule, ratio);
  });
}

function drawRule(context: CanvasRenderingContext2D, plot: uPlot, to: Positions, rule: Rule, ratio: number): void {
  const { left, top, width, height } = plot.bbox;
  stroke(context, rule.colour, rule.width, rule.dashes, ratio);
  context.beginPath();
  if (rule.upright) {
    context.moveTo(to.x(rule.at), top);
    context.lineTo(to.x(rule.at), top + height);
  } else {
    context.moveTo(left, to.y(rule.at));
    context.lineTo(left + width, to.y(rule.at));
  }
  context.stroke();
}

export type Layer = (context: CanvasRenderingContext2D, to: Positions, ratio: number) => void;

export function drawAbove(plot: uPlot, chart: Chart, all: Series[], layers: Layer[], whole: boolean): void {
  clipped(plot, (context, ratio) => {
    const to = new Positions(plot);
    for (const draw of layers) draw(context, to, ratio);
    for (const series of all) {
      if (series.hidden) continue;
      const { colour, width, dashes, joined, marker } = series.curve;
      stroke(context, colour, width, dashes, ratio);
      if (joined) traceLine(context, plot, series, to);
      if (marker > 0) drawMarkers(context, series, to, marker, ratio);
    }
  });
  for (const note of chart.notes ?? []) {
    if (note.of_axes && !whole) continue; // it speaks of the range as drawn
    const { context, ratio } = { context: plot.ctx, ratio: devicePixelRatio };
    const to = new Positions(plot);
    const x = to.x(note.at[0], note.of_axes) + note.offset[0] * POINT * ratio;
    const y = to.y(note.at[1], note.of_axes) - note.offset[1] * POINT * ratio;
    if (!inside(plot, to.x(note.at[0], note.of_axes), to.y(note.at[1], note.of_axes))) continue;
    context.font = `${note.bold ? "bold " : ""}${10.5 * ratio}px "DejaVu Sans", Verdana, sans-serif`;
    context.fillStyle = note.colour;
    context.textAlign = note.align[0] as CanvasTextAlign;
    context.textBaseline = note.align[1] === "top" ? "top" : note.align[1] === "center" ? "middle" : "alphabetic";
    context.fillText(note.text, x, y);
  }
}

function inside(plot: uPlot, x: number, y: number): boolean {
  const { left, top, width, height } = plot.bbox;
  return x >= left - 1 && x <= left + width + 1 && y >= top - 1 && y <= top + height + 1;
}

function traceLine(context: CanvasRenderingContext2D, plot: uPlot, series: Series, to: Positions): void {
  const { x, isPath, curve } = series;
  const begin = isPath ? 0 : Math.max(lowerBound(x, plot.scales.x!.min!) - 1, 0);
  const end = isPath ? x.length : Math.min(lowerBound(x, plot.scales.x!.max!) + 2, x.length);
  context.beginPath();
  if (!isPath && end - begin > 4 * plot.bbox.width) traceColumns(context, series, to, begin, end);
  else {
    let [lastX, lastY, pen] = [NaN, NaN, false];
    for (let row = begin; row < end; row++) {
      const [px, py] = [to.x(x[row]!), to.y(series.y(row))];
      if (Number.isNaN(px) || Number.isNaN(py)) pen = false;
      else if (!pen) {
        context.moveTo(px, py);
        [lastX, lastY, pen] = [px, py, true];
      } else if (Math.abs(px - lastX) > NEAR || Math.abs(py - lastY) > NEAR || row === end - 1) {
        if (curve.steps) context.lineTo(px, lastY);
        context.lineTo(px, py);
        [lastX, lastY] = [px, py];
      }
    }
  }
  context.stroke();
}

// Of all rows in a column of pixels the first, least, greatest and last, as one line along which dashes go on: the same
// picture as of all rows.
function traceColumns(context: CanvasRenderingContext2D, series: Series, to: Positions, begin: number, end: number): void {
  let pen = false;
  let row = begin;
  while (row < end) {
    const column = Math.floor(to.x(series.x[row]!));
    const first = series.y(row);
    let [least, greatest, last] = [Infinity, -Infinity, NaN];
    for (; row < end && Math.floor(to.x(series.x[row]!)) === column; row++) {
      last = series.y(row);
      if (last < least) least = last;
      if (last > greatest) greatest = last;
    }
    if (least > greatest) {
      pen = false;
      continue;
    }
    if (pen && !Number.isNaN(first)) {
      context.lineTo(column, to.y(first));
      context.lineTo(column, to.y(least));
    } else context.moveTo(column, to.y(least));
    context.lineTo(column, to.y(greatest));
    pen = !Number.isNaN(last);
    if (pen) context.lineTo(column, to.y(last));
  }
}

function drawMarkers(context: CanvasRenderingContext2D, series: Series, to: Positions, size: number, ratio: number): void {
  context.setLineDash([]);
  context.fillStyle = series.curve.filled ? series.curve.colour : "#fff";
  for (let row = 0; row < series.x.length; row++) {
    const value = series.y(row);
    if (Number.isNaN(value)) continue;
    context.beginPath();
    context.arc(to.x(series.x[row]!), to.y(value), (size / 2) * POINT * ratio, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

function stroke(context: CanvasRenderingContext2D, colour: string, width: number, dashes: number[] | undefined, ratio: number): void {
  context.strokeStyle = colour;
  context.lineWidth = Math.max(width * POINT * ratio, 1);
  context.lineJoin = "round";
  context.setLineDash((dashes ?? []).map((length) => length * width * POINT * ratio));
}

function clipped(plot: uPlot, draw: (context: CanvasRenderingContext2D, ratio: number) => void): void {
  const { left, top, width, height } = plot.bbox;
  plot.ctx.save();
  plot.ctx.beginPath();
  plot.ctx.rect(left, top, width, height);
  plot.ctx.clip();
  draw(plot.ctx, devicePixelRatio);
  plot.ctx.restore();
}
