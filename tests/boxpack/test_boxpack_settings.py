from __future__ import annotations

import subprocess
import sys
from itertools import combinations, product

import pytest
from packing_world import box as box_spec
from packing_world import problem

from llm3.jsonio import dumps, loads, pretty
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.instance import BoxpackInstance
from llm3_bullet.robots.panda import panda
from llm3_bullet.tabletop.grasps import OPENING_MARGIN

SETTINGS = (
    *("easy-small", "easy-medium", "easy-large"),
    *("medium-small", "medium-medium", "medium-large"),
    *("hard-small", "hard-medium", "hard-large"),
)
CUBE, POST = (0.07, 0.07, 0.07), (0.035, 0.035, 0.07)
SIZES = {
    "easy": {"red_box": POST, "blue_box": CUBE, "green_box": POST, "tan_box": POST},
    "medium": {
        "cyan_box": CUBE,
        "blue_box": CUBE,
        "red_box": (0.035, 0.035, 0.04),
        "yellow_box": (0.035, 0.035, 0.04),
    },
    "hard": {"red_box": CUBE, "blue_box": CUBE, "green_box": (0.105, 0.035, 0.07), "tan_box": POST},
}
BASKETS = {"small": (0.65, 0.22), "medium": (0.70, 0.32), "large": (0.75, 0.42)}


def test_the_papers_nine_settings_come_first_and_one_of_them_is_the_default(domain: BoxPack):
    assert domain.settings[:9] == SETTINGS
    assert domain.default_setting == "medium-small"


@pytest.mark.parametrize(("boxes", "basket"), list(product(SIZES, BASKETS)))
def test_sizes_are_those_of_the_paper(domain: BoxPack, boxes: str, basket: str):
    instance = domain.instance(f"{boxes}-{basket}", 0)
    assert {box.name: box.size for box in instance.boxes} == SIZES[boxes]
    center, length = BASKETS[basket]
    assert instance.basket.center == (center, 0.0)
    assert instance.basket.size == (length, 0.21)


@pytest.mark.parametrize("setting", SETTINGS)
def test_every_seed_gives_a_row_of_boxes_each_in_a_lane_with_room_for_the_open_gripper(domain: BoxPack, setting: str):
    gripper = panda().gripper
    for seed in range(500):
        boxes = sorted(domain.instance(setting, seed).boxes, key=lambda box: box.position[1])
        width = 1.2 / len(boxes)
        for lane, box in enumerate(boxes):
            x, y = box.position
            assert 0.385 <= x <= 0.395
            assert box.yaw == 0.0
            low = -0.6 + lane * width
            assert low <= y - box.size[1] / 2
            assert y + box.size[1] / 2 <= low + width
        for left, right in combinations(boxes, 2):
            free = abs(left.position[1] - right.position[1]) - (left.size[1] + right.size[1]) / 2
            for box in (left, right):  # opened for the box, a finger stands in this much of the free space
                assert OPENING_MARGIN / 2 + gripper.finger_reach <= free, (seed, box.name)


@pytest.mark.parametrize("setting", SETTINGS)
def test_seeds_differ_and_so_does_the_order_of_the_boxes(domain: BoxPack, setting: str):
    instances = [domain.instance(setting, seed) for seed in range(20)]
    assert len(set(instances)) == 20
    orders = {tuple(b.name for b in sorted(i.boxes, key=lambda box: box.position[1])) for i in instances}
    assert len(orders) > 5


def test_the_boxes_are_listed_in_the_same_order_whatever_the_seed(domain: BoxPack):
    for setting in SETTINGS:
        names = tuple(SIZES[setting.split("-")[0]])
        assert all(tuple(b.name for b in domain.instance(setting, seed).boxes) == names for seed in range(20))


def test_the_same_seed_gives_the_same_instance_in_another_process_too(domain: BoxPack):
    here = "".join(dumps(domain.instance(setting, seed)) for setting in SETTINGS for seed in (0, 1, 99))
    code = (
        "import sys; from llm3.jsonio import dumps; from llm3_boxpack.paper_settings import SETTINGS, generate\n"
        "sys.stdout.write(''.join(dumps(generate(s, n)) for s in SETTINGS for n in (0, 1, 99)))"
    )
    path = "import sys; sys.path[:0] = " + repr(sys.path) + "\n"
    there = subprocess.run([sys.executable, "-c", path + code], capture_output=True, text=True, check=True)
    assert there.stdout == here


@pytest.mark.parametrize("setting", SETTINGS)
def test_an_instance_survives_a_file(domain: BoxPack, setting: str):
    instance = domain.instance(setting, 3)
    for text in (pretty(instance), dumps(instance)):
        assert loads(text, BoxpackInstance, "instance.json") == instance


def test_the_skeleton_picks_and_places_every_box_in_turn(domain: BoxPack):
    instance = domain.instance("easy-small", 0)
    skeleton = domain.skeleton(instance)
    assert [(s.name, *s.objects) for s in skeleton] == [
        (action, box.name) for box in instance.boxes for action in ("pick", "place")
    ]


def test_the_regions_for_sampling_are_where_a_box_can_lie_in_the_basket(domain: BoxPack):
    instance = domain.instance("hard-large", 0)
    regions = domain.regions(instance)
    assert regions[("place", ("blue_box",), "x")] == pytest.approx((0.575, 0.925))  # 70 mm wide
    assert regions[("place", ("blue_box",), "y")] == pytest.approx((-0.07, 0.07))
    assert regions[("place", ("green_box",), "x")] == pytest.approx((0.5575, 0.9425))  # 35 mm the narrow way
    assert set(regions) == {("place", (box.name,), axis) for box in instance.boxes for axis in "xy"}


def test_a_box_that_only_just_fits_has_the_middle_as_region(domain: BoxPack):
    instance = problem(box_spec("red_box", 0.0, 0.5, (0.211, 0.211, 0.1)))
    region = domain.regions(instance)[("place", ("red_box",), "y")]
    assert region == (instance.basket.center[1],) * 2
