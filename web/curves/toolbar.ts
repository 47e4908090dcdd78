// Buttons for what keys and the wheel do, and the place of the cursor: one bar for the page.

import type { SharedAxis } from "./axis";
import { format } from "../page/numbers";

const BUTTONS: [key: string, label: string, sign: string][] = [
  ["ArrowLeft", "previous row", "\u25c2"],
  ["ArrowRight", "next row", "\u25b8"],
  ["+", "zoom in", "+"],
  ["-", "zoom out", "\u2212"],
  ["PageUp", "earlier", "\u27f5"],
  ["PageDown", "later", "\u27f6"],
  ["0", "whole range", "\u2922"],
  ["m", "second cursor at this point: differences and slopes", "\u0394"],
  ["r", "minimum, maximum and rms of the visible range", "\u03a3"],
];

const GESTURES = ["+", "-", "0"]; // a telephone has no button for a pinch and a double tap
const TELEPHONE = "(max-width: 640px)";

export class Toolbar {
  readonly element = document.createElement("div");
  private readonly cursor = document.createElement("output");
  private readonly spoken = document.createElement("p");
  private speaking = 0;

  constructor(press: (key: string) => void) {
    this.element.className = "explore";
    this.element.setAttribute("role", "toolbar");
    this.element.setAttribute("aria-label", "Cursor and zoom");
    this.element.append(this.cursor);
    for (const [key, label, sign] of BUTTONS) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = sign;
      button.title = label;
      button.className = GESTURES.includes(key) ? "gesture" : "";
      button.setAttribute("aria-label", label);
      button.addEventListener("click", () => press(key));
      this.element.append(button);
    }
    this.cursor.textContent = matchMedia(TELEPHONE).matches ? "Tap a figure." : "Point at a figure; drag to zoom.";
    this.spoken.className = "spoken";
    this.spoken.setAttribute("aria-live", "polite");
    document.body.append(this.element, this.spoken);
  }

  show(axis: SharedAxis): void {
    const { name, unit } = axis.quantity;
    const { cursor, mark } = axis;
    const difference = cursor === null || mark === null ? "" : `, \u0394 ${format(cursor - mark)} ${unit}`;
    this.cursor.textContent = cursor === null ? "" : `${name} ${format(cursor)} ${unit}${difference}`;
  }

  // Says the values once the cursor rests.
  speak(text: () => string): void {
    clearTimeout(this.speaking);
    this.speaking = window.setTimeout(() => {
      this.spoken.textContent = `${this.cursor.textContent}: ${text()}`;
    }, 400);
  }
}
