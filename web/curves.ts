// Figures of a page that answer: one cursor over all that share an abscissa, zoom, values.

import { SharedAxis } from "./curves/axis";
import { Diagram } from "./curves/diagram";
import { Figure } from "./curves/figure";
import { listenToLegends } from "./curves/legend";
import type { Plot } from "./curves/plot";
import { listen, listenToKeys, press } from "./curves/pointer";
import { Toolbar } from "./curves/toolbar";
import { addCopyButtons } from "./page/copying";
import type { Axis } from "./generated/charts";
import { type Page, readPage } from "./page/document";
import { followLinks } from "./page/folding";
import { addSearch } from "./page/search";
import { announceTime, followTime } from "./page/time";
import { Card } from "./trials/card";
import { showChosen } from "./trials/chosen";
import { Selection } from "./trials/selection";
import { TrialPlot } from "./trials/trial_plot";
import { Trials } from "./trials/trials";

const TIME = "time, s";

class Curves {
  private readonly axes = new Map<string, SharedAxis>();
  private readonly figures = new Map<Element, Promise<Figure | null>>();
  private readonly toolbar = new Toolbar((key) => this.chosen && press(this.chosen.plot, key, false));
  private readonly selection = new Selection();
  private readonly card: Card;
  private chosen: { plot: Plot; figure: Figure } | null = null;
  private isFollowing = false;

  constructor(
    private readonly page: Page,
    private readonly trials: Trials | null,
  ) {
    this.card = new Card(page, trials);
    if (trials) showChosen(this.selection, trials, this.toolbar.element);
    followTime("curves", (at) => {
      this.isFollowing = true;
      this.axes.get(TIME)?.goTo(at);
      this.isFollowing = false;
    });
    listenToLegends((picture) => this.figures.get(picture));
    // What is folded away or made for another width becomes a plot when it is first seen.
    document.addEventListener("toggle", () => void this.attachVisible(), true);
    window.addEventListener("resize", () => void this.attachVisible());
  }

  async attachVisible(): Promise<void> {
    const pictures = [...document.querySelectorAll<SVGElement>("[data-figure]")];
    const visible = pictures.filter((picture) => !this.figures.has(picture) && picture.getClientRects().length);
    for (const picture of visible) this.figures.set(picture, this.attach(picture));
    await Promise.all(this.figures.values());
  }

  attachDiagrams(): void {
    const time = this.share({ label: TIME });
    for (const picture of document.querySelectorAll<SVGElement>("svg.diagram")) new Diagram(picture, this.page, time, () => this.attachVisible());
  }

  private async attach(picture: SVGElement): Promise<Figure | null> {
    const time = () => this.share({ label: TIME });
    const figure = await Figure.load(picture, this.page, (axis) => this.share(axis), time);
    for (const plot of figure?.plots ?? []) {
      const choice = { plot, figure: figure! };
      const choose = () => {
        this.chosen = choice;
      };
      this.chosen ??= choice;
      const ofTrials = TrialPlot.of(plot, this.trials, this.selection, this.card);
      listen(plot, choose, ofTrials);
      listenToKeys(plot, choose, (key) => ofTrials?.press(key) ?? false);
      const keys = "arrow keys move the cursor, plus and minus zoom, 0 shows the whole range";
      plot.root.setAttribute("role", "application");
      plot.root.setAttribute("aria-label", `${[picture.getAttribute("aria-label"), plot.chart.title].filter(Boolean).join(", ")}; ${keys}`);
    }
    return figure;
  }

  private share({ label = "", logarithmic = false }: Pick<Axis, "label" | "logarithmic">): SharedAxis {
    let axis = this.axes.get(label);
    if (!axis) {
      axis = new SharedAxis(label, logarithmic);
      this.axes.set(label, axis);
      axis.followCursor(() => this.onCursor(axis!));
    }
    return axis;
  }

  private onCursor(axis: SharedAxis): void {
    this.toolbar.show(axis);
    this.toolbar.speak(() => this.chosen?.figure.describe() ?? "");
    if (axis.label === TIME && axis.cursor !== null && !this.isFollowing) announceTime(axis.cursor, "curves");
  }
}

async function start(): Promise<void> {
  const page = readPage();
  if (!page?.figures.length) return;
  const curves = new Curves(page, await Trials.load(page));
  followLinks();
  await curves.attachVisible();
  curves.attachDiagrams();
  addCopyButtons();
  addSearch(page, () => curves.attachVisible());
  await new Promise(requestAnimationFrame); // in which the figures learn their sizes
  await new Promise(requestAnimationFrame);
  document.documentElement.dataset.ready = "curves";
}

void start();
