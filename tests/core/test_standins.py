"""The backends that need no network: `random`, `offline` and `scripted`."""

import json
from dataclasses import replace
from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from line_world import line_registry, play, reply

from llm3.errors import BackendError, InputError, MissingCapability, UsageError
from llm3.interfaces import BackendSettings
from llm3.parsing import parse_reply
from llm3.types import Action, ActionSchema, Context, Entity, Message, Parameter, Proposal, Request, Sketch

GO = ActionSchema("go", (), (Parameter("x", 0, 10, "m"), Parameter("turn", -3.14159, 3.14159, "rad")))
TAKE = ActionSchema("take", ("thing",))
CONTEXT = Context("Go.", (GO, TAKE), ("coin",), (Entity("robot", {"x": 0.0}),))
SKELETON = (Sketch("go"), Sketch("take", ("coin",)), Sketch("go"))
SETTINGS = BackendSettings(domain="line", skeleton=SKELETON)


def request(seed=0, context=CONTEXT):
    return Request((Message("user", "Plan!"),), context, seed)


def backend(name, settings=SETTINGS):
    return line_registry().backend(name, settings)


def drawn(seed, settings=SETTINGS, context=CONTEXT):
    """The plan that the random backend writes, read as a model's would be."""
    text = backend("random", settings).complete(request(seed, context)).text
    proposal = parse_reply(text, context.actions, context.objects, settings.skeleton)
    assert isinstance(proposal, Proposal)
    assert proposal.repairs == ()
    assert all(isinstance(action, Action) for action in proposal.actions), proposal
    return proposal.actions


# ---- random --------------------------------------------------------------------------------------------------------


@given(st.integers(0, 2**64 - 1))
def test_random_fills_in_the_skeleton_within_the_ranges(seed):
    plan = drawn(seed)
    assert tuple(Sketch(action.name, action.objects) for action in plan) == SKELETON
    assert all(0 <= plan[i].params["x"] <= 10 and abs(plan[i].params["turn"]) <= 3.14159 for i in (0, 2))


PIECES = ((Sketch("go"), Sketch("take", ("coin",))), (Sketch("go"), Sketch("go")), (Sketch("take", ("coin",)),))


def test_random_draws_the_order_of_pieces_and_keeps_each_together():
    settings = replace(SETTINGS, skeleton=(), pieces=PIECES)
    orders = {tuple(Sketch(action.name, action.objects) for action in drawn(seed, settings)) for seed in range(60)}
    assert orders == {sum(order, ()) for order in permutations(PIECES)}


def test_random_keeps_to_the_sequence_that_the_prompt_gives():
    settings = replace(SETTINGS, pieces=PIECES)
    given = replace(CONTEXT, skeleton=SKELETON)
    for seed in range(20):
        assert tuple(Sketch(action.name, action.objects) for action in drawn(seed, settings, given)) == SKELETON


def test_pieces_are_enough_for_random_and_for_offline():
    settings = BackendSettings(domain="line", pieces=PIECES)
    for name in ("random", "offline"):
        assert "Full Plan" in backend(name, settings).complete(request()).text


@given(st.integers(0, 2**64 - 1), st.tuples(st.floats(0, 10), st.floats(0, 10)).map(sorted))
def test_random_stays_in_the_region_where_the_domain_has_one(seed, region):
    low, high = region
    plan = drawn(seed, replace(SETTINGS, regions={("go", (), "x"): (low, high)}))
    assert all(low <= plan[i].params["x"] <= high for i in (0, 2))


@given(st.integers(0, 2**64 - 1), st.tuples(st.floats(-1e-3, 1e-3), st.floats(-1e-3, 1e-3)).map(sorted))
def test_no_range_is_too_narrow_for_its_rounding(seed, bounds):
    narrow = ActionSchema("go", (), (Parameter("x", *bounds),))
    drawn(seed, replace(SETTINGS, skeleton=(Sketch("go"),)), replace(CONTEXT, actions=(narrow,)))


def test_random_draws_from_the_whole_range_and_anew_for_every_request():
    xs = [action.params["x"] for seed in range(100) for action in (drawn(seed)[0], drawn(seed)[2])]
    assert len(set(xs)) > 190
    assert min(xs) < 0.5
    assert max(xs) > 9.5


def test_random_draws_by_the_seed_of_the_request_alone():
    one = backend("random")
    first = one.complete(request(1))
    one.complete(request(2))
    assert one.complete(request(1)) == first == backend("random").complete(request(1))


def test_random_needs_a_skeleton():
    with pytest.raises(MissingCapability) as caught:
        backend("random", BackendSettings(domain="corridor"))
    assert str(caught.value) == "domain 'corridor' has no skeleton, which the backend 'random' needs."


def test_random_says_that_it_is_no_language_model():
    assert not backend("random").is_language_model
    assert backend("random").notice == "No language model is used: the parameters are drawn at random."


# ---- offline -------------------------------------------------------------------------------------------------------


def test_offline_answers_by_the_domains_rules_from_the_context_and_the_seed():
    def stand_in(context, rng):
        return f"{context.task} {rng.integers(1000)}"

    one = backend("offline", replace(SETTINGS, stand_in=stand_in))
    first = one.complete(request(5)).text
    assert first.startswith("Go. ")
    assert one.complete(request(5)).text == first
    assert len({one.complete(request(seed)).text for seed in range(5)}) == 5
    assert not one.is_language_model
    assert one.notice == "No language model is used: the rule-based stand-in of domain 'line' writes the replies."


def test_what_a_stand_in_writes_passes_through_the_parser():
    settings = replace(SETTINGS, stand_in=lambda context, rng: "no plan today")
    result = play(backend=backend("offline", settings))
    assert result.stats.unreadable_replies == 1


def test_without_rules_offline_draws_at_random_and_says_so():
    one = backend("offline")
    assert one.complete(request(7)) == backend("random").complete(request(7))
    assert not one.is_language_model
    assert one.notice == (
        "No language model is used: domain 'line' has no rule-based stand-in, "
        "so the backend 'random' draws the parameters."
    )


def test_without_rules_and_without_a_skeleton_there_is_nothing_to_draw():
    with pytest.raises(UsageError) as caught:
        backend("offline", BackendSettings(domain="corridor"))
    assert str(caught.value) == (
        "domain 'corridor' has no rule-based stand-in and no skeleton to draw parameters for: "
        "give --model NAME or --llm scripted:FILE."
    )


@pytest.mark.parametrize("name", ["offline", "random", "scripted"])
def test_a_stand_in_takes_no_model(name):
    with pytest.raises(UsageError) as caught:
        backend(name, BackendSettings(model="gpt", skeleton=(Sketch("go"),)))
    assert str(caught.value) == (f"the backend {name!r} uses no language model: leave out --model gpt, or --llm.")


@pytest.mark.parametrize("name", ["offline", "random"])
def test_only_scripted_takes_an_argument(name):
    with pytest.raises(UsageError) as caught:
        backend(name, BackendSettings(argument="x", skeleton=(Sketch("go"),)))
    assert str(caught.value) == f"the backend {name!r} takes no argument, so leave out ':x'."


# ---- scripted ------------------------------------------------------------------------------------------------------


def test_scripted_reads_its_replies_from_a_file(tmp_path):
    path = tmp_path / "replies.json"
    path.write_text(json.dumps([reply(), "two"]), encoding="utf-8")
    one = backend("scripted", BackendSettings(argument=str(path)))
    assert [one.complete(request()).text for _ in range(2)] == [reply(), "two"]
    assert not one.is_language_model
    with pytest.raises(BackendError) as caught:
        one.complete(request())
    assert str(caught.value) == "the script has run out after 2 replies."


def test_scripted_needs_a_file():
    with pytest.raises(UsageError) as caught:
        backend("scripted", BackendSettings())
    assert str(caught.value) == (
        "the backend 'scripted' needs a JSON file with a list of replies: --llm scripted:replies.json."
    )


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ('{"replies": []}', "Expected `array`, got `object`"),
        ('["one", 2]', "Expected `str`, got `int` 2 - at `$[1]`"),
        ("one", "JSON is malformed: invalid character (column 1)"),
        (None, "No such file or directory"),
    ],
)
def test_a_script_in_another_form_is_refused(tmp_path, text, wrong):
    path = tmp_path / "replies.json"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        backend("scripted", BackendSettings(argument=str(path)))
    assert str(caught.value) == f"{path}: {wrong}"
