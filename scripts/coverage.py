#!/usr/bin/env python3
"""Lines that were run, by folder, of what llvm-cov wrote: coverage.py SUMMARY.json TOP_FOLDER LEAST_PERCENT"""
import collections
import json
import os
import sys

with open(sys.argv[1]) as file:
    exported = json.load(file)["data"][0]["files"]
top, least = sys.argv[2], float(sys.argv[3])
files = {}
for entry in exported:
    name = os.path.relpath(entry["filename"])
    if name.startswith(top + "/"):
        files[name] = (entry["summary"]["lines"]["covered"], entry["summary"]["lines"]["count"])
if not files:
    sys.exit("coverage: no line was counted; have the tests been run?")
folders = collections.defaultdict(lambda: [0, 0])
for name, (covered, total) in files.items():
    for folder in ("/".join(name.split("/")[:2]), "all"):
        folders[folder][0] += covered
        folders[folder][1] += total
for name, (covered, total) in sorted(folders.items(), key=lambda item: (item[0] == "all", item[0])):
    print(f"coverage: {name:18} {covered:6} of {total:6} lines, {100 * covered / max(total, 1):5.1f} %")
for name, (covered, total) in sorted(files.items(), key=lambda item: item[1][0] - item[1][1])[:10]:
    print(f"coverage: not reached  {total - covered:4} lines of {name}")
covered, total = folders["all"]
if 100 * covered < least * total:
    sys.exit(f"coverage: less than {least} % of {top}/")
