"""Compares what seam-export wrote of one recording: check_export.py CSV JSON TRACE. Silent if good."""
import csv, json, math, sys

rows = list(csv.DictReader(open(sys.argv[1], newline="")))
doc = json.load(open(sys.argv[2]))
trace = json.load(open(sys.argv[3]))["traceEvents"]
hz = doc["room"]["tick_hz"]
view_of = {v["peer"]: v["name"] for v in doc["views"]}
body_of = {b["id"]: b["name"] for b in doc["bodies"]}


def number(text):
    return float(text) if text != "" else None


# JSON: the same poses in the same order.
assert len(rows) == len(doc["poses"]["rows"]) > 0
for row, pose in zip(rows, doc["poses"]["rows"]):
    p = dict(zip(doc["poses"]["columns"], pose))
    assert int(row["tick"]) == p["tick"] and math.isclose(float(row["time_s"]), p["tick"] / hz, abs_tol=1e-6)
    assert row["view"] == view_of[p["peer"]] and row["body"] == body_of[p["body"]], (row, p)
    for key in ("x", "y", "angle", "vx", "vy", "spin", "error_m"):
        assert number(row[key]) == p[key], (key, row, p)

# Trace: a slice for each tick of each view.
by_tick = {}
for row in rows:
    by_tick.setdefault((row["view"], int(row["tick"])), []).append(number(row["error_m"]))
name_of = {e["pid"]: e["args"]["name"] for e in trace if e["ph"] == "M" and e["name"] == "process_name"}
slices = {(name_of[e["pid"]], e["args"]["tick"]) for e in trace if e["ph"] == "X"}
assert slices == set(by_tick), slices ^ set(by_tick)

# Its counters are the roots of the mean squares of the table's errors.
counters = 0
for e in trace:
    if e["ph"] != "C" or e["name"] != "error_m":
        continue
    errors = [v for v in by_tick[name_of[e["pid"]], round(e["ts"] * hz / 1e6)] if v is not None]
    rms = math.sqrt(sum(v * v for v in errors) / len(errors))
    assert math.isclose(e["args"]["rms"], rms, rel_tol=1e-6, abs_tol=1e-9), (e, rms)
    counters += 1
assert counters == sum(any(v is not None for v in errors) for errors in by_tick.values())

# Spans of authority cover the ticks in which the view says so, and no others.
held, began = set(), {}
for e in trace:
    key = (e["pid"], e.get("id2", {}).get("local"))
    if e["ph"] == "b":
        began[key] = e
    if e["ph"] == "e":
        b = began.pop(key)
        for tick in range(round(b["ts"] * hz / 1e6), round(e["ts"] * hz / 1e6)):
            held.add((name_of[e["pid"]], tick, e["name"]))
assert not began
said = set()
for pose in doc["poses"]["rows"]:
    p = dict(zip(doc["poses"]["columns"], pose))
    if p["authority"] == p["peer"]:
        said.add((view_of[p["peer"]], p["tick"], body_of[p["body"]]))
assert held == said and said, held ^ said

# Arrows end after they began, within ticks that are shown.
starts = {e["id"]: e for e in trace if e["ph"] == "s"}
ends = {e["id"]: e for e in trace if e["ph"] == "f"}
assert starts.keys() == ends.keys() and starts
for i, s in starts.items():
    assert ends[i]["ts"] > s["ts"] and ends[i]["pid"] != s["pid"]
    for e in (s, ends[i]):
        assert (name_of[e["pid"]], math.floor(e["ts"] * hz / 1e6)) in slices
