// What trials have recorded over time.

import type { Axis, Chart } from "../generated/charts";
import type { FlightColumns, FlightsPanel } from "../generated/embedded_flights";
import type { Page } from "../page/document";
import type { TrialName } from "../page/trial";

const MARGIN = 0.06; // of an ordinate, above and below its values

const PLAIN: Pick<Axis, "size" | "grid" | "marked"> = { size: 8.8, grid: true, marked: true };

export interface Titled {
  title: string;
  chart: Chart;
}

export class Flights {
  private constructor(
    private readonly page: Page,
    private readonly panels: FlightsPanel[],
    private readonly flights: FlightColumns[],
  ) {}

  // Null where the page has none.
  static of(page: Page): Flights | null {
    const document = page.document.recorded;
    return document ? new Flights(page, document.panels, document.flights) : null;
  }

  // A chart over time for each panel; null for a trial that has recorded nothing in this page.
  async charts({ variant, trial }: TrialName): Promise<Titled[] | null> {
    const flight = this.flights.find((each) => each.variant === variant && each.trial === trial);
    if (!flight) return null;
    const time = await this.page.column(flight.time);
    const ends: [number, number] = [time[0]!, time[time.length - 1]!];
    let line = 0;
    return Promise.all(
      this.panels.map((panel) => {
        const columns = flight.columns.slice(line, (line += panel.lines.length));
        return this.chart(panel, flight.time, columns, ends);
      }),
    );
  }

  private async chart({ title, unit, factor, steps, lines }: FlightsPanel, time: number, columns: number[], ends: [number, number]): Promise<Titled> {
    const numbers = await Promise.all(columns.map((each) => this.page.column(each)));
    const finite = numbers.flatMap((each) => [...each]).filter(Number.isFinite);
    const [low, high] = [Math.min(...finite), Math.max(...finite)].map((each) => each * factor) as [number, number];
    const margin = MARGIN * (high - low) || MARGIN * Math.abs(high) || 1;
    const chart: Chart = {
      x: { ...PLAIN, label: "time, s", ends },
      y: { ...PLAIN, ends: finite.length ? [low - margin, high + margin] : [0, 1] },
      curves: lines.map(({ name, colour }, index) => ({
        x: time, y: columns[index]!, factor, name, unit, colour, opacity: 1, width: 1.2, steps, joined: true,
      })),
    };
    return { title: unit ? `${title}, ${unit}` : title, chart };
  }
}
