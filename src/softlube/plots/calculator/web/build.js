// Bundles main.js, uPlot and its style sheet into bundle.js and bundle.css; `python .ci/calculator_bundle.py` calls it.
import { readFileSync } from "node:fs";
import { build } from "esbuild";

const licence = readFileSync("node_modules/uplot/LICENSE", "utf8").trim();
const { version } = JSON.parse(readFileSync("node_modules/uplot/package.json", "utf8"));

await build({
  entryPoints: { bundle: "main.js" },
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2020"],
  charset: "utf8",
  outdir: ".",
  allowOverwrite: true,
  banner: { js: `/*! Contains uPlot ${version}, https://github.com/leeoniya/uPlot\n\n${licence}\n*/` },
});
