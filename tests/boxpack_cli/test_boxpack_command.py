"""The command that the README starts with."""

from __future__ import annotations

import json

from command_line import environment, llm3, run


def test_the_main_job(tmp_path):
    ended = run(llm3("--domain boxpack --out here"), tmp_path, environment())
    assert ended.code == 0
    notice, *story = ended.err.splitlines()
    assert notice == "No language model is used: the rule-based stand-in of domain 'boxpack' writes the replies."
    assert story[-1] == "record: here"
    actions = ended.out.splitlines()
    assert [action.partition("(")[0] for action in actions] == ["pick", "place"] * 4
    told = json.loads((tmp_path / "here/run.json").read_text(encoding="utf-8"))
    assert (told["status"], told["config"]["setting"]) == ("solved", "medium-small")
    assert (tmp_path / "here/plan.json").exists()


def test_bullet_itself_never_writes_to_stdout(tmp_path):
    ended = run(llm3("--domain boxpack --json --quiet --max-llm-calls 1 --out here"), tmp_path, environment())
    (line,) = ended.out.splitlines()
    assert json.loads(line)["llm_calls"] == 1
    assert ended.err == ""


def test_a_wrong_instance_names_the_field(tmp_path):
    made = run(llm3("instance --domain boxpack --out problem.json"), tmp_path, environment())
    assert (made.code, made.out, made.err) == (0, "", "")
    problem = json.loads((tmp_path / "problem.json").read_text(encoding="utf-8"))
    problem["boxes"][1]["size"] = "big"
    (tmp_path / "problem.json").write_text(json.dumps(problem), encoding="utf-8")
    ended = run(llm3("--domain boxpack --instance problem.json"), tmp_path, environment())
    sentence = 'problem.json: Expected `array`, got `str` "big" - at `$.boxes[1].size`'
    assert (ended.code, ended.out, ended.err) == (3, "", f"llm3: error: {sentence}\n")
