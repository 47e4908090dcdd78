// The lines, areas, rules and notes of a chart on uPlot's canvas, as the figure of the page has them.

import type uPlot from "uplot";

import type { Chart, Marker, Note, Rule } from "../generated/charts";
import type { Page, Values } from "../page/document";
import { type Series, lowerBound } from "./series";
import { FAINT, fontOf } from "./ticks";

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

// A fraction of the axes is from the left or the bottom, the other way round only what is of the data.

function placing(scale: uPlot.Scale, begin: number, length: number): (value: number, ofAxes?: boolean) => number {
  const logarithmic = scale.distr === 3;
  const [low, high] = [scale.min!, scale.max!].map((end) => (logarithmic ? Math.log10(end) : end)) as [number, number];
  const turned = scale.dir === -1;
  const slope = (turned ? -length : length) / (high - low);
  const origin = turned ? begin + length : begin;
  return (value, ofAxes = false) =>
    ofAxes ? begin + value * length : origin + ((logarithmic ? Math.log10(value) : value) - low) * slope;
}

// ``point``: px of a pt of the figure.
export function drawBelow(plot: uPlot, chart: Chart, shapes: Shape[], point: number): void {
  clipped(plot, (context) => {
    const size = point * devicePixelRatio;
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
        stroke(context, area.colour, area.stroke, area.dashes, size);
        context.stroke();
      } else {
        context.fillStyle = area.colour;
        context.fill();
      }
    });
    context.globalAlpha = 1;
    for (const rule of chart.rules ?? []) drawRule(context, plot, to, rule, size);
  });
}

function drawRule(context: CanvasRenderingContext2D, plot: uPlot, to: Positions, rule: Rule, size: number): void {
  const { left, top, width, height } = plot.bbox;
  stroke(context, rule.colour, rule.width, rule.dashes, size);
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

// ``size``: px of the canvas, a pt of the figure.
export type Layer = (context: CanvasRenderingContext2D, to: Positions, size: number) => void;

export function drawAbove(plot: uPlot, chart: Chart, all: Series[], layers: Layer[], point: number, isWhole: boolean): void {
  const size = point * devicePixelRatio;
  const to = new Positions(plot);
  const shown = all.filter((series) => !series.hidden);
  clipped(plot, (context) => {
    for (const draw of layers) draw(context, to, size);
    for (const series of shown) {
      const { colour, opacity, width, dashes, joined, marker, beyond } = series.curve;
      context.globalAlpha = opacity;
      stroke(context, colour, width, dashes, size);
      if (joined) traceLine(context, plot, series, to);
      if (marker && !beyond) drawMarkers(plot, series, to, marker, size);
    }
    context.globalAlpha = 1;
  });
  drawSpines(plot, size);
  for (const series of shown) {
    const { marker, beyond, opacity } = series.curve;
    plot.ctx.save();
    plot.ctx.globalAlpha = opacity;
    if (marker && beyond) drawMarkers(plot, series, to, marker, size);
    plot.ctx.restore();
  }
  for (const note of chart.notes ?? []) {
    const ofRange = note.of_axes[0] && note.of_axes[1]; // it speaks of the range as drawn
    if (!ofRange || isWhole) drawNote(plot, note, to, size);
  }
}

// The lines at the left and at the bottom, over the grid, whose lines may end there.
function drawSpines(plot: uPlot, size: number): void {
  const { ctx, bbox: { left, top, width, height } } = plot;
  ctx.save();
  stroke(ctx, FAINT, 0.7, [], size);
  const shift = (Math.round(ctx.lineWidth) % 2) / 2; // as the canvas has whole pixels
  ctx.translate(shift, shift);
  ctx.beginPath();
  ctx.moveTo(left, top);
  ctx.lineTo(left, top + height);
  ctx.lineTo(left + width, top + height);
  ctx.stroke();
  ctx.restore();
}

function drawNote(plot: uPlot, note: Note, to: Positions, size: number): void {
  const context = plot.ctx;
  const at = [to.x(note.at[0], note.of_axes[0]), to.y(note.at[1], note.of_axes[1])] as const;
  const { left, top } = plot.bbox;
  if (!inside(plot, note.of_axes[0] ? left : at[0], note.of_axes[1] ? top : at[1])) return;
  const x = at[0] + note.offset[0] * size;
  const y = at[1] - note.offset[1] * size;
  context.save();
  context.font = fontOf(note.size * size, note.bold ? "bold" : "normal");
  context.textAlign = note.align[0] as CanvasTextAlign;
  context.textBaseline = note.align[1] === "top" ? "top" : note.align[1] === "center" ? "middle" : "alphabetic";
  if (note.backing) {
    const box = context.measureText(note.text);
    const tall = context.measureText(`lp${note.text}`); // matplotlib's least height of a line
    const margin = note.backing.margin * size;
    context.globalAlpha = note.backing.opacity;
    context.fillStyle = note.backing.colour;
    context.fillRect(
      x - box.actualBoundingBoxLeft - margin, y - tall.actualBoundingBoxAscent - margin,
      box.actualBoundingBoxLeft + box.actualBoundingBoxRight + 2 * margin,
      tall.actualBoundingBoxAscent + tall.actualBoundingBoxDescent + 2 * margin,
    );
    context.globalAlpha = 1;
  }
  context.fillStyle = note.colour;
  context.fillText(note.text, x, y);
  context.restore();
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

function drawMarkers(plot: uPlot, series: Series, to: Positions, marker: Marker, size: number): void {
  const context = plot.ctx;
  const scale = marker.size * size;
  context.setLineDash([]);
  context.fillStyle = marker.fill ?? "";
  context.strokeStyle = marker.edge ?? "";
  context.lineWidth = marker.width * size;
  for (let row = 0; row < series.x.length; row++) {
    const [x, y] = [to.x(series.x[row]!), to.y(series.y(row))];
    if (Number.isNaN(x) || Number.isNaN(y) || !inside(plot, x, y)) continue;
    context.beginPath();
    if (!marker.outline) context.arc(x, y, scale / 2, 0, 2 * Math.PI);
    for (const line of marker.outline ?? []) {
      for (let each = 0; each < line.length; each += 2) context[each ? "lineTo" : "moveTo"](x + scale * line[each]!, y - scale * line[each + 1]!);
    }
    if (marker.fill) context.fill();
    if (marker.edge) context.stroke();
  }
}

function stroke(context: CanvasRenderingContext2D, colour: string, width: number, dashes: number[] | undefined, size: number): void {
  context.strokeStyle = colour;
  context.lineWidth = Math.max(width * size, 1);
  context.lineJoin = "round";
  context.setLineDash((dashes ?? []).map((length) => length * width * size));
}

function clipped(plot: uPlot, draw: (context: CanvasRenderingContext2D) => void): void {
  const { left, top, width, height } = plot.bbox;
  plot.ctx.save();
  plot.ctx.beginPath();
  plot.ctx.rect(left, top, width, height);
  plot.ctx.clip();
  draw(plot.ctx);
  plot.ctx.restore();
}
