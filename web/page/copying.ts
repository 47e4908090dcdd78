// Buttons that copy a command.

import { button } from "./elements";

// ``whole``: what an element has once it is selected or copied, where its text was cut.
export function copyButton(code: HTMLElement, label: string, whole?: string): HTMLButtonElement {
  const complete = () => {
    if (whole) code.textContent = whole;
  };
  code.addEventListener("pointerdown", complete, { once: true });
  const copy = button(label, async () => {
    complete();
    copy.textContent = (await copyText(code)) ? "Copied" : "Select the text and copy it";
  });
  copy.className = "copy";
  return copy;
}

// One behind each command of the page's tables.
export function addCopyButtons(): void {
  for (const code of document.querySelectorAll<HTMLElement>("code.command")) code.after(" ", copyButton(code, "Copy"));
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
