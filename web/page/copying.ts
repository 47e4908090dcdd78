// Buttons that copy a command.

import { button } from "./elements";

export function copyButton(code: HTMLElement, label: string): HTMLButtonElement {
  const copy = button(label, async () => {
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
