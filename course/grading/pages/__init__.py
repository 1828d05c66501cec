"""What instructors and students read.

    report        a student's page, and Gradescope's results
    overview      the class's page
    similarity    answers that are alike, as pairs, and those that are like the reference
    numeric       backward passes that try functions out
    unusual       what a person should look at, in each submission
    side_by_side  their page, and similar.csv
"""
