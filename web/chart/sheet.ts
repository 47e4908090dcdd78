// A canvas of a chart, as large as its place.

export interface Place {
  left: number; // px, of the chart in the figure
  top: number;
  width: number;
  height: number;
  margins: [top: number, right: number, bottom: number, left: number]; // px, from there to the axes' area
  point: number; // px of a pt of the figure
  isNarrow: boolean; // the abscissa has few ticks
}

export class Sheet {
  readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d")!;

  // Without what was drawn; from here on drawn in px of the page from the upper left corner of the axes.
  clear({ width, height, margins }: Place): CanvasRenderingContext2D {
    const { canvas, context } = this;
    const ratio = devicePixelRatio;
    const size = { width: Math.round(width * ratio), height: Math.round(height * ratio) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    context.resetTransform();
    context.clearRect(0, 0, size.width, size.height);
    context.setTransform(ratio, 0, 0, ratio, Math.round(margins[3] * ratio), Math.round(margins[0] * ratio));
    return context;
  }
}
