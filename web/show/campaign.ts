// One campaign: its figures, what is selected in them, and the requests that follow a selection.

import type { CampaignEntry, Counts, ShowDocument } from "../generated/documents";
import { make } from "../page/elements";
import { choice, labelOf } from "./elements";
import { Filter } from "./filter";
import { Grid } from "./grid";
import { Histogram } from "./histogram";
import { Requests } from "./requests";
import { Summary } from "./summary";
import { TrialCard, TrialTable } from "./table";

const REST = 250; // ms, after which the table follows a selection

export class CampaignView {
  readonly element = make("article");
  private readonly filter: Filter;
  private readonly requests: Requests;
  private readonly summary: Summary;
  private readonly table: TrialTable;
  private readonly card: TrialCard;
  private readonly panels = make("div", { class: "panels" });
  private readonly error = make("p", { class: "status bad", role: "alert", hidden: "" });
  private histograms: Histogram[] = [];
  private readonly grid: Grid | null;
  private waiting = 0;

  constructor(
    private readonly campaign: CampaignEntry,
    number: number,
    private readonly document: ShowDocument,
  ) {
    this.filter = new Filter(campaign.variants.length);
    this.requests = new Requests(number, (text) => this.complain(text));
    this.summary = new Summary(campaign, this.filter, () => void this.update());
    const open = async (row: number) => {
      const entry = await this.requests.trial(row);
      if (entry) this.card.show(entry);
    };
    this.table = new TrialTable(campaign.quantities, open);
    this.card = new TrialCard(campaign.quantities);
    this.histograms = campaign.quantities.slice(0, document.figures).map((_, column) => this.histogram(column));
    this.panels.append(...this.histograms.map((each) => each.element));
    const second = Math.min(1, campaign.quantities.length - 1);
    const update = () => void this.update();
    this.grid = campaign.quantities.length
      ? new Grid([0, second], campaign.quantities, campaign.variants, document, this.filter, update, open)
      : null;
    this.build();
  }

  // The first figure at once, then all.
  async start(): Promise<void> {
    const [first] = this.histograms;
    if (first) {
      const counts = await this.requests.counts(this.filter, [first.column], []);
      if (!counts) return;
      first.show(counts.histograms[0]!);
      this.summary.show(counts);
      window.document.documentElement.dataset.first = "";
    }
    await this.update();
  }

  stop(): void {
    clearTimeout(this.waiting);
    this.requests.stop();
  }

  private async update(): Promise<void> {
    const shown = this.histograms;
    clearTimeout(this.waiting);
    const counts = await this.requests.counts(
      this.filter,
      shown.map((each) => each.column),
      this.grid ? [this.grid.columns] : [],
    );
    if (!counts) return;
    this.error.hidden = true;
    delete this.element.dataset.stale;
    counts.histograms.forEach((each, index) => shown[index]!.show(each));
    if (counts.grids[0]) this.grid?.show(counts.grids[0]);
    this.summary.show(counts);
    this.followWithTable(counts);
  }

  private followWithTable(counts: Counts): void {
    this.waiting = window.setTimeout(async () => {
      const columns = this.histograms.map((each) => each.column);
      const entries = await this.requests.trials(this.filter, columns);
      const selected = counts.outcomes.reduce((sum, [failures, successes]) => sum + failures + successes, 0);
      if (entries) this.table.show(entries, columns, selected, this.requests.fileOf(this.filter));
      window.document.documentElement.dataset.ready = "show";
    }, REST);
  }

  private histogram(column: number): Histogram {
    const { quantities, variants } = this.campaign;
    const made: Histogram = new Histogram(
      column,
      quantities[column]!,
      variants,
      this.document,
      this.filter,
      () => void this.update(),
      () => {
        this.histograms = this.histograms.filter((each) => each !== made);
        made.element.remove();
        this.filter.select(column, null);
        void this.update();
      },
    );
    return made;
  }

  private add(column: number): void {
    if (this.histograms.some((each) => each.column === column)) return;
    const made = this.histogram(column);
    this.histograms.push(made);
    this.panels.append(made.element);
    void this.update();
  }

  private build(): void {
    const { system, folder, description, criterion, trials, flown, quantities } = this.campaign;
    const there = flown < trials ? `${flown} of ${trials} trials; the others are not simulated yet` : `${trials} trials`;
    const names = ["\u2026", ...quantities.map(labelOf)];
    const adding = choice("Add a histogram", names, 0, (index) => {
      if (index) this.add(index - 1);
      adding.querySelector("select")!.value = "0";
    });
    this.element.append(
      make("h1", {}, `${system}: ${folder}`),
      ...(description ? [make("p", { class: "lead" }, description)] : []),
      make("p", { class: "note" }, `${there} of each variant. Success: `, make("code", {}, criterion)),
      this.error,
      this.summary.element,
      make("h2", {}, "Distributions"),
      make("div", { class: "controls" }, adding),
      this.panels,
      ...(this.grid ? [make("h2", {}, "Two quantities"), this.grid.element, make("p", { class: "note" }, NOTE)] : []),
      this.table.element,
      this.card.element,
    );
  }

  private complain(text: string): void {
    this.error.textContent = text;
    this.error.hidden = false;
    this.element.dataset.stale = ""; // what is shown is of an earlier selection
  }
}

const NOTE =
  "Squares: blue for successes, red for failures, mixed by the fraction of failures; darker squares have more trials. Up to 20 000 trials are " +
  "drawn as marks: successes in the colour of their variant, failures as crosses; click a mark for its numbers and replay command. " +
  "The figure ignores the ranges of its own axes and shows them as a rectangle.";
