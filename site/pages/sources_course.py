"""What the pages of the source and of the labs know: modules, lectures and exercises.

All of them stand one folder deep, so a link between two pages is "../folder/page.html#place".
"""
import ast
import functools
import re
from typing import NamedTuple

from labkit import board, exercises, places


class Module(NamedTuple):
    """A module of reference/ or course/given/: its name as it is imported, its folder, its topic,
    its lab or None, its text, and of what is in it

    nodes: {name: node} of its functions and classes
    names: {name in the module: full name} of what it defines and imports.
    """

    name: str
    folder: str
    topic: str
    lab: int | None
    text: str
    tree: ast.Module
    nodes: dict
    names: dict


class Lecture(NamedTuple):
    """A lecture and the pages after it: its page's name, {number: page and LaTeX} of equations,
    {full name: Exercise} of its lab in its order, {exercise's number: page and heading}.
    """

    page: str
    equations: dict
    asked: dict
    announced: dict


class Course(NamedTuple):
    """modules: {full name: Module}, lectures: {lab: Lecture}, exercises: {full name: Exercise}.

    places: {name: full names} of all functions, classes and constants, and of the other modules.
    """

    modules: dict
    lectures: dict
    exercises: dict
    places: dict

    def find(self, name, lab):
        """The full name of what a text of a lab calls so, or None if that is nothing, or many.

        Of several it is the lab's own. Lab 17's kernels have the names of what they stand for,
        which is meant elsewhere.
        """
        labs = {full: (self.modules.get(full) or self.modules[full.rpartition(".")[0]]).lab
                for full in self.places.get(name.rpartition(".")[2], ())
                if f".{full}".endswith(f".{name}")}
        near = [full for full, its_lab in labs.items() if its_lab == lab]
        other = [full for full, its_lab in labs.items()
                 if its_lab not in (None, max(self.lectures))]
        return next((found[0] for found in ([*labs], near, other) if len(found) == 1), None)

    def module_and_node(self, full):
        """The full name of a function or a class -> its Module, its node."""
        module, _, name = full.rpartition(".")
        return self.modules[module], self.modules[module].nodes[name]

    def function(self, full):
        """Is it a function, and no class, constant or module?"""
        module, _, name = full.rpartition(".")
        return module in self.modules and isinstance(self.modules[module].nodes.get(name),
                                                     ast.FunctionDef)

    def equations(self, module):
        """{number: page and LaTeX} of the lecture whose numbers a module uses."""
        return self.lectures[module.lab].equations if module.lab else {}

    def address(self, name):
        """Where a module, or a function, class or constant of one, has its place on the site."""
        if name in self.modules:
            module = self.modules[name]
            return f"../{module.folder}/{module.topic}.html"
        return f"{self.address(name.rpartition('.')[0])}#{name}"


@functools.cache
def read():
    """The course as it is in the working folder."""
    fast, given = (sorted((places.ROOT / "course" / room).glob("[!_]*.py"))
                   for room in ("fast", "given"))
    texts = {f"reference.{path.stem}": exercises.read(path) for path in
             (*map(exercises.reference, (*exercises.TOPICS, "tiny")), *fast)}
    texts |= {f"course.given.{path.stem}": exercises.read(path) for path in given}
    modules = {name: read_module(name, text, texts) for name, text in texts.items()}
    lectures = {lab: read_lecture(topics) for lab, topics in enumerate(exercises.LABS, 1)}
    asked = {name: exercise for lecture in lectures.values()
             for name, exercise in lecture.asked.items()}
    return Course(modules, lectures, asked, places_of(modules))


def places_of(modules):
    """{name: full names} of what modules define, and of those modules with a name of their own."""
    found = {}
    for module in modules.values():
        for short, full in module.names.items():
            if full == f"{module.name}.{short}":
                found.setdefault(short, []).append(full)
    return {module.topic: [module.name] for module in modules.values()} | found


def read_module(name, text, known):
    """known: the full names of all modules."""
    folder, topic = name.split(".")[-2:]
    lab = None if folder == "given" or topic == "tiny" else (  # of none
        exercises.lab_number(topic) if topic in exercises.TOPICS else len(exercises.LABS))
    tree, names = ast.parse(text), {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            package = f"{name.rpartition('.')[0]}." if node.level else ""
            source = f"{package}{node.module or ''}".rstrip(".")
            names |= {alias.name: f"{source}.{alias.name}" for alias in node.names
                      if source in known or f"{source}.{alias.name}" in known}
        else:
            names |= {short: f"{name}.{short}" for short in defined(node)}
    nodes = {node.name: node for node in tree.body
             if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    return Module(name, folder, topic, lab, text, tree, nodes, names)


def defined(node):
    """The names that a statement of a module defines: a function, a class, constants."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    return [part.id for target in getattr(node, "targets", ()) for part in ast.walk(target)
            if isinstance(part, ast.Name)]


def read_lecture(topics):
    asked = {f"reference.{topic}.{exercise.name}": exercise for topic in topics
             for exercise in exercises.topic_exercises(topic)}
    order = [*board.sections(*exercises.pages(topics[0])), *(one.number for one in asked.values())]
    asked = dict(sorted(asked.items(), key=lambda item: order.index(item[1].number)))
    equations, announced = {}, {}
    for path in exercises.pages(topics[0]):
        texts = exercises.cells(path)
        for formula in re.findall(r"\$\$(.*?)\$\$", "\n".join(texts), re.S):
            if tag := re.search(r"\\tag\{(\d+)\}", formula):
                equations[int(tag[1])] = path.stem, formula.replace(tag[0], "").strip()
        announced = {number: (path.stem, heading) for number, heading
                     in announcements(texts, asked.values()).items()} | announced
    return Lecture(exercises.lecture(topics[0]).stem, equations, asked, announced)


def announcements(texts, asked):
    """{exercise's number: the heading above the paragraph that announces it}."""
    heading, found = "", {}
    for paragraph in (paragraph for text in texts for paragraph in text.split("\n\n")):
        title = re.match(r"#+ (.*)", paragraph)
        heading = title[1] if title else heading
        if re.search(r"\*(Exercise|Step|Extra)s? \d", paragraph):
            for exercise in asked:
                named = re.search(rf"(?<![\d.]){re.escape(exercise.number)}(?!\d)", paragraph)
                if named and f"`{exercise.name}`" in paragraph:
                    found.setdefault(exercise.number, heading)
    return found
