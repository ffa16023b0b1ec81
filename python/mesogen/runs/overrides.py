"""Overrides: the keys of a case that a run changes, {"kernel.type": "quintic"}, as `mesogen run --set` takes them."""

import hashlib
import json

from .table_reader import is_number


def is_value(value):
    """Whether --set takes the value, read from TOML: a number, a text, true, false, or a list of them."""
    if isinstance(value, list):
        return all(is_value(member) for member in value)
    return isinstance(value, (bool, str)) or is_number(value)


def value_text(value):
    """The value as TOML: 0.1, "quintic", [1.0, 2.0]. Numbers keep all digits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(value_text(member) for member in value) + "]"
    return repr(value)


def set_arguments(overrides):
    """Overrides as arguments of mesogen: ["--set", 'kernel.type="quintic"', ...]."""
    return [word for key, value in overrides.items() for word in ("--set", f"{key}={value_text(value)}")]


def read_overrides(table, reserved=()):
    """The keys of a TableReader that are dotted keys of a case, as a dictionary; others are added to its problems.

    reserved: keys with another meaning, left to the caller.
    """
    found = {}
    for key, value in table.data.items():
        if key in reserved:
            continue
        table.known.append(key)
        if isinstance(value, dict):
            table.refuse(key, "is a table; write its keys as one dotted, quoted key each, as for --set: "
                              f'"{key}.KEY" = VALUE')
        elif "." not in key:
            allowed = f", nor is it one of: {', '.join(reserved)}" if reserved else ""
            table.refuse(key, f'is no dotted key of a case such as "kernel.type"{allowed}')
        elif not is_value(value):
            table.refuse(key, "must be a number, a text, true or false, or a list of them")
        else:
            found[key] = value
    return found


def digest(*parts):
    """Twelve hexadecimal digits that differ if any part does. parts: values read from TOML."""
    text = json.dumps(parts, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:12]
