// The page begins: it connects, and shows the run that it is told of.

import "uplot/dist/uPlot.min.css";
import "./style/page.css";
import { Connection, streamAddress } from "./connection";
import { h, show } from "./core/dom";
import { readPlace, type Place } from "./core/place";
import { Settings } from "./core/settings";
import { Page } from "./page";
import { Run } from "./run";
import { lostLine } from "./ui/notices";
import type { Hello } from "./wire";

/** What goes between page and program; another number is another page. */
const PROTOCOL = 1;

const root = document.getElementById("page")!;
const settings = new Settings();
const greeting = h("div", { class: "card greeting", id: "greeting", role: "status" }, h("p", { text: "Connecting to the program …" }));
root.append(greeting);

let run: Run | null = null;
let page: Page | null = null;

const connection = new Connection(streamAddress(location), {
  message(message) {
    if (message.type === "hello") begin(message);
    else if (message.type === "error" && !run) greet(message.text);
    else run?.hear(message);
  },
  frame(frame) {
    run?.live?.take(frame, performance.now());
    run?.replay?.take(frame);
    page?.wake();
  },
  values(values) {
    // All values of a recording come as histories; these would only be the same once more.
    if (run?.live) run.series.push(values);
  },
  garbled: (text) => (run ? run.say(text, true) : greet(text)),
});
root.append(lostLine(connection.link, () => run, () => connection.retry()));

/** For tests, and for people at the browser's console. */
Object.assign(window, {
  simbeeotic: {
    place: () => page?.place(),
    stats: () => page?.stats(),
    quiet: () => page?.quiet() ?? false,
    state: () => run?.told,
    time_s: () => run?.time.value,
    frame: () => run?.player.frame,
    vehicle: (path: string) => run?.number(path),
  },
});

addEventListener("error", (event) => run?.say(`Something went wrong on this page: ${event.message}`, true));
addEventListener("unhandledrejection", (event) => run?.say(`Something went wrong on this page: ${event.reason}`, true));

function begin(hello: Hello): void {
  if (hello.protocol !== PROTOCOL) {
    greet(`The program speaks another language (${hello.protocol}, this page ${PROTOCOL}). Load the page again.`);
    return;
  }
  let place: Place = readPlace(location.hash);
  if (page) place = page.dispose();
  show(greeting, false);
  run = new Run(hello, connection);
  page = new Page(run, settings, root, place);
  if (hello.truncated) run.say("This recording ends early: the program that wrote it was stopped.", true);
}

function greet(text: string): void {
  greeting.replaceChildren(h("p", { text }));
  show(greeting, true);
}
