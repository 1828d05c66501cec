"""What instructors and students read.

    report        a student's page, and Gradescope's results
    overview      the class's page
    similarity    answers that are alike, as pairs
    side_by_side  their page, and similar.csv
"""
