"""What a lecture's text names becomes a link: equations, sections, lectures, exercises, functions,
and the words of the glossary.

(3) is an equation of the page, or of the lecture that is named beside it. A lecture and the page
that goes on from it, 14 and 14b, number their equations together. What has no target stays text.
"""
import functools
import re

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from . import sources_course
from .names import exercise_pages, function_page

NUMBER = re.compile(r"\d+[bc]?")
LIST = r"\d+[bc]?(?:(?:, and|,| and| or| to) \d+[bc]?)*"
PLACE = re.compile(
    rf"\b[Ll]ectures (?P<lectures>{LIST})|\b[Ll]ecture (?P<lecture>\d+[bc]?)"
    r"|(?<!\d{4}, )\b(?:"  # "2020, section 3" is in a paper
    rf"[Ss]ections (?P<sections>{LIST})|[Ss]ection (?P<section>\d+))(?!\.?\d)"
    r"|(?<![\w)])\((?P<equation>[1-9]\d?)\)")  # 22(4) is a volume of a journal
BEFORE = re.compile(r"[Ll]ecture (\d+[bc]?)(?:, |['\u2019]s )(?:equation )?$")
BEHIND = re.compile(r" of lecture (\d+[bc]?)")
ANNOUNCED = re.compile(r"(?:Exercises?|Steps?|Extras?) \d")
EXERCISE = re.compile(r"\b\d+\.\d+\b")
EVERYDAY = set(  # words of another meaning, too: they are links where the glossary leads
    "chart crossing fan filter flip fused kernel lattice mass owner picture pixel shade steep "
    "sweep tap target thread tile warp".split())
SENTENCE = re.compile(r".{24,}?\.(?= |$)|.*")  # "CSG." alone says nothing
UNTOUCHED = nodes.literal, nodes.math, nodes.raw, nodes.reference


class References(SphinxPostTransform):
    """Makes the links of a lecture's page, after those that its text has of its own."""

    default_priority = 200
    formats = ("html",)

    def run(self):
        page = self.env.docname
        if not page.startswith("lectures/"):
            return
        self.relative = functools.partial(self.app.builder.get_relative_uri, page)
        self.lectures = {page.partition("/")[2].partition("_")[0]: page
                         for page in self.env.found_docs if page.startswith("lectures/")}
        self.here = page.partition("/")[2].partition("_")[0]
        self.defined, self.seen = definitions(self.env, page), set()
        for paragraph in self.document.findall(nodes.paragraph):
            self.link(paragraph)

    def link(self, paragraph):
        section = _above(paragraph, nodes.section)
        announced = False
        for node in [*paragraph.findall(lambda one: isinstance(one, nodes.Text | nodes.literal))]:
            if _above(node, UNTOUCHED):
                continue
            if isinstance(node, nodes.literal):
                self.link_function(node, section)
                continue
            bold = isinstance(node.parent, nodes.strong | nodes.emphasis)
            announced = announced or (bold and ANNOUNCED.match(node))
            found = [*self.places(node, isinstance(section.parent, nodes.document)),
                     *(exercises(node) if announced else ()), *self.words(node, section)]
            _replace(node, found)

    def link_function(self, literal, section):
        """The first `crossing` of a section leads to its place in the source."""
        address = function_page(literal.astext(), int(self.here[:2]))
        if address and (section, address) not in self.seen:
            self.seen.add((section, address))
            literal.replace_self(_reference(literal.deepcopy(), f"../{address}",
                                            classes=["function"]))

    def words(self, text, section):
        """The first use of each word of the glossary. The sources have words of their own."""
        pattern, defined = self.defined
        if section.next_node(nodes.title).astext().startswith("Sources"):
            return
        for found in pattern.finditer(text):
            word = found[1][0].lower() + found[1][1:]
            if word not in self.seen:
                self.seen.add(word)
                name, sentence = defined[word]
                yield (*found.span(), self.address("glossary", name),
                       {"classes": ["term"], "reftitle": sentence})

    def places(self, text, is_introduction):
        """(start, end, address, {}) of each equation, section and lecture that a text names."""
        for found in PLACE.finditer(text):
            kind = found.lastgroup
            named = BEFORE.search(text[:found.start()]) or BEHIND.match(text, found.end())
            lecture = named[1].zfill(2) if named else self.here
            for number in NUMBER.finditer(text, *found.span(kind)):
                address = getattr(self, kind.rstrip("s"))(number[0], lecture)
                # An introduction states no equation: in it, "clip space (1)" is a lab.
                if address and not (is_introduction and address.startswith("#equation")):
                    yield *(number if kind.endswith("s") else found).span(), address, {}

    def lecture(self, number, _):
        page = self.lectures.get(number.zfill(2))
        return page and self.relative(page)

    def section(self, number, lecture):
        page = self.lectures.get(lecture)
        slugs = self.env.metadata[page].get("myst_slugs", {})
        return next((self.address(page, slug) for slug, (_, _, title) in slugs.items()
                     if title.startswith(f"{number}. ")), None)

    def equation(self, number, lecture):
        lectures = sources_course.read().lectures
        known = lectures[int(lecture[:2])].equations if int(lecture[:2]) in lectures else {}
        page, _ = known.get(int(number), (None, None))
        return page and self.address(f"lectures/{page}", f"equation-{number}")

    def address(self, page, place):
        return f"{self.relative(page)}#{place}"


def exercises(text):
    """(start, end, address, {}) of each exercise that a text names."""
    for found in EXERCISE.finditer(text):
        if address := exercise_pages().get(found[0]):
            yield *found.span(), f"../{address}", {}


def definitions(env, page):
    """The glossary's words on a page: a pattern, {word: (anchor, its definition's first sentence)}.
    """
    found = {}
    for term in env.get_doctree("glossary").findall(nodes.term):
        said, word = term.parent.next_node(nodes.paragraph), term.astext()
        leads = [link.get("reftarget") for link in said.findall(addnodes.pending_xref)]
        if word not in EVERYDAY or page in leads:
            sentence = SENTENCE.match(" ".join(said.astext().split()))[0]
            found[word[0].lower() + word[1:]] = term["ids"][0], sentence
    words = "|".join(f"(?i:{word[0]}){re.escape(word[1:])}"
                     for word in sorted(found, key=len, reverse=True))
    return re.compile(rf"\b({words})(?:s|es)?\b"), found


def _above(node, kinds):
    """The nearest element of these kinds that holds a node, or None."""
    node = node.parent
    while node is not None and not isinstance(node, kinds):
        node = node.parent
    return node


def _reference(shown, address, **more):
    return nodes.reference("", "", shown, internal=True, refuri=address, **more)


def _replace(text, found):
    """Put links into a text. Where two overlap, the first stays."""
    parts, done = [], 0
    for start, end, address, more in sorted(found, key=lambda one: one[:2]):
        if start >= done:
            parts += [nodes.Text(text[done:start]),
                      _reference(nodes.Text(text[start:end]), address, **more)]
            done = end
    if parts:
        text.parent.replace(text, [*parts, nodes.Text(text[done:])])


def setup(app):
    app.add_post_transform(References)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
