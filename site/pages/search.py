"""The records of the search: each section, function and word of the glossary, as a reader sees it.

An extension of Sphinx, in place of its own search, which fetches whole pages to quote a line. When
the pages are made, it writes search_records.js for static/search.js.
"""
import base64
import gzip
import html
import json
import re

from docutils import nodes
from sphinx import addnodes

from . import put, sources_course

SKIPPED = (nodes.literal_block, nodes.doctest_block, nodes.math_block, nodes.image,
           nodes.comment, nodes.title, nodes.term, addnodes.index, addnodes.toctree,
           addnodes.desc_signature)
INLINE = re.compile(r"</?(?:a|b|code|em|i|span|strong|sub|sup)\b[^>]*>")
UNSEEN = re.compile(r"<(pre|svg|math|script|style)\b.*?</\1>|<[^>]*>", re.DOTALL)
SAID_ELSEWHERE = re.compile(r'<(\w+) class="(?:docutils )?(?:belongs|exercises|marks|'
                            r'modules|overview|read-on)".*?</\1>', re.DOTALL)
SHAPE = re.compile(r"(?:\s->)?\s\((?=\.{3}|[^()]*,)"
                   r"(?:(?:\.{3}|[A-Z]\w*|[1-9]\d*)(?:,\s*|(?=\))))+\)")
EQUATION = re.compile(r"\b([Ee])q\. \(")
OBJECTS = "function", "class", "exception"
KINDS = {"lectures": "Lecture", "labs": "Lab", "reference": "Annotated source",
         "given": "Given code"}


def setup(app):
    app.connect("builder-inited", lambda app: setattr(app.builder, "search", False))
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(app, fault):
    """Write all records, packed: a browser loads them from disk, too."""
    if fault:
        return
    found = [record for name in sorted(app.env.found_docs)
             for record in records(name, app.env.get_doctree(name))]
    columns = json.dumps([*zip(*found, strict=True)], ensure_ascii=False, separators=(",", ":"))
    packed = gzip.compress(columns.encode("utf-8"), mtime=0)
    put(app.outdir / "search_records.js",
        f'const PACKED_RECORDS = "{base64.b64encode(packed).decode()}";\n')


def short(tex):
    """A formula that is read as it is typed, e_0. Others are left out: …"""
    return "…" if "\\" in tex or len(tex) > 16 else tex


def records(name, page):
    """A page -> [address, title, place, text] of each of its parts. Code and equations stay out."""
    parts = []
    gather(page, parts)
    folder, asked = name.rpartition("/")[0], sources_course.read().exercises
    head = page_title(name, parts[0][1])
    yield [f"{name}.html", head, KINDS.get(folder, "Page"), shown(parts[0][2])]
    place = f"{name}.py" if folder in ("reference", "given") else head.partition(":")[0]
    if name == "labs/index":  # its sections are pages
        return
    for anchor, title, words in parts[1:]:
        if anchor.startswith("exercise-"):
            title = f"Exercise {title}"
        # An exercise is found on its lab's page, what a lecture cites in the bibliography.
        if anchor not in asked and title != "Sources and further reading":
            yield [f"{name}.html#{anchor}", title, place, shown(words)]


def shown(words):
    """The words of a part as a text, without arrays' shapes."""
    text = SHAPE.sub("", " ".join("".join(words).split()))
    return EQUATION.sub(r"\1quation (", text)


def page_title(name, title):
    """08 Antialiasing: an outline -> Lecture 8. Antialiasing: an outline."""
    if not name.startswith("lectures/"):
        return title
    number, _, words = title.partition(" ")
    return f"Lecture {number.removeprefix('0')}. {words}"


def gather(node, parts):
    """Append [anchor, title, words] of all that begins in a node; its words belong to the last."""
    if isinstance(node, SKIPPED) or {"cell_input", "letters"} & {*node.get("classes", ())}:
        return
    begun = part(node)
    if begun:
        parts.append(begun)
    for child in node.children:
        if not isinstance(child, nodes.Text):
            gather(child, parts)
        elif parts:
            said = {nodes.raw: seen, nodes.math: short}.get(type(node), str)
            parts[-1][2].append(said(child.astext()))
    if parts and not isinstance(node, nodes.Inline):
        parts[-1][2].append(" ")


def seen(source):
    """HTML -> the words that a reader sees."""
    source = INLINE.sub("", SAID_ELSEWHERE.sub(" ", source))
    return html.unescape(UNSEEN.sub(" ", source))


def part(node):
    """[anchor, title, no words yet] of what a reader looks for, or None."""
    if isinstance(node, nodes.section):
        return [node["ids"][0], node.next_node(nodes.title).astext(), []]
    if isinstance(node, addnodes.desc) and node["objtype"] in OBJECTS:
        anchor = node[0]["ids"][0]
        return [anchor, anchor.rpartition(".")[2], []]
    if isinstance(node, nodes.definition_list_item) and node[0]["ids"]:
        return [node[0]["ids"][0], node[0].astext(), []]
    return None
