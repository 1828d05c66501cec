"""The command line: what was asked for, and how it ended. A course may add to COMMANDS."""
import argparse
import dis
import os
import sys
from pathlib import Path

from . import memory
from .commands import COMMANDS, DO, FOR_TEACHERS, LOOK, TEACH, WORK
from .places import ROOT, is_handout
from .table import COMMAND, HANDED_OUT, LABS, NAME, TITLE

EXAMPLES = {  # what one types after COMMAND: what comes of it
    "check": "the board of all labs",
    f"check {LABS[0][0]}": "one lab, by its topic",
    "check 1.1": "one exercise",
    "check 1 --pictures": "expected, got and difference as pictures",
    "COMMAND --help": "more about one command"}


def main(argv: list[str] | None = None) -> int:
    """Run one command -> its exit status: 0 well, 1 something failed, 2 cannot be done, 130 Ctrl-C.

    What the user can mend is said in one line. Everything else is a defect: traceback.
    """
    memory.hold()
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="replace")  # for consoles that lack a character
    asked = arguments(sys.argv[1:] if argv is None else argv)
    try:
        return asked.command(asked)
    except KeyboardInterrupt as stopped:
        if str(stopped):
            print(f"{NAME}: {stopped}", file=sys.stderr)
        return 130
    except BrokenPipeError:  # whoever reads along has seen enough, as in: check | head
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (OSError, ValueError, NotImplementedError) as error:
        if not can_be_mended(error):
            raise
        unwritten = isinstance(error, NotImplementedError)
        print(f"{NAME}: {error}{' is not written yet' if unwritten else ''}", file=sys.stderr)
        return 2


def can_be_mended(error):
    """Can the user mend it? Yes: a file that fails, or what our own code raises.

    What Python or a library raises in between is a defect of the code that called it.
    """
    cause = error.__traceback__
    while cause.tb_next:
        cause = cause.tb_next
    code = cause.tb_frame.f_code
    ours = any(Path(code.co_filename).resolve().is_relative_to(ROOT / folder)
               for folder in ("labkit", "labs", *(each.split("/")[0] for each in HANDED_OUT), NAME))
    raised = code.co_code[cause.tb_lasti] == dis.opmap["RAISE_VARARGS"]
    return isinstance(error, OSError) or (ours and raised)


def there():
    """{section: {name: Command}} of the commands that this copy has."""
    sections = {section: {} for section in (LOOK, DO, TEACH, WORK)
                if not (is_handout() and section in FOR_TEACHERS)}
    for name, command in COMMANDS.items():
        if command.section in sections:
            sections[command.section][name] = command
    return {section: commands for section, commands in sections.items() if commands}


def page():
    """What the course is, each command with the first line of its docstring, and examples."""
    parts = [TITLE]
    for section, commands in there().items():
        parts += ["", section]
        parts += [f"  {command.usage:22}{command.function.__doc__.splitlines()[0]}"
                  for command in commands.values()]
    parts += ["", "examples"]
    parts += [f"  {COMMAND} {typed:22}{result}" for typed, result in EXAMPLES.items()]
    return "\n".join(parts)


class Parser(argparse.ArgumentParser):
    """Tells a mistake in one line, without the usage."""

    def error(self, message):
        self.exit(2, f"{NAME}: {message}; {self.prog} --help says more\n")


def arguments(argv):
    """What was asked for, out of the commands that this copy has. Without a command, the page."""
    parser = Parser(prog=COMMAND, usage="%(prog)s COMMAND ...", description=page(),
                    formatter_class=argparse.RawDescriptionHelpFormatter)

    def show_help(_):
        parser.print_help()
        return 0

    parser.set_defaults(command=show_help)
    commands = parser.add_subparsers(prog=parser.prog, metavar="COMMAND", help=argparse.SUPPRESS)
    names = {name: one for section in there().values() for name, one in section.items()}
    for name, command in names.items():
        made = commands.add_parser(name, description=command.function.__doc__)
        made.set_defaults(command=command.function)
        for flags, settings in command.options:
            made.add_argument(*flags, **settings)
    if argv and argv[0] in COMMANDS.keys() - names.keys():
        parser.error(f"{argv[0]} is for teachers, and this is a copy for students")
    return parser.parse_args(argv)
