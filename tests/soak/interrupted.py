#!/usr/bin/env python3
"""Signals at random moments, and memory limits of all sizes, in the middle of whatever vasa does. Not part of the tests: minutes.
  interrupted.py signals PROGRAM BODY NET [N]   N signals (100) a command: how long each answer takes
  interrupted.py memory PROGRAM BODY NET [N]    N limits (40) a command, from none of it to enough: how each run ends"""
import os, random, resource, signal, subprocess, sys, tempfile, time
from pathlib import Path

def line(path, samples):  # one line that winds through a box
    with open(path, "w") as file:
        for i in range(1, samples + 1):
            row, column = divmod(i, 1000)
            file.write(f"{i} 3 {999 - column if row % 2 else column} {row % 1000} {row // 1000} 0.4 {i - 1 if i > 1 else -1}\n")

def sheet(path, side):  # one element of triangles
    with open(path, "w") as file:
        for i in range(side):
            file.writelines(f"v {i} {k} {(i * 7 + k * 3) % 5}\n" for k in range(side))
        for i in range(side - 1):
            for k in range(1, side):
                a = i * side + k
                file.write(f"f {a} {a + side} {a + side + 1}\nf {a} {a + side + 1} {a + 1}\n")

def commands(folder, body, net, samples, side):
    line(folder / "line.swc", samples)
    sheet(folder / "sheet.obj", side)
    out = folder / "out"
    return {
        "convert swc": ["convert", folder / "line.swc", "--scale", "0.001", "-o", out / "a.vasa"],
        "convert obj": ["convert", folder / "sheet.obj", "--scale", "0.001", "-o", out / "b.vasa"],
        "info": ["info"],
        "info glb": ["info", body],
        "compare": ["compare", net, net],
        "fit": ["fit", net, "--from", body, "--to", body, "-o", out / "c.vasa"],
        "check": ["check", "--clip", "run", "--no-cache"],
        "export glb": ["export", "--clip", "walk", "-o", out / "d.glb", "--no-cache"],
        "export csv": ["export", "--clip", "walk", "-o", out / "e.csv"],
        "export vtp": ["export", "-o", out / "f.vtp"],
    }

def run(program, arguments, folder, limit=None, after=None, number=None):
    def limited():
        if limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    start = time.monotonic()
    child = subprocess.Popen([program, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                             errors="replace", preexec_fn=limited, env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache")})
    if after is not None:
        try:
            child.wait(after)
        except subprocess.TimeoutExpired:
            start = time.monotonic()
            child.send_signal(number)
    try:
        error = child.communicate(timeout=900)[1]
    except subprocess.TimeoutExpired:
        child.kill()
        return "hangs", child.communicate()[1], 900.0, start
    return child.returncode, error, time.monotonic() - start, start

def signals(program, folder, all_commands, count):
    random.seed(1)
    bad = 0
    for name, arguments in all_commands.items():
        longest = 8.0
        answers, cut = [], 0
        for _ in range(count):
            for left in (folder / "out").iterdir(): left.unlink()
            number = random.choice([signal.SIGINT, signal.SIGTERM])
            code, error, seconds, _ = run(program, arguments, folder, after=random.uniform(0.01, longest), number=number)
            if code == 0: continue  # was done by then
            answers.append(seconds)
            cut += "in the middle" in error
            left = list((folder / "out").iterdir())
            if code != 128 + number or left:
                bad += 1
                print(f"  {name}: {code}, {left}, {error[-200:]}")
        answers.sort()
        if answers:
            print(f"{name:12} {len(answers):4} answers: median {1e3 * answers[len(answers) // 2]:.0f} ms, longest {1e3 * answers[-1]:.0f} ms; "
                  f"{cut} cut off in the middle of something", flush=True)
    return bad

def memory(program, folder, all_commands, count):
    bad = 0
    for name, arguments in all_commands.items():
        high = 64 << 20  # the least limit, doubled, at which it does what it is told
        while run(program, arguments, folder, limit=high)[0] != 0 and high < 32 << 30: high *= 2
        ends = {}
        for i in range(count):
            limit = int(high * (i + 1) / count) if i % 2 else int(high ** ((i + 1) / count) * (8 << 20) ** (1 - (i + 1) / count))
            code, error, seconds, _ = run(program, arguments, folder, limit=limit)
            good = code in (0, 127) or (code == 1 and "error: " in error)  # 127: no room for the libraries
            ends[code] = ends.get(code, 0) + 1
            if not good:
                bad += 1
                print(f"  {name} at {limit >> 10} KiB: {code} after {seconds:.1f} s: {error.strip()[-300:]}", flush=True)
        print(f"{name:12} up to {high >> 20} MiB: " + ", ".join(f"{n} end with {c}" for c, n in sorted(ends.items(), key=str)), flush=True)
    return bad

def main():
    what, program, body, net = sys.argv[1:5]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "out").mkdir()
        if what == "signals": bad = signals(program, folder, commands(folder, body, net, 1000000, 1000), int((sys.argv + ["100"])[5]))
        else: bad = memory(program, folder, commands(folder, body, net, 60000, 120), int((sys.argv + ["40"])[5]))
    sys.exit(f"{bad} runs ended as they must not" if bad else 0)

main()
