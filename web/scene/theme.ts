// Colours of a scene in light and dark, as the page is.

import { Color } from "three";

import { SHADES } from "../generated/colours";

export interface Theme {
  sky: string;
  ground: string;
  haze: string;
  grid: string;
  flame: string;
  failed: string; // paths of failures
  lighter: number; // of lines' colours, from 0 to 1
}

function themeAt(shade: 0 | 1): Theme {
  return {
    sky: SHADES.scene_sky[shade],
    ground: SHADES.scene_ground[shade],
    haze: SHADES.scene_haze[shade],
    grid: SHADES.scene_grid[shade],
    flame: SHADES.flame[shade],
    failed: SHADES.failed[shade],
    lighter: 0.25 * shade,
  };
}

const [LIGHT, DARK] = [themeAt(0), themeAt(1)];

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
