// A search over the signals of a page: figures, rows and entries of other names are hidden, folded ones that fit are opened.

import { make } from "./elements";
import type { Page } from "./document";
import { reveal } from "./folding";

const WAIT = 150; // ms, after the last letter
const ENTRIES = "figure:has(svg[data-figure]), .signals tbody tr, .pairs li";
const BLOCKS = "section, .group, .panels, .part";

// Above the contents; `afterwards` draws what has become visible.
export function addSearch(page: Page, afterwards: () => Promise<void>): void {
  const contents = document.querySelector(".contents");
  if (!contents) return;
  const main = document.querySelector("main")!;
  const texts = new Map([...main.querySelectorAll(ENTRIES)].map((entry) => [entry, textOf(entry, page)]));
  const input = make("input", { type: "search", placeholder: "Find a signal", "aria-label": "Find a signal: figures and values" });
  const count = make("output", { "aria-live": "polite" });
  let opened: HTMLDetailsElement[] = [];

  const search = () => {
    const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const each of main.querySelectorAll("[data-filtered]")) each.removeAttribute("data-filtered");
    for (const each of opened) each.open = false;
    opened = [];
    count.textContent = "";
    if (words.length) {
      const closed = [...main.querySelectorAll<HTMLDetailsElement>("details:not([open])")];
      const fitting = [...texts].filter(([, text]) => words.every((word) => text.includes(word))).map(([entry]) => entry);
      hideOthers(main, new Set(fitting), texts.keys());
      fitting.forEach(reveal);
      opened = closed.filter((each) => each.open);
      const figures = fitting.filter((entry) => entry.matches("figure")).length;
      count.textContent = `${figures} ${figures === 1 ? "figure" : "figures"}, ${fitting.length - figures} values`;
    }
    void afterwards();
  };
  let waiting = 0;
  input.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = window.setTimeout(search, WAIT);
  });
  contents.prepend(make("div", { class: "search" }, input, count));
}

// What an entry is found by: its words, the name of its picture, those of its lines.
function textOf(entry: Element, page: Page): string {
  const picture = entry.querySelector<SVGElement>("svg[data-figure]");
  if (!picture) return entry.textContent!.toLowerCase();
  const charts = page.figures[Number(picture.dataset.figure)]!;
  const names = charts.flatMap((chart) => [chart.title, ...(chart.curves ?? []).map((curve) => curve.name)]);
  const caption = entry.querySelector("figcaption")?.textContent;
  return [caption, picture.getAttribute("aria-label"), ...names].join(" ").toLowerCase();
}

// Blocks without an entry that fits are hidden with all that they say; in the others each entry that does not.
function hideOthers(main: Element, fitting: ReadonlySet<Element>, entries: Iterable<Element>): void {
  const blocks = new Set([...fitting].flatMap((entry) => blocksAround(entry)));
  for (const block of main.querySelectorAll(BLOCKS)) if (!blocks.has(block)) block.setAttribute("data-filtered", "");
  for (const entry of entries) if (!fitting.has(entry)) entry.setAttribute("data-filtered", "");
}

function blocksAround(entry: Element): Element[] {
  const around: Element[] = [];
  for (let block = entry.closest(BLOCKS); block; block = block.parentElement!.closest(BLOCKS)) around.push(block);
  return around;
}
