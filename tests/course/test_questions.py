"""Questions are short, and typing the equation that is printed is a right answer."""
import ast
import re

import numpy as np

from labkit import exercises, places
from labkit.upkeep import changes, hours, mistakes


def words(text):
    """How many words a reader has to take in: a shape is one, and examples are looked at."""
    text = re.sub(r"^ *>>>.*(?:\n.*\S.*)*", "", text, flags=re.M)
    return len(re.sub(r"\([^()]*,[^()]*\)|->", lambda part: "s" * (part[0] != "->"), text).split())


def core(topic):
    return [exercise for exercise in exercises.topic_exercises(topic) if not exercise.is_extra]


def docstring(topic, exercise):
    return ast.get_docstring(changes.function_of(topic, exercise))


def questions():
    """[(number, words of its question, words of its fine print)] of the core."""
    texts = [(exercise.number, *docstring(topic, exercise).partition("Fine print.")[::2])
             for topic in exercises.topics() for exercise in core(topic)]
    return [(number, words(question), words(fine)) for number, question, fine in texts]


def test_the_core_can_be_finished():
    """A lab takes longer than an evening, with its steps, or the course longer than a term has.

    Lab 8, the outline, has two lectures and two evenings.
    """
    labs = range(1, len(exercises.LABS) + 1)
    number = {lab: len(hours.core(lab)) for lab in labs}
    assert [lab for lab in labs if not 5 <= number[lab] <= (14 if lab == 8 else 10)] == [], number
    assert [lab for lab in labs if hours.hours(lab) > {8: 3.5, 14: 3}.get(lab, 2.5)] == []
    assert [lab for lab in labs if sum(one.points > 0 for one in hours.core(lab)) > 8] == []
    assert sum(one.points > 0 for lab in labs for one in hours.core(lab)) <= 70
    assert sum(map(hours.hours, labs)) <= 42


def test_questions_are_short():
    """A question reads like a standard. (A whole function needs more words than a step.)"""
    _, question, fine = zip(*questions(), strict=True)
    assert np.median(question) <= 37 and np.quantile(question, 0.9) <= 62
    assert max(fine) <= 60


def test_the_equation_as_it_is_printed_answers_the_question(run_module, tmp_path):
    """A check of the question asks for what only the fine print says."""
    for topic in exercises.topics():
        texts = [text for _, _, text, _ in mistakes.changed_functions("literal", topic)]
        (tmp_path / f"{topic}.py").write_text(
            "\n\n".join([exercises.read(exercises.reference(topic)), *texts]), "utf-8")
    done = run_module(places.ROOT, "course", "check", "--impl", tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_fine_print_has_an_answer_that_knows_nothing_of_it():
    """A check of the question asks for what only the fine print says, and nobody has tried."""
    for topic in exercises.topics():
        typed = {exercise for _, exercise, _, _ in mistakes.changed_functions("literal", topic)}
        fine = {exercise for exercise in core(topic) if "Fine print." in docstring(topic, exercise)}
        assert fine <= typed <= {*core(topic)}, topic
