// What a run's page and a batch's show in Firefox, over WebDriver BiDi: node firefox.mjs PACKAGES FIREFOX RUN BATCH TIME
// prints it as JSON.

import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [packages, executablePath, run, batch, time] = process.argv.slice(2);
const puppeteer = createRequire(`${packages}/`)("puppeteer-core");
const browser = await puppeteer.launch({ browser: "firefox", executablePath, headless: true });
const messages = [];

async function open(path, part) {
  const page = await browser.newPage();
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && messages.push(message.text()));
  page.on("pageerror", (error) => messages.push(String(error)));
  await page.setViewport({ width: 1400, height: 1200 });
  await page.goto(pathToFileURL(path).href + part);
  await page.waitForFunction(() => document.documentElement.dataset.ready, { timeout: 120_000 });
  return page;
}

const text = (page, selector) => page.$eval(selector, (element) => element.textContent);

const flight = await open(run, "#section-states-and-commands");
const frame = await flight.$("::-p-xpath(//*[@aria-label='plant.altitude over time']/..)");
await frame.evaluate((element) => element.scrollIntoView({ block: "center" }));
const area = await flight.waitForFunction((element) => element.querySelector(".chart > .area"), {}, frame);
const box = await area.boundingBox();
await flight.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
const pointed = await text(flight, ".explore output");
await flight.evaluate((at) => document.dispatchEvent(new CustomEvent("perilune-time", { detail: { time: at, from: "test" } })), Number(time));
const altitude = await frame.evaluate((element) => element.nextElementSibling.textContent);
await flight.$eval("g.block[data-block=plant]", (block) => {
  block.dispatchEvent(new PointerEvent("pointermove", { clientX: 9, clientY: 9, pointerType: "mouse" }));
});
await flight.waitForFunction(() => [...document.querySelectorAll(".card")].some((card) => !card.hidden && card.textContent));
const card = await flight.$$eval(".card", (cards) => cards.find((each) => !each.hidden).textContent);
await flight.$eval("[data-scene]", (holder) => holder.scrollIntoView({ block: "center" }));
await flight.waitForFunction(() => document.querySelector("[data-drawn], [data-scene] > .empty:not([hidden])"), { timeout: 60_000 });
const scene = await flight.$eval("[data-scene]", (holder) => holder.querySelector("[data-drawn] .scene-values, .empty:not([hidden])").textContent);

const trials = await open(batch, "");
await trials.$$eval("[data-figure]", (pictures) => {
  const picture = pictures.find((each) => each.getAttribute("aria-label").startsWith("Failures of") && each.getClientRects().length);
  picture.closest(".live").scrollIntoView({ block: "center" });
  picture.closest(".live").querySelector(".chart").focus();
});
await trials.waitForFunction(() => document.activeElement.querySelector(".chart > .area"));
await trials.keyboard.press("ArrowRight");
await trials.keyboard.press("Enter");
const pinned = await text(trials, ".card.pinned");

await browser.close();
process.stdout.write(JSON.stringify({ pointed, altitude, card, scene, pinned, messages }));
