// The first of the selected trials with exact numbers, and one trial with all of them and its replay command.

import { DIGITS, format } from "../page/numbers";
import type { Quantity, TrialEntry } from "./document";
import { button, element, shortName } from "./elements";

export class TrialTable {
  readonly element = element("section", { class: "trials" });
  private readonly head = element("thead");
  private readonly body = element("tbody");
  private readonly note = element("p", { class: "note" });

  constructor(
    private readonly quantities: Quantity[],
    private readonly onTrial: (row: number) => void,
  ) {
    const table = element("table", { class: "tight" }, this.head, this.body);
    this.element.append(element("h2", {}, "Selected trials"), element("div", { class: "scroll", tabindex: "0" }, table), this.note);
  }

  show(entries: TrialEntry[], columns: number[], selected: number): void {
    const shown = columns.map((each) => this.quantities[each]!);
    const heads = ["trial", "variant", "outcome", ...shown.map(({ name, unit }) => (unit ? `${shortName(name)}, ${unit}` : shortName(name)))];
    this.head.replaceChildren(element("tr", {}, ...heads.map((text, index) => element("th", index > 2 ? { class: "n" } : {}, text))));
    this.body.replaceChildren(
      ...entries.map((entry) => {
        const open = button(String(entry.trial), () => this.onTrial(entry.row));
        open.setAttribute("aria-label", `Trial ${entry.trial} of ${entry.variant}: all numbers, replay command`);
        const texts = [entry.variant, outcomeOf(entry)].map((text) => element("td", {}, text));
        const numbers = entry.numbers.map((number, index) => element("td", { class: "n" }, numberText(number, shown[index]!)));
        return element("tr", {}, element("td", {}, open), ...texts, ...numbers);
      }),
    );
    this.note.textContent = entries.length < selected ? `The first ${entries.length} of ${selected}.` : selected ? "" : "No trial is selected.";
  }
}

export class TrialCard {
  readonly element = element("aside", { class: "card pinned", "aria-label": "Trial", "aria-live": "polite" });

  constructor(private readonly quantities: Quantity[]) {
    this.element.hidden = true;
  }

  show(entry: TrialEntry): void {
    const list = element("dl");
    const rows = [
      ["trial", `${entry.trial} of ${entry.variant}`],
      ["outcome", outcomeOf(entry)],
      ...this.quantities.map((quantity, index) => [shortName(quantity.name), `${numberText(entry.numbers[index]!, quantity)} ${quantity.unit}`.trim()]),
    ];
    for (const [label = "", text = ""] of rows) list.append(element("dt", {}, label), element("dd", {}, text));
    const command = element("code", {}, entry.command);
    const copy = button("Copy command", async () => {
      await navigator.clipboard.writeText(entry.command).then(
        () => (copy.textContent = "Copied"),
        () => (copy.textContent = "Select the text and copy it"),
      );
    });
    const close = button("Close", () => {
      this.element.hidden = true;
    });
    this.element.replaceChildren(command, copy, close, list);
    this.element.hidden = false;
    copy.focus();
  }
}

function outcomeOf({ success, status }: TrialEntry): string {
  return `${success ? "success" : "failure"}, ${status}`;
}

function numberText(number: number | string | null, { factor }: Quantity): string {
  if (number === null) return "\u2013";
  if (typeof number === "string") return number === "inf" ? "\u221e" : "\u2212\u221e";
  return format(number * factor, DIGITS);
}
