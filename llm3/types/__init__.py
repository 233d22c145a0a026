"""The nouns of the framework: frozen dataclasses, JSON-safe but for `MotionProblem` and `Path`."""

from llm3.types.actions import Action, ActionSchema, Parameter
from llm3.types.attempts import Attempt, Outcome, Proposal, Rejected
from llm3.types.bodies import Body, Surface, box_surface, prism_surface
from llm3.types.dialogue import Completion, Context, Entity, Feedback, Message, Remark, Request, Sketch
from llm3.types.drawing import GREY, Camera, Color, Shape, color_of
from llm3.types.events import (
    ActionTried,
    AttemptEnded,
    CallFailed,
    Observer,
    PromptSent,
    ReplyRead,
    ReplyReceived,
    RunEnded,
    RunEvent,
    RunStarted,
    nobody,
)
from llm3.types.execution import Executed, Execution, ExecutionReport, Noise, PoseError, Slip
from llm3.types.failures import ITSELF, Contact, Failure, FailureKind
from llm3.types.frozen import FrozenDict
from llm3.types.moments import Moment, moment_of
from llm3.types.motion import (
    Event,
    EventKind,
    Goal,
    Goals,
    Mask,
    Motion,
    MotionProblem,
    NoMotion,
    Path,
    Segment,
    Vector,
    Waypoints,
)
from llm3.types.pace import PACE, Timed
from llm3.types.results import PlannedAction, Result, Stop
from llm3.types.state import Fact, GoalStatus, Held, Pose, State, Transition
from llm3.types.stats import Stats
from llm3.types.trajectory import Trajectory
from llm3.types.verification import Defect, Verification

__all__ = [
    "GREY",
    "ITSELF",
    "PACE",
    "Action",
    "ActionSchema",
    "ActionTried",
    "Attempt",
    "AttemptEnded",
    "Body",
    "CallFailed",
    "Camera",
    "Color",
    "Completion",
    "Contact",
    "Context",
    "Defect",
    "Entity",
    "Event",
    "EventKind",
    "Executed",
    "Execution",
    "ExecutionReport",
    "Fact",
    "Failure",
    "FailureKind",
    "Feedback",
    "FrozenDict",
    "Goal",
    "GoalStatus",
    "Goals",
    "Held",
    "Mask",
    "Message",
    "Moment",
    "Motion",
    "MotionProblem",
    "NoMotion",
    "Noise",
    "Observer",
    "Outcome",
    "Parameter",
    "Path",
    "PlannedAction",
    "Pose",
    "PoseError",
    "PromptSent",
    "Proposal",
    "Rejected",
    "Remark",
    "ReplyRead",
    "ReplyReceived",
    "Request",
    "Result",
    "RunEnded",
    "RunEvent",
    "RunStarted",
    "Segment",
    "Shape",
    "Sketch",
    "Slip",
    "State",
    "Stats",
    "Stop",
    "Surface",
    "Timed",
    "Trajectory",
    "Transition",
    "Vector",
    "Verification",
    "Waypoints",
    "box_surface",
    "color_of",
    "moment_of",
    "nobody",
    "prism_surface",
]
