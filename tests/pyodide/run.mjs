// Run tests in Pyodide, where NumPy's indices have 32 bits:
//
//     npm install --prefix out pyodide@0.27.7
//     node tests/pyodide/run.mjs                             all lab checks, a minute
//     node tests/pyodide/run.mjs tests/labs/test_msaa.py     or what pytest is given here
//
// Packages come from Pyodide's CDN. PYODIDE=FOLDER takes a whole Pyodide that is there already.
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const root = resolve(import.meta.dirname, "../..");
const folder = resolve(process.env.PYODIDE ?? join(root, "out/node_modules/pyodide"));
const { loadPyodide } = await import(pathToFileURL(join(folder, "pyodide.mjs")));
const python = await loadPyodide();
await python.loadPackage(["numpy", "scipy", "matplotlib", "pillow", "pytest", "rich"]);
python.mountNodeFS("/course", root);
const asked = process.argv.slice(2);
python.globals.set("asked", python.toPy(asked.length ? asked : ["tests/labs", "tests/pyodide"]));
process.exitCode = python.runPython(`
import os, pytest
os.chdir("/course")
int(pytest.main(["-p", "no:cacheprovider", *asked]))
`);
