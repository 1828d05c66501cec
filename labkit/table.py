"""What labkit is told of a course: the file labs.toml in the course's folder."""
import tomllib

from .places import ROOT, read_whole

TABLE = tomllib.loads(read_whole(ROOT / "labs.toml").decode("utf-8"))
NAME = TABLE["name"]
TITLE = TABLE["title"]
COMMAND = f"python3 -m {NAME}"
WHEN_DONE = TABLE["when_done"]  # what the board says then
LABS = tuple(map(tuple, TABLE["labs"]))  # the topics of each lab, one module each
TASKS = tuple(TABLE.get("tasks", ()))     # open tasks, one module of tasks/ each
GIVEN = tuple(TABLE["given"])            # modules that labs may import
USED = tuple(TABLE["used"])              # files that labs and checks use, as patterns
README = ROOT / TABLE["readme"]          # of a hand-out, with places for its labs
HANDED_OUT = tuple(TABLE["handed_out"])  # more of a hand-out's files
WITH_LABS = TABLE["with_labs"]           # {topic: pattern of files that come with it alone}
COMPLETE = TABLE["complete"]             # the folder of topics with nothing to write
FAST = TABLE.get("fast", COMPLETE)       # the folder of what is only faster than a topic
