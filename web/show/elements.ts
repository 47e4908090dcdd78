// Pieces of the page that its figures share: choices, names of quantities, colours.

import { SHADES } from "../generated/colours";
import { make } from "../page/elements";
import type { QuantityEntry } from "../generated/documents";

export function choice(label: string, options: string[], chosen: number, onChange: (index: number) => void): HTMLLabelElement {
  const select = make("select");
  options.forEach((text, index) => select.append(make("option", { value: index }, text)));
  select.value = String(chosen);
  select.addEventListener("change", () => onChange(Number(select.value)));
  return make("label", {}, `${label} `, select);
}

// A name from its column: "metric.miss" is miss.
export function shortName({ name }: QuantityEntry): string {
  return name.replace(/^(metric|draw)\./, "");
}

export function labelOf(quantity: QuantityEntry): string {
  return quantity.unit ? `${shortName(quantity)}, ${quantity.unit}` : shortName(quantity);
}

export type ShadeName = keyof typeof SHADES;

// For what is drawn on a canvas, which has no properties of CSS.
export function colour(name: ShadeName): string {
  return SHADES[name][matchMedia("(prefers-color-scheme: dark)").matches ? 1 : 0];
}
