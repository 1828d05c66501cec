"""Exercises as functions, checks as tests, and what becomes of them. It knows no topic.

labs.toml tells it of a course. A course of other exercises has this folder, and its own labs.toml.

    places       where things lie, and files read and written whole
    table        what it is told of a course: labs.toml
    contract     what goes into an exercise, and what may come out
    suspicions   common mistakes that show in the numbers alone
    memory       freed arrays stay with the process
    exercises    what exercises there are
    imports      what labs import, and what is handed in with them
    lab_text     their answers, taken out of a module and put back
    checks       assertions, hints, the report: the pytest plugin
    verdicts     what became of an exercise: done, failing, blocked by 2.1
    tasks        open tasks: their scorers, and scores at home
    board        a screen: what is done, and what to do next
    upkeep       what makes labs, hints and notebooks
    grading      hand out, grade, report
    commands     what each command takes, and what it starts
    cli          the command line: its help, its errors
    __main__     starts it
"""
