// Says so when Python cannot be loaded, where JupyterLite would wait for ever without a word.
// <script src="no_python.js" data-python="the address that its kernel loads first">

const { python } = document.currentScript.dataset;
const Thread = window.Worker;

window.Worker = class extends Thread {
  constructor(file, options) {
    super(file, options);
    if (String(file).includes("pyodide-kernel")) fetch(python, { mode: "no-cors" }).catch(tell);
  }
};

function tell() {
  const said = document.createElement("p");
  said.setAttribute("role", "alert");
  said.textContent = `Python cannot be loaded: ${new URL(python).host} cannot be reached. ` +
    "Look to your network, then reload this page.";
  said.style = "position: fixed; inset: auto 0 0; z-index: 9999; margin: 0; padding: 0.75rem; " +
    "font: 1rem sans-serif; color: #000; background: #ffd9d9";
  document.body.append(said);
}
