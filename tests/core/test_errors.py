"""Every error is one sentence for the user, and has an exit code."""

import inspect

import pytest

from llm3 import errors
from llm3.errors import (
    BackendError,
    InputError,
    InstanceError,
    LLM3Error,
    MissingCapability,
    MissingDependency,
    OutputExists,
    PluginError,
    UnknownName,
    UsageError,
)

EXIT_CODES = {
    LLM3Error: 3,
    UsageError: 2,
    UnknownName: 2,
    MissingCapability: 2,
    OutputExists: 2,
    InputError: 3,
    InstanceError: 3,
    PluginError: 3,
    MissingDependency: 3,
    BackendError: 3,
}


@pytest.mark.parametrize(("error", "code"), EXIT_CODES.items())
def test_usage_errors_exit_with_2_and_all_others_with_3(error, code):
    assert error.exit_code == code
    assert issubclass(error, UsageError) == (code == 2)
    assert issubclass(error, LLM3Error)


def test_no_error_is_left_out_here_nor_in_the_tree_of_the_documentation():
    defined = {thing for _, thing in inspect.getmembers(errors, inspect.isclass) if thing.__module__ == errors.__name__}
    assert defined == set(EXIT_CODES)
    assert all(error.__name__ in errors.__doc__ for error in defined)


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (
            UnknownName("domain", "boxpak", ["corridor", "boxpack"]),
            "unknown domain 'boxpak'; did you mean 'boxpack'? Known: boxpack, corridor.",
        ),
        (
            UnknownName("setting", "hard-smal", ["hard-small", "hard-large", "easy-small"]),
            "unknown setting 'hard-smal'; did you mean 'hard-small' or 'hard-large' or 'easy-small'? "
            "Known: easy-small, hard-large, hard-small.",
        ),
        (UnknownName("planner", "prm", ["birrt"]), "unknown planner 'prm'. Known: birrt."),
        (UnknownName("planner", "prm", []), "unknown planner 'prm'. Known: none."),
        (
            UnknownName("planner", "prm", ["birrt"], remark="Failed to load: x (no)."),
            "unknown planner 'prm'. Known: birrt. Failed to load: x (no).",
        ),
        (
            MissingCapability("corridor", "window", "--gui"),
            "domain 'corridor' has no window, which --gui needs.",
        ),
    ],
)
def test_the_sentence_names_the_value_and_the_valid_ones(error, sentence):
    assert str(error) == sentence


def test_an_unknown_name_keeps_its_parts():
    error = UnknownName("domain", "x", {"b": 1, "a": 2})
    assert (error.kind, error.name, error.known) == ("domain", "x", ("a", "b"))
