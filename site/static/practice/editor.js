/** An editor of Python, with the lines of a lab's file beside it. Its question is folded. */
import * as code from "../vendor/codemirror/codemirror.js";

/** Put an editor into a place. changed(text) hears each stroke, run() Ctrl+Enter. */
export function edit(place, label, text, changed, run) {
  const numbers = new code.Compartment();
  const view = new code.EditorView({
    parent: place,
    state: code.EditorState.create({ doc: text, extensions: [
      code.keymap.of([{ key: "Mod-Enter", run: () => (run(), true) }]),
      code.minimalSetup, code.python(), code.codeFolding(), code.indentUnit.of("    "),
      code.EditorView.lineWrapping, code.bracketMatching(),
      code.keymap.of([code.indentWithTab]), code.EditorView.contentAttributes.of({
        "aria-label": label, "aria-description": "Escape, then Tab, leaves it." }),
      numbers.of([]), code.EditorView.updateListener.of((update) => {
        if (update.docChanged) changed(update.state.doc.toString());
      })] }),
  });
  fold(view);
  return {
    read: () => view.state.doc.toString(),
    write(other) {
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: other } });
      fold(view);
    },
    /** The number of its first line in the lab's file. */
    begin: (first) => view.dispatch({ effects: numbers.reconfigure(
      code.lineNumbers({ formatNumber: (line) => String(line + first - 1) })) }),
  };
}

/** The question stands above already. */
function fold(view) {
  const found = view.state.doc.toString().match(/:[^\n]*\n\s+("""[^]*?""")/);
  if (!found) return;
  const to = found.index + found[0].length;
  view.dispatch({ effects: code.foldEffect.of({ from: to - found[1].length + 3, to: to - 3 }) });
}
