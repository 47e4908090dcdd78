// What a brush has chosen, in the bar of the page: how many trials, how many of them failed, the command for them.

import { copyButton } from "../page/copying";
import { make } from "../page/elements";
import type { Selection } from "./selection";
import type { Trials } from "./trials";

const LONGEST = 300; // letters of a command that are shown: to lay out ten thousand numbers takes longer than a figure

export function showChosen(selection: Selection, trials: Trials, bar: HTMLElement): void {
  const note = make("div", { class: "chosen", "aria-live": "polite", hidden: "" });
  bar.prepend(note);
  selection.follow(() => {
    note.hidden = selection.isWhole;
    const variants = selection.variants;
    const count = variants.reduce((sum, [, rows]) => sum + rows.length, 0);
    const failures = variants.reduce((sum, [variant, rows]) => sum + rows.filter((row) => variant.success[row] !== 1).length, 0);
    note.replaceChildren(`${count} of ${trials.size} trials, ${failures} ${failures === 1 ? "failure" : "failures"}`);
    for (const [variant, rows] of variants) {
      const command = variant.commandOf(rows);
      const code = make("code", {}, command.length > LONGEST ? `${command.slice(0, LONGEST)}\u2026` : command);
      note.append(make("div", {}, code, copyButton(code, "Copy command", command)));
    }
  });
}
