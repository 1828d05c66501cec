"""Pages with one figure each, its formulas, and its numbers as they are shown."""
import itertools
import json
import shutil

import numpy as np
import pytest
from pages import served
from reading import NAMES, SOURCE, opened

PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>
<meta name="viewport" content="width=device-width"><link rel="icon" href="data:,">
<link rel="stylesheet" href="figures/figures.css">
<style>body {{ --color-foreground-primary: light-dark(#000, #cfd0d0); margin: 0;
               --color-foreground-secondary: light-dark(#5a5c63, #9ca0a5);
               color: var(--color-foreground-primary); font-family: sans-serif; }}
body[data-theme="dark"] {{ color-scheme: dark; background: #131416; }}
main {{ max-width: 46em; margin: auto; padding: 1em; }}</style>
<body data-theme="light">
<main><h1>Above</h1><div class="answers" data-figure="{name}"></div><p>Below</p></main>
<script type="module" src="figures/begin.js"></script>"""


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    """A page for each figure, NAME.html."""
    folder = tmp_path_factory.mktemp("figures")
    shutil.copytree(SOURCE, folder / "figures")
    for name in NAMES:
        (folder / f"{name}.html").write_text(PAGE.format(name=name))
    with served(folder) as at:
        yield at


@pytest.fixture
def page(new_page):
    """A new page of a reader who asked for rest, so that no figure sways."""
    return new_page(reduced_motion="reduce")


@pytest.fixture
def call(page, address):
    """call(module, function, *columns): what it returns for each row of arguments. A number is the
    same in all rows.
    """
    opened(page, address, "alias")

    def called(module, function, *columns):
        count = next(len(column) for column in columns if not np.isscalar(column))
        rows = zip(*(itertools.repeat(column, count) if np.isscalar(column) else column
                     for column in columns), strict=False)
        inputs = json.loads(json.dumps(list(rows), default=lambda x: x.tolist()))  # of NumPy
        return page.evaluate("""async ([module, name, inputs]) => {
            const functions = await import(`/figures/${module}.js`);
            const results = inputs.map((x) => functions[name](...x));
            return results.map((y) => ArrayBuffer.isView(y) ? [...y] : y);
        }""", [module, function, inputs])
    return called


@pytest.fixture
def agrees(call):
    """agrees(module, function, wanted, *columns): the function's results are the reference's."""
    def compare(module, function, wanted, *columns):
        found = np.reshape(call(module, function, *columns), np.shape(wanted))
        np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9)
    return compare
