"""What instructors and students read.

    report    a student's page
    overview  the class's page
    unusual   what a person should look at, in each submission
"""
