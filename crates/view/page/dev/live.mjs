// Takes pictures of the page at an address, with the page's files from a folder instead of those in the program:
//   node dev/live.mjs http://127.0.0.1:PORT/ FOLDER NAME [wait, ms]
import { chromium } from "playwright-core";
import { readFileSync } from "node:fs";

const [, , address, folder, name, wait = "6000"] = process.argv;
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
page.on("pageerror", (e) => console.log("ERROR", e.message));
page.on("console", (m) => m.type() === "error" && console.log(m.text().slice(0, 500)));
for (const [file, type] of [["page.js", "text/javascript"], ["page.css", "text/css"]]) {
  await page.route((url) => url.pathname === `/${file}`, (route) => route.fulfill({ contentType: type, body: readFileSync(`${folder}/${file}`) }));
}
await page.goto(address);
await page.waitForTimeout(Number(wait));
await page.screenshot({ path: `test/out/live-${name}.png` });
await browser.close();
