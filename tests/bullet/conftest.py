from __future__ import annotations

import pytest
from toy_arm import toy_arm

from llm3_bullet.clients import connect
from llm3_bullet.collision import CollisionChecker
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import iiwa, panda


@pytest.fixture(scope="session")
def descriptions(tmp_path_factory):
    return {"panda": panda(), "iiwa": iiwa(), "toy": toy_arm(tmp_path_factory.mktemp("toy"))}


@pytest.fixture(scope="session")
def checkers(descriptions):
    """A checker for each robot. Verdicts depend on no history, so all tests may share them."""
    clients = {name: connect() for name in descriptions}
    made = {}
    for name, description in descriptions.items():
        model = RobotModel(description)
        made[name] = CollisionChecker(clients[name], model, Kinematics(model))
    yield made
    for client in clients.values():
        client.close()


@pytest.fixture
def checker(checkers):
    return checkers["panda"]
