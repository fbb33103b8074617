// The page's own modules, for tests without a browser.
import { build } from "esbuild";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

/** Bundles modules of `src` and imports them: `{ decode: "decode.ts" }` answers `{ decode }`. */
export async function sources(names) {
  const folder = mkdtempSync(join(tmpdir(), "simbeeotic-page-"));
  try {
    await build({
      entryPoints: Object.fromEntries(
        Object.entries(names).map(([name, path]) => [name, fileURLToPath(new URL(`../src/${path}`, import.meta.url))]),
      ),
      outdir: folder,
      outExtension: { ".js": ".mjs" },
      bundle: true,
      format: "esm",
      logLevel: "error",
    });
    const modules = Object.keys(names).map(async (name) => [name, await import(pathToFileURL(join(folder, `${name}.mjs`)))]);
    return Object.fromEntries(await Promise.all(modules));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
