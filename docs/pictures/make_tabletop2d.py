"""Makes tabletop2d.png: a problem of each setting, as it starts and as a solved run leaves it.

It needs matplotlib, which comes with ``pip install '.[plot]'``::

    python docs/pictures/make_tabletop2d.py
"""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from llm3 import Registry, RunConfig, assemble
from llm3.types import PlannedAction, State, color_of
from llm3_tabletop2d.domain import Tabletop2D
from llm3_tabletop2d.instance import TabletopInstance

TARGET = Path(__file__).with_name("tabletop2d.png")
SEED = 0
OPTIONS = {"robot_radius": "0.03"}
ROBOT = "#222222"


def main() -> None:
    """Solve, draw and write."""
    domain, registry = Tabletop2D(), Registry.discover()
    figure = Figure(figsize=(12, 5.6), layout="constrained")
    for axes, setting in zip(figure.subplots(2, 3).flat, domain.settings, strict=True):
        with assemble(registry, RunConfig(domain.name, setting=setting, seed=SEED, timing="none")) as run:
            result = run.solve()
        if not result.solved:
            raise SystemExit(f"the run of {setting} is not solved, so there is nothing to draw")
        axes.set_title(setting)
        draw(axes, domain, domain.instance(setting, SEED), result.start, result.plan)
    figure.savefig(TARGET, dpi=110, metadata={"Software": None})


def draw(
    axes: Axes, domain: Tabletop2D, instance: TabletopInstance, start: State, plan: tuple[PlannedAction, ...]
) -> None:
    """The start as outlines, the end filled, and the way of the robot between them."""
    for state, filled in ((start, False), (plan[-1].state, True)):
        for shape in domain.top_view(instance, OPTIONS, state):
            if shape.fixed and filled:
                axes.add_patch(Polygon(shape.corners, facecolor=shape.color, edgecolor="none", zorder=0))
            elif not shape.fixed:
                color = shape.color or color_of(shape.name)
                style = {"facecolor": color, "zorder": 3} if filled else {"facecolor": "none", "zorder": 2, "ls": ":"}
                axes.add_patch(Polygon(shape.corners, edgecolor=color, lw=1.4, **style))
    way = [point for step in plan for segment in step.motion.segments for point in segment.waypoints]
    axes.plot(*zip(*way, strict=True), color=ROBOT, lw=0.5, alpha=0.5, zorder=1)
    axes.set(xlim=(0, instance.room[0]), ylim=(0, instance.room[1]), aspect="equal", xticks=(), yticks=())


if __name__ == "__main__":
    main()
