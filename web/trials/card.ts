// What is known of a trial: beside the cursor, or pinned by a click with the command that simulates it again.

import type { Trial } from "./selection";

export class Card {
  private readonly hovering = document.createElement("aside");
  private readonly pinned = document.createElement("aside");

  constructor() {
    this.hovering.className = "card";
    this.pinned.className = "card pinned";
    this.hovering.hidden = this.pinned.hidden = true;
    this.pinned.setAttribute("aria-live", "polite");
    this.pinned.setAttribute("aria-label", "Pinned trial");
    document.body.append(this.hovering, this.pinned);
  }

  hover(trial: Trial | null, at: { clientX: number; clientY: number }): void {
    this.hovering.hidden = trial === null;
    if (!trial) return;
    this.hovering.replaceChildren(table(trial));
    const { offsetWidth: width, offsetHeight: height } = this.hovering;
    const left = at.clientX + 16 + width > innerWidth ? at.clientX - 16 - width : at.clientX + 16;
    const top = Math.min(at.clientY + 16, innerHeight - height - 8);
    Object.assign(this.hovering.style, { left: `${Math.max(left, 4)}px`, top: `${Math.max(top, 4)}px` });
  }

  pin(trial: Trial): void {
    const command = document.createElement("code");
    command.textContent = trial.variant.command(trial.row);
    const copy = button("Copy command", async () => {
      copy.textContent = (await copyText(command)) ? "Copied" : "Select the text and copy it";
    });
    const close = button("Close", () => {
      this.pinned.hidden = true;
    });
    this.pinned.replaceChildren(table(trial), command, copy, close);
    this.pinned.hidden = false;
    this.hovering.hidden = true;
  }
}

function table(trial: Trial): HTMLElement {
  const list = document.createElement("dl");
  for (const { label, text } of trial.variant.entries(trial.row)) {
    const [term, definition] = [document.createElement("dt"), document.createElement("dd")];
    term.textContent = label;
    definition.textContent = text;
    list.append(term, definition);
  }
  return list;
}

function button(text: string, onClick: () => void): HTMLButtonElement {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  element.addEventListener("click", onClick);
  return element;
}

// A page from file:// may have no clipboard of its own; a selection can be copied all the same.
async function copyText(element: HTMLElement): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(element.textContent ?? "");
    return true;
  } catch {
    getSelection()?.selectAllChildren(element);
    return document.execCommand("copy");
  }
}
