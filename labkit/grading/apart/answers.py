"""The reference's answers to a worker that asks for an earlier exercise: as many as are needed.

What the reference's own solution asks for was found out before (Job.asks). A submission may ask for
about ten times as much. Beyond that, it is told to use its own function.
"""
from ... import exercises
from . import sandbox, wire
from .labs import before_it, exercise_numbers

LOOPS = 10            # loops name the same numbers again, so a submission may send more of them
FEW = 10_000          # bytes that each exercise may send to what another one of its lab asks


class Answers:
    """asked {exercise: {"topic.name": bytes}}: the reference was asked for.

    budget: what a submission may take, see Budget. start() -> a worker that runs.
    """

    def __init__(self, asks, topic, budget, start):
        """asks: of the Job. topic {exercise: its topic}."""
        self.asks = asks
        self.topic = topic
        self.budget = budget
        self.start = start
        self.asked = {}
        self.worker = None

    def answer(self, number, topic, name, question, has_own) -> bytes:
        """What the worker is told that asks for a function, while an exercise runs.

        number: the exercise. has_own: whether the worker has a function of its own for that.
        """
        asked = self.asked.setdefault(number, {})
        what = f"{topic}.{name}"
        asked[what] = asked.get(what, 0) + wire.size(question)
        if asked[what] <= self.allowed(number, what):
            return self.returned(number, topic, name, question)
        if has_own:
            return wire.encode(("own",))
        return wire.encode(("raised", "RuntimeError", f"{what} is not needed here, or not so "
                            "often, so the grader does not answer any more", (), ""))

    def allowed(self, number, what):
        """How many bytes of numbers an exercise may send to "topic.name"."""
        if self.asks is None:
            return self.budget.MOST_RECEIVED
        own = self.topic[number]
        of_lab = any(what in asks for other, asks in self.asks.items()
                     if self.topic.get(other) == own)
        return LOOPS * self.asks.get(number, {}).get(what, 0) + FEW * (
            of_lab and not what.startswith(f"{own}."))

    def returned(self, number, topic, name, question) -> bytes:
        """What the reference returns, found out in a worker of its own.

        Question and answer are passed on as they came: only the two workers look inside.
        """
        self.worker = self.worker or self.opened()
        try:
            return self.budget.timed(number, self.worker, wire.encode(("relay", topic, name)),
                                     question)
        except sandbox.Lost as lost:
            self.close()
            raise sandbox.Lost(f"in {topic}.{name}, which it asked for: {lost}") from None

    def opened(self):
        """A worker that has all modules of the reference. It serves all exercises."""
        worker = self.start()
        modules = tuple((topic, exercises.read(exercises.reference(topic)), ())
                        for topic in exercises.topics())
        opened = worker.exchange(("open", modules, ()), 60)
        assert opened[0] == "opened", opened  # topics are loaded in the order of exercises.LABS
        return worker

    def close(self):
        if self.worker:
            self.worker.close()
        self.worker = None


class Budget:
    """What a submission may take: seconds of a call, of an exercise, of all, and bytes."""

    MOST_RECEIVED = 1 << 30  # bytes of all that its workers send

    def __init__(self, limits):
        self.limits = limits
        self.spent = {}    # {exercise, or None for all of them: seconds}
        self.received = 0  # bytes

    def timed(self, number, worker, *payloads) -> bytes:
        """Payloads to a worker and one back, in the time that is left for this exercise."""
        for what, most, each in ((number, self.limits.exercise, "this exercise"),
                                 (None, self.limits.submission, "all exercises")):
            if self.spent.get(what, 0.0) >= most:
                raise sandbox.Lost(f"the {most:g} s for {each} are used up")
        payload = worker.relay(min(self.limits.call, self.limits.exercise), *payloads)
        self.received += len(payload)
        if self.received > self.MOST_RECEIVED:
            raise sandbox.Lost(f"all answers together have more than {self.MOST_RECEIVED >> 20} MB")
        for what in (number, None):
            self.spend(what, worker.spent)
        return payload

    def spend(self, what, seconds):
        self.spent[what] = self.spent.get(what, 0.0) + seconds


def may_ask(own, topic, earlier):
    """{name: number} of the exercises that an exercise of the topic `own` may ask for in `topic`.

    earlier {name: number}: those before it in its own topic.
    """
    return earlier if topic == own else exercise_numbers(topic) if topic in before_it(own) else {}
