"""The labs' pages: what each exercise asks, without its answer, and where to read on."""
import ast
import html
import re

from docutils.nodes import make_id

from labkit import exercises, places

from . import practice, put, sources_course
from .names import anchor, exercise_pages, kind, lab_title, mark, points
from .sources_text import as_myst, docstring, escape, first_sentence, in_code, table

ABOUT = ("Each lab is the code of one lecture, with functions left for you to write. An exercise's "
         "docstring is the question, its body is your answer. It is written and checked on the "
         "lab's page, or by `python3 -m course check 1` on your own computer. Exercises are the "
         "core. A step is on the way to one, and gives no points. Extras, in italics, go further: "
         "they are complete until you open them.")


def write(folder, extra, python):
    """Write folder/labs: a page for each lab, and the index of all exercises. To extra goes what is
    needed to do them there. python: see practice.
    """
    drawings = practice.write(extra, python)
    course = sources_course.read()
    put(folder / "labs" / "index.md", index(course))
    for lab, lecture in course.lectures.items():
        put(folder / "labs" / f"{lecture.page}.md", page(course, lab, python, drawings))


def summary(course, lab):
    """What is built in a lab, what one can do afterwards, and how long it takes: the tables in
    README.md and in teaching/ know.
    """
    row = rf"^\| {lab} \|.*\| ([^|]*) \| ([\d.]+) \|$"
    (built, hours), (able, _) = (re.search(row, exercises.read(places.ROOT / page), re.M).groups()
                                 for page in ("README.md", "teaching/README.md"))
    found = course.lectures[lab].asked.values()
    core = [exercise for exercise in found if kind(exercise) == "core"]
    return (f"What you build: {escape(built)}. Afterwards you can {escape(able)}. About {hours} "
            f"hours with the lecture: {len(core)} exercises "
            f"({points(sum(exercise.points for exercise in core))}) and "
            f"{sum(exercise.is_extra for exercise in found)} extras.\n")


def index(course):
    """All labs, with all their exercises."""
    parts = [f"# Labs\n\n{ABOUT}\n"]
    for lab, lecture in course.lectures.items():
        items = " ".join(f'<li><a class="{kind(exercise)}" href="{lecture.page}.html'
                         f'#{anchor(exercise.number)}">{exercise.number} '
                         f"<code>{exercise.name}</code></a></li>"
                         for exercise in lecture.asked.values())
        parts.append(f"## [{lab_title(lab)}](/labs/{lecture.page}.md)\n\n"
                     + summary(course, lab)
                     + as_myst(f'<ul class="exercises">{items}</ul>'))
    return "\n".join(parts)


def page(course, lab, python, drawings):
    """One lab: its table of exercises, then their questions."""
    lecture, asked = course.lectures[lab], course.lectures[lab].asked
    modules = [course.modules[f"reference.{topic}"] for topic in exercises.LABS[lab - 1]]
    links = " · ".join([f'<a href="../lectures/{lecture.page}.html">Lecture {lab}</a>',
                        *(f'<a href="{course.address(module.name)}">'
                          f"<code>{module.topic}.py</code></a>" for module in modules),
                        '<a href="../lectures/00_start_here.html#draw-your-own-mesh">'
                        "Draw your own mesh</a>"])
    return "\n".join([f"# {lab_title(lab)}\n",
                      summary(course, lab),
                      as_myst(f'<p class="belongs">{links}</p>'),
                      "You write on this page, with nothing installed, or on your computer, "
                      f"where `python3 -m course check {lab}` checks it. A number that is missing "
                      "belongs to given code.\n", overview(course, asked),
                      as_myst(practice.work(exercises.LABS[lab - 1], python)),
                      *(question(course, name, drawings) for name in asked)])


def overview(course, asked):
    """The table of a lab's exercises, a line each."""
    rows = []
    for name, exercise in asked.items():
        _, node = course.module_and_node(name)
        link, question = f'<a href="#{anchor(exercise.number)}">', ast.get_docstring(node)
        rows.append([f"{link}{exercise.number}</a>", f"{link}<code>{exercise.name}</code></a>",
                     str(exercise.points or ""),
                     f'<span class="badge {kind(exercise)}">{kind(exercise)}</span>',
                     in_code(first_sentence(question))])
    return table("overview", ["number", "function", "points", "kind", "question"], rows)


def question(course, name, drawings):
    """An exercise: its mark, its signature, constants, its docstring, and links."""
    exercise, (module, node) = course.exercises[name], course.module_and_node(name)
    drawn = drawings.get((module.topic, node.name), "")
    marks = f'<p class="marks"><span class="badge {kind(exercise)}">{mark(exercise)}</span></p>'
    for text in f"{node.name}({ast.unparse(node.args)})", *constants(course, module, node):
        long = ' lines" tabindex="0' * ("\n" in text)
        marks += f'<pre class="signature{long}"><code>{html.escape(text)}</code></pre>'
    return "\n".join([f"({anchor(exercise.number)})=\n## {exercise.number} `{exercise.name}`\n",
                      as_myst(marks),
                      as_myst(docstring(course, module, node), "{eval-rst}"),
                      as_myst(practice.place(exercise, module.topic, drawn)),
                      as_myst(read_on(course, name, bool(drawn)))])


def constants(course, module, node):
    """The code that defines what a question names in capitals."""
    names = re.findall(r"\b[A-Z_]{3,}\b", ast.get_docstring(node)) or ["none"]
    line = rf"^(?=[A-Z_, ]*\b(?:{'|'.join(names)})\b)[A-Z_, ]+ = .+(?:\n[ \])}}].*)*$"
    return re.findall(line, module.text + course.modules["course.given.arrays"].text, re.M)


def read_on(course, name, is_drawn):
    """Where the lecture asks it, its answer, what the answer calls, and the demos that it names."""
    exercise, (module, node) = course.exercises[name], course.module_and_node(name)
    page, heading = course.lectures[module.lab].announced[exercise.number]
    place = f"../lectures/{page}.html#{make_id(heading)}"
    items = [("In the lecture", f'<a href="{place}">{html.escape(heading)}</a>'),
             ("The answer", f'<a href="{course.address(name)}"><code>reference/{module.topic}.py'
                        f"</code>, line {exercise.line}</a>")]
    parts = ast.walk(ast.Module(node.body))  # without decorators
    called = dict.fromkeys(full for part in parts if isinstance(part, ast.Name)
                           and (full := module.names.get(part.id)) and course.function(full))
    if called:
        items.append(("It calls", ", ".join(
            f'<a href="{asked_address(course, full)}"><code>{full.rpartition(".")[2]}</code></a>'
            for full in called)))
    for demo in re.findall("`(demo [^`]+)`", ast.get_docstring(node)):
        items.append(("To see it", "the picture below your code, or, " * is_drawn
                      + f"on your own computer, <code>python3 -m course {demo}</code>"))
    lines = "".join(f"<li>{words}: {links}</li>" for words, links in items)
    return f'<ul class="read-on">{lines}</ul>'


def asked_address(course, full):
    """An exercise's question, or the place of a function that is none."""
    if full not in course.exercises:
        return course.address(full)
    return f"../{exercise_pages()[course.exercises[full].number]}"
