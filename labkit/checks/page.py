"""What failed, as HTML. Whatever comes from students is escaped, and cut where it is long."""
import base64
import html
from pathlib import Path

from ..table import TASKS
from .report import rerun

MOST_TEXT = 4000  # characters of one message on a page
MOST_CELL = 300   # characters of a table's cell
SHORT = 12        # characters of a table's cell that is kept on one line
COLOURS = {"done": "#1a7f37", "failing": "#cf222e"}
STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem;
       color: #1f2328; background: #fff; overflow-wrap: anywhere; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; }
td, th { padding: .15rem .8rem .15rem 0; text-align: left; vertical-align: top;
         overflow-wrap: break-word; }
.number { text-align: right; } .number, .short { white-space: nowrap; }
pre { background: #f6f8fa; padding: .8rem; overflow-x: auto; font-size: 13px; line-height: 1.4; }
img { max-width: 100%; border: 1px solid #d0d7de; }
.bar { background: #d8dee4; width: clamp(4rem, 20vw, 12rem); height: .7rem; margin-top: .4rem; }
.bar i { display: block; height: 100%; background: #1a7f37; }
.note { color: #59636e; } .claim { margin: 1.2rem 0 .3rem; font-weight: 600; }
@media (max-width: 45rem) { body { margin-top: 1rem; } pre { font-size: 11px; padding: .5rem; } }
"""


class Markup(str):
    """HTML that is ours: nothing in it is left to escape."""


def document(title: str, *parts: str, style: str = "") -> str:
    """No script and nothing from elsewhere can be loaded, whatever a student has smuggled in."""
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return "\n".join([
        "<!doctype html>", '<html lang="en">', "<head>", '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escaped(title)}</title>", f"<style>{STYLE}{style}</style>", "</head>", "<body>",
        f"<h1>{escaped(title)}</h1>", *parts, "</body>", "</html>", ""])


def escaped(text: str, most: int = MOST_TEXT) -> str:
    """A text of a student's as HTML, and no more of it than a page can bear."""
    more = len(text) - most
    return html.escape(text if more <= 0 else
                       f"{text[:most]}\n(cut here; there are {more:,} characters more)")


def paragraph(text, kind="note"):
    return f'<p class="{kind}">{escaped(text)}</p>'


def preformatted(text):
    return f"<pre>{escaped(text)}</pre>"


def coloured(verdict):
    colour = COLOURS.get(verdict.partition(",")[0], "#59636e")
    return Markup(f'<span style="color:{colour}">{escaped(verdict)}</span>')


def rows(lines, head=None):
    """A table of these rows of cells: numbers, texts and Markup. A number is set to the right."""
    def cell(content, tag):
        text = f"{content:g}" if isinstance(content, float) else str(content)
        kind = "number" if isinstance(content, int | float) else "short" * (len(text) <= SHORT)
        inside = content if isinstance(content, Markup) else breakable(text)
        return f'<{tag} class="{kind}">{inside}</{tag}>'

    table = [[*(cell(content, "td") for content in line)] for line in lines]
    if head:
        table.insert(0, [cell(content, "th") for content in head])
    return "\n".join(['<div class="wide"><table>',
                      *(f"<tr>{''.join(line)}</tr>" for line in table), "</table></div>"])


def breakable(text):
    """A cell's text as HTML. A long name may go on below after each underscore."""
    return Markup(escaped(text, MOST_CELL).replace("_", "_<wbr>"))


def bar(part, whole):
    return Markup(f'<div class="bar"><i style="width:{100 * part / max(whole, 1):.0f}%"></i></div>')


def exercise_part(entry, reached, lost: str | None, pictures: dict, seed: int) -> list[str]:
    """What is wrong in an exercise: every claim that failed, its message and its picture.

    entry: as in labkit/verdicts.py. reached: its points. lost: what became of the process that ran
    it, or None.
    """
    failed = [check for check in entry.checks if check.verdict != "passed"]
    again = (rerun(entry.number, seed=seed) if entry.topic not in TASKS else
             f"{rerun(entry.topic)}, which has other random numbers")
    parts = [f"<h2>{entry.number} {html.escape(entry.name)}: {coloured(entry.told)}</h2>",
             paragraph(f"{entry.told_points(reached)}. "
                       f"To check it again: {again}")]
    if lost:
        parts.append(paragraph(f"The process that ran this exercise was lost {lost}", ""))
    for check in failed:
        parts += [paragraph(check.claim, "claim"), preformatted(check.message)]
        name = check.picture and Path(check.picture).name
        if name in pictures:
            data = base64.b64encode(pictures[name]).decode("ascii")
            parts.append(f'<img alt="the picture" src="data:image/png;base64,{data}">')
    return parts
