// What is selected, in words, with how many trials fail and succeed; what ends the selection.

import { DIGITS, format } from "../page/numbers";
import type { Campaign, Counts } from "./document";
import { button, choice, element, shortName } from "./elements";
import type { Filter, Outcome } from "./filter";
import { lineColour } from "./histogram";

const OUTCOMES: Outcome[] = ["all", "success", "failure"];
const LABELS = ["all", "successes", "failures"];

export class Summary {
  readonly element = element("section", { class: "summary" });
  private readonly words = element("ul", { class: "ranges" });
  private readonly body = element("tbody");
  private readonly outcome: HTMLLabelElement;
  private readonly reset: HTMLButtonElement;

  constructor(
    private readonly campaign: Campaign,
    private readonly filter: Filter,
    private readonly onSelect: () => void,
  ) {
    this.outcome = choice("Outcome", LABELS, 0, (index) => {
      filter.outcome = OUTCOMES[index]!;
      onSelect();
    });
    this.reset = button("Select all trials", () => {
      filter.reset();
      this.outcome.querySelector("select")!.value = "0";
      onSelect();
    });
    const heads = ["variant", "selected", "successes", "failures", "success, %"].map((text, index) => element("th", index ? { class: "n" } : {}, text));
    const table = element("table", { class: "tight" }, element("thead", {}, element("tr", {}, ...heads)), this.body);
    this.element.append(
      element("div", { class: "scroll", "aria-live": "polite" }, table),
      this.words,
      element("div", { class: "controls" }, this.outcome, this.reset),
    );
  }

  show(counts: Counts): void {
    this.body.replaceChildren(...this.campaign.variants.map((_, index) => this.row(index, counts.outcomes[index]!)));
    const texts = this.filter.ranges.map((range, index) => {
      const { name, unit, factor } = this.campaign.quantities[range.column]!;
      const ends = counts.ranges[index]?.map((end) => format(end * factor, DIGITS));
      const clear = button("\u00d7", () => {
        this.filter.select(range.column, null);
        this.onSelect();
      });
      clear.setAttribute("aria-label", `End the range of ${shortName(name)}`);
      return element("li", {}, `${shortName(name)} from ${ends?.join(" to ")} ${unit}`.trim() + " ", clear);
    });
    if (!texts.length) texts.push(element("li", { class: "note" }, "Drag over a figure to select a range: all other figures then show its trials."));
    this.words.replaceChildren(...texts);
    this.reset.disabled = this.filter.isEmpty;
  }

  private row(index: number, [failures, successes]: [number, number]): HTMLTableRowElement {
    const variant = this.campaign.variants[index]!;
    const swatch = element("span", { class: "swatch" });
    swatch.style.background = lineColour(variant);
    const selected = failures + successes;
    const rate = selected ? format((100 * successes) / selected, 4) : "\u2013";
    const numbers = [String(selected), String(successes), String(failures), rate];
    return element("tr", {}, element("td", {}, this.toggle(index, swatch)), ...numbers.map((text) => element("td", { class: "n" }, text)));
  }

  private toggle(index: number, swatch: HTMLElement): HTMLElement {
    const { name } = this.campaign.variants[index]!;
    if (this.campaign.variants.length === 1) return element("span", {}, swatch, name);
    const box = element("input", { type: "checkbox" });
    box.checked = !this.filter.hides(index);
    box.addEventListener("change", () => {
      this.filter.toggle(index);
      this.onSelect();
    });
    return element("label", {}, box, swatch, name);
  }
}
