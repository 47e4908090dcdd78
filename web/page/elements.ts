// Elements of HTML and SVG, made without markup: names of users are text.

const SVG = "http://www.w3.org/2000/svg";

type Attributes = Record<string, string | number>;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export function makeSvg(tag: string, attributes: Attributes = {}, ...children: Node[]): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

// A name of a user, whose direction of writing does not reach beyond it.
export function nameOf(text: string): HTMLElement {
  return make("bdi", {}, text);
}

export function button(label: string, press: () => void, title = ""): HTMLButtonElement {
  const element = make("button", { type: "button", ...(title ? { "aria-label": title, title } : {}) }, label);
  element.addEventListener("click", press);
  return element;
}
