"""The key goes to the server and nowhere else: nothing that a run leaves behind or shows holds it."""

from __future__ import annotations

import json
import subprocess
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from command_line import environment, llm3
from corridor_replies import ARRIVED, HALF_WAY, reply

KEY = "sk-c4n4ry/with+slash=4711"
TRACE = b"c4n4ry"
PROCESSES = Path("/proc")
"""Where Linux shows the titles of processes; elsewhere there is no such folder."""


class Echo(BaseHTTPRequestHandler):
    """Answers with a plan that solves the corridor, or with an error; and repeats the key wherever it can."""

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        said = self.headers["Authorization"]
        server = self.server
        server.heard.append(said)
        server.running.wait(20)  # until the test knows the process
        process = PROCESSES / str(server.process.pid)
        server.titles += [name.read_bytes() for name in (*process.glob("cmdline"), *process.glob("task/*/comm"))]
        plan = json.dumps({**json.loads(reply(HALF_WAY, ARRIVED)), "Reasoning": said})
        message = {"role": "assistant", "content": plan, "reasoning_content": said}
        choice = {"index": 0, "message": message, "finish_reason": "stop"}
        body = {"model": said, "choices": [choice]} if server.status == 200 else {"error": {"message": said}}
        self.send_response(server.status, said if server.status != 200 else None)
        self.send_header("X-Echo", said)
        self.end_headers()
        self.wfile.write(json.dumps(body).encode())

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture
def server() -> Iterator[ThreadingHTTPServer]:
    with ThreadingHTTPServer(("127.0.0.1", 0), Echo) as running:
        running.daemon_threads = False  # so that closing waits for every answer
        running.status, running.heard, running.titles = 200, [], []
        running.running = threading.Event()
        thread = threading.Thread(target=running.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield running
        running.running.set()
        running.shutdown()
        thread.join()


@pytest.mark.parametrize(
    ("status", "code"),
    [(200, 0), (401, 3), *(pytest.param(status, 3, marks=pytest.mark.slow) for status in (400, 403, 404, 302))],
)
def test_the_key_is_nowhere(cwd, plugins, server, status, code):
    server.status = status
    url = f"http://127.0.0.1:{server.server_port}/v1"
    line = "--domain corridor --seed 7 --model m --out first --record tape.jsonl --debug"
    process = server.process = subprocess.Popen(
        llm3(line), cwd=cwd, env=environment(plugins, LLM3_BASE_URL=url, LLM3_API_KEY=KEY),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    server.running.set()
    try:
        printed = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == code, printed
    assert set(server.heard) == {f"Bearer {KEY}"}
    assert any(b"corridor" in title for title in server.titles) == PROCESSES.exists()
    assert (b"Traceback" in printed[1]) == (code == 3)
    files = {path.relative_to(cwd).as_posix(): path.read_bytes() for path in cwd.rglob("*") if path.is_file()}
    assert {"first/run.json", "first/events.jsonl", "tape.jsonl"} <= set(files)
    assert b"Bearer ***" in files["first/events.jsonl"] or code == 3  # it was there to be seen
    shown = {**files, "stdout": printed[0], "stderr": printed[1], "titles": b"".join(server.titles)}
    assert not [name for name, held in shown.items() if TRACE in held]
