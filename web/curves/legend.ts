// Entries of legends as buttons that hide and show a line in the figures below them.

import type { Figure } from "./figure";

export function listenToLegends(figureOf: (picture: Element) => Promise<Figure | null> | undefined): void {
  for (const legend of document.querySelectorAll(".legend")) {
    const below = picturesBelow(legend);
    if (!below.length) continue;
    const entries = [...legend.querySelectorAll<HTMLElement>(".who")];
    const hides = (name: string, line: number, names: ReadonlySet<string>) =>
      entries.some((entry, index) => entry.getAttribute("aria-pressed") === "false" && isFor(entry, index, name, line, names));
    entries.forEach((entry) => {
      entry.setAttribute("role", "button");
      entry.setAttribute("aria-pressed", "true");
      entry.tabIndex = 0;
      const toggle = async () => {
        const shown = entry.getAttribute("aria-pressed") !== "true";
        entry.setAttribute("aria-pressed", String(shown));
        for (const picture of below) (await figureOf(picture))?.hide(hides);
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

// An entry is for lines that begin with a run, or end with an index or an axis of its data-lines; without these for lines
// that have its text as their name, or in a figure without such lines for that of its number.
function isFor(entry: HTMLElement, index: number, name: string, line: number, names: ReadonlySet<string>): boolean {
  const keys = entry.dataset.lines?.split(" ");
  if (keys) return keys.some((key) => (key.startsWith("[") ? name.endsWith(key) : name === key || name.startsWith(`${key} `) || name.endsWith(` ${key}`)));
  const text = entry.textContent!.trim();
  return names.has(text) ? name === text : index === line;
}

function picturesBelow(legend: Element): Element[] {
  const below: Element[] = [];
  for (let next = legend.nextElementSibling; next && !/^H[1-6]$/.test(next.tagName) && !next.matches(".legend"); next = next.nextElementSibling) {
    below.push(...next.querySelectorAll("[data-figure]"));
  }
  return below;
}
