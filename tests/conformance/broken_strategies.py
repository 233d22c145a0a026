"""Templates with one fault each, written into a package of their own."""

from __future__ import annotations

from pathlib import Path

from planted import Planted

from llm3 import Strategy

PACKAGE = "conformance_templates"
GOOD = """\
{% call message("system") %}
{% include "llm3_templates/partials/role.j2" %}
{% endcall %}
{% call message("user") %}
{% include "llm3_templates/partials/task.j2" %}
{% include "llm3_templates/partials/trace.j2" %}
{% include "llm3_templates/partials/format.j2" %}
{% endcall %}
"""
FORMAT = '{% include "llm3_templates/partials/format.j2" %}'
SEQUENCE_AT_FIRST = "{% if not trace %}{{ skeleton | join('; ') }}{% endif %}"
ESCAPED_TRACE = """
{% for f in trace %}{{ f.summary | e }}
{% for r in f.remarks %}{{ r.action }} {{ r.verdict }} {{ r.text | e }}
{% endfor %}{% endfor %}
"""
EXAMPLE = 'None of this is a hole: {"Reasoning": "", "an example": {"of": {"nested": "JSON"}}}'
TASK = '{% include "llm3_templates/partials/task.j2" %}'
OWN_TASK = """\
{{ task }}
{% for a in actions %}
{{ a | usage }}: {{ a.description }}{% for p in a.parameters %} {{ p.name }} {{ p.low }} {{ p.high }} {{ p.unit }};\
{% endfor %}
{% endfor %}
{{ objects | join(", ") }}
{% for e in state %}{{ e.name }}{% for name, p in e.properties.items() %} {{ name }} {{ p | value }}{% endfor %}
{% endfor %}
"""


def of(name: str, **fields) -> Strategy:
    return Strategy(PACKAGE, f"{name.replace(' ', '-')}.j2", **fields)


def without(part: str) -> str:
    return GOOD.replace(f'{{% include "llm3_templates/partials/{part}.j2" %}}\n', "")


def own_task(old: str, new: str) -> str:
    assert old in OWN_TASK
    return GOOD.replace(TASK, OWN_TASK.replace(old, new))


TEMPLATES = {
    "good": GOOD,
    "own task": GOOD.replace(TASK, OWN_TASK),
    "wrapped": GOOD.replace(TASK, OWN_TASK.replace("{{ task }}", "{{ task | wordwrap(30) }}")),
    "nested example": GOOD.replace(FORMAT, f"{FORMAT}\n{EXAMPLE}"),
    "ends of ranges by name": GOOD.replace(
        TASK, OWN_TASK.replace("{{ p.low }} {{ p.high }}", "at most {{ p.high }}, at least {{ p.low }}")
    ),
    "unknown name": GOOD.replace(TASK, "{{ tsk }}"),
    "syntax": GOOD.replace("{% endcall %}", ""),
    "no user": GOOD.replace('message("user")', 'message("system")'),
    "empty": GOOD.replace('{% include "llm3_templates/partials/role.j2" %}', "{% if false %}Hello{% endif %}"),
    "a hole": GOOD.replace(TASK, TASK + "\n{% raw %}{{ task }}{% endraw %}"),
    "python": own_task("{{ p | value }}", "{{ state[0] }}"),
    "no task": own_task("{{ task }}", ""),
    "no state": own_task("{{ p | value }}", ""),
    "no ranges": own_task("{{ p.low }} {{ p.high }}", ""),
    "no units": own_task(" {{ p.unit }}", ""),
    "low and high swapped": own_task("{{ p.low }} {{ p.high }} {{ p.unit }}", "{{ p.high }} {{ p.low }} {{ p.unit }}"),
    "high to low": own_task("{{ p.low }} {{ p.high }}", "from {{ p.high }} {{ p.unit }} to {{ p.low }}"),
    "no slots": own_task("{{ a | usage }}", "{{ a.name }}(...)").replace(FORMAT, '{"Full Plan": []}'),
    "escaped": own_task("{{ task }}", "{{ task | e }}"),
    "escaped property": own_task("{{ p | value }}", "{{ p | value | e }}"),
    "escaped trace": without("trace").replace(TASK, TASK + ESCAPED_TRACE),
    "task at first only": GOOD.replace(TASK, f"{{% if trace %}}Again.{{% else %}}{TASK}{{% endif %}}"),
    "format at first only": GOOD.replace(FORMAT, f"{{% if trace %}}As before.{{% else %}}{FORMAT}{{% endif %}}"),
    "sequence at first only": GOOD.replace(TASK, TASK + SEQUENCE_AT_FIRST),
    "no format": without("format"),
    "no trace": without("trace"),
    "draws": GOOD.replace(TASK, TASK + "\n{{ range(1000000) | random }}"),
}
FAULTS: dict[str, Planted] = {
    "no template": Planted(
        of("nowhere"),
        "nothing is raised",
        f"prompt template '{PACKAGE}/nowhere.j2' cannot be loaded: …",
        "its sentence says what to change",
    ),
    "syntax": Planted(
        of("syntax"), "nothing is raised", f"prompt template '{PACKAGE}/syntax.j2' cannot be loaded: …", "its sentence"
    ),
    "unknown name": Planted(
        of("unknown name"),
        "nothing is raised",
        f"prompt template '{PACKAGE}/unknown-name.j2' cannot be rendered: 'tsk' is undefined",
        "its sentence",
    ),
    "draws": Planted(
        of("draws"),
        "prompts are written for every context",
        "the same context is written in two ways.",
        "must not draw",
    ),
    "no user": Planted(
        of("no user"),
        "prompts are written for every context",
        "the last message is the system's.",
        "A model answers to the user",
    ),
    "empty": Planted(
        of("empty"),
        "prompts are written for every context",
        "message 1, of the system, is empty.",
        "left all of it out",
    ),
    "a hole": Planted(of("a hole"), "prompts have no holes", "the prompt holds '{{': …", "outside of raw blocks"),
    "python": Planted(of("python"), "prompts have no holes", "the prompt holds 'Entity(': …", "by the filters"),
    "no task": Planted(
        of("no task"),
        "prompts tell the task and the state",
        "the prompt does not tell the task.",
        "partials/task.j2",
    ),
    "no state": Planted(
        of("no state"),
        "prompts tell the task and the state",
        "the prompt does not tell '(0.125, 0.5)' of robot.",
        "with all its properties",
    ),
    "no ranges": Planted(
        of("no ranges"),
        "prompts tell the actions",
        "the prompt does not tell '0.25' of action 'go'.",
        "with its ranges",
    ),
    "no units": Planted(
        of("no units"),
        "prompts tell the actions",
        "the prompt does not tell 'cm' of action 'go'.",
        "with its ranges and units",
    ),
    "low and high swapped": Planted(
        of("low and high swapped"),
        "prompts tell the actions",
        "the prompt tells the range of 'x' of action 'go' from its end.",
        "from p.low to p.high",
    ),
    "high to low": Planted(
        of("high to low"),
        "prompts tell the actions",
        "the prompt tells the range of 'x' of action 'go' from its end.",
        "from p.low to p.high",
    ),
    "no slots": Planted(
        of("no slots"),
        "prompts tell the actions",
        "the prompt does not tell 'vessel' of action 'take'.",
        "every schema",
    ),
    "escaped": Planted(
        of("escaped"), "prompts tell the task and the state", "the prompt does not tell the task.", "partials/task.j2"
    ),
    "escaped property": Planted(
        of("escaped property"),
        "prompts tell the task and the state",
        "the prompt does not tell 'open & empty' of robot.",
        "with all its properties",
    ),
    "escaped trace": Planted(
        of("escaped trace"),
        "prompts tell of earlier attempts",
        "the prompt does not tell 'The hand hits the lid of a pot at x < 1 m.' of attempt 1.",
        "partials/trace.j2",
    ),
    "task at first only": Planted(
        of("task at first only"),
        "prompts tell the task and the state",
        "the later prompt does not tell the task.",
        "partials/task.j2",
    ),
    "actions at first only": Planted(
        of("task at first only"),
        "prompts tell the actions",
        "the later prompt does not tell '…' of action '…'.",
        "partials/task.j2",
    ),
    "format at first only": Planted(
        of("format at first only"),
        "prompts tell how to answer",
        "the later prompt does not say that the plan stands under 'Full Plan'.",
        "partials/format.j2",
    ),
    "sequence at first only": Planted(
        of("sequence at first only", fixed_sequence=True),
        "a given sequence is shown",
        "the later prompt does not show go([], ...) of the given sequence.",
        "every sketch",
    ),
    "no format": Planted(
        of("no format"),
        "prompts tell how to answer",
        "the prompt does not say that the plan stands under 'Full Plan'.",
        "partials/format.j2",
    ),
    "no trace": Planted(
        of("no trace"),
        "prompts tell of earlier attempts",
        "the prompt does not tell 'Still missing: a saucer.' of attempt 1.",
        "partials/trace.j2",
    ),
    "sequence that is not shown": Planted(
        of("good", fixed_sequence=True),
        "a given sequence is shown",
        "the prompt does not show go([], ...) of the given sequence.",
        "every sketch",
    ),
}


def write_package(folder: Path) -> None:
    """The templates as an importable package inside of a folder."""
    package = folder / PACKAGE
    package.mkdir()
    (package / "__init__.py").touch()
    for name, text in TEMPLATES.items():
        (package / of(name).template).write_text(text, encoding="utf-8")
