"""Which run is next."""

from experiment_files import experiment
from hypothesis import given
from hypothesis import strategies as st

from llm3.experiments import providers
from llm3.experiments.schedule import Schedule, provider

METHODS = [
    {"name": "openai", "model": "openai/gpt"},
    {"name": "anthropic", "model": "anthropic/claude"},
    {"name": "own server", "model": "qwen"},
    {"name": "random", "llm": "random"},
    {"name": "search", "solver": "search"},
]
ASKED = experiment(methods=METHODS, attempts=4)
JOBS = list(ASKED.jobs())
LIMITS = st.dictionaries(st.sampled_from(["openai", "anthropic", "http", "random"]), st.integers(1, 3))


def test_a_provider_is_what_stands_before_the_slash_or_else_the_backend():
    assert [provider(job.config) for job in JOBS[:5]] == ["openai", "anthropic", "http", "random", ""]
    assert providers(ASKED) == ("anthropic", "http", "openai", "random")


@given(LIMITS, st.integers(1, 8), st.randoms())
def test_every_job_is_handed_out_once_and_no_provider_gets_more_than_it_takes(limits, slots, random):
    schedule, running, seen = Schedule(JOBS, limits), [], []
    while True:
        while len(running) < slots and (job := schedule.next()):
            running.append(job)
            seen.append(job)
        for name, most in limits.items():
            assert sum(provider(job.config) == name for job in running) <= most
        if not running:
            break
        schedule.ended(running.pop(random.randrange(len(running))))
    assert sorted(map(str, seen)) == sorted(map(str, JOBS))
    assert len(schedule) == 0


@given(st.integers(1, 8))
def test_without_limits_jobs_are_handed_out_in_their_order(slots):
    schedule = Schedule(JOBS, {})
    assert [schedule.next() for _ in JOBS] == JOBS
    assert schedule.next() is None


def test_those_that_wait_for_their_provider_do_not_stop_the_others():
    schedule = Schedule(JOBS, {"openai": 1, "anthropic": 1, "http": 1})
    names = [job.key.method for _ in range(8) if (job := schedule.next())]
    assert names == ["openai", "anthropic", "own server", "random", "search", "random", "search", "random"]
