"""What instructors and students read.

    report      a student's page
    overview    the class's page
    scoreboard  of an open task
    unusual     what a person should look at, in each submission
"""
