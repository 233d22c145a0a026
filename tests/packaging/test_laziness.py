"""Looking at llm3 costs no heavy import: they belong into the factories."""

from __future__ import annotations

import json
import sys

import pytest
from command_line import environment, run

HEAVY = {"matplotlib", "ompl", "pybullet", "pybullet_data", "requests", "scipy", "toppra"}
REPORT = "import json, sys; print('\\n' + json.dumps(sorted({name.partition('.')[0] for name in sys.modules})))"
LOOKS = {
    "import llm3": "import llm3",
    "import llm3.testing": "import llm3.testing",
    "llm3 --help": "from llm3.cli.main import main; main(['--help'])",
    "llm3 list": "from llm3.cli.main import main; main(['list'])",
    "llm3 models": "from llm3.cli.main import main; main(['models'])",
    "prepare(boxpack)": (
        "from llm3 import Registry, RunConfig, prepare\n"
        "for solver in ('loop', 'search'):\n"
        "    prepare(Registry.discover(), RunConfig('boxpack', solver=solver, timing='none')).close()"
    ),
    "llm3 --domain garden": "from llm3.cli.main import main; main(['--domain', 'garden'])",
}


@pytest.mark.parametrize("look", LOOKS)
def test_nothing_heavy_is_loaded(tmp_path, look):
    ended = run([sys.executable, "-W", "error", "-c", f"{LOOKS[look]}\n{REPORT}"], tmp_path, environment())
    loaded = set(json.loads(ended.out.splitlines()[-1]))
    assert "llm3" in loaded
    assert not loaded & HEAVY
