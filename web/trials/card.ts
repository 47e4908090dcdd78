// What is known of a trial: beside the pointer, or pinned by a click.

import { PinnedCard, definitions, moveBeside } from "../page/card";
import { make } from "../page/elements";
import type { Trial } from "./selection";

export class Card {
  private readonly hovering = make("aside", { class: "card", hidden: "" });
  private readonly pinned = new PinnedCard();

  constructor() {
    document.body.append(this.hovering, this.pinned.element);
  }

  hover(trial: Trial | null, at: { clientX: number; clientY: number }): void {
    this.hovering.hidden = trial === null;
    if (!trial) return;
    this.hovering.replaceChildren(definitions(trial.variant.entries(trial.row)));
    moveBeside(this.hovering, at);
  }

  pin({ variant, row }: Trial): void {
    this.pinned.show(variant.entries(row), variant.command(row));
    this.hovering.hidden = true;
  }
}
