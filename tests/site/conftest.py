"""What the tests of the web site share: a browser, and pages that may not fail."""
import shutil
import sys

import pytest
from serving import ROOT, SITE, served

sys.path.insert(0, str(ROOT / "site"))  # for the tests of what makes the site

BROWSERS = "chromium", "chromium-browser", "google-chrome", "chrome"


@pytest.fixture(scope="session")
def browser():
    """Headless Chromium. Without one, the tests that need it are skipped."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not found:
        pytest.skip(f"no browser: install one of {', '.join(BROWSERS)}")
    from playwright.sync_api import sync_playwright
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield chromium
        chromium.close()


@pytest.fixture(scope="session")
def address():
    """The address of the site that was made."""
    with served(SITE) as there:
        yield there


@pytest.fixture
def page(browser):
    """A new page. An error in its console, or a request that fails, fails the test."""
    opened, said = browser.new_page(), []
    opened.on("console", lambda message: message.type == "error" and said.append(message.text))
    opened.on("pageerror", lambda error: said.append(str(error)))
    opened.on("requestfailed", lambda request: said.append(f"failed: {request.url}"))
    yield opened
    found = list(said)  # before the page is closed, which breaks off what it still loads
    opened.close()
    assert found == []
