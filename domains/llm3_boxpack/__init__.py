"""The paper's task: a Franka Panda packs four boxes into a basket on a table."""
