"""similar.csv and similar.html: the pairs of `similarity`, their answers beside each other."""
import html
import itertools

from ... import exercises
from ...checks.page import document, escaped, paragraph, rows
from ...given import places
from ..gradebook import sheets
from ..handing.texts import whole
from . import similarity

MOST_PAIRS = 50      # shown side by side; similar.csv has all
MOST_EXERCISES = 6   # of a pair, the most alike ones
MOST_LINES = 150     # of an answer
STYLE = """
.sides { display: grid; grid-template-columns: 1fr 1fr; gap: 1rem; width: min(94vw, 100rem);
         margin-left: calc(50% - min(47vw, 50rem)); }
.sides > div { min-width: 0; } .sides pre { margin: .3rem 0 0; font-size: 12px; }
@media (max-width: 45rem) { .sides { display: block; width: auto; margin: 0; } }
mark { background: #fff0b3; }
"""
ABOUT = (
    "What is marked stands in both answers: the same syntax, whatever the variables are called, "
    "in whatever order. What the reference has, other answers that the course keeps, or "
    "many of the class, is not marked.",
    "The number of a pair counts nodes of the syntax trees, beyond the "
    f"{similarity.FORCED} that two honest answers to an exercise may share. It says where to look "
    "first, and no more. It takes no points. Two people may have worked together, or from the "
    "same source, or have thought alike.")


def write(out, pairs, texts):
    """Write both files. texts: as `texts.kept` has them."""
    places.write_whole(out / "similar.csv", sheets.written(table(pairs)))
    places.write_whole(out / "similar.html", page(pairs, texts).encode("utf-8"))


def table(pairs):
    """The rows of similar.csv."""
    yield "student", "other student", "nodes beyond what is forced", "exercises"
    for pair in pairs:
        yield pair.first, pair.second, pair.nodes, "; ".join(map(sentence, pair.exercises))


def sentence(shared):
    return f"{shared.number} {shared.name}: {shared.nodes} of {shared.of}"


def page(pairs, texts):
    shown = pairs[:MOST_PAIRS]
    parts = [*map(paragraph, ABOUT)]
    if len(pairs) > len(shown):
        parts.append(paragraph(f"These are the {len(shown)} that are most alike of {len(pairs)}; "
                               "similar.csv has all."))
    parts.append(rows([[pair.first, pair.second, pair.nodes,
                        ", ".join(one.number for one in pair.exercises)] for pair in shown]))
    for pair in shown:
        parts.append(f"<h2>{escaped(pair.first)} and {escaped(pair.second)}: {pair.nodes}</h2>")
        for one in pair.exercises[:MOST_EXERCISES]:
            parts.append(paragraph(sentence(one), "claim"))
            sides = (f"<div>{escaped(student)}"
                     f"<pre>{highlighted(whole(texts[student], one.topic), one)}</pre></div>"
                     for student in (pair.first, pair.second))
            parts.append(f'<div class="sides">{"".join(sides)}</div>')
    return document("Alike, for a person to judge", *parts, style=STYLE)


def highlighted(text, shared):
    """The functions of an answer as HTML, without docstrings, what is shared marked."""
    answer, lines = similarity.read_answer(text, shared), exercises.text_lines(text)
    columns = highlighted_columns(answer, shared.parts, lines)
    shown = [number for function in answer.functions for number in code_lines(function)]
    more = len(shown) - MOST_LINES
    parts = [highlighted_line(lines[number - 1].rstrip(), columns.get(number, ()))
             for number in shown[:MOST_LINES]]
    return "\n".join([*parts, *[f"(cut here; there are {more} lines more)"] * (more > 0)])


def code_lines(function):
    """The numbers of a function's lines, but for those of its docstring."""
    numbers = range(function.lineno, function.end_lineno + 1)
    if similarity.without_texts(function.body[:1]):
        return list(numbers)
    text = function.body[0]
    return [number for number in numbers if not text.lineno <= number <= text.end_lineno]


def highlighted_columns(answer, parts, lines):
    """{line: the columns in it that belong to these parts}."""
    bits, columns = similarity.covered(answer.parts, parts), {}
    places = (node for place, (node, _) in enumerate(answer.nodes) if bits >> place & 1)
    for node in filter(lambda node: hasattr(node, "lineno"), places):
        for number in range(node.lineno, node.end_lineno + 1):
            line = lines[number - 1].rstrip()
            start, end = len(line) - len(line.lstrip()), len(line)
            if number == node.lineno:
                start = column(line, node.col_offset)
            if number == node.end_lineno:
                end = column(line, node.end_col_offset)
            columns.setdefault(number, set()).update(range(start, end))
    return columns


def column(line, offset):
    """An offset in bytes of UTF-8, as the syntax tree has it -> one in characters."""
    return len(line.encode("utf-8")[:offset].decode("utf-8", "ignore"))


def highlighted_line(line, columns):
    pieces = itertools.groupby(enumerate(line), key=lambda place: place[0] in columns)
    texts = [(is_shared, html.escape("".join(letter for _, letter in each)))
             for is_shared, each in pieces]
    return "".join(f"<mark>{text}</mark>" if is_shared else text for is_shared, text in texts)
