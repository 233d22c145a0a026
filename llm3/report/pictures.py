"""The plan, picture by picture."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO

from llm3.interfaces import Picture
from llm3.playback import frames
from llm3.report.drawing import Drawing, Window, drawing
from llm3.report.sights import Sights
from llm3.types import Moment, PlannedAction, State, moment_of

SIZE = (400, 300)
"""Width and height in pixels."""


@dataclass(frozen=True)
class Step:
    """An action of the plan, and what is to be seen at its end; before the first one, the start."""

    number: int
    """0 for the start."""
    action: str
    """Empty for the start."""
    seconds: float | None
    """How long the robot moves; None where the plan has no times."""
    image: str
    """A picture as a data URI; empty where there is none."""
    drawing: Drawing | None
    """From above, where there is no picture."""


def steps(start: State, plan: tuple[PlannedAction, ...], sights: Sights, window: Window | None) -> Iterator[Step]:
    """The start and the actions of a plan, in order; nothing of an empty plan.

    Args:
        start: Where it begins.
        plan: Its actions.
        sights: What there is to see.
        window: For what is seen from above.
    """
    ends = {frame.action: frame.moment for frame in frames(start, plan, 1.0)}
    if plan:
        yield Step(0, "", None, *_seen("At the start", moment_of(start), sights, window))
    for number, step in enumerate(plan, start=1):
        seen = _seen(f"After action {number}", ends[number - 1], sights, window)
        yield Step(number, str(step.action), step.motion.duration, *seen)


def _seen(when: str, moment: Moment, sights: Sights, window: Window | None) -> tuple[str, Drawing | None]:
    """A picture, or a drawing in its place."""
    image = _image(moment, sights)
    if image or sights.view is None or window is None:
        return image, None
    return "", drawing(f"{when}, seen from above.", window, sights.view(moment))


def _image(moment: Moment, sights: Sights) -> str:
    if sights.stage is None:
        return ""
    sights.stage.show(moment)
    return data_uri(sights.stage.picture(*SIZE))


def data_uri(picture: Picture) -> str:
    """A picture as an address that holds it."""
    from PIL import Image

    file = BytesIO()
    Image.fromarray(picture).save(file, "PNG", optimize=True)
    return f"data:image/png;base64,{b64encode(file.getvalue()).decode()}"
