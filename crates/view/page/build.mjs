// Builds the page into dist/, which is checked in: the program embeds it, and building the program needs no npm.
//   node build.mjs [FOLDER]
import { build } from "esbuild";
import { cpSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const folder = process.argv[2] ?? here("dist");

mkdirSync(folder, { recursive: true });
await build({
  absWorkingDir: here("."),
  entryPoints: { page: "src/main.ts" },
  outdir: folder,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "inline",
  logLevel: "warning",
});
cpSync(here("src/index.html"), `${folder}/index.html`);
