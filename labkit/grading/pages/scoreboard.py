"""An open task's scoreboard, for all to see: nicknames, and nothing that the mark is made of."""
from ...checks import page as html
from ..apart.jobs import BOARD

ABOUT = ("The claims that hold on the scoreboard's own instances. The mark is made of others, so "
         "nobody can fit it to this table.")


def page(records) -> str:
    """The best first. Of equals, whose function takes less of a processor."""
    lines = sorted(([entry.name or "no nickname", *entry.claims,
                     sum(check.seconds for check in entry.checks),
                     *(record.result.asked.get(BOARD) or {"": ""}).values()]
                    for record in records for entry in record.result.entries
                    if entry.number == BOARD), key=lambda line: (-line[1], line[3]))
    return html.document("Scoreboard", html.paragraph(ABOUT), html.rows(
        [[name, hold, html.bar(hold, of), f"{seconds:.1f} s", calls]
         for name, hold, of, seconds, calls in lines], ["", "hold", "", "time", "renders"]))
