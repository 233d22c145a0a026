"""Runs to be reported, and pages as a program reads them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser
from pathlib import Path

from llm3.assembly import RunConfig, assemble
from llm3.records import Recorder, create_folder
from llm3.registry import Registry
from llm3.testing import ScriptedLLM

VOID = {"meta", "link", "img", "hr", "br"}
"""Elements of HTML that have no end."""


def record(folder: Path, config: RunConfig, script: Sequence[str] = ()) -> Path:
    """Record a run in a folder, of a scripted model if there is a script."""
    with assemble(Registry.discover(), config) as run:
        if script:
            solver = replace(run.solver, backend=ScriptedLLM(script))
            run = replace(run, solver=solver)
        with Recorder(create_folder(folder), run) as recorder:
            run.solve(recorder)
    return folder


@dataclass
class Element:
    """An element of a page."""

    tag: str
    attributes: dict[str, str]
    children: list[Element | str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """What it says, with all that stands in it."""
        return " ".join("".join(c if isinstance(c, str) else f" {c.text} " for c in self.children).split())

    def all(self, *tags: str) -> Iterator[Element]:
        """Everything below it of these tags, or everything, in order."""
        for child in self.children:
            if isinstance(child, Element):
                if not tags or child.tag in tags:
                    yield child
                yield from child.all(*tags)

    def classed(self, name: str) -> list[Element]:
        """Everything below it of this class."""
        return [element for element in self.all() if name in element.attributes.get("class", "").split()]


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.root = Element("", {})
        self._open = [self.root]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        element = Element(tag, {name: value or "" for name, value in attrs})
        self._open[-1].children.append(element)
        if tag not in VOID:
            self._open.append(element)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._open[-1].children.append(Element(tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop().tag == tag, f"</{tag}> ends something else"

    def handle_data(self, data: str) -> None:
        self._open[-1].children.append(data)


def read_page(page: str) -> Element:
    """A page as a tree; every element that begins has to end in its place."""
    reader = _Reader()
    reader.feed(page)
    reader.close()
    assert reader.root is reader._open.pop(), "something does not end"
    return reader.root
