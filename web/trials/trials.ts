// The trials of a batch.

import type { TrialQuantity, VariantTrials } from "../generated/embedded_trials";
import type { Entry } from "../page/card";
import type { Page, Values } from "../page/document";
import { uncertainty } from "../page/columns";
import { DIGITS, format } from "../page/numbers";

export class Trials {
  private constructor(
    readonly quantities: TrialQuantity[],
    private readonly variants: Map<string, Variant>,
  ) {}

  static async load(page: Page): Promise<Trials | null> {
    const document = page.document.trials;
    if (!document) return null;
    const variants = await Promise.all(document.variants.map((each) => Variant.load(each, document.quantities, page)));
    return new Trials(document.quantities, new Map(variants.map((each) => [each.name, each])));
  }

  // How many trials of all variants the page has.
  get size(): number {
    return [...this.variants.values()].reduce((sum, each) => sum + each.numbers.length, 0);
  }

  variant(name: string): Variant | undefined {
    return this.variants.get(name);
  }
}

export class Variant {
  private constructor(
    private readonly encoded: VariantTrials,
    private readonly quantities: TrialQuantity[],
    readonly numbers: Values,
    readonly success: Values,
    private readonly status: Values,
    private readonly columns: Map<string, Values>,
    private readonly page: Page,
  ) {}

  static async load(encoded: VariantTrials, quantities: TrialQuantity[], page: Page): Promise<Variant> {
    const [numbers, success, status, ...columns] = await Promise.all(
      [encoded.trial, encoded.success, encoded.status, ...encoded.columns].map((each) => page.column(each)),
    );
    const named = new Map(quantities.map(({ name }, index) => [name, columns[index]!]));
    return new Variant(encoded, quantities, numbers!, success!, status!, named, page);
  }

  get name(): string {
    return this.encoded.name;
  }

  // A quantity of all trials by name, as displayed.
  displayed(name: string): Float64Array {
    if (name === "trial") return Float64Array.from(this.numbers);
    const factor = this.quantities.find((each) => each.name === name)?.factor ?? 1;
    return Float64Array.from(this.columns.get(name)!, (number) => factor * number);
  }

  command(row: number): string {
    const [before, after] = this.encoded.command;
    return `${before}${this.numbers[row]}${after}`;
  }

  // A shell command that simulates several trials again.
  commandOf(rows: number[]): string {
    if (rows.length === 1) return this.command(rows[0]!);
    const [before, after] = this.encoded.command;
    return `for trial in ${rows.map((row) => this.numbers[row]).join(" ")}; do ${before}$trial${after}; done`;
  }

  // What is known of a trial; "about" where a number is rounded to the digits that its column has.
  entries(row: number): Entry[] {
    const outcome = this.success[row] ? "success" : "failure";
    return [
      { label: "trial", text: `${this.numbers[row]} of ${this.name}` },
      { label: "outcome", text: `${outcome}, ${this.encoded.statuses[this.status[row]!] ?? ""}` },
      ...this.quantities.map((quantity, index) => ({
        label: quantity.name.replace(/^(metric|draw)\./, ""),
        text: `${this.text(quantity, index, row)} ${quantity.unit}`.trim(),
      })),
    ];
  }

  private text({ name, factor }: TrialQuantity, index: number, row: number): string {
    const exact = this.encoded.exact[row]?.[index];
    if (exact !== undefined) return typeof exact === "number" ? format(exact * factor, DIGITS) : exact;
    const number = this.columns.get(name)![row]!;
    if (Number.isNaN(number)) return "\u2013";
    const within = uncertainty(this.page.encoded[this.encoded.columns[index]!]!, number);
    if (within === 0) return format(number * factor, DIGITS);
    const digits = Math.floor(Math.log10(Math.abs(number) / within));
    return digits < 1 ? `0 within ${format(within * factor, 1)}` : `about ${format(number * factor, Math.min(digits, DIGITS))}`;
  }
}
