"""Pages with one figure each, its formulas, and its numbers as they are shown."""
import json
import shutil

import numpy as np
import pytest
from reading import NAMES, SOURCE, opened
from serving import SITE, served

PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{name}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="figures/figures.css">
<style>
  body {{ --color-foreground-primary: #000000; --color-foreground-secondary: #5a5c63;
          margin: 0; font-family: sans-serif; color: var(--color-foreground-primary); }}
  body[data-theme="dark"] {{ --color-foreground-primary: #cfd0d0; background: #131416;
                             --color-foreground-secondary: #9ca0a5; }}
  main {{ max-width: 46em; margin: auto; padding: 1em; }}
</style>
<body data-theme="light">
<main><h1>Above</h1><div class="answers" data-figure="{name}"></div><p>Below</p></main>
<script type="module" src="figures/begin.js"></script>
</body>
</html>
"""


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    """A page for each figure, NAME.html."""
    folder = tmp_path_factory.mktemp("figures")
    shutil.copytree(SOURCE, folder / "figures")
    shutil.copytree(SITE / "waves", folder / "waves")
    for name in NAMES:
        (folder / f"{name}.html").write_text(PAGE.format(name=name))
    with served(folder) as at:
        yield at


@pytest.fixture
def call(page, address):
    """call(module, function, inputs): the function's results for many lists of arguments."""
    opened(page, address, "alias")

    def called(module, function, inputs):
        inputs = json.loads(json.dumps(list(inputs), default=lambda x: x.tolist()))  # of NumPy
        return page.evaluate("""async ([module, name, inputs]) => {
            const functions = await import(`/figures/${module}.js`);
            const results = inputs.map((x) => functions[name](...x));
            return results.map((y) => ArrayBuffer.isView(y) ? [...y] : y);
        }""", [module, function, inputs])
    return called


@pytest.fixture
def agrees(call):
    """agrees(module, function, inputs, wanted): the function's results are the reference's."""
    def compare(module, function, inputs, wanted):
        found = np.reshape(call(module, function, inputs), np.shape(wanted))
        np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9)
    return compare
