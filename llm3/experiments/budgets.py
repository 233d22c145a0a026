"""The budgets for which an experiment's tables tell how many runs are solved within them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from itertools import pairwise


@dataclass(frozen=True)
class Budgets:
    """Whole numbers of each kind that grow: what a run may spend of it. They limit no run."""

    llm_calls: tuple[int, ...] = ()
    motion_calls: tuple[int, ...] = ()
    tokens: tuple[int, ...] = ()
    seconds: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        for measure, amounts in self.by_measure.items():
            if any(after <= before for before, after in pairwise((0, *amounts))):
                raise ValueError(
                    f"the budgets of {measure} must be whole numbers from 1 on, each larger than the one before, "
                    f"not {list(amounts)}"
                )

    @property
    def by_measure(self) -> Mapping[str, tuple[int, ...]]:
        """Those that are given."""
        return {field.name: amounts for field in fields(self) if (amounts := getattr(self, field.name))}
