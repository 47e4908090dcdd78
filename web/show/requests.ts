// Requests to the server that the page is from; a newer one of its kind ends an older one.

import type { Counts, TrialEntry } from "../generated/documents";
import type { Query } from "../generated/query";
import type { Filter } from "./filter";

export class Requests {
  private readonly running = new Map<string, AbortController>();

  constructor(
    private readonly campaign: number,
    private readonly onError: (text: string) => void,
  ) {}

  counts(filter: Filter, histograms: number[], grids: [number, number][]): Promise<Counts | null> {
    return this.get("counts", "counts", { ...filter.query(), histograms, grids });
  }

  trials(filter: Filter, histograms: number[]): Promise<TrialEntry[] | null> {
    return this.get("trials", "trials", { ...filter.query(), histograms });
  }

  trial(row: number): Promise<TrialEntry | null> {
    return this.get("trial", `trials/${row}`, null);
  }

  // The address of a file with all trials that a filter selects.
  fileOf(filter: Filter): string {
    return this.address("selected.csv", filter.query());
  }

  stop(): void {
    for (const each of this.running.values()) each.abort();
  }

  private address(path: string, query: Partial<Query> | null): string {
    const search = query === null ? "" : `?query=${encodeURIComponent(JSON.stringify(query))}`;
    return `/campaigns/${this.campaign}/${path}${search}`;
  }

  // Null where a newer request of the kind has begun, or the server has refused.
  private async get<T>(kind: string, path: string, query: Query | null): Promise<T | null> {
    this.running.get(kind)?.abort();
    const controller = new AbortController();
    this.running.set(kind, controller);
    try {
      const response = await fetch(this.address(path, query), { signal: controller.signal });
      if (response.ok) return (await response.json()) as T;
      this.onError((await response.text()) || `The server answered ${response.status}.`);
    } catch (error) {
      if (controller.signal.aborted) return null;
      const isLost = error instanceof TypeError; // of fetch, when there is no answer
      this.onError(isLost ? "No answer: perilune show has ended, or the connection is lost." : `The answer of the server cannot be read: ${error}`);
    }
    return null;
  }
}
