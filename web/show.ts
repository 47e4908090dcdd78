// `perilune show`: campaigns whose trials a server counts, explored in the browser.

import { readPage } from "./page/document";
import { make } from "./page/elements";
import { CampaignView } from "./show/campaign";
import { choice } from "./show/elements";

function start(): void {
  const content = readPage()?.document.show;
  const main = document.getElementById("show");
  if (!content || !main) return;
  const area = make("div");
  let view: CampaignView | null = null;
  const open = (index: number) => {
    view?.stop();
    view = new CampaignView(content.campaigns[index]!, index, content);
    area.replaceChildren(view.element);
    void view.start();
  };
  if (content.campaigns.length > 1) {
    const names = content.campaigns.map(({ system, folder }) => `${system}: ${folder}`);
    main.append(make("div", { class: "controls" }, choice("Campaign", names, 0, open)));
  }
  main.append(area);
  open(0);
}

start();
