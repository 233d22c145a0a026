"""The paper's task: an arm packs four boxes into a basket on a table."""
