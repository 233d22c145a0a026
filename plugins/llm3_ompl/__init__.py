"""Planners of the Open Motion Planning Library (OMPL) over a MotionProblem; they know no robot and no simulator."""
