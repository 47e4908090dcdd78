// What is selected, in words, with how many trials fail and succeed; what ends the selection.

import { DIGITS, format } from "../page/numbers";
import type { CampaignEntry, Counts, RangeEnds, VariantEntry } from "../generated/documents";
import { button, make } from "../page/elements";
import { choice, shortName } from "./elements";
import type { Filter, Outcome } from "./filter";
import { lineColour } from "./histogram";

const OUTCOMES: Outcome[] = ["all", "success", "failure"];
const LABELS = ["all", "successes", "failures"];

interface Row {
  element: HTMLTableRowElement;
  box: HTMLInputElement | null; // by which its variant is hidden
  numbers: HTMLTableCellElement[];
}

export class Summary {
  readonly element = make("section", { class: "summary" });
  private readonly words = make("ul", { class: "ranges" });
  private readonly rows: Row[];
  private readonly outcome: HTMLLabelElement;
  private readonly reset: HTMLButtonElement;

  constructor(
    private readonly campaign: CampaignEntry,
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
    this.rows = campaign.variants.map((variant, index) => this.row(variant, index));
    const heads = ["variant", "selected", "successes", "failures", "success, %"].map((text, index) => make("th", index ? { class: "n" } : {}, text));
    const table = make("table", { class: "tight" }, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...this.rows.map((row) => row.element)));
    this.element.append(
      make("div", { class: "scroll", "aria-live": "polite" }, table),
      this.words,
      make("div", { class: "controls" }, this.outcome, this.reset),
    );
  }

  show(counts: Counts): void {
    counts.outcomes.forEach(([failures, successes], index) => {
      const selected = failures + successes;
      const rate = selected ? format((100 * successes) / selected, 4) : "\u2013";
      const texts = [String(selected), String(successes), String(failures), rate];
      const row = this.rows[index]!;
      texts.forEach((text, position) => (row.numbers[position]!.textContent = text));
      if (row.box) row.box.checked = !this.filter.hides(index);
    });
    const items = this.filter.ranges.map((range, index) => this.item(range.column, counts.ranges[index]));
    if (!items.length) items.push(make("li", { class: "note" }, "Drag over a figure to select a range: all other figures then show its trials."));
    this.words.replaceChildren(...items);
    this.reset.disabled = this.filter.isEmpty;
  }

  private item(column: number, ends: RangeEnds | null | undefined): HTMLLIElement {
    const quantity = this.campaign.quantities[column]!;
    const clear = button("\u00d7", () => {
      this.filter.select(column, null);
      this.onSelect();
    }, `Remove the range of ${shortName(quantity)}`);
    const item = make("li", {}, `${shortName(quantity)} `);
    if (ends) {
      const digits = Math.max(DIGITS, 2 + Math.ceil(Math.log10(Math.max(Math.abs(ends.low), Math.abs(ends.high)) / ends.step)));
      // As everywhere in pages the element has the exact value in SI.
      const end = (value: number) => make("data", { value: String(value) }, format(value * quantity.factor, Math.min(digits, 17)));
      item.append("from ", end(ends.low), " to below ", end(ends.high), ` ${quantity.unit} `);
    }
    item.append(clear);
    return item;
  }

  private row({ name }: VariantEntry, index: number): Row {
    const swatch = make("span", { class: "swatch" });
    swatch.style.background = lineColour(this.campaign.variants[index]!);
    const box = this.campaign.variants.length > 1 ? make("input", { type: "checkbox" }) : null;
    box?.addEventListener("change", () => {
      this.filter.toggle(index);
      this.onSelect();
    });
    const label = box ? make("label", {}, box, swatch, name) : make("span", {}, swatch, name);
    const numbers = Array.from({ length: 4 }, () => make("td", { class: "n" }));
    return { element: make("tr", {}, make("td", {}, label), ...numbers), box, numbers };
  }
}
