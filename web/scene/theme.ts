// Colours of a scene in light and dark, as the page is.

import { Color } from "three";

export interface Theme {
  sky: string;
  ground: string;
  haze: string;
  grid: string;
  flame: string;
  failed: string; // paths of failures
  lighter: number; // of lines' colours, from 0 to 1
}

const LIGHT: Theme = {
  sky: "#eef2f6",
  ground: "#d8d4cc",
  haze: "#e6e5e2",
  grid: "#8f8a80",
  flame: "#e8590c",
  failed: "#222222",
  lighter: 0,
};
const DARK: Theme = {
  sky: "#0d1117",
  ground: "#3a3936",
  haze: "#23252a",
  grid: "#7d7a74",
  flame: "#ffa94d",
  failed: "#f1f3f5",
  lighter: 0.25,
};

// The theme of an element: dark where its text is light.
export function themeOf(element: HTMLElement): Theme {
  const [red = 0] = getComputedStyle(element).color.match(/\d+/g)?.map(Number) ?? [];
  return red > 128 ? DARK : LIGHT;
}

export function followTheme(change: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", change);
}

export function lineColour(colour: string, { lighter }: Theme): Color {
  return new Color(colour).lerp(new Color("#ffffff"), lighter);
}

// The same for what is not drawn by WebGL.
export function strokeOf(colour: string): string {
  return `stroke: color-mix(in srgb, ${colour} 60%, light-dark(${colour}, #fff))`;
}
