// Mouse, touch and keys on a plot: the cursor, zoom and pan.

import type { Frame, Range } from "../chart/frame";
import type { Plot } from "./plot";

const CLICK = 4; // px, up to which a drag is a click
const WHEEL = 0.0015; // of the logarithm of the zoom, a px of the wheel
const ROWS = 10; // that a page key moves the cursor

// What a pointer does besides: the trial at a place is shown or pinned, those in a rectangle are chosen.
export interface Picking {
  hover(event: PointerEvent | null, place: Place): void;
  pick(place: Place): void;
  brush(x: Range, y: Range): void;
}

interface Place {
  x: number; // px in the area
  y: number;
}

export function listen(plot: Plot, onFocus: () => void, picking: Picking | null): void {
  const area = plot.area;
  const touches = new Map<number, PointerEvent>();
  let begin: (Place & { shift: boolean }) | null = null;
  let lastTap = 0;
  const selection = document.createElement("b");
  selection.hidden = true;
  area.append(selection);

  const placeOf = (event: PointerEvent | WheelEvent) => {
    const bounds = area.getBoundingClientRect();
    return { x: event.clientX - bounds.left, y: event.clientY - bounds.top };
  };
  const follow = (event: PointerEvent | null, { x, y }: Place) => {
    picking?.hover(event, { x, y });
    const at = plot.isPath ? plot.nearestTime(x, y) : plot.snap(plot.frame!.x.value(within(x, plot.frame!.width)));
    if (at !== null) plot.time.moveCursor(at);
  };

  area.addEventListener("pointerdown", (event) => {
    onFocus();
    if (event.pointerType === "mouse" && event.button !== 0) return;
    touches.set(event.pointerId, event);
    if (event.pointerType === "mouse") {
      begin = { ...placeOf(event), shift: event.shiftKey };
      area.setPointerCapture(event.pointerId);
    } else if (touches.size === 1) {
      if (event.timeStamp - lastTap < 300) plot.zoom(null, null);
      lastTap = event.timeStamp;
      follow(event, placeOf(event));
    } else lastTap = 0; // a pinch is no tap
  });
  area.addEventListener("pointerleave", (event) => picking?.hover(null, placeOf(event)));

  area.addEventListener("pointermove", (event) => {
    const to = placeOf(event);
    const before = touches.get(event.pointerId);
    if (event.pointerType !== "mouse" && touches.size === 2 && before) {
      pinch(plot, [...touches.values()], event, placeOf);
    } else if (begin?.shift && before) {
      plot.axis.pan((before.clientX - event.clientX) / plot.frame!.width);
    } else if (begin) {
      select(selection, begin, to, plot.isPath || picking !== null, plot.frame!);
      follow(event, to);
    } else follow(event, to);
    if (before) touches.set(event.pointerId, event);
  });

  const end = (event: PointerEvent) => {
    touches.delete(event.pointerId);
    if (event.pointerType !== "mouse" && event.type === "pointerup") picking?.pick(placeOf(event));
    if (!begin || event.pointerType !== "mouse") return;
    const [from, to] = [begin, placeOf(event)];
    begin = null;
    selection.hidden = true;
    if (from.shift || event.type === "pointercancel") return;
    if (Math.abs(to.x - from.x) < CLICK) {
      picking?.pick(to);
      return;
    }
    const { x: abscissas, y: ordinates, width, height } = plot.frame!;
    const x = sorted(abscissas.value(from.x), abscissas.value(within(to.x, width)));
    const y = sorted(ordinates.value(from.y), ordinates.value(within(to.y, height)));
    if (picking) picking.brush(x, y);
    else plot.zoom(x, y);
  };
  area.addEventListener("pointerup", end);
  area.addEventListener("pointercancel", end);
  area.addEventListener("dblclick", () => plot.zoom(null, null));

  // The page scrolls under a wheel unless the plot was chosen, by a click or by the Ctrl key.
  area.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !plot.root.contains(document.activeElement)) return;
      event.preventDefault();
      const { x, width } = plot.frame!;
      if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) plot.axis.pan((event.deltaX || event.deltaY) / width);
      else plot.axis.zoomBy(Math.exp(WHEEL * event.deltaY), x.value(placeOf(event).x));
    },
    { passive: false },
  );
}

export function listenToKeys(plot: Plot, onFocus: () => void, onPress: (key: string) => boolean): void {
  plot.root.tabIndex = 0;
  plot.root.addEventListener("focus", onFocus);
  plot.root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(onPress(event.key) || press(plot, event.key, event.shiftKey))) return;
    event.preventDefault();
  });
}

// What a key does; false where it does nothing.
export function press(plot: Plot, key: string, shift: boolean): boolean {
  const step = (rows: number) => {
    const at = plot.snap(plot.time.cursor ?? -Infinity, rows);
    if (Number.isFinite(at)) plot.time.goTo(at); // no line has rows
  };
  const rows = shift ? ROWS : 1;
  switch (key) {
    case "ArrowLeft": step(-rows); break;
    case "ArrowRight": step(rows); break;
    case "PageUp": plot.axis.pan(-0.5); break;
    case "PageDown": plot.axis.pan(0.5); break;
    case "Home": step(-Infinity); break;
    case "End": step(Infinity); break;
    case "+": case "=": plot.axis.zoomBy(0.5, plot.isPath ? null : plot.axis.cursor); break;
    case "-": plot.axis.zoomBy(2, plot.isPath ? null : plot.axis.cursor); break;
    case "0": plot.zoom(null, null); break;
    case "m": plot.time.setMark(); break;
    case "r": plot.time.toggleStatistics(); break;
    case "Escape": plot.zoom(null, null); plot.time.clearMark(); break;
    default: return false;
  }
  return true;
}

// The values under both fingers follow them: one rests, the other one moves.
function pinch(plot: Plot, [one, other]: PointerEvent[], moved: PointerEvent, placeOf: (event: PointerEvent) => { x: number }): void {
  const still = one!.pointerId === moved.pointerId ? other! : one!;
  const before = one!.pointerId === moved.pointerId ? one! : other!;
  const [was, is] = [Math.abs(before.clientX - still.clientX), Math.abs(moved.clientX - still.clientX)];
  if (was > 10 && is > 10) plot.axis.zoomBy(was / is, plot.frame!.x.value(placeOf(still).x));
}

function select(selection: HTMLElement, from: Place, to: Place, both: boolean, { width, height }: Frame): void {
  const [left, right] = sorted(from.x, within(to.x, width));
  const [top, bottom] = both ? sorted(from.y, within(to.y, height)) : [0, height];
  selection.hidden = right - left < CLICK;
  Object.assign(selection.style, { left: `${left}px`, top: `${top}px`, width: `${right - left}px`, height: `${bottom - top}px` });
}

function within(place: number, length: number): number {
  return Math.min(Math.max(place, 0), length);
}

function sorted(one: number, other: number): Range {
  return one < other ? [one, other] : [other, one];
}
