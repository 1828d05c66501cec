# For Gradescope's "Manual Docker Configuration", from the folder in which the zip for it is unpacked:
#     docker build -t YOU/lab2 -f labkit/grading/files/gradescope.Dockerfile .
FROM gradescope/autograder-base:ubuntu-22.04
COPY . /autograder/source
RUN bash /autograder/source/setup.sh && cp /autograder/source/run_autograder /autograder/ \
    && chmod +x /autograder/run_autograder
