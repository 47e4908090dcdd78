// Cards over a page: beside the pointer, or pinned with the command that simulates a trial again.

import { copyButton } from "./copying";
import { button, make } from "./elements";

export interface Entry {
  label: string;
  text: string;
}

export function definitions(entries: Entry[]): HTMLDListElement {
  return make("dl", {}, ...entries.flatMap(({ label, text }) => [make("dt", {}, label), make("dd", {}, text)]));
}

// Moves a card beside a point of the screen, within it.
export function moveBeside(card: HTMLElement, { clientX, clientY }: { clientX: number; clientY: number }): void {
  const { offsetWidth: width, offsetHeight: height } = card;
  const left = clientX + 16 + width > innerWidth ? clientX - 16 - width : clientX + 16;
  const top = Math.min(clientY + 16, innerHeight - height - 8);
  Object.assign(card.style, { left: `${Math.max(left, 4)}px`, top: `${Math.max(top, 4)}px` });
}

export class PinnedCard {
  readonly element = make("aside", { class: "card pinned", "aria-label": "Pinned trial", "aria-live": "polite", hidden: "" });

  show(entries: Entry[], command: string): void {
    const code = make("code", {}, command);
    const close = button("Close", () => {
      this.element.hidden = true;
    });
    this.element.replaceChildren(make("div", {}, definitions(entries), code, copyButton(code, "Copy command"), close));
    this.element.hidden = false;
  }
}
