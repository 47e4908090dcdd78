// Colours of a scene in light and dark.

export interface Theme {
  sky: string;
  ground: string;
  haze: string;
  grid: string;
  ink: string;
  flame: string;
}

const LIGHT: Theme = {
  sky: "#eef2f6",
  ground: "#d8d4cc",
  haze: "#e6e5e2",
  grid: "#8f8a80",
  ink: "#222222",
  flame: "#e8590c",
};
const DARK: Theme = {
  sky: "#0d1117",
  ground: "#3a3936",
  haze: "#23252a",
  grid: "#7d7a74",
  ink: "#e6e6e6",
  flame: "#ffa94d",
};

const dark = matchMedia("(prefers-color-scheme: dark)");

export function theme(): Theme {
  return dark.matches ? DARK : LIGHT;
}

export function followTheme(change: () => void): void {
  dark.addEventListener("change", change);
}
