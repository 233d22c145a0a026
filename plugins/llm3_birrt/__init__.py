"""A bidirectional RRT in numpy over a MotionProblem; it knows no robot and no simulator."""
