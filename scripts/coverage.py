#!/usr/bin/env python3
"""Lines of engine/ that were run, by folder, of what gcovr wrote: coverage.py SUMMARY.json LEAST_PERCENT"""
import collections
import json
import sys

with open(sys.argv[1]) as file:
    files = json.load(file)["files"]
folders = collections.defaultdict(lambda: [0, 0])
for entry in files:
    folder = "/".join(entry["filename"].split("/")[:2])
    for name in (folder, "all"):
        folders[name][0] += entry["line_covered"]
        folders[name][1] += entry["line_total"]
if not files:
    sys.exit("coverage: no line was counted; have the tests been run?")
for name, (covered, total) in sorted(folders.items(), key=lambda item: (item[0] == "all", item[0])):
    print(f"coverage: {name:18} {covered:6} of {total:6} lines, {100 * covered / max(total, 1):5.1f} %")
worst = sorted(files, key=lambda entry: entry["line_covered"] - entry["line_total"])[:10]
for entry in worst:
    print(f"coverage: not reached  {entry['line_total'] - entry['line_covered']:4} lines of {entry['filename']}")
covered, total = folders["all"]
if 100 * covered < float(sys.argv[2]) * total:
    sys.exit(f"coverage: less than {sys.argv[2]} % of engine/")
