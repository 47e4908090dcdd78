// Parts of a page that are folded away, <details>: what a link or a figure leads to is opened.

export function reveal(element: Element): void {
  for (let folded = element.closest("details"); folded; folded = folded.parentElement!.closest("details")) folded.open = true;
}

// Browsers of before 2025 do not open what the target of a link is in.
export function followLinks(): void {
  const open = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target?.closest("details:not([open])")) return;
    reveal(target);
    target.scrollIntoView();
  };
  window.addEventListener("hashchange", open);
  open();
}
