// The lines, marks, areas and rules of a chart on its canvas, as the figure of the page has them.

import type { Chart, Marker, Rule } from "../generated/charts";
import type { Page, Values } from "../page/document";
import { drawSpines } from "./axes";
import type { Frame } from "./frame";
import { drawNote } from "./notes";
import { type Series, lowerBound } from "./series";

const NEAR = 0.4; // pixels, nearer points of a path are one

export type Shape = { x: Values; y: Values };

export async function loadShapes(chart: Chart, page: Page): Promise<Shape[]> {
  return Promise.all(
    (chart.areas ?? []).map(async (area) => ({ x: await page.column(area.x), y: await page.column(area.y) })),
  );
}

// ``point``: px of a pt of the figure.
export function drawBelow(context: CanvasRenderingContext2D, frame: Frame, chart: Chart, shapes: Shape[], point: number): void {
  clipped(context, frame, () => {
    (chart.areas ?? []).forEach((area, index) => {
      const { x, y } = shapes[index]!;
      context.globalAlpha = area.opacity;
      context.beginPath();
      for (let row = 0; row < x.length; row++) {
        const place: [number, number] = [frame.across(x[row]!, area.of_axes[0]), frame.down(y[row]!, area.of_axes[1])];
        if (row === 0 || (area.stroke > 0 && row % 2 === 0)) context.moveTo(...place);
        else context.lineTo(...place);
      }
      if (area.stroke > 0) {
        stroke(context, area.colour, area.stroke, area.dashes, point);
        context.stroke();
      } else {
        context.fillStyle = area.colour;
        context.fill();
      }
    });
    context.globalAlpha = 1;
    for (const rule of chart.rules ?? []) drawRule(context, frame, rule, point);
  });
}

function drawRule(context: CanvasRenderingContext2D, frame: Frame, rule: Rule, point: number): void {
  stroke(context, rule.colour, rule.width, rule.dashes, point);
  context.beginPath();
  if (rule.upright) {
    context.moveTo(frame.across(rule.at), 0);
    context.lineTo(frame.across(rule.at), frame.height);
  } else {
    context.moveTo(0, frame.down(rule.at));
    context.lineTo(frame.width, frame.down(rule.at));
  }
  context.stroke();
}

export type Layer = (context: CanvasRenderingContext2D, frame: Frame, point: number) => void;

export function drawAbove(context: CanvasRenderingContext2D, frame: Frame, chart: Chart, all: Series[], point: number, isWhole: boolean): void {
  const shown = all.filter((series) => !series.hidden);
  clipped(context, frame, () => {
    for (const series of shown) {
      const { colour, opacity, width, dashes, joined, marker, beyond } = series.curve;
      context.globalAlpha = opacity;
      stroke(context, colour, width, dashes, point);
      if (joined) traceLine(context, frame, series);
      if (marker && !beyond) drawMarkers(context, frame, series, marker, point);
    }
    context.globalAlpha = 1;
  });
  drawSpines(context, frame, point);
  for (const series of shown) {
    const { marker, beyond, opacity } = series.curve;
    context.globalAlpha = opacity;
    if (marker && beyond) drawMarkers(context, frame, series, marker, point);
  }
  context.globalAlpha = 1;
  for (const note of chart.notes ?? []) {
    const ofRange = note.of_axes[0] && note.of_axes[1]; // it speaks of the range as drawn
    if (!ofRange || isWhole) drawNote(context, frame, note, point);
  }
}

function traceLine(context: CanvasRenderingContext2D, frame: Frame, series: Series): void {
  const { x, isPath, curve } = series;
  const near = NEAR / devicePixelRatio;
  const begin = isPath ? 0 : Math.max(lowerBound(x, frame.x.ends[0]) - 1, 0);
  const end = isPath ? x.length : Math.min(lowerBound(x, frame.x.ends[1]) + 2, x.length);
  context.beginPath();
  if (!isPath && end - begin > 4 * frame.width * devicePixelRatio) traceColumns(context, frame, series, begin, end);
  else {
    let [lastX, lastY, pen] = [NaN, NaN, false];
    for (let row = begin; row < end; row++) {
      const [px, py] = [frame.x.place(x[row]!), frame.y.place(series.y(row))];
      if (Number.isNaN(px) || Number.isNaN(py)) pen = false;
      else if (!pen) {
        context.moveTo(px, py);
        [lastX, lastY, pen] = [px, py, true];
      } else if (Math.abs(px - lastX) > near || Math.abs(py - lastY) > near || row === end - 1) {
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
function traceColumns(context: CanvasRenderingContext2D, frame: Frame, series: Series, begin: number, end: number): void {
  let pen = false;
  let row = begin;
  while (row < end) {
    const column = Math.floor(frame.x.place(series.x[row]!) * devicePixelRatio);
    const next = frame.x.value((column + 1) / devicePixelRatio);
    const first = series.y(row);
    let [least, greatest, last] = [Infinity, -Infinity, NaN];
    do {
      last = series.y(row);
      if (last < least) least = last;
      if (last > greatest) greatest = last;
    } while (++row < end && series.x[row]! < next);
    if (least > greatest) {
      pen = false;
      continue;
    }
    const at = column / devicePixelRatio;
    if (pen && !Number.isNaN(first)) {
      context.lineTo(at, frame.y.place(first));
      context.lineTo(at, frame.y.place(least));
    } else context.moveTo(at, frame.y.place(least));
    context.lineTo(at, frame.y.place(greatest));
    pen = !Number.isNaN(last);
    if (pen) context.lineTo(at, frame.y.place(last));
  }
}

function drawMarkers(context: CanvasRenderingContext2D, frame: Frame, series: Series, marker: Marker, point: number): void {
  const scale = marker.size * point;
  context.setLineDash([]);
  context.fillStyle = marker.fill ?? "";
  context.strokeStyle = marker.edge ?? "";
  context.lineWidth = marker.width * point;
  for (let row = 0; row < series.x.length; row++) {
    const [x, y] = [frame.x.place(series.x[row]!), frame.y.place(series.y(row))];
    if (!frame.has(x, y, 1)) continue;
    context.beginPath();
    if (!marker.outline) context.arc(x, y, scale / 2, 0, 2 * Math.PI);
    for (const line of marker.outline ?? []) {
      for (let each = 0; each < line.length; each += 2) context[each ? "lineTo" : "moveTo"](x + scale * line[each]!, y - scale * line[each + 1]!);
    }
    if (marker.fill) context.fill();
    if (marker.edge) context.stroke();
  }
}

function stroke(context: CanvasRenderingContext2D, colour: string, width: number, dashes: number[] | undefined, point: number): void {
  context.strokeStyle = colour;
  context.lineWidth = Math.max(width * point, 1 / devicePixelRatio);
  context.lineJoin = "round";
  context.setLineDash((dashes ?? []).map((length) => length * width * point));
}

export function clipped(context: CanvasRenderingContext2D, { width, height }: Frame, draw: () => void): void {
  context.save();
  context.beginPath();
  context.rect(0, 0, width, height);
  context.clip();
  draw();
  context.restore();
}
