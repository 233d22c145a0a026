"""A real browser without a network. Where there is none, these tests fail: what they show has to be seen."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from llm3.cli.main import main

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
WITHOUT_A_GPU = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    program = next(filter(None, map(shutil.which, CHROMIUM)), None)
    assert program, f"no {CHROMIUM[0]} on the path: apt-get install chromium"
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=WITHOUT_A_GPU)
        yield started
        started.close()


@contextmanager
def opened(browser: Any, file: Path, width: int) -> Iterator[Any]:
    """The page of a file from disk, with the network off; at its end nothing may have gone wrong or been fetched."""
    errors: list[str] = []
    requests: list[str] = []
    context = browser.new_context(offline=True, viewport={"width": width, "height": 600})
    page = context.new_page()
    page.on("console", lambda said: errors.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(file.as_uri())
    yield page
    context.close()
    assert errors == []
    assert [url for url in requests if not url.startswith((file.as_uri(), "data:", "blob:", "about:"))] == []


@pytest.fixture
def visit(browser: Any) -> Any:
    """Opens a file from disk, in a window of some width."""
    return lambda file, width=500: opened(browser, file, width)


@pytest.fixture(scope="session")
def reported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of a run of box packing in which an attempt failed."""
    folder = tmp_path_factory.mktemp("reported") / "run"
    assert main(["--domain", "boxpack", "--setting", "hard-small", "--out", str(folder), "--quiet"]) == 0
    assert main(["report", str(folder), "--quiet"]) == 0
    return folder / "report.html"


@pytest.fixture(scope="module")
def page(browser: Any, reported: Path) -> Iterator[Any]:
    """That report, open in a small window, as pictures take long without a graphics card."""
    with opened(browser, reported, 500) as found:
        yield found
