from __future__ import annotations

import dataclasses
import json

import pytest
from docs_pages import page, table

from llm3.cli.main import INTERRUPTED, TERMINATED, main
from llm3.errors import LLM3Error, UsageError
from llm3_http.presets import VARIABLE, known_presets
from llm3_http.settings import API_KEY, BASE_URL, HttpSettings


def test_the_exit_codes_are_those_of_the_program():
    codes = {row[0] for row in table(page("command-line"), "Exit codes").rows}
    assert codes == {"0", "1", str(UsageError.exit_code), str(LLM3Error.exit_code), str(INTERRUPTED), str(TERMINATED)}


@pytest.mark.parametrize("backend", ["offline", "random", "scripted"])
def test_what_is_no_language_model_refuses_a_model_as_the_page_says(corridor, capsys, backend):
    assert main(["--domain", "corridor", "--llm", backend, "--model", "gpt"]) == 2
    said = f"the backend '{backend}' uses no language model: leave out --model gpt, or --llm."
    assert said in capsys.readouterr().err
    assert said.replace(backend, "offline") in page("command-line").replace("\n", " ")


def test_the_json_object_has_the_documented_fields(corridor, capsys):
    assert main(["--domain", "corridor", "--json", "--quiet"]) == 0
    assert set(json.loads(capsys.readouterr().out)) == set(table(page("command-line"), "Streams").names)


@pytest.mark.parametrize(
    ("limit", "fields"),
    [
        ("requests for one completion", {"max_attempts": "5"}),
        ("wait before the first retry", {"first_wait": "1 s", "longest_wait": "30 s"}),
        ("to connect", {"connect_timeout": "10 s"}),
        ("to answer one request", {"read_timeout": "300 s"}),
        ("one completion, all requests and waits together", {"deadline": "900 s"}),
        ("length of an answer", {"max_body": "4,000,000"}),
    ],
)
def test_the_limits_of_the_http_backend_are_its_defaults(limit, fields):
    (shown,) = [
        row[1]
        for row in table(page("command-line"), "Environment variables of the http backend", "limit").rows
        if row[0] == limit
    ]
    defaults = {f.name: f.default for f in dataclasses.fields(HttpSettings)}
    for name, value in fields.items():
        assert value in shown
        assert float(value.replace(",", "").split()[0]) == defaults[name]


def test_the_variables_of_the_http_backend_are_documented():
    shown = table(page("command-line"), "Environment variables of the http backend", "variable")
    presets = known_presets({})
    own = {variable for preset in presets.values() for variable in preset.key_variables}
    assert set(shown.names) == {BASE_URL, API_KEY, VARIABLE, *own}
    assert presets["openai"].base_url in shown.rows[0][1]
