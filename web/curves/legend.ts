// Entries of legends as buttons that hide and show a line in the figures below them.

import type { Figure } from "./figure";

export function listenToLegends(figureOf: (picture: Element) => Promise<Figure | null> | undefined): void {
  for (const legend of document.querySelectorAll(".legend")) {
    const below = picturesBelow(legend);
    if (!below.length) continue;
    legend.querySelectorAll<HTMLElement>(".who").forEach((entry, index) => {
      entry.setAttribute("role", "button");
      entry.setAttribute("aria-pressed", "true");
      entry.tabIndex = 0;
      const toggle = async () => {
        const shown = entry.getAttribute("aria-pressed") !== "true";
        entry.setAttribute("aria-pressed", String(shown));
        for (const picture of below) (await figureOf(picture))?.show(index, shown);
      };
      entry.addEventListener("click", () => void toggle());
      entry.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        void toggle();
      });
    });
  }
}

function picturesBelow(legend: Element): Element[] {
  const below: Element[] = [];
  for (let next = legend.nextElementSibling; next && !/^H[1-6]$/.test(next.tagName) && !next.matches(".legend"); next = next.nextElementSibling) {
    below.push(...next.querySelectorAll("[data-figure]"));
  }
  return below;
}
