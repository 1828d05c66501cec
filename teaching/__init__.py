"""What a teacher needs, from the first Monday to the exam. README.md is the door.

    exam     a paper of twelve questions, whose numbers come from a seed
"""
