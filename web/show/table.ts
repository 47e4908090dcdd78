// The first of the selected trials, and one trial with all of its numbers and its replay command.

import { PinnedCard } from "../page/card";
import { button, make } from "../page/elements";
import { DIGITS, format } from "../page/numbers";
import type { QuantityEntry, TrialEntry } from "../generated/documents";
import { labelOf, shortName } from "./elements";

export class TrialTable {
  readonly element = make("section", { class: "trials" });
  private readonly head = make("thead");
  private readonly body = make("tbody");
  private readonly note = make("p", { class: "note" });

  constructor(
    private readonly quantities: QuantityEntry[],
    private readonly onTrial: (row: number) => void,
  ) {
    const table = make("table", { class: "tight" }, this.head, this.body);
    this.element.append(make("h2", {}, "Selected trials"), make("div", { class: "scroll", tabindex: "0" }, table), this.note);
  }

  // ``file`` is the address of a file with all of them.
  show(entries: TrialEntry[], columns: number[], selected: number, file: string): void {
    const shown = columns.map((each) => this.quantities[each]!);
    const heads = ["trial", "variant", "outcome", ...shown.map(labelOf)];
    this.head.replaceChildren(make("tr", {}, ...heads.map((text, index) => make("th", index > 2 ? { class: "n" } : {}, text))));
    this.body.replaceChildren(
      ...entries.map((entry) => {
        const open = button(String(entry.trial), () => this.onTrial(entry.row));
        open.setAttribute("aria-label", `Trial ${entry.trial} of ${entry.variant}: all numbers, replay command`);
        const texts = [entry.variant, outcomeOf(entry)].map((text) => make("td", {}, text));
        const numbers = entry.numbers.map((number, index) => make("td", { class: "n" }, numberText(number, shown[index]!)));
        return make("tr", {}, make("td", {}, open), ...texts, ...numbers);
      }),
    );
    this.note.textContent = entries.length < selected ? `The first ${entries.length} of ${selected}. ` : selected ? "" : "No trial is selected.";
    const link = `${selected === 1 ? "The selected trial" : `All ${selected} selected trials`} as CSV`;
    if (selected) this.note.append(make("a", { href: file, download: "" }, link), ", every quantity in SI.");
  }
}

// All numbers of one trial.
export class TrialCard {
  private readonly card = new PinnedCard();
  readonly element = this.card.element;

  constructor(private readonly quantities: QuantityEntry[]) {}

  show(entry: TrialEntry): void {
    const numbers = this.quantities.map((quantity, index) => ({
      label: shortName(quantity),
      text: `${numberText(entry.numbers[index]!, quantity)} ${quantity.unit}`.trim(),
    }));
    this.card.show(
      [{ label: "trial", text: `${entry.trial} of ${entry.variant}` }, { label: "outcome", text: outcomeOf(entry) }, ...numbers],
      entry.command,
    );
    this.element.querySelector("button")!.focus();
  }
}

function outcomeOf({ success, status }: TrialEntry): string {
  return `${success ? "success" : "failure"}, ${status}`;
}

function numberText(number: number | string | null, { factor }: QuantityEntry): string {
  if (number === null) return "\u2013";
  if (typeof number === "string") return number === "inf" ? "\u221e" : "\u2212\u221e";
  return format(number * factor, DIGITS);
}
