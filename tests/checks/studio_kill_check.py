"""kill -9 at random moments during 200 scripted edits: the reopened document is the last one that was committed."""
import http.client
import json
import os
import random
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from studio_server import Studio, dummy_pages

program = os.path.abspath(sys.argv[1])
EDITS = 200
work = tempfile.mkdtemp(prefix="rhombloom-studio-")
design = os.path.join(work, "design.json")
pages = dummy_pages()
r = random.Random(7)
problems, kills, in_flight = [], 0, 0


def on_disk():
    return json.load(open(design)) if os.path.exists(design) else {"rhombloom": 1, "title": "", "operations": []}


def next_edit(state, number):
    """A request and the document it should lead to."""
    operations = state["operations"]
    place = {"op": "place", "id": f"part {number}", "shape": r.choice(["ball-6", "ball-12", "ball-30"]), "position_mm": [number * 400.0, 0.0, 0.0], "rotation_deg": [0.0, 0.0, 0.0]}
    what = r.random()
    if len(operations) > 5 and what < 0.25:
        return "remove", {"index": 0}, operations[1:], state["title"]
    if operations and what < 0.45:
        moved = dict(operations[-1], position_mm=[number * 400.0, 50.0, 0.0])
        return "edit", {"index": len(operations) - 1, "operation": moved}, operations[:-1] + [moved], state["title"]
    if what < 0.6:
        return "document", {"title": f"title {number}"}, operations, f"title {number}"
    return "apply", {"operation": place}, operations + [place], state["title"]


edit = 0
studio = Studio(program, design, pages)
state = studio.get("/api/state")[1]
while edit < EDITS:
    # A killer with a random fuse; several edits may pass before it strikes.
    fuse = threading.Timer(r.uniform(0.0, 0.12), studio.kill)
    fuse.start()
    committed = {"operations": state["operations"], "title": state["title"]}
    pending = committed
    try:
        while edit < EDITS:
            edit += 1
            name, body, operations, title = next_edit(state, edit)
            pending = {"operations": operations, "title": title}
            status, answer = studio.post("/api/" + name, {"revision": state["revision"], **body})
            if status != 200:
                problems.append(f"edit {edit} ({name}): {status} {answer}")
                break
            state = answer
            committed = {"operations": state["operations"], "title": state["title"]}
            if committed != pending:
                problems.append(f"edit {edit} ({name}) led somewhere else")
    except (http.client.HTTPException, ConnectionError, OSError, json.JSONDecodeError):
        pass
    fuse.join()
    studio.process.wait()
    kills += 1
    left = [name for name in os.listdir(work) if name not in ("design.json", "data")]
    found = {"operations": on_disk()["operations"], "title": on_disk()["title"]}
    if found == pending and found != committed:
        in_flight += 1  # committed, but killed before it could say so
    elif found != committed:
        problems.append(f"after kill {kills}: {len(found['operations'])} operations, title {found['title']!r}; committed were {len(committed['operations'])}, {committed['title']!r}")
    studio = Studio(program, design, pages)
    state = studio.get("/api/state")[1]
    if {"operations": state["operations"], "title": state["title"]} != found:
        problems.append(f"after kill {kills}: the reopened document is not the file's")
studio.stop()
print("\n".join(problems[:20]) or f"{EDITS} edits, {kills} kills: every reopened document is the last committed one ({in_flight} were committed without having been reported)")
sys.exit(1 if problems else 0)
