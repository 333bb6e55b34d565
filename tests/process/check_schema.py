"""Validates TOML files by a JSON schema. python3 check_schema.py SCHEMA FILE...; each mistake is a line."""

import json
import sys
import tomllib

with open(sys.argv[1]) as file:
    SCHEMA = json.load(file)

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int}


def wrong(value, schema, place):
    """The mistakes of a value by the keywords that the schema uses; any other keyword is an error."""
    if "$ref" in schema:
        return wrong(value, SCHEMA["definitions"][schema["$ref"].removeprefix("#/definitions/")], place)
    if "anyOf" in schema:
        each = [wrong(value, one, place) for one in schema["anyOf"]]
        return [] if [] in each else each[0]
    known = {"$schema", "title", "definitions", "type", "properties", "additionalProperties", "items",
             "minimum", "maximum", "minItems", "maxItems"}
    assert set(schema) <= known, set(schema) - known
    kind = schema.get("type")
    if kind == "number":
        fits = isinstance(value, (int, float)) and not isinstance(value, bool)
    else:
        fits = kind is None or isinstance(value, TYPES[kind]) and (kind != "integer" or value is not True)
    if not fits:
        return [f"{place}: {value!r} is no {kind}"]
    found = []
    if "minimum" in schema and not schema["minimum"] <= value * (1 + 1e-6) + 1e-9:
        found.append(f"{place}: {value} is too small")
    if "maximum" in schema and not value * (1 - 1e-6) - 1e-9 <= schema["maximum"]:
        found.append(f"{place}: {value} is too large")
    if kind == "array":
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", 1 << 60):
            found.append(f"{place}: {len(value)} items")
        for i, item in enumerate(value):
            found += wrong(item, schema.get("items", {}), f"{place}[{i}]")
    if kind == "object":
        for key, item in value.items():
            if key in schema.get("properties", {}):
                found += wrong(item, schema["properties"][key], f"{place}.{key}")
            elif schema.get("additionalProperties") is False:
                found.append(f"{place}: no key {key}")
    return found


bad = 0
for path in sys.argv[2:]:
    with open(path, "rb") as file:
        for line in wrong(tomllib.load(file), SCHEMA, path):
            print(line)
            bad += 1
sys.exit(1 if bad else 0)
