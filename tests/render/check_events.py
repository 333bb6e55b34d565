"""Reads the tables of seam-export --events and --metrics: check_events.py EVENTS METRICS JSONLINES."""
import csv, json, sys

events = list(csv.DictReader(open(sys.argv[1], newline="")))
metrics = list(csv.DictReader(open(sys.argv[2], newline="")))
lines = [json.loads(line) for line in open(sys.argv[3])]

assert len(events) == len(lines) > 3, (len(events), len(lines))
for row, line in zip(events, lines):
    assert int(row["tick"]) == line["tick"] and row["kind"] == line["kind"] and row["text"] == line["text"], (row, line)
    assert float(row["value"]) == line.get("value", 0), (row, line)
    assert (row["client"] == "") == ("client" not in line), (row, line)
kinds = [row["kind"] for row in events]
assert kinds.count("started") == 1 and kinds.count("joined") == 2, kinds
assert {row["player"] for row in events if row["kind"] == "joined"} == {"ann", "bob"}

assert {row["peer"] for row in metrics} == {"server", "ann", "bob"}
for peer in ("server", "ann", "bob"):
    sent = [int(row["bytes_out"]) for row in metrics if row["peer"] == peer]
    assert len(sent) >= 3 and sent == sorted(sent), (peer, sent)
