// Elements of the page; every text is set as text.

type Child = Node | string;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, text] of Object.entries(attributes)) made.setAttribute(name, text);
  made.append(...children);
  return made;
}

export function button(text: string, onClick: () => void): HTMLButtonElement {
  const made = element("button", { type: "button" }, text);
  made.addEventListener("click", onClick);
  return made;
}

export function choice(label: string, options: string[], chosen: number, onChange: (index: number) => void): HTMLLabelElement {
  const select = element("select");
  options.forEach((text, index) => select.append(element("option", { value: String(index) }, text)));
  select.value = String(chosen);
  select.addEventListener("change", () => onChange(Number(select.value)));
  return element("label", {}, `${label} `, select);
}

// A name from its column: "metric.miss" is miss.
export function shortName(name: string): string {
  return name.replace(/^(metric|draw)\./, "");
}

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
