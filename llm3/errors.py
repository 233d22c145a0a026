"""What can go wrong with the program, as opposed to the robot.

Each error carries one sentence for the user, which names the offending value and the valid ones.
What the *robot* cannot do is never an exception: it is a :class:`llm3.types.Failure`, and the model reads it.

::

    LLM3Error                 exit code 3
    ├── UsageError            exit code 2: the command or the call asks for something that is not there
    │   ├── UnknownName       no plugin, setting or option of that name
    │   ├── MissingCapability the domain lacks what the command needs
    │   └── OutputExists      the output folder would be overwritten
    ├── InputError            a file or a value from outside does not have the documented form
    │   └── InstanceError     an instance makes no sense in the world that is made of it
    ├── PluginError           a plugin is broken, or two plugins claim one name
    ├── MissingDependency     a package that is not installed is needed for what was asked
    └── BackendError          the language model cannot be reached or refuses to answer
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class LLM3Error(Exception):
    """Base of all errors of the framework; its text is one line for the user."""

    exit_code = 3

    def __init__(self, text: str) -> None:
        """Take the sentence; white space in it, such as that of a library's message, is folded into one line."""
        super().__init__(" ".join(text.split()))


class UsageError(LLM3Error):
    """The command line or the call asks for something that is not there."""

    exit_code = 2


class UnknownName(UsageError):
    """No thing of this kind has this name."""

    def __init__(self, kind: str, name: str, known: Iterable[str], owner: str = "", remark: str = "") -> None:
        """Say what was asked for, what comes close to it and what there is.

        Args:
            kind: What the name should have named, such as ``"setting"``.
            name: The unknown name.
            known: The valid names.
            owner: Whose name it should be, such as ``"domain 'boxpack'"``.
            remark: A further sentence, such as which plugins failed to load.
        """
        self.kind, self.name, self.known, self.remark = kind, name, tuple(sorted(known)), remark
        close = difflib.get_close_matches(name, self.known, n=3)
        guess = f"; did you mean {' or '.join(map(repr, close))}?" if close else "."
        valid = ", ".join(self.known) or "none"
        of = f" of {owner}" if owner else ""
        text = f"unknown {kind} {name!r}{of}{guess} Known: {valid}."
        super().__init__(f"{text} {remark}" if remark else text)


class MissingCapability(UsageError):
    """The domain does not offer what the command or the strategy needs."""

    def __init__(self, domain: str, capability: str, needed_for: str) -> None:
        super().__init__(f"domain {domain!r} has no {capability}, which {needed_for} needs.")


class OutputExists(UsageError):
    """The output folder holds files that would be overwritten."""


class InputError(LLM3Error):
    """A file or a value from outside does not have the documented form."""


class InstanceError(InputError):
    """An instance has the right form, but no world can be made of it: things start in one another, say.

    A domain raises it in `Domain.make`; whoever knows which file the instance comes from says that first.
    """


class PluginError(LLM3Error):
    """A plugin is broken, or two plugins claim one name."""


class MissingDependency(LLM3Error):
    """What was asked for needs a package that is not installed."""


class BackendError(LLM3Error):
    """The language model cannot be reached or refuses to answer."""

    def __init__(self, text: str, *, retries: int = 0, step_downs: int = 0, out_of_time: bool = False) -> None:
        """Take the sentence, and what was spent in vain.

        Args:
            text: One line for the user.
            retries: Requests that led to nothing.
            step_downs: Requests that were made again with fewer features.
            out_of_time: Whether it was given up because `Request.seconds` did not allow another try.
        """
        super().__init__(text)
        self.retries, self.step_downs, self.out_of_time = retries, step_downs, out_of_time
