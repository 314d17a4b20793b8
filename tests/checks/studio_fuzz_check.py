"""Random and malformed requests: the studio stays alive, and what it refuses changes nothing.

usage: studio_fuzz_check.py PROGRAM SOURCE_DIR [REQUESTS]
"""
import concurrent.futures
import copy
import http.client
import json
import os
import random
import socket
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from studio_server import Studio, dummy_pages

program = os.path.abspath(sys.argv[1])
requests = int(sys.argv[3]) if len(sys.argv) > 3 else 100_000
work = tempfile.mkdtemp(prefix="rhombloom-studio-")
design = os.path.join(work, "design.json")
studio = Studio(program, design, dummy_pages())
for body in ({"op": "place", "shape": "ball-12"}, {"op": "place", "id": "other", "shape": "ball-6", "position_mm": [700, 0, 0]}):
    status, state = studio.post("/api/apply", {"revision": studio.get("/api/state")[1]["revision"], "operation": body})
    assert status == 200, state
revision = state["revision"]
saved = open(design, "rb").read()

OPERATIONS = [
    {"op": "place", "id": "third", "shape": "ball-6", "position_mm": [0, 0, 300], "rotation_deg": [0, 0, 0]},
    {"op": "extrude", "on": "body", "apex": {"vertex": 3}, "brush": "ball-6", "by_mm": [0, 0, 90], "candidate": 0, "symmetric": False},
    {"op": "merge", "on": "body", "with": "other", "candidate": 0},
    {"op": "open", "on": "body", "elements": [{"element": 2}], "purpose": "cable"},
    {"op": "flip", "on": "body", "element": {"toward": [0, 0, 1]}},
    {"op": "layout", "id": "drawn", "elements": [{"x_mm": 0, "y_mm": 0}, {"x_mm": 100, "y_mm": 0, "facing": "back"}], "joins": [{"element": 0, "side": 1, "to": 1, "to_side": 0}]},
]
BODIES = {
    "apply": lambda r: {"operation": r.choice(OPERATIONS)}, "edit": lambda r: {"index": r.choice([0, 1, 7]), "operation": r.choice(OPERATIONS)}, "remove": lambda r: {"index": r.choice([0, 5])},
    "undo": lambda r: {}, "redo": lambda r: {}, "move": lambda r: {"part": "other", "move_mm": [1, 2, 3], "turn": [0, 0, 0, 1]}, "delete": lambda r: {"part": "other"},
    "document": lambda r: {"title": "x", "symmetry": {"mirror": [1, 0, 0]}}, "replace": lambda r: {"design": {"rhombloom": 1, "operations": []}},
    "pull": lambda r: {"pull": r.randrange(9), "on": "body", "vertex": 3, "brush": "ball-6", "by_mm": [0, 0, 90], "symmetric": False}, "merge": lambda r: {"on": "body", "with": "other", "move_mm": [-600, 0, 0], "candidate": 0},
    "try": lambda r: {"operation": r.choice(OPERATIONS), "alone": False}, "fabricate": lambda r: {"material": "none", "machine": "none", "paper": "a5"}, "layouts": lambda r: {"layouts": [{"name": "a", "elements": [], "joins": []}]},
}
CHANGING = {"apply", "edit", "remove", "undo", "redo", "move", "delete", "document", "replace"}
HEAVY = {"pull", "merge", "try", "apply", "edit"}
ODD = [None, True, -1, 0, 1e308, -1e308, 2**63, 10**30, 1e-320, "", "x" * 300, "\u0000", "ünïcödé", [], {}, [[]], {"a": {"b": {}}}, [1, 2], ["a", "b", "c"], [1e9, -1e9, 0], "body", "ball-0", "ball-31", "polar-0x0", "nothing"]


def mutate(value, r):
    """The value with one or more places replaced, dropped, added or renamed."""
    value = copy.deepcopy(value)
    for _ in range(r.choice([1, 1, 2, 4])):
        at = value
        while isinstance(at, (dict, list)) and at and r.random() < 0.7:
            key = r.choice(list(at) if isinstance(at, dict) else range(len(at)))
            if not isinstance(at[key], (dict, list)) or r.random() < 0.4:
                break
            at = at[key]
        if isinstance(at, dict) and at:
            key = r.choice(list(at))
            what = r.random()
            if what < 0.6:
                at[key] = copy.deepcopy(r.choice(ODD))
            elif what < 0.8:
                del at[key]
            else:
                at[r.choice(["x", key + "s", ""])] = copy.deepcopy(r.choice(ODD))
        elif isinstance(at, list):
            at.insert(r.randrange(len(at) + 1), copy.deepcopy(r.choice(ODD))) if r.random() < 0.5 or not at else at.pop()
    return value


def noise(r, most=200):
    return bytes(r.randrange(256) for _ in range(r.randrange(most)))


def spoilt(data, r):
    data = bytearray(data)
    for _ in range(r.randrange(1, 6)):
        at = r.randrange(len(data) + 1)
        what = r.random()
        if what < 0.4 and at < len(data):
            data[at] = r.randrange(256)
        elif what < 0.7:
            del data[at:at + r.randrange(1, 9)]
        else:
            data[at:at] = r.choice([b"{", b"[", b'"', b"\\u0000", b"1e999", b"NaN", b"[" * 400, noise(r, 9)])
    return bytes(data)


def body_of(name, r):
    """A body that is surely refused when its request could change the document."""
    known = {"revision": revision, **BODIES[name](r)}
    if name in CHANGING:
        known["revision"] = r.choice([revision - 1, revision + 1, 0, 10**9])
        if r.random() < 0.5:
            # The present revision and a key that nothing expects: read in full, then refused.
            known["revision"] = revision
            known["unexpected"] = copy.deepcopy(r.choice(ODD))
            return json.dumps(known).encode()
    if name in ("fabricate", "layouts"):
        known["unexpected"] = 1
    what = r.random()
    if what < 0.6:
        changed = mutate(known, r)
        if name in CHANGING:
            changed["revision"] = known["revision"]
        if name in ("fabricate", "layouts"):
            changed["unexpected"] = 1
        return json.dumps(changed).encode()
    if what < 0.85:
        return spoilt(json.dumps(known).encode(), r) + (b"}" if name in CHANGING or name in ("fabricate", "layouts") else b"")
    return noise(r)


def raw(r):
    """Bytes that are no proper request."""
    right = f"POST /api/undo HTTP/1.1\r\nHost: {studio.host}\r\nOrigin: http://{studio.host}\r\nX-Rhombloom-Token: {studio.token}\r\nContent-Length: 2\r\n\r\n{{}}".encode()
    return r.choice([lambda: noise(r, 400), lambda: spoilt(right, r), lambda: right[:r.randrange(len(right))] + noise(r, 30), lambda: b"GET /" + b"a" * r.choice([10, 9000, 70000]) + b" HTTP/1.1\r\n\r\n",
                     lambda: b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * r.choice([1, 200]) + b"\r\n", lambda: right.replace(b"Content-Length: 2", r.choice([b"Content-Length: -1", b"Content-Length: 99999999999999999999", b"Transfer-Encoding: chunked", b"Content-Length: x"]))])()


def send_raw(r):
    with socket.create_connection(("127.0.0.1", studio.port), timeout=30) as connection:
        connection.sendall(raw(r))
        connection.shutdown(socket.SHUT_WR)
        while connection.recv(65536):
            pass


def random_request(r, connection, seen):
    names = list(BODIES)
    light = [n for n in names if n not in HEAVY]
    what = r.random()
    if what < 0.8:
        name = r.choice(light if r.random() < 0.75 else names)
        headers = list(studio.headers(True).items())
        if r.random() < 0.15:
            headers = [h for h in headers if r.random() < 0.7] + [(r.choice(["Host", "Origin", "X-Rhombloom-Token", "Cookie"]), r.choice(["", "x", "http://evil.example"]))]
        status, answer = studio.request("POST", "/api/" + name, body_of(name, r), headers, connection)
        if status == 200 and name in CHANGING:
            raise AssertionError(f"{name} was accepted: {answer[:200]!r}")
        if status >= 500:
            raise AssertionError(f"{name}: {status} {answer[:300]!r}")
    else:
        path = r.choice(["/", "/api/" + r.choice(names), "/api/thumbnail?shape=" + r.choice(["ball-6", "x", "%00", "%ff%fe", "a" * 900]), "/api/figures?count=" + r.choice(["-1", "x", "1e9", "", "99999999999999"]), "/kit/" + "".join(r.choice("abc/.%2e0") for _ in range(30)),
                         "/" + "".join(r.choice("abc/.%?&=#;+") for _ in range(r.randrange(40)))])
        status, answer = studio.request(r.choice(["GET", "GET", "HEAD", "PUT", "DELETE", "OPTIONS", "BREW"]), path.replace("#", ""), None, list(studio.headers(r.random() < 0.5).items()), connection)
    seen[status] = seen.get(status, 0) + 1


def worker(seed, count):
    r = random.Random(seed)
    connection, seen = studio.connect(), {}
    for k in range(count):
        try:
            if r.random() < 0.02:
                send_raw(r)
                seen["raw"] = seen.get("raw", 0) + 1
            else:
                random_request(r, connection, seen)
        except (http.client.HTTPException, ConnectionError, TimeoutError, OSError) as problem:
            if not studio.alive():
                raise AssertionError(f"the studio died of request {k} of worker {seed}") from problem
            connection.close()
            connection = studio.connect()
            seen["closed"] = seen.get("closed", 0) + 1
    return seen


began = time.time()
workers = 4
problems, total = [], {}
with concurrent.futures.ThreadPoolExecutor(workers) as pool:
    for job in [pool.submit(worker, seed, requests // workers) for seed in range(workers)]:
        try:
            for status, count in job.result().items():
                total[status] = total.get(status, 0) + count
        except AssertionError as problem:
            problems.append(str(problem))
if not studio.alive():
    problems.append("the studio is dead: " + studio.process.stderr.read()[-3000:])
else:
    status, state = studio.get("/api/state")
    if status != 200 or state["revision"] != revision:
        problems.append(f"the document was changed: revision {state.get('revision')} instead of {revision}")
    status, state = studio.post("/api/document", {"revision": revision, "title": "still here"})
    if status != 200:
        problems.append(f"the studio no longer works: {state}")
    errors = studio.stop()
    if errors.strip():
        problems.append("it complained: " + errors[-3000:])
if b"still here" not in open(design, "rb").read() or open(design, "rb").read().replace(b"still here", b"") != saved:
    problems.append("the file was changed")
print(f"{requests} requests in {time.time() - began:.1f} s, answers: {dict(sorted(total.items(), key=str))}")
print("\n".join(problems) or "alive, and the document is unchanged")
sys.exit(1 if problems else 0)
