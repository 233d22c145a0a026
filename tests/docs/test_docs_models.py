"""The page on models says what the code does."""

from __future__ import annotations

import dataclasses
import json

from docs_pages import blocks, names, page, table

from llm3.jsonio import dumps, loads
from llm3.prices import Price
from llm3_http.context_window import LONG
from llm3_http.presets import Preset, known_presets

PAGE = page("models")


def test_the_table_is_the_shipped_presets():
    shown = {names(row[0])[0]: row[1:] for row in table(PAGE, "Presets").rows}
    assert {
        name: (names(address)[0], names(key), names(formats)) for name, (address, key, formats) in shown.items()
    } == {
        name: (preset.base_url, preset.key_variables, preset.reply_formats)
        for name, preset in known_presets({}).items()
    }


def test_every_field_is_documented_in_order_with_its_default():
    shown = table(PAGE, "A server of your own")
    fields = dataclasses.fields(Preset)
    assert shown.names == tuple(field.name for field in fields)
    assert [row[2] for row in shown.rows] == [
        "must be there",
        "none",
        f"`{dumps(Preset('http://host').needs_key)}`",
        f"`{Preset('http://host').dialect}`",
        "all three",
        f"`{Preset('http://host').limit_field}`",
        "no limit is sent",
        f"`{dumps(Preset('http://host').cuts_long_prompts)}`",
    ]


def test_the_example_is_a_preset():
    block, _ = blocks(PAGE, "json")
    presets = loads(block.text, dict[str, Preset], "the example")
    assert list(json.loads(block.text)) == ["lab"]
    assert presets["lab"].needs_key


def test_the_long_prompt_of_the_doctor_is_as_long_as_it_says():
    assert f"a prompt of {LONG:,} words" in PAGE


def test_the_example_is_a_price_table():
    _, block = blocks(PAGE, "json")
    assert loads(block.text, dict[str, Price], "the example") == {"openai/gpt-4.1": Price(2.0, 8.0, 0.5)}
