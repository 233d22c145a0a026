"""A library for domains whose world is simulated by PyBullet: robots, kinematics, collision, settling."""
