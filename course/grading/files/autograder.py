"""Runs the checks of the course in this folder, and writes result.json as Classroom 50 wants it.

For Classroom 50, this file is autograder.py of the assignment. A workflow can run it as well. The
code that is checked runs in the same process as its checks, so this is for feedback: marks that
count come from `python3 -m course grade`.
"""
import datetime
import json
import os
import subprocess
import sys
from pathlib import Path


def main():
    done = subprocess.run([sys.executable, "-m", "course", "check", "--json", "board.json"],
                          stdout=subprocess.PIPE, encoding="utf-8",
                          env={**os.environ, "COLUMNS": "100"})
    print(done.stdout)
    if not Path("board.json").exists():
        return done.returncode or 1
    board = json.loads(Path("board.json").read_text("utf-8"))
    Path("result.json").write_text(json.dumps(result(board, os.environ), indent=2), "utf-8")
    if summary := os.environ.get("GITHUB_STEP_SUMMARY"):
        Path(summary).write_text(f"```\n{done.stdout}\n```\n", "utf-8")
    return 0


def result(board, settings):
    """The payload classroom50/result/v1, from a board and the runner's settings."""
    owner = settings.get("USERNAME") or settings.get("GITHUB_REPOSITORY_OWNER", "")
    now = datetime.datetime.now(datetime.UTC)
    tests = [{"test-name": f"{entry['number']} {entry['name']}",
              "passed": entry["verdict"] == "done",
              "score": entry["points"] * (entry["verdict"] == "done"),
              "max-score": entry["points"]} for entry in board["exercises"]]
    return {"schema": "classroom50/result/v1", "classroom": settings.get("CLASSROOM", ""),
            "assignment": settings.get("ASSIGNMENT", ""), "usernames": [owner], "owner": owner,
            "assignment_type": "individual", "submission": settings.get("SUBMISSION_TAG", ""),
            "commit": settings.get("COMMIT_URL", ""), "release": settings.get("RELEASE_URL", ""),
            "review": settings.get("REVIEW_URL", ""),
            "datetime": now.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "score": board["points"], "max-score": board["of"], "tests": tests}


if __name__ == "__main__":
    sys.exit(main())
