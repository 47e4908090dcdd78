// Before a page's own scripts: what they write on canvases is noted and not drawn, long tasks are noted.
{
  const noted = new WeakMap();
  const prototype = CanvasRenderingContext2D.prototype;
  const clear = prototype.clearRect;
  prototype.clearRect = function (...box) {
    noted.set(this.canvas, []);
    clear.apply(this, box);
  };
  prototype.fillText = function (text, x, y) {
    if (!text || !this.canvas.isConnected) return;
    const box = this.measureText(text);
    const at = (right, down) => this.getTransform().transformPoint({ x: x + right, y: y + down }); // px of the canvas
    const middle = at((box.actualBoundingBoxRight - box.actualBoundingBoxLeft) / 2, (box.actualBoundingBoxDescent - box.actualBoundingBoxAscent) / 2);
    const isCut = at(-box.actualBoundingBoxLeft, 0).x < -1 || at(box.actualBoundingBoxRight, 0).x > this.canvas.width + 1;
    if (!this.getTransform().b) noted.get(this.canvas)?.push([isCut ? `${text}, cut off` : text, middle.x, middle.y]);
  };
  const tasks = [];
  new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: "longtask", buffered: true });

  const frames = async (count) => {
    for (let each = 0; each < count; each++) await new Promise(requestAnimationFrame);
  };
  const SIZE = 2; // of a bitmap, px a px of the page

  // Shows all figures of the page as a reader does, who opens what is folded, scrolls and zooms; then compares them.
  const read = async () => {
    for (const folded of document.querySelectorAll("details")) {
      folded.open = true;
      await frames(2);
    }
    const pictures = [...document.querySelectorAll("svg.figure")].filter((each) => each.getClientRects().length);
    for (const picture of pictures) {
      await show(picture);
      for (const plot of picture.closest(".live")?.querySelectorAll(".chart") ?? []) {
        for (const key of ["+", "+", "PageDown", "-", "0"]) {
          plot.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
        }
        await frames(1);
      }
    }
    await frames(2);
    const longest = Math.max(0, ...tasks);
    const all = [];
    for (const picture of pictures) {
      const frame = picture.closest(".live");
      const name = picture.getAttribute("aria-label");
      if (frame) await show(picture);
      all.push(frame ? { name, interactive: true, ...(await compare(picture, frame)) } : { name, interactive: false });
    }
    return { longest, figures: all };
  };

  // Scrolls to a figure, and waits until it is drawn.
  const show = async (picture) => {
    picture.scrollIntoView({ block: "center" });
    await frames(2);
    const frame = picture.closest(".live");
    for (let tries = 0; tries < 300 && frame && !frame.querySelector("canvas"); tries++) await frames(1);
  };

  const compare = async (picture, frame) => {
    const origin = frame.getBoundingClientRect();
    const place = (element) => {
      const { left, top, width, height } = element.getBoundingClientRect();
      return [left + width / 2 - origin.left, top + height / 2 - origin.top];
    };
    const texts = [...picture.querySelectorAll("text")].filter((each) => each.textContent.trim() && each.getClientRects().length);
    const isStill = (each) => each.closest(".still") !== null;
    const stated = texts.filter((each) => !isStill(each)).map((each) => [each.textContent, ...place(each)]);
    const still = texts.filter(isStill);
    const hidden = still.filter((each) => getComputedStyle(each).visibility !== "visible").map((each) => each.textContent);
    const canvases = [...frame.querySelectorAll("canvas")];
    const written = canvases.flatMap((canvas) => {
      const { left, top, width } = canvas.getBoundingClientRect();
      const ratio = canvas.width / width;
      return (noted.get(canvas) ?? []).map(([text, x, y]) => [text, left - origin.left + x / ratio, top - origin.top + y / ratio]);
    });
    const values = instants(picture, frame);
    const different = await ink(picture, canvases, frame);
    return { stated, written, hidden, still: still.length, values, different };
  };

  // At ten places of the cursor: the marks on lines, which must lie on strokes of their colour in the picture.
  const instants = (picture, frame) => {
    const paths = [...picture.querySelectorAll("path")].filter((path) => !path.closest("defs"));
    const coloured = (colour) => paths.filter((path) => getComputedStyle(path).stroke === colour);
    const marked = [...picture.querySelectorAll("use, circle")]; // where a line has marks alone
    const off = [];
    let marks = 0;
    for (const area of frame.querySelectorAll(".chart > .area")) {
      const { left, top, width, height } = area.getBoundingClientRect();
      for (let each = 0; each < 10; each++) {
        const clientX = left + (0.05 + 0.1 * each) * width;
        area.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY: top + height / 2, pointerType: "mouse" }));
        for (const mark of area.querySelectorAll(":scope > i:not([hidden])")) {
          marks += 1;
          const box = mark.getBoundingClientRect();
          const at = new DOMPoint(box.left + box.width / 2, box.top + box.height / 2);
          const colour = getComputedStyle(mark).backgroundColor;
          const isNear = (element) => {
            const { left, top, width, height } = element.getBoundingClientRect();
            return Math.hypot(left + width / 2 - at.x, top + height / 2 - at.y) < 4;
          };
          const isOn = marked.some(isNear) || coloured(colour).some((path) => {
            const style = path.getAttribute("style");
            Object.assign(path.style, { strokeWidth: "5", strokeDasharray: "none", strokeLinecap: "round" });
            const isInside = path.isPointInStroke(at.matrixTransform(path.getScreenCTM().inverse())); // it may be stretched
            path.setAttribute("style", style);
            return isInside;
          });
          if (!isOn) off.push([colour, at.x, at.y]);
        }
      }
      area.dispatchEvent(new PointerEvent("pointerleave", { clientX: left, clientY: top, pointerType: "mouse" }));
    }
    return { marks, off };
  };

  const bitmap = (width, height) => {
    const context = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d", { willReadFrequently: true });
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, height);
    return context;
  };

  // A picture whose sizes are px at any width, its padding as a place, in one that can be enlarged.
  const inside = (copy, picture, { width, height }) => {
    const [top, right, bottom, left] = ["Top", "Right", "Bottom", "Left"].map((side) => parseFloat(getComputedStyle(picture)[`padding${side}`]));
    const place = { x: left, y: top, width: width - left - right, height: height - top - bottom, overflow: "visible" };
    for (const [name, each] of Object.entries(place)) copy.setAttribute(name, each);
    copy.removeAttribute("style");
    for (const path of copy.querySelectorAll("path[stroke]")) { // strokes are not stretched; those of the sheet are missing here
      path.setAttribute("vector-effect", "non-scaling-stroke");
      path.setAttribute("stroke-width", SIZE * parseFloat(path.getAttribute("stroke-width") ?? "1"));
    }
    const whole = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    whole.setAttribute("viewBox", `0 0 ${width} ${height}`);
    whole.append(copy);
    return whole;
  };

  // The pixels that one of picture and canvases has and the other one nowhere near: without texts and what is still.
  const ink = async (picture, canvases, frame) => {
    const origin = frame.getBoundingClientRect();
    const [width, height] = [Math.round(origin.width * SIZE), Math.round(origin.height * SIZE)];
    const copy = picture.cloneNode(true);
    for (const each of copy.querySelectorAll("text, .still")) each.remove();
    const whole = inside(copy, picture, origin);
    whole.setAttribute("width", width);
    whole.setAttribute("height", height);
    whole.setAttribute("style", "stroke-linecap: butt; stroke-linejoin: round");
    const image = new Image();
    image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(whole))}`;
    await image.decode();
    const static_ = bitmap(width, height);
    static_.drawImage(image, 0, 0, width, height);
    const live = bitmap(width, height);
    const { left, top } = frame.getBoundingClientRect(); // values below other figures may have moved it meanwhile
    for (const canvas of canvases) {
      const box = canvas.getBoundingClientRect();
      live.drawImage(canvas, (box.left - left) * SIZE, (box.top - top) * SIZE, box.width * SIZE, box.height * SIZE);
    }
    const [one, other] = [static_, live].map((context) => context.getImageData(0, 0, width, height).data);
    return { missing: apart(one, other, width, height), added: apart(other, one, width, height) };
  };

  // How many inked pixels of a bitmap have none a third as strong near them in the other. Colours are compared at instants:
  // where lines overlap, another dash is on top.
  const apart = (from, to, width, height) => {
    const [NEAR, STEP, INKED] = [5 * SIZE, SIZE, 45];
    const strength = (pixels, at) => 255 - Math.min(pixels[at], pixels[at + 1], pixels[at + 2]);
    const isNear = (x, y, enough) => {
      for (let yy = Math.max(y - NEAR, 0); yy <= Math.min(y + NEAR, height - 1); yy++) {
        for (let xx = Math.max(x - NEAR, 0); xx <= Math.min(x + NEAR, width - 1); xx++) {
          if (strength(to, 4 * (yy * width + xx)) >= enough) return true;
        }
      }
      return false;
    };
    const places = [];
    for (let y = 0; y < height; y += STEP) {
      for (let x = 0; x < width; x += STEP) {
        const at = 4 * (y * width + x);
        const enough = strength(from, at) / 3; // pictures are aligned with pixels, thin lines of canvases lie across two
        if (3 * enough < INKED || strength(to, at) >= enough || isNear(x, y, enough)) continue;
        places.push([x / SIZE, y / SIZE]);
      }
    }
    return { count: places.length, first: places.slice(0, 5) };
  };

  Object.defineProperty(window, "perilune_read", { value: read });
}
