"""What failed, as HTML. Whatever comes from students is escaped."""
import base64
import html
from pathlib import Path

from .report import rerun

COLOURS = {"done": "#1a7f37", "failing": "#cf222e"}
STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem;
       color: #1f2328; background: #fff; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; }
table { border-collapse: collapse; } td, th { padding: .15rem .8rem .15rem 0; text-align: left; }
td.number, th.number { text-align: right; }
pre { background: #f6f8fa; padding: .8rem; white-space: pre-wrap; font-size: 13px;
      line-height: 1.4; overflow-wrap: anywhere; }
img { max-width: 100%; border: 1px solid #d0d7de; }
.bar { background: #d8dee4; width: 12rem; height: .7rem; } .bar i { display: block; height: 100%;
       background: #1a7f37; }
.note { color: #59636e; } .claim { margin: 1.2rem 0 .3rem; font-weight: 600; }
"""


def document(title, *parts):
    """No script and nothing from elsewhere can be loaded, whatever a student has smuggled in."""
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return "\n".join([
        "<!doctype html>", '<html lang="en">', "<head>", '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>{html.escape(title)}</title>", f"<style>{STYLE}</style>", "</head>", "<body>",
        f"<h1>{html.escape(title)}</h1>", *parts, "</body>", "</html>", ""])


def paragraph(text, kind="note"):
    return f'<p class="{kind}">{html.escape(text)}</p>'


def coloured(verdict):
    colour = COLOURS.get(verdict.partition(",")[0], "#59636e")
    return f'<span style="color:{colour}">{html.escape(verdict)}</span>'


def exercise_part(entry, lost, pictures, seed):
    """What is wrong in an exercise: every claim that failed, its message and its picture."""
    failed = [check for check in entry["checks"] if check["verdict"] != "passed"]
    parts = [f"<h2>{entry['number']} {html.escape(entry['name'])}: "
             f"{coloured(entry['told'])}</h2>",
             paragraph(f"{len(failed)} of {len(entry['checks'])} claims do not hold. "
                       f"To run them again: {rerun(entry['number'], seed=seed)}")]
    if lost:
        parts.append(paragraph(f"The process that ran this exercise was lost {lost}", ""))
    for check in failed:
        parts += [paragraph(check["claim"], "claim"),
                  f"<pre>{html.escape(check['message'])}</pre>"]
        name = check["picture"] and Path(check["picture"]).name
        if name in pictures:
            data = base64.b64encode(pictures[name]).decode("ascii")
            parts.append(f'<img alt="the picture" src="data:image/png;base64,{data}">')
    return parts
