"""Makes the picture of a report: the first attempt of a run whose parameters are drawn at random.

It needs PyBullet, what comes with ``pip install '.[docs,test]'``, and Debian's program chromium::

    python docs/pictures/make_report.py
"""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import sync_playwright

from llm3 import Registry
from llm3.assembly import RunConfig, assemble
from llm3.records import Recorder
from llm3.report import run_report

RUN = RunConfig("boxpack", setting="hard-small", seed=3, llm="random", max_llm_calls=1)


def main() -> None:
    """Run, report and look."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        with assemble(Registry.discover(), RUN) as run, Recorder(folder, run) as record:
            run.solve(record)
        page = folder / "report.html"
        page.write_text(run_report(Registry.discover(), folder, moving=False).page, encoding="utf-8")
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
            view = browser.new_page(viewport={"width": 1100, "height": 800})
            view.goto(page.as_uri())
            view.locator("article").first.screenshot(path=Path(__file__).parent / "report.png")
            browser.close()


if __name__ == "__main__":
    main()
