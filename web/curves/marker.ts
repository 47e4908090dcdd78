// The cursor over a figure that remains a picture.

import type { Axis, Chart } from "../generated/charts";
import type { SharedAxis } from "./axis";
import { Scale } from "../chart/frame";

export function markCursor(picture: SVGElement, charts: Chart[], sharing: (axis: Axis) => SharedAxis): void {
  const frame = document.createElement("div");
  const line = document.createElement("div");
  frame.className = "pictured";
  line.className = "cursor";
  line.hidden = true;
  picture.before(frame);
  frame.append(picture, line);
  for (const axis of new Set(charts.map((chart) => sharing(chart.x)))) {
    axis.followCursor(() => show(axis));
  }

  function show(axis: SharedAxis): void {
    const at = axis.cursor;
    const chart = charts.find(({ x }) => at !== null && sharing(x) === axis && at >= x.ends[0] && at <= x.ends[1]);
    line.hidden = !chart;
    if (!chart) return;
    const fraction = new Scale(!!chart.x.logarithmic, chart.x.ends, 0, 1).place(at!);
    const [left, top, right, bottom] = chart.fluid!.margins;
    Object.assign(line.style, { left: `calc(${left}px + ${fraction} * (100% - ${left + right}px))`, top: `${top}px`, bottom: `${bottom}px` });
  }
}
