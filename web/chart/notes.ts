// The texts of a chart at points of its data or its axes.

import type { ChartNote } from "../generated/charts";
import { fontOf } from "./axes";
import type { Frame } from "./frame";

const BASELINES: Record<string, CanvasTextBaseline> = { top: "top", center: "middle" };

// ``point``: px of a pt of the figure.
export function drawNote(context: CanvasRenderingContext2D, frame: Frame, note: ChartNote, point: number): void {
  const at = [frame.across(note.at[0], note.of_axes[0]), frame.down(note.at[1], note.of_axes[1])] as const;
  if (!frame.has(note.of_axes[0] ? 0 : at[0], note.of_axes[1] ? 0 : at[1], 1)) return;
  const x = at[0] + note.offset[0] * point;
  const y = at[1] - note.offset[1] * point;
  context.font = fontOf(note.size * point, note.bold ? "bold" : "normal");
  context.textAlign = note.align[0] as CanvasTextAlign;
  context.textBaseline = BASELINES[note.align[1]] ?? "alphabetic";
  if (note.backing) {
    const box = context.measureText(note.text);
    const tall = context.measureText(`lp${note.text}`); // matplotlib's least height of a line
    const margin = note.backing.margin * point;
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
}
