// Written by build_web.py from analysis/documents/common/colours.py.

export const SHADES = {
  ink: ["#222", "#e6e6e6"],
  paper: ["#fff", "#141414"],
  note: ["#555", "#b0b0b0"],
  link: ["#0059a0", "#6db3f2"],
  outline: ["#ccc", "#4a4a4a"],
  row: ["#e4e4e4", "#3a3a3a"],
  edge: ["#999", "#777"],
  bar: ["#777", "#999"],
  button: ["#f6f6f6", "#262626"],
  muted: ["#666", "#a8a8a8"],
  empty: ["#aaa", "#666"],
  track: ["#f0f0f0", "#2a2a2a"],
  replay: ["#ddd", "#444"],
  good: ["#eef5fa", "#14293a"],
  bad: ["#fdf1e9", "#3a2415"],
  pass: ["#00694d", "#4cc38a"],
  fail: ["#a84300", "#ff9a5a"],
  withheld: ["#7a5c00", "#e0b94a"],
  faint: ["#6b6b6b", "#a8a8a8"],
  grid: ["#e4e4e4", "#333"],
  brush: ["rgb(0 0 0 / 10%)", "rgb(255 255 255 / 14%)"],
  scene_veil: ["rgb(238 242 246 / 75%)", "rgb(13 17 23 / 75%)"],
  scene_button: ["#f3f4f6", "#2b2f36"],
  scene_edge: ["#9aa0a6", "#6b7280"],
  pressed: ["#0059a0", "#4dabf7"],
  on_pressed: ["#fff", "#10151c"],
  scene_sky: ["#eef2f6", "#0d1117"],
  scene_ground: ["#d8d4cc", "#3a3936"],
  scene_haze: ["#e6e5e2", "#23252a"],
  scene_grid: ["#8f8a80", "#7d7a74"],
  flame: ["#e8590c", "#ffa94d"],
  failed: ["#222222", "#f1f3f5"],
} as const;

export const SHIP = {
  foil: "#c8a040",
  metal: "#c9ced4",
  dark: "#4a4f57",
  shield: "#6b4a36",
  panel: "#27408b",
  mark: "#d9480f",
} as const;

export const FIGURE = {
  ink: "#222222",
  faint: "#6b6b6b",
  grid: "#dddddd",
} as const;
