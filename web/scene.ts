// The three-dimensional view of a page: what a system's SSD declares as its Scene.

import { WebGLRenderer } from "three";
import { readPage } from "./page/document";
import { readScene } from "./scene/document";
import { make } from "./page/elements";
import { SHEET } from "./scene/sheet";
import { View } from "./scene/view";

const NO_WEBGL = "There is no three-dimensional view, since this browser has no WebGL; the figures of this page show the same flight.";
const LOST = "The graphics system has lost the three-dimensional view. It may return by itself; otherwise reload the page.";
const FAILED = "The three-dimensional view could not be created; the figures of this page show the same flight.";

// In a thread of its own: the first context of a browser may take as long as the rest of the page.
const PROBE = `
  const context = new OffscreenCanvas(1, 1).getContext("webgl2");
  const names = context?.getExtension("WEBGL_debug_renderer_info");
  postMessage(String(names && context.getParameter(names.UNMASKED_RENDERER_WEBGL)));
  context?.getExtension("WEBGL_lose_context")?.loseContext();
`;

// Without a graphics processor smooth edges take more time than a picture may.
async function drawsInSoftware(): Promise<boolean> {
  const address = URL.createObjectURL(new Blob([PROBE], { type: "text/javascript" }));
  const worker = new Worker(address);
  const name = await new Promise<string>((resolve) => {
    worker.onmessage = (event) => resolve(event.data as string);
    worker.onerror = () => resolve(""); // a browser without OffscreenCanvas
  });
  worker.terminate();
  URL.revokeObjectURL(address);
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

async function start(holder: HTMLElement): Promise<View | null> {
  const page = readPage();
  const [data, isSoftware] = await Promise.all([page && readScene(page), drawsInSoftware()]);
  if (!data) return null;
  const canvas = make("canvas");
  const context = canvas.getContext("webgl2", { antialias: !isSoftware, alpha: false, powerPreference: "high-performance" });
  if (!context) {
    say(holder, NO_WEBGL);
    return null;
  }
  document.head.append(make("style", {}, SHEET));
  const view = new View(data, new WebGLRenderer({ canvas, context }));
  const lost = make("p", { class: "empty", role: "status", hidden: "" }, LOST);
  holder.replaceChildren(lost, view.element);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    view.isNear = false;
    view.element.hidden = true;
    lost.hidden = false;
  });
  canvas.addEventListener("webglcontextrestored", () => {
    view.element.hidden = false;
    lost.hidden = true;
    view.isNear = true;
  });
  return view;
}

function say(holder: HTMLElement, text: string): void {
  holder.prepend(make("p", { class: "empty", role: "status" }, text)); // pictures stay
}

// A view is made when it comes near to the screen: figures above it are not kept waiting. Far from it, it rests.
for (const holder of document.querySelectorAll<HTMLElement>("[data-scene]")) {
  let started: Promise<View | null> | null = null;
  const observer = new IntersectionObserver(
    (entries) => {
      const isNear = entries.at(-1)!.isIntersecting;
      if (!started && !isNear) return;
      started ??= start(holder).catch((error: unknown) => {
        say(holder, FAILED);
        throw error;
      });
      void started.then((view) => view && (view.isNear = isNear));
    },
    { rootMargin: "200px" },
  );
  observer.observe(holder);
}
