"""Whatever a model server does: no crash, no hang, a true reason at the end, every request counted, nothing left."""

import socket
from collections import Counter

import pytest
from chaos import DOMAINS, alive, chaos
from chaos_report import KINDS

from llm3.testing import REPLY_FAULTS, LLMServer


def test_what_is_left_behind_is_seen():
    before = alive()
    with LLMServer([]), socket.socket():
        assert {name.split()[0] for name in alive() - before} == {"thread", "socket"}
    assert alive() == before


def check(report):
    assert report.left == ()
    assert report.served == sum(episode.requests for episode in report.episodes)
    for episode in report.episodes:
        check_end(episode)


def check_end(episode):
    """The reason that the record gives for the end is the true one."""
    config, record, stats = episode.config, episode.record, episode.record["stats"]
    assert stats["llm_calls"] <= config.max_llm_calls
    refused = Counter(episode.answers)["refused response_format"]
    assert stats["step_downs"] <= 1
    assert stats["step_downs"] <= refused <= stats["step_downs"] + stats["retries"]  # one that came too late is retried
    received = [event for event in episode.events if event["event"] == "ReplyReceived"]
    failed = [event for event in episode.events if event["event"] == "CallFailed"]
    assert len(received) == stats["llm_calls"]
    if episode.result is None:
        assert (record["status"], record["stop"]) == ("error", "")
        assert episode.events[-1]["event"] == "CallFailed"
        assert [event["error"] for event in failed] == [record["error"]]
        assert episode.answers[-1] in KINDS
        return
    assert record["error"] == ""
    assert episode.events[-1]["event"] == "RunEnded"
    assert record["stop"] == episode.result.stop
    assert record["status"] == ("solved" if episode.result.solved else "not solved")
    assert len(failed) == (1 if failed and record["stop"] == "seconds" else 0)
    assert {
        "solved": episode.result.goal.achieved,
        "calls": stats["llm_calls"] == config.max_llm_calls,
        "tokens": stats["prompt_tokens"] + stats["completion_tokens"] >= (config.max_tokens_total or float("inf")),
        # Or the last call was given up early, as the time left allowed no further try.
        "seconds": config.max_seconds is not None and (record["seconds"] >= config.max_seconds or bool(failed)),
    }[record["stop"]]


def test_twenty_episodes_in_the_corridor(tmp_path):
    report = chaos(20, ["corridor"], tmp_path, seed=1, rate=0.3)
    check(report)
    assert len(report.injected) > len(REPLY_FAULTS)
    assert str(report).endswith("left behind: nothing")


@pytest.mark.slow
@pytest.mark.pybullet
def test_two_hundred_episodes_in_both_domains(tmp_path):
    report = chaos(200, DOMAINS, tmp_path)
    check(report)
    assert set(report.injected) == set(KINDS)
    assert report.share == pytest.approx(0.2, abs=0.04)
    assert {stop for episode in report.episodes if (stop := episode.record["stop"])} >= {"solved", "calls", "tokens"}
