"""What Chromium finds on a page that is open: barriers, and what moved while it opened."""
from axe_playwright_python.sync_playwright import Axe


def barriers(page, context=None, **options):
    """What axe finds. Its list of all that is well would take as long again."""
    options["resultTypes"] = ["violations"]
    found = Axe().run(page, context, options).response["violations"]
    return [(rule["id"], node["html"][:200], node.get("failureSummary", "")[:300])
            for rule in found for node in rule["nodes"]]


def moved(page):
    """By how much parts of the page have moved so far, and which."""
    return page.evaluate("""new Promise(done => {
      const moved = [];
      const watch = list => list.getEntries().forEach(entry => moved.push(
        [entry.value, entry.sources.map(source => source.node?.outerHTML?.slice(0, 200))]));
      new PerformanceObserver(watch).observe({type: "layout-shift", buffered: true});
      setTimeout(() => done(moved), 300);
    })""")
