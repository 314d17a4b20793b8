"""A studio started for a check, and requests to it with every header under control."""
import http.client
import json
import os
import pathlib
import re
import subprocess
import tempfile


def dummy_pages():
    """Enough of a page to start the server: the checks of the server do not need the real one."""
    folder = tempfile.mkdtemp(prefix="rhombloom-pages-")
    for name in ("index.html", "studio.js", "studio.css"):
        pathlib.Path(folder, name).write_text("<!doctype html><title>page</title>" if name == "index.html" else "")
    return folder


class Studio:
    def __init__(self, program, design, pages):
        environment = dict(os.environ, XDG_DATA_HOME=os.path.join(os.path.dirname(os.path.abspath(design)), "data"))
        environment.pop("DISPLAY", None)
        self.process = subprocess.Popen([program, "studio", design, "--no-browser", "--pages", pages], env=environment,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]{32})", line)
        if not found:
            raise RuntimeError("the studio did not start: " + line + self.process.stderr.read())
        self.port, self.token = int(found[1]), found[2]
        self.address = found[0]
        self.host = f"127.0.0.1:{self.port}"

    def headers(self, post):
        return {"Host": self.host, "X-Rhombloom-Token": self.token, **({"Origin": f"http://{self.host}"} if post else {})}

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)

    def request(self, method, path, body=None, headers=None, connection=None):
        """Status and body. `headers` is a list of pairs, sent as it stands."""
        own = connection or self.connect()
        data = body if isinstance(body, bytes) or body is None else json.dumps(body).encode()
        own.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in headers if headers is not None else self.headers(method == "POST").items():
            own.putheader(name, value)
        if data is not None:
            own.putheader("Content-Length", str(len(data)))
        own.endheaders()
        if data:
            own.send(data)
        response = own.getresponse()
        answer = response.read()
        self.last_headers = response.headers
        if connection is None:
            own.close()
        return response.status, answer

    def get(self, path):
        status, answer = self.request("GET", path)
        return status, json.loads(answer)

    def post(self, path, body):
        status, answer = self.request("POST", path, body)
        try:
            return status, json.loads(answer)
        except ValueError:
            return status, answer

    def alive(self):
        return self.process.poll() is None

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.kill()
        return self.process.stderr.read()
