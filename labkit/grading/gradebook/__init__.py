"""From results to grades, and to the tables that platforms import.

    sheets       tables as CSV
    lateness     when something was handed in, and what that costs
    overrides    points by hand, each with its reason
    people       groups, and due times of single students
    records      what is kept of one student's work
    worth        the points of a record
    tables       grades.csv
    earlier      the records that earlier runs left
    rosters      what Canvas and Moodle export and import
    book         all of this for a class
    handback     feedback.zip
"""
