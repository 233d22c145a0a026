"""What a stand-in may be told of earlier attempts: sense and nonsense."""

from __future__ import annotations

from hypothesis import strategies as st

from llm3.types import Action, FailureKind, Feedback, Remark


def traces_of(actions: st.SearchStrategy[Action]) -> st.SearchStrategy[tuple[Feedback, ...]]:
    """Traces whose remarks are about these actions, about text that is none, or about a thing that is not there."""
    remarks = st.builds(
        Remark,
        st.one_of(actions.map(str), st.text(max_size=40), st.just("place(['nobody'], {'x': 1})")),
        st.sampled_from(["feasible", "failed", "not tried"]),
        st.text(max_size=40),
        st.sampled_from([None, *FailureKind]),
    )
    told = st.builds(Feedback, st.integers(1, 20), st.lists(remarks, max_size=10).map(tuple), st.text(max_size=40))
    return st.lists(told, max_size=6).map(tuple)
