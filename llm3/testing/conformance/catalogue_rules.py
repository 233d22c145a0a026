"""Rules for what a domain says of itself, and for its instances."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, is_dataclass
from typing import Any

from llm3.errors import InputError
from llm3.guarded import place
from llm3.interfaces import Domain, Options
from llm3.jsonio import loads, pretty
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.purity_rules import global_generators

SEEDS = range(5)
"""How many problems of a setting are compared."""


@dataclass(frozen=True)
class Catalogue:
    """A domain and those of its settings that are looked at."""

    domain: Domain
    settings: tuple[str, ...]


def default_options(domain: Domain) -> Options:
    """A value for every option, as a record keeps them."""
    return domain.self_contained({option.name: option.default for option in domain.options})


def a_domain_says_what_it_is(subject: Catalogue) -> Iterator[Fault]:
    """Name, description, settings, default setting and instance type are there, and fit together."""
    domain = subject.domain
    cause = "Domain has them as class attributes, which every domain fills."
    for name in ("name", "description", "settings", "default_setting", "instance_type"):
        if not hasattr(domain, name):
            yield Fault(f"the domain has no attribute {name!r}.", cause)
            return
    for name in ("name", "description", "default_setting"):
        value = getattr(domain, name)
        if not isinstance(value, str) or not value.strip() or "\n" in value:
            yield Fault(f"{name} must be one line of text, not {value!r}.", cause)
    if isinstance(domain.settings, str) or not domain.settings or len(set(domain.settings)) < len(domain.settings):
        yield Fault(
            f"settings must be a tuple of different names, at least one, not {domain.settings!r}.",
            "A tuple of one needs a comma: settings = ('default',).",
        )
    if domain.default_setting not in domain.settings:
        yield Fault(
            f"the default setting {domain.default_setting!r} is none of the settings {tuple(domain.settings)}.",
            "One of the two is misspelt.",
        )
    if not isinstance(domain.instance_type, type) or not is_dataclass(domain.instance_type):
        yield Fault(
            f"instance_type must be a frozen dataclass, not {domain.instance_type!r}.",
            "It is the class itself, with @dataclass(frozen=True), and no instance of it.",
        )


def options_have_a_default_that_is_valid(subject: Catalogue) -> Iterator[Fault]:
    """Options have different names, a line of help, and a default among their choices."""
    names = [option.name for option in subject.domain.options]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield Fault(f"two options are called {name!r}.", "Users choose an option by its name.")
    for option in subject.domain.options:
        if option.choices and option.default not in option.choices:
            text = f"option {option.name!r} has the default {option.default!r}, which is none of {option.choices}."
            yield Fault(text, "A run without -D would be refused: add the default to the choices.")
        if not option.help.strip():
            yield Fault(f"option {option.name!r} has no help.", "The manual and the command line show it.")


def options_stay_as_they_are_in_a_record(subject: Catalogue) -> Iterator[Fault]:
    """self_contained answers a text for each option, and takes its own answer."""
    given = {option.name: option.default for option in subject.domain.options}
    once = subject.domain.self_contained(given)
    if not isinstance(once, Mapping) or set(once) != set(given) or not all(isinstance(v, str) for v in once.values()):
        yield Fault(
            f"self_contained must answer a text for each of {sorted(given)}, not {once!r}.",
            "It answers all options, also those that it leaves as they are.",
        )
        return
    twice = subject.domain.self_contained(once)
    if dict(twice) != dict(once):
        yield Fault(
            f"self_contained changes its own answer: {dict(once)} and then {dict(twice)}.",
            "What is the content of a file already must be left alone: make gets it when a record is read again.",
        )


def every_choice_of_an_option_makes_a_world(subject: Catalogue) -> Iterator[Fault]:
    """With each choice of each option, the others at their defaults, the first problem is made and has a state."""
    domain, setting = subject.domain, subject.settings[0]
    defaults = default_options(domain)
    for option in domain.options:
        for choice in option.choices:
            if choice == option.default:
                continue
            try:
                env = domain.make(domain.instance(setting, 0), {**defaults, option.name: choice})
                env.reset()
                env.close()
            except (Exception, SystemExit) as error:
                yield Fault(
                    f"with {option.name}={choice} no world of {setting!r}, seed 0, is made: "
                    f"{type(error).__name__}: {error} ({place(error)}).",
                    "A choice that is offered is one that works: take it out of the choices, or mend make.",
                )


def the_same_seed_gives_the_same_instance(subject: Catalogue) -> Iterator[Fault]:
    """Two calls of instance with the same arguments are equal, and of the domain's instance type."""
    for setting in subject.settings:
        for seed in SEEDS[:2]:
            chance = global_generators()
            one, other = subject.domain.instance(setting, seed), subject.domain.instance(setting, seed)
            if global_generators() != chance:
                yield Fault(
                    f"instance({setting!r}, {seed}) draws from the global generator of random or numpy.",
                    "It would disturb all others who draw from that: make a generator, np.random.default_rng(seed).",
                )
            if not isinstance(one, subject.domain.instance_type):
                wanted = subject.domain.instance_type.__name__
                yield Fault(
                    f"instance({setting!r}, {seed}) is a {type(one).__name__} and no {wanted}.",
                    "instance_type is what instance answers.",
                )
            if one != other:
                yield Fault(
                    f"instance({setting!r}, {seed}) is {one!r} and then {other!r}.",
                    "Draw from np.random.default_rng(seed) alone, and make the instance a dataclass, which compares.",
                )


def another_seed_gives_another_instance(subject: Catalogue) -> Iterator[Fault]:
    """Somewhere among the settings and seeds, instances differ."""
    for setting in subject.settings:
        found = [subject.domain.instance(setting, seed) for seed in SEEDS]
        if any(instance != found[0] for instance in found):
            return
    yield Fault(
        f"seeds {SEEDS[0]} to {SEEDS[-1]} give the same instance in every setting: {found[0]!r}.",
        "instance does not look at its seed, so runs with other seeds repeat one problem.",
    )


def instances_survive_a_file(subject: Catalogue) -> Iterator[Fault]:
    """An instance that is written to a file and read again is equal."""
    for setting in subject.settings:
        instance: Any = subject.domain.instance(setting, 0)
        cause = "Use a frozen dataclass of plain numbers, texts, tuples and such dataclasses, with their types written."
        try:
            again = loads(pretty(instance), subject.domain.instance_type, "the instance")
        except (InputError, TypeError, ValueError) as error:
            yield Fault(f"{setting}: an instance cannot be written to a file and read again: {error}.", cause)
            continue
        if again != instance:
            yield Fault(f"{setting}: an instance is {instance!r}, and read from its file {again!r}.", cause)


RULES = (
    options_have_a_default_that_is_valid,
    options_stay_as_they_are_in_a_record,
    the_same_seed_gives_the_same_instance,
    another_seed_gives_another_instance,
    instances_survive_a_file,
)
LAST_RULES = (every_choice_of_an_option_makes_a_world,)
"""Looked at after all others: they make more worlds, and close them."""
