"""What the tests of the web site share: a browser, and pages that may not fail."""
import re

import pytest
from serving import SITE


@pytest.fixture(scope="session")
def browser():
    """Headless Chromium. Without one, the tests that need it are skipped."""
    import stills
    try:
        with stills.chromium() as started:
            yield started
    except SystemExit as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def address():
    """The address of the site that was made."""
    from pages import served
    with served(SITE) as there:
        yield there


@pytest.fixture
def new_page(browser):
    """new_page(**options): a new page in a context with these options.

    An error in its console, or a request that fails, fails the test, but for a `missing` file's;
    and so does a request to another host.
    """
    contexts, faults = [], []

    def new(missing=None, **options):
        def fault(text, url=""):
            if not (missing and url.endswith(missing)):
                faults.append(text)

        contexts.append(browser.new_context(**options))
        page = contexts[-1].new_page()
        page.on("pageerror", lambda error: fault(str(error)))
        page.on("request", lambda request: re.match(r"\w+://(?!127\.0\.0\.1:)", request.url)
                and fault(f"another host: {request.url}"))
        page.on("requestfailed", lambda request: fault(f"failed: {request.url}", request.url))
        page.on("console", lambda message: message.type == "error"
                and fault(message.text, message.location["url"]))
        return page

    yield new
    found = list(faults)  # before pages are closed, which breaks off what they still load
    for context in contexts:
        context.close()
    assert found == []


@pytest.fixture
def page(new_page):
    """A new page."""
    return new_page()
