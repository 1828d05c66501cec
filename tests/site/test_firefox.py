"""The site in Firefox: the parts that browsers may do differently."""
import itertools
import json
import re
import shutil
import subprocess

import pytest
import websocket  # comes with Jupyter

PAGES = ("index", "lectures/02_rasterization", "lectures/09_inverse_rendering",
         "labs/08_antialiasing", "reference/antialiasing", "search")


UNTIL = """const until = async (test) => {
  for (let n = 0; !test() && n < 600; n++) await new Promise((next) => setTimeout(next, 100));
  return test(); };"""


class Firefox:
    """A tab of a headless Firefox, by WebDriver BiDi, for the site at an address."""

    def __init__(self, control, address):
        self.socket = websocket.create_connection(f"{control}/session", timeout=120,
                                                  suppress_origin=True)
        self.address = address
        self.numbers, self.errors = itertools.count(1), []
        self.send("session.new", capabilities={})
        self.send("session.subscribe", events=["log.entryAdded"])
        self.tab = self.send("browsingContext.getTree")["contexts"][0]["context"]

    def send(self, method, **params):
        """-> the answer's result. Errors of pages that come before it are kept."""
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            said = json.loads(self.socket.recv())
            if said.get("params", {}).get("level") == "error":
                self.errors.append(said["params"]["text"])
            if said.get("id") == number:
                assert said["type"] == "success", said
                return said["result"]

    def run(self, page, script):
        """Open a page of the site -> what an async function with this body returns there."""
        self.errors.clear()
        self.send("browsingContext.navigate", context=self.tab, url=f"{self.address}/{page}",
                  wait="complete")
        function = f"(async () => {{ {UNTIL} {script} }})().then(JSON.stringify)"
        found = self.send("script.evaluate", target={"context": self.tab}, awaitPromise=True,
                          expression=function)
        assert found["type"] == "success", found
        return json.loads(found["result"]["value"])


@pytest.fixture(scope="module")
def firefox(tmp_path_factory, address):
    """Headless Firefox. Without one, these tests are skipped."""
    found = shutil.which("firefox") or shutil.which("firefox-esr")
    if not found:
        pytest.skip("no Firefox: install firefox or firefox-esr")
    with subprocess.Popen([found, "--headless", "--remote-debugging-port", "0", "--profile",
                           tmp_path_factory.mktemp("profile")],
                          stderr=subprocess.PIPE, encoding="utf-8") as process:
        where = next(filter(None, (re.search(r"ws://[\d.:]+", line) for line in process.stderr)))
        yield Firefox(where[0], address)
        process.kill()


@pytest.mark.parametrize("page", PAGES)
def test_a_page_opens_without_a_fault(page, firefox):
    """A word of CSS or JavaScript that only Chromium knows."""
    fits = "return document.documentElement.scrollWidth <= innerWidth"
    assert firefox.run(f"{page}.html", fits)
    assert firefox.errors == []


def test_a_figure_takes_keys_and_plays(firefox):
    """A handle does not hear the keys, or a frame is never drawn."""
    assert firefox.run("lectures/00_start_here.html", """
        const figure = document.querySelector("#figure-descent");
        await until(() => figure.querySelector(".handle"));
        const handle = figure.querySelector(".handle");
        const at = () => handle.getAttribute("aria-valuetext"), before = at();
        handle.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
        const heard = at() !== before;
        figure.scrollIntoView();
        await new Promise(requestAnimationFrame);
        [...figure.querySelectorAll("button")].find((one) => one.textContent === "Play").click();
        const found = await until(() => figure.textContent.includes("Found"));
        return [heard, found]""") == [True, True]


def test_the_search_finds_an_exercise(firefox):
    """The records are in a form that only one browser reads."""
    assert "#exercise-8-7" in firefox.run("search.html?q=8.7", """
        await until(() => document.querySelector("#found a"));
        return document.querySelector("#found a").href""")
