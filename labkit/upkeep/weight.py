"""How much code stands around the code that is taught, a row a house.

    python3 -m labkit.upkeep.weight

What is taught are the modules of reference/ with exercises, and tiny.py. Around them stands all
other code that git tracks. Not counted are labs/, which is made from reference/, and what others
wrote. A line is code if it holds more than a comment or a docstring. A known mistake that is
written as a change counts, too.
"""
import io
import subprocess
import tokenize
from collections import Counter

from .. import exercises, places

MOST = 43_842
TAUGHT = "taught"
NOT_COUNTED = "labs/", "site/static/vendor/"
CODE = ".py", ".js", ".mjs", ".html", ".css", ".sh", "/run"
CHANGE = *map(str, range(10)), "->", "and "  # how a line of a known mistake begins
WITHOUT = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
           tokenize.ENCODING, tokenize.ENDMARKER}


def lines_with_code(text: str) -> list[str]:
    """The lines of a Python text that hold code, without comments. Of another text: not blank ones.
    """
    lines, numbers, statement = text.splitlines(), set(), []
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            row, column = token.start
            if token.type == tokenize.COMMENT:
                lines[row - 1] = lines[row - 1][:column].rstrip()
            if token.type not in WITHOUT:
                statement.append(token)
            if token.type == tokenize.NEWLINE:
                if any(part.type != tokenize.STRING for part in statement):
                    numbers.update(*(range(part.start[0], part.end[0] + 1) for part in statement))
                statement = []
    except (tokenize.TokenError, SyntaxError):
        return [line for line in text.splitlines() if line.strip()]
    return [lines[number - 1] for number in sorted(numbers)]


def code_lines(text: str) -> int:
    return len(lines_with_code(text))


def lines_of(path: str, text: str) -> int:
    """How much code a tracked file holds: 0 for data, texts and lectures."""
    if path.startswith(("tests/mistakes/", "tests/literal/")) and path.endswith(".txt"):
        return sum(line.startswith(CHANGE) for line in text.splitlines())
    if path.endswith(".py"):
        return code_lines(text)
    return sum(line.strip() != "" for line in text.splitlines()) if path.endswith(CODE) else 0


def house(path: str) -> str:
    """The folder at the top that a file lies in; a house's own tests are told apart."""
    first, _, rest = path.partition("/")
    return first + (", its tests" if "/tests/" in path else "") if rest else "the rest"


def houses() -> Counter:
    """{house: lines of code}, of all that git tracks."""
    taught = {f"reference/{topic}.py" for topic in (*exercises.asking_topics(), "tiny")}
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=places.ROOT, capture_output=True,
                            check=True, encoding="utf-8").stdout
    found = Counter()
    for path in listed.split("\0"):
        if (places.ROOT / path).is_file() and not path.startswith(NOT_COUNTED):
            text = (places.ROOT / path).read_bytes().decode("utf-8", "replace")
            found[TAUGHT if path in taught else house(path)] += lines_of(path, text)
    return +found


def around(found: Counter) -> int:
    """The lines around what is taught."""
    return found.total() - found[TAUGHT]


if __name__ == "__main__":
    everything = houses()
    for name, lines in everything.most_common():
        print(f"{lines:7,}  {name}")
    print(f"{around(everything):7,}  around what is taught; at most {MOST:,}")
