"""Programs to be written and read."""

from __future__ import annotations

from hypothesis import strategies as st

from llm3.export import Deed, Move, Program
from llm3.types import Event, EventKind, Pose, Trajectory

NAMES = st.text(st.characters(categories=("L", "N", "P", "S", "Zs")), min_size=1, max_size=12).filter(str.isprintable)
"""Whatever can be printed: quotes, commas and brackets, too."""
VALUES = st.floats(-1e6, 1e6)
"""Joint values and speeds."""


def trajectories(dof: int) -> st.SearchStrategy[Trajectory]:
    """With times of whole nanoseconds."""

    def with_spans(spans: list[int]) -> st.SearchStrategy[Trajectory]:
        times = [sum(spans[:index]) / 10**9 for index in range(len(spans) + 1)]
        rows = st.tuples(*[st.tuples(*[VALUES] * dof)] * len(times))
        return st.builds(Trajectory, st.just(tuple(times)), rows, rows)

    return st.lists(st.integers(1_000, 10**11), max_size=3).flatmap(with_spans)


def events() -> st.SearchStrategy[Event]:
    """All kinds."""
    poses = st.builds(Pose, st.tuples(*[st.floats(-9, 9)] * 3), st.sampled_from([(0, 0, 0, 1), (0.6, 0, 0.8, 0)]))
    return st.one_of(
        st.builds(Event, st.just(EventKind.GRIPPER), st.floats(0, 1)),
        st.builds(Event, st.just(EventKind.ATTACH), st.none(), NAMES, st.none() | poses),
        st.builds(Event, st.just(EventKind.DETACH), st.none(), NAMES),
    )


@st.composite
def programs(draw: st.DrawFn) -> Program:
    """Of one to three joints, and up to five items."""
    joints = draw(st.lists(NAMES, min_size=1, max_size=3, unique=True))
    units = draw(st.tuples(*[st.sampled_from(["rad", "m"])] * len(joints)))
    items: list[Deed | Move] = []
    number, text = 0, ""
    for another in draw(st.lists(st.booleans(), max_size=5)):
        if another or not items:
            number, text = number + 1, draw(NAMES)
        items.append(
            draw(
                st.builds(Deed, st.just(number), st.just(text), events())
                | st.builds(Move, st.just(number), st.just(text), NAMES, trajectories(len(joints)))
            )
        )
    return Program(tuple(joints), units, tuple(items))


LIFT = Trajectory((0.0, 0.5, 2.5), ((0.0, 1.0), (0.25, 1.5), (0.5, 0.0)), ((0.0, 0.0), (0.5, -0.25), (0.0, 0.0)))
SMALL = Program(
    ("wheel", "arm"),
    ("m", "rad"),
    (
        Deed(1, "pick(['a'], {})", Event(EventKind.GRIPPER, 0.04)),
        Deed(1, "pick(['a'], {})", Event(EventKind.ATTACH, object="a", grasp=Pose((0, 0, 0.1)))),
        Move(1, "pick(['a'], {})", "lift", LIFT),
        Deed(2, "drop(['a'], {})", Event(EventKind.DETACH, object="a")),
        Move(2, "drop(['a'], {})", "retreat", Trajectory((0.0,), ((0.5, 0.0),), ((0.0, 0.0),))),
    ),
)
"""A program with one of everything."""
