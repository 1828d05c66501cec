"""The text of made-up exercises and of their checks."""
SPOILT = """

@pytest.fixture
def spoilt():
    yield
    raise OSError("spoilt")
"""


def exercise_text(number, name, question, *answer, points=1, inputs="x", kind="exercise"):
    """A function that is an exercise, below two blank lines. points 0: it is a step."""
    mark = f"{kind} {number} ({points} point{'s' * (points != 1)})" if points else f"step {number}"
    return "\n".join(["", "", f"def {name}({inputs}):  # {mark}",
                      f'    """{question}"""', *(f"    {line}" for line in answer), ""])


def check_text(number, name, mistake, *body, inputs="impl", marks=(), fine_print=False):
    """A check of an exercise, below two blank lines. marks: lines between its mark and its def."""
    fine = ", fine_print=True" if fine_print else ""
    return "\n".join(["", "", f'@exercise("{number}"{fine})', *marks, f"def test_{name}({inputs}):",
                      f'    """{mistake}"""', *(f"    {line}" for line in body), ""])
