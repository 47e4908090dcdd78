// Pieces of the page that its figures share: choices, names of quantities, colours.

import { make } from "../page/elements";
import type { Quantity } from "../generated/documents";

export function choice(label: string, options: string[], chosen: number, onChange: (index: number) => void): HTMLLabelElement {
  const select = make("select");
  options.forEach((text, index) => select.append(make("option", { value: index }, text)));
  select.value = String(chosen);
  select.addEventListener("change", () => onChange(Number(select.value)));
  return make("label", {}, `${label} `, select);
}

// A name from its column: "metric.miss" is miss.
export function shortName({ name }: Quantity): string {
  return name.replace(/^(metric|draw)\./, "");
}

export function labelOf(quantity: Quantity): string {
  return quantity.unit ? `${shortName(quantity)}, ${quantity.unit}` : shortName(quantity);
}

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
