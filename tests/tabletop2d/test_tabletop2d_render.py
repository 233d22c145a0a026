"""`llm3 render`: a run as a film or a picture, on the smallest domain that can be drawn."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

SMALL = "--size 96x64 --rate 2 --quiet"


@pytest.fixture
def run(command):
    """A run of two attempts, solved, in the folder ``here``."""
    assert command("--domain tabletop2d --setting clutter --seed 1 --timing none --quiet --out here").code == 0


@pytest.fixture
def rendered(run, command):
    return lambda line="": command(f"render here {SMALL} {line}")


def pictures(file: Path) -> list[np.ndarray]:
    with Image.open(file) as image:
        return [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(image)]


def test_a_run_becomes_a_film_from_the_start_to_the_end(rendered, cwd):
    ended = rendered()
    assert (ended.code, ended.out, ended.err) == (0, "here.gif\n", "")
    film = pictures(cwd / "here.gif")
    assert len(film) > 3
    assert film[0].shape == (64, 96, 3)
    assert not np.array_equal(film[0], film[-1])


def test_a_picture_shows_the_end_or_a_moment(rendered, cwd):
    for name, at in (("end", ""), ("start", "--at 0"), ("late", "--at 1000")):
        assert rendered(f"--out {name}.png {at}").out == f"{name}.png\n"
    (end,), (start,), (late,) = (pictures(cwd / f"{name}.png") for name in ("end", "start", "late"))
    assert np.array_equal(end, late)
    assert not np.array_equal(end, start)


def test_the_plans_file_is_as_good_as_its_folder(rendered, command, cwd):
    rendered("--out a.png")
    command(f"render here/plan.json {SMALL} --out b.png")
    assert (cwd / "a.png").read_bytes() == (cwd / "b.png").read_bytes()


def test_an_attempt_shows_what_was_carried_out_of_it(rendered, cwd):
    rendered("--out first.png --attempt 1")
    rendered("--out plan.png")
    assert not np.array_equal(*(pictures(cwd / f"{name}.png")[0] for name in ("first", "plan")))


def test_speed_and_rate_decide_how_many_pictures_there_are(rendered, cwd):
    counts = {}
    for name, line in (("slow", "--speed 1"), ("fast", "--speed 4"), ("fine", "--speed 4 --rate 8")):
        rendered(f"--out {name}.gif {line}")
        counts[name] = len(pictures(cwd / f"{name}.gif"))
    assert counts["slow"] > 2 * counts["fast"]
    assert counts["fine"] > 2 * counts["fast"]


def test_in_a_pipe_the_number_of_pictures_is_told_at_the_end(run, command):
    ended = command("render here --size 96x64 --rate 1 --speed 10")
    (line,) = ended.err.splitlines()
    assert line.endswith(" pictures")


WRONG = {
    "--out film.avi": (2, "'film.avi' must end in .gif, .mp4, .png or .html: that decides what is written."),
    "--out there.gif": (2, "'there.gif' exists: choose another file, or give --force."),
    "--out no/where.gif": (3, "'no/where.gif' cannot be written: No such file or directory."),
    "--out no/where.png": (3, "'no/where.png' cannot be written: No such file or directory."),
    "--attempt 9": (2, "here has no attempt 9: the last one is 2."),
    "--out film.mp4": (3, "an .mp4 needs the program ffmpeg, which is not installed: write a .gif instead."),
}
ARGUMENTS = {
    "--size 97x64": "argument --size: expected two even numbers from 16 to 4000, such as 480x360, not '97x64'",
    "--size large": "argument --size: expected two even numbers from 16 to 4000, such as 480x360, not 'large'",
    "--rate 0": "argument --rate: expected a number from 1 to 100, not '0'",
    "--speed nan": "argument --speed: expected a number from 0.1 to 100, not 'nan'",
    "--at -1": "argument --at: expected a number from 0 to 1e+06, not '-1'",
    "--attempt 0": "argument --attempt: expected a whole number from 1 to 1000000, not '0'",
}


@pytest.mark.parametrize("line", WRONG)
def test_what_cannot_be_is_one_line(rendered, cwd, line, monkeypatch):
    monkeypatch.setenv("PATH", str(cwd))
    (cwd / "there.gif").write_bytes(b"a film")
    code, sentence = WRONG[line]
    ended = rendered(line)
    assert (ended.code, ended.out, ended.err) == (code, "", f"llm3: error: {sentence}\n")
    assert (cwd / "there.gif").read_bytes() == b"a film"


@pytest.mark.parametrize("line", ARGUMENTS)
def test_a_wrong_argument_is_one_line(command, line):
    ended = command(f"render here {line}")
    assert (ended.code, ended.err) == (2, f"llm3: error: {ARGUMENTS[line]}. See 'llm3 render --help'.\n")


def test_a_film_can_be_made_anew(rendered, cwd):
    (cwd / "here.gif").write_bytes(b"an old film")
    assert rendered("--force").code == 0
    assert len(pictures(cwd / "here.gif")) > 3


def test_a_run_without_a_plan_has_none_to_show(command):
    command("--domain tabletop2d --setting clutter --max-llm-calls 1 --quiet --out short")
    ended = command(f"render short {SMALL}")
    assert (ended.code, ended.err) == (
        3,
        "llm3: error: short holds no plan.json: the run was not solved, or has not ended.\n",
    )
    assert command(f"render short {SMALL} --attempt 1").code == 0


def test_a_domain_that_cannot_be_drawn_is_told(command):
    assert command("--domain corridor --quiet --out dark").code == 0
    ended = command("render dark")
    sentence = "llm3: error: domain 'corridor' has no stage, no top view and no scenery, which llm3 render needs.\n"
    assert (ended.code, ended.err) == (2, sentence)


# ---- MP4 -----------------------------------------------------------------------------------------------------------

COUNTS = """#!{python}
import sys
data = sys.stdin.buffer.read()
size = sys.argv[sys.argv.index("-s") + 1].split("x")
open(sys.argv[-1], "w").write(str(len(data) / (3 * int(size[0]) * int(size[1]))))
"""
REFUSES = """#!{python}
import sys
sys.exit("no such codec")
"""


@pytest.fixture
def ffmpeg(cwd, monkeypatch):
    """Puts a program of this name on the path."""

    def put(source: str) -> None:
        program = cwd / "bin/ffmpeg"
        program.parent.mkdir()
        program.write_text(source.format(python=sys.executable), encoding="utf-8")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(program.parent), prepend=":")

    return put


def test_an_mp4_is_ffmpegs_to_write(rendered, ffmpeg, cwd):
    ffmpeg(COUNTS)
    rendered("--out film.gif")
    assert rendered("--out film.mp4").out == "film.mp4\n"
    assert float((cwd / "film.mp4").read_text()) == len(pictures(cwd / "film.gif"))


@pytest.mark.slow
def test_an_mp4_of_the_real_ffmpeg_holds_every_picture(rendered, cwd):
    assert shutil.which("ffprobe"), "no ffprobe on the path: apt-get install ffmpeg"
    rendered("--out film.gif")
    assert rendered("--out film.mp4").err == ""
    count = (
        "ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=nb_read_frames -of csv=p=0 film.mp4"
    )
    told = subprocess.run(count.split(), capture_output=True, text=True, check=True, timeout=60).stdout
    assert int(told.strip().strip(",")) == len(pictures(cwd / "film.gif"))


def test_what_ffmpeg_says_is_told(rendered, ffmpeg, cwd):
    ffmpeg(REFUSES)
    ended = rendered("--out film.mp4")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.startswith("llm3: error: ffmpeg cannot write 'film.new.mp4': ")
    assert "no such codec" in ended.err
    assert not list(cwd.glob("*.mp4"))
