"""A client of the model server that hides nothing."""

import requests

ASKED = {"model": "toy", "messages": [{"role": "user", "content": "Plan, please!"}]}
PLAN = """{"Full Plan": ["go([], {'x': 1.0})"]}"""


def ask(server, timeout=10.0, **more):
    return requests.post(f"{server.url}/chat/completions", json={**ASKED, **more}, timeout=timeout)


def said(response):
    assert response.status_code == 200
    return response.json()["choices"][0]["message"]["content"]


def refused(response):
    assert response.status_code == 400
    return response.json()["error"]["message"]
