"""What the pages of the source and of the labs know: modules, lectures and exercises.

All of them stand one folder deep, so a link between two pages is "../folder/page.html#place".
"""
import ast
import functools
import re
from typing import NamedTuple

from course import exercises
from course.given import places


class Module(NamedTuple):
    """A module of reference/ or course/given/.

    name: as it is imported. names: {name in the module: full name} of what it defines and imports.
    """

    name: str
    text: str
    tree: ast.Module
    names: dict

    @property
    def folder(self):
        return self.name.split(".")[-2]

    @property
    def topic(self):
        return self.name.split(".")[-1]

    @property
    def nodes(self):
        """{name: node} of its functions and classes."""
        return {node.name: node for node in self.tree.body
                if isinstance(node, ast.FunctionDef | ast.ClassDef)}

    @property
    def lab(self):
        known = self.folder == "reference" and self.topic in exercises.TOPICS
        return exercises.lab_number(self.topic) if known else None


class Lecture(NamedTuple):
    """A lecture and the pages after it: its page's name, its title, {number: page and LaTeX} of
    equations, {exercise's number: page and heading}.
    """

    page: str
    title: str
    equations: dict
    announced: dict


class Course(NamedTuple):
    """modules: {full name: Module}, lectures: {lab: Lecture}, exercises: {full name: Exercise}.

    uses: {module's name: {(line, column): full name}} where code names something of the course.
    """

    modules: dict
    lectures: dict
    exercises: dict
    uses: dict

    def equations(self, module):
        """{number: LaTeX} of the lecture whose numbers a module uses."""
        known = self.lectures[module.lab].equations if module.lab else {}
        return {number: latex for number, (_, latex) in known.items()}

    def address(self, name):
        """Where a module, or a function, class or constant of one, has its place on the site."""
        if name in self.modules:
            module = self.modules[name]
            return f"../{module.folder}/{module.topic}.html"
        return f"{self.address(name.rpartition('.')[0])}#{name}"

    def equation_address(self, module, number):
        page, _ = self.lectures[module.lab].equations[number]
        return f"../lectures/{page}.html#equation-{number}"


@functools.cache
def read():
    """The course as it is in the working folder."""
    texts = {f"reference.{topic}": exercises.read(exercises.reference(topic))
             for topic in exercises.TOPICS}
    texts |= {"reference.tiny": exercises.read(exercises.reference("tiny"))}  # of no lab
    given = places.ROOT / "course" / "given"
    texts |= {f"course.given.{path.stem}": exercises.read(path)
              for path in sorted(given.glob("*.py")) if path.stem != "__init__"}
    modules = {name: read_module(name, text, texts) for name, text in texts.items()}
    for module in modules.values():
        module.names.update({short: origin(modules, full) for short, full in module.names.items()})
    asked = {f"reference.{topic}.{exercise.name}": exercise for topic in exercises.TOPICS
             for exercise in exercises.topic_exercises(topic)}
    lectures = {lab: read_lecture(topics[0], [exercise for exercise in asked.values()
                                              if exercise.number.split(".")[0] == str(lab)])
                for lab, topics in enumerate(exercises.LABS, 1)}
    used = {name: uses(modules, module) for name, module in modules.items()}
    return Course(modules, lectures, asked, used)


def read_module(name, text, known):
    """known: the full names of all modules."""
    tree = ast.parse(text)
    names = {}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            source = ".".join([name.rpartition(".")[0], node.module or ""][not node.level:])
            found = {alias.asname or alias.name: f"{source.strip('.')}.{alias.name}"
                     for alias in node.names}
            names |= {short: full for short, full in found.items()
                      if full in known or full.rpartition(".")[0] in known}
        else:
            names |= {short: f"{name}.{short}" for short in defined(node)}
    return Module(name, text, tree, names)


def origin(modules, full):
    """The full name where a name is defined, which a module may have imported itself."""
    module, _, name = full.rpartition(".")
    here = modules[module].names.get(name, full) if module in modules else full
    return full if here == full else origin(modules, here)


def defined(node):
    """The names that a statement of a module defines: a function, a class, constants."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    if not isinstance(node, ast.Assign):
        return []
    return [part.id for target in node.targets for part in ast.walk(target)
            if isinstance(part, ast.Name)]


def read_lecture(topic, asked):
    equations, announced = {}, {}
    for path in exercises.pages(topic):
        texts = exercises.cells(path)
        for formula in re.findall(r"\$\$(.*?)\$\$", "\n".join(texts), re.S):
            if tag := re.search(r"\\tag\{(\d+)\}", formula):
                equations[int(tag[1])] = path.stem, formula.replace(tag[0], "").strip()
        announced = {number: (path.stem, heading) for number, heading
                     in announcements(texts, asked).items()} | announced
    path = exercises.lecture(topic)
    title = re.search(r"^# (.*)", exercises.cells(path)[0], re.M)[1]
    return Lecture(path.stem, title, equations, announced)


def announcements(texts, asked):
    """{exercise's number: the heading above the paragraph that announces it}."""
    heading, found = "", {}
    for paragraph in (paragraph for text in texts for paragraph in text.split("\n\n")):
        title = re.match(r"#+ (.*)", paragraph)
        heading = title[1] if title else heading
        if re.search(r"\*(Exercise|Extra)s? \d", paragraph):
            for exercise in asked:
                named = re.search(rf"(?<![\d.]){re.escape(exercise.number)}(?!\d)", paragraph)
                if named and f"`{exercise.name}`" in paragraph:
                    found.setdefault(exercise.number, heading)
    return found


def uses(modules, module):
    """{(line, column): full name} where a module's code names something of the course."""
    found = {}
    for statement in module.tree.body:
        own = bound(statement) if isinstance(statement, ast.FunctionDef) else set()
        for node in ast.walk(statement):
            if isinstance(node, ast.alias) and node.name in module.names:
                found[node.lineno, node.col_offset] = module.names[node.name]
            elif isinstance(node, ast.Name) and node.id not in own:
                if isinstance(node.ctx, ast.Load) and node.id in module.names:
                    found[node.lineno, node.col_offset] = module.names[node.id]
            elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                owner = modules.get(module.names.get(node.value.id))
                if owner and node.value.id not in own and node.attr in owner.names:
                    column = node.end_col_offset - len(node.attr)
                    found[node.end_lineno, column] = owner.names[node.attr]
    return found


def bound(function):
    """The names that a function gives to values of its own."""
    nodes = list(ast.walk(function))
    return ({node.arg for node in nodes if isinstance(node, ast.arg)}
            | {node.id for node in nodes if isinstance(node, ast.Name)
               and isinstance(node.ctx, ast.Store)}
            | {node.name for node in nodes if isinstance(node, ast.FunctionDef)
               and node is not function})
