"""The studio answers its own page and nobody else: every forbidden request is sent once."""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from studio_server import Studio, dummy_pages

program = os.path.abspath(sys.argv[1])
work = tempfile.mkdtemp(prefix="rhombloom-studio-")
design = os.path.join(work, "design.json")
pathlib.Path(work, "secret.json").write_text('{"rhombloom": 1, "secret": "tell nobody"}')
problems, checked = [], 0
studio = Studio(program, design, dummy_pages())
host, own, token = studio.host, f"http://{studio.host}", studio.token
place = {"revision": 1, "operation": {"op": "place", "shape": "ball-6"}}
changing = ["apply", "edit", "remove", "undo", "redo", "move", "delete", "document", "replace"]
posting = changing + ["pull", "merge", "hint", "try", "fabricate", "layouts"]


def check(what, condition, answer=""):
    global checked
    checked += 1
    if not condition:
        problems.append(f"{what}: {answer}")


def refused(what, status, method, path, body=None, headers=None):
    got, answer = studio.request(method, path, body, headers)
    check(what, got == status, f"{got} instead of {status}: {answer[:200]!r}")
    check(what + ": no CORS", not any(h.lower().startswith("access-control") for h in studio.last_headers), studio.last_headers)


def head(**changes):
    """The right headers of a POST, with changes: None leaves one out, a list repeats it."""
    right = {"Host": host, "Origin": own, "X-Rhombloom-Token": token, "Content-Type": "application/json"}
    right.update({name.replace("_", "-"): value for name, value in changes.items()})
    pairs = []
    for name, value in right.items():
        pairs += [(name, v) for v in (value if isinstance(value, list) else [value]) if v is not None]
    return pairs


# Bound to this machine alone.
addresses = subprocess.run(["cat", "/proc/net/tcp", "/proc/net/tcp6"], capture_output=True, text=True).stdout
listening = [line.split()[1] for line in addresses.splitlines() if line.split()[1:2] and line.split()[3] == "0A" and line.split()[1].endswith(f":{studio.port:04X}")]
check("listens on 127.0.0.1 only", listening == [f"0100007F:{studio.port:04X}"], listening)

# Foreign hosts: a name that was made to resolve here.
for name in ("evil.example", f"evil.example:{studio.port}", "127.0.0.1", f"127.0.0.1:{studio.port + 1}", f"127.0.0.1.evil.example:{studio.port}", f"[::1]:{studio.port}", f"127.0.0.1:{studio.port}.", f"0.0.0.0:{studio.port}", ""):
    refused(f"Host {name!r}", 421, "GET", "/", headers=[("Host", name)])
    refused(f"Host {name!r}, POST", 421, "POST", "/api/apply", place, head(Host=name))
refused("two Hosts", 421, "GET", "/", headers=[("Host", host), ("Host", "evil.example")])
refused("no Host", 421, "GET", "/", headers=[])

# Foreign pages.
for path in posting:
    for origin in (None, "null", "http://evil.example", f"https://{host}", f"http://localhost:{studio.port}", own + "/", own + ".evil.example", f"http://127.0.0.1:{studio.port + 1}", ""):
        refused(f"Origin {origin!r} to {path}", 403, "POST", "/api/" + path, place, head(Origin=origin))
    refused(f"two Origins to {path}", 403, "POST", "/api/" + path, place, head(Origin=[own, "http://evil.example"]))
    for site in ("cross-site", "same-site", "none"):
        refused(f"Sec-Fetch-Site {site} to {path}", 403, "POST", "/api/" + path, place, head(Sec_Fetch_Site=site))
    for wrong in (None, "", "0" * 32, token[:-1], token + "0", token.upper() + "Z"):
        refused(f"token {wrong!r} to {path}", 403, "POST", "/api/" + path, place, head(X_Rhombloom_Token=wrong))
    refused(f"two tokens to {path}", 403, "POST", "/api/" + path, place, head(X_Rhombloom_Token=[token, "0" * 32]))
    refused(f"token in the query of {path}", 403, "POST", f"/api/{path}?X-Rhombloom-Token={token}", place, head(X_Rhombloom_Token=None))
    refused(f"token in a cookie to {path}", 403, "POST", "/api/" + path, place, head(X_Rhombloom_Token=None, Cookie=f"X-Rhombloom-Token={token}"))
for path in ("state", "design", "revision", "geometry", "shapes", "piece", "choices", "kit", "layouts", "figures?count=1", "thumbnail?shape=ball-6"):
    refused(f"GET {path} without a token", 403, "GET", "/api/" + path, headers=[("Host", host)])
    refused(f"GET {path} from another page", 403, "GET", "/api/" + path, headers=[("Host", host), ("X-Rhombloom-Token", token), ("Origin", "http://evil.example")])
    refused(f"GET {path} cross-site", 403, "GET", "/api/" + path, headers=[("Host", host), ("X-Rhombloom-Token", token), ("Sec-Fetch-Site", "cross-site")])
refused("the page inside another site", 403, "GET", "/", headers=[("Host", host), ("Sec-Fetch-Site", "cross-site")])

# Other methods, a preflight among them.
for method in ("PUT", "DELETE", "PATCH", "OPTIONS"):
    refused(method, 405, method, "/api/apply", None, head())
for path in changing:
    refused(f"GET /api/{path}", 405, "GET", "/api/" + path)

# No path reaches the file system.
names = ["/secret.json", "/design.json", "/../secret.json", "/..%2fsecret.json", "/%2e%2e/secret.json", "//etc/passwd", "/etc/passwd", "/kit/../secret.json",
         "/kit//etc/passwd", "/kit/" + "0" * 32 + "/README.txt", "/kit/%2e%2e/%2e%2e/etc/passwd", "/api/../secret.json", "/index.html%00.json", "/studio.js/../../secret.json",
         "/.git/config", "/kit//README.txt", "/kit/"]
for name in names:
    status, answer = studio.request("GET", name)
    check(f"GET {name}", status == 404 and b"secret" not in answer and b"root:" not in answer, f"{status} {answer[:80]!r}")
for shape in ("../../secret", "/etc/passwd", "ball-6\0", "", "x" * 5000):
    status, answer = studio.request("GET", "/api/thumbnail?shape=" + __import__("urllib.parse").parse.quote(shape))
    check(f"thumbnail of {shape[:20]!r}", status == 422 and b"root:" not in answer, f"{status} {answer[:80]!r}")

# Limits: a body too large, a request that never arrives.
status, answer = 0, b""
try:
    status, answer = studio.request("POST", "/api/apply", b" " * 9_000_000, head())
except (ConnectionError, OSError) as problem:
    status = 413 if isinstance(problem, (BrokenPipeError, ConnectionResetError)) else 0
check("a body of 9 MB", status == 413, status)
with socket.create_connection(("127.0.0.1", studio.port), timeout=15) as slow:
    slow.sendall(b"POST /api/apply HTTP/1.1\r\nHost: " + host.encode())
    try:
        ended = slow.recv(1000)
    except TimeoutError:
        ended = None
check("half a request is given up", ended is not None, "still waiting after 15 s")

# One request a connection: what follows a refused one, its body for example, is never read as another.
hidden = f"GET /api/state HTTP/1.1\r\nHost: {host}\r\nX-Rhombloom-Token: {token}\r\n\r\n".encode()
for first in (f"POST /api/undo HTTP/1.1\r\nHost: {host}\r\nOrigin: http://evil.example\r\nContent-Length: {len(hidden)}", f"PUT / HTTP/1.1\r\nHost: {host}\r\nContent-Length: {len(hidden)}",
              f"BREW / HTTP/1.1\r\nHost: {host}", "GET / HTTP/1.1\r\nHost: evil.example", f"GET / HTTP/1.1\r\nHost: {host}", f"OPTIONS /api/undo HTTP/1.1\r\nHost: {host}\r\nContent-Length: {len(hidden)}"):
    with socket.create_connection(("127.0.0.1", studio.port), timeout=15) as pipe:
        pipe.sendall(first.encode() + b"\r\n\r\n")
        time.sleep(0.1)
        answers = b""
        try:
            pipe.sendall(hidden)
            while part := pipe.recv(65536):
                answers += part
        except ConnectionError:
            pass
    check(f"one answer to {first[:30]!r}", answers.count(b"HTTP/1.1 ") <= 1 and b"revision" not in answers, answers[:300])

# The headers of the page.
studio.request("GET", "/", headers=[("Host", host)])
policy = studio.last_headers.get_all("Content-Security-Policy") or []
check("one policy", len(policy) == 1, policy)
for word in ("default-src 'none'", "script-src 'self'", "connect-src 'self'", "frame-ancestors 'none'", "base-uri 'none'"):
    check(f"policy has {word}", policy and word in policy[0], policy)
check("no unsafe policy", policy and "unsafe" not in policy[0] and "*" not in policy[0] and "http" not in policy[0], policy)
check("nosniff", studio.last_headers.get("X-Content-Type-Options") == "nosniff")
check("no cookie", studio.last_headers.get("Set-Cookie") is None)
check("the page does not hold the token", token.encode() not in studio.request("GET", "/", headers=[("Host", host)])[1])

# After all that: nothing was changed, and the right request works.
status, state = studio.get("/api/state")
check("nothing changed", status == 200 and state["revision"] == 1 and not os.path.exists(design), state)
status, state = studio.post("/api/apply", place)
check("the right request works", status == 200 and state["revision"] == 2 and os.path.exists(design), state)
check("alive", studio.alive())
other = Studio(program, os.path.join(work, "other.json"), dummy_pages())
check("every run has a token of its own", other.token != token)
other.stop()
studio.stop()
print("\n".join(problems[:40]) or f"{checked} checks: every forbidden request is refused")
sys.exit(1 if problems else 0)
