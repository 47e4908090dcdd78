// What is known of a trial: at the pointer, or pinned by a click with what it recorded.

import { PinnedCard, definitions, moveBeside } from "../page/card";
import type { Page } from "../page/document";
import { button, make } from "../page/elements";
import { type TrialName, announceTrial, followTrial } from "../page/trial";
import { FlightPlots } from "./flight_plots";
import { Flights } from "./flights";
import type { Trial } from "./selection";
import type { Trials } from "./trials";

const NAME = "card"; // in events
const FLIGHTS = "flights"; // the section of the page with the scene

export class Card {
  private readonly hovering = make("aside", { class: "card", hidden: "" });
  private readonly pinned = new PinnedCard();
  private readonly flights: Flights | null;
  private readonly plots: FlightPlots;
  private latest: TrialName | null = null;

  constructor(page: Page, trials: Trials | null) {
    this.flights = Flights.of(page);
    this.plots = new FlightPlots(page);
    document.body.append(this.hovering, this.pinned.element);
    followTrial(NAME, (name) => {
      const variant = trials?.variant(name.variant);
      const row = variant?.numbers.indexOf(name.trial) ?? -1;
      if (variant && row >= 0) void this.show({ variant, row }, name, true);
    });
  }

  hover(trial: Trial | null, at: { clientX: number; clientY: number }): void {
    this.hovering.hidden = trial === null;
    if (!trial) return;
    this.hovering.replaceChildren(definitions(trial.variant.entries(trial.row)));
    moveBeside(this.hovering, at);
  }

  pin(trial: Trial): void {
    const name = { variant: trial.variant.name, trial: trial.variant.numbers[trial.row]! };
    void this.show(trial, name, false);
    announceTrial(name, NAME);
  }

  // `aside`: narrow, without the trial's numbers, so that the scene is visible.
  private async show({ variant, row }: Trial, name: TrialName, aside: boolean): Promise<void> {
    const { element } = this.pinned;
    this.pinned.show(variant.entries(row), variant.command(row));
    this.hovering.hidden = true;
    this.plots.hide();
    element.classList.remove("flown", "aside");
    this.latest = name;
    const charts = await this.flights?.charts(name);
    if (!charts || this.latest !== name) return;
    element.classList.toggle("aside", aside);
    if (document.querySelector(`#${FLIGHTS} .scene`)) {
      const toScene = make("a", { href: `#${FLIGHTS}`, class: "to-scene" }, "Show in the scene");
      toScene.addEventListener("click", () => element.classList.add("aside"));
      const toNumbers = button("Numbers", () => element.classList.remove("aside"));
      toNumbers.className = "to-numbers";
      element.firstElementChild!.append(toNumbers, toScene);
    }
    element.classList.add("flown");
    element.append(this.plots.element);
    await this.plots.show(charts);
  }
}
