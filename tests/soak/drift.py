#!/usr/bin/env python3
"""Memory and file descriptors of vasa over a long time: a session of the app that resizes its window and opens files, and, with
--pictures, a long film. Samples what the process holds beyond files ("Private_Dirty" of /proc/PID/smaps_rollup) and its descriptors; the
median of the last quarter may be 2 MiB above that of the second quarter (an opening holds two scenes for a while), and
descriptors none.
  tests/soak/drift.py PROGRAM BODY.glb NETWORK.vasa [--frames 20000] [--resizes 500] [--openings 20] [--validate] [--pictures 0 --clip NAME|FILE.bvh]"""
import argparse, os, statistics, subprocess, sys, tempfile, time

ALLOWED_KIB = 2048


def dirty(pid):
    with open(f"/proc/{pid}/smaps_rollup") as rollup:
        return next(int(line.split()[1]) for line in rollup if line.startswith("Private_Dirty"))


def watch(name, command, expected, **more):
    """Runs it and samples ten times a second, until it ends."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **more)
    samples = []
    while process.poll() is None:
        try:
            samples.append((dirty(process.pid), len(os.listdir(f"/proc/{process.pid}/fd"))))
        except (FileNotFoundError, ProcessLookupError, StopIteration, PermissionError):
            pass
        time.sleep(0.1)
    if process.returncode != 0:
        sys.exit(f"{name}: exit {process.returncode}\n{process.stderr.read()}")
    samples = samples[:-2]  # what ends gives back
    quarter = len(samples) // 4
    if quarter < 5:
        sys.exit(f"{name}: over before anything could be seen")
    before, after = samples[quarter:2 * quarter], samples[3 * quarter:]
    growth = statistics.median(kib for kib, _ in after) - statistics.median(kib for kib, _ in before)
    opened = statistics.median_high(count for _, count in after) - statistics.median_high(count for _, count in before)
    marks = ", ".join(f"{statistics.median(kib for kib, _ in samples[i * len(samples) // 8:(i + 1) * len(samples) // 8]) / 1024:.1f}" for i in range(8))
    print(f"{name}: {expected}; {growth / 1024:.2f} MiB and {opened} descriptors more than after warm-up (MiB by eighths: {marks})", flush=True)
    return growth <= ALLOWED_KIB and opened <= 0


def main():
    parse = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parse.add_argument("program")
    parse.add_argument("body")
    parse.add_argument("network")
    parse.add_argument("--frames", type=int, default=20000)
    parse.add_argument("--resizes", type=int, default=500)
    parse.add_argument("--openings", type=int, default=20)
    parse.add_argument("--pictures", type=int, default=0, help="of render; the clip must have as many frames")
    parse.add_argument("--clip", default="")
    parse.add_argument("--validate", action="store_true", help="the app under Vulkan's validation layer: a message fails it")
    wish = parse.parse_args()
    program, scene = os.path.abspath(wish.program), ["--body", os.path.abspath(wish.body), "--network", os.path.abspath(wish.network)]
    clip = ["--clip", wish.clip] if wish.clip else []
    good = True
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, XDG_CONFIG_HOME=folder, XDG_CACHE_HOME=folder)
        if wish.frames:
            lines = ["settle", "key space"]
            steps = max(wish.resizes, wish.openings, 1)
            for step in range(steps):
                if step * wish.resizes // steps != (step + 1) * wish.resizes // steps:
                    lines.append(f"resize {400 + 16 * (step * 7 % 16)} {320 + 10 * (step * 5 % 16)}")
                if step * wish.openings // steps != (step + 1) * wish.openings // steps:
                    lines += [f"drop {scene[1]}", f"drop {scene[3]}", "settle"]  # together, as dropped in one frame
                lines.append(f"frames {max(wish.frames // steps, 1)}")
            script = os.path.join(folder, "script.txt")
            with open(script, "w") as file:
                file.write("\n".join(lines + ["close"]) + "\n")
            server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-noreset", "-nolisten", "tcp"],
                                      stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            try:
                environment["DISPLAY"] = ":" + server.stdout.readline().strip()
                good &= watch("view", [program, "view", *scene, *clip, *["--validate"] * wish.validate, "--script", script, "--size", "480x400"],
                              f"{wish.frames} frames, {wish.resizes} resizes, {wish.openings} openings", env=environment, cwd=folder)
            finally:
                server.terminate()
                server.wait()
        if wish.pictures:
            good &= watch("render", [program, "render", *scene, *clip, "--quiet", "--size", "64x64", "--quads", "4x2", "--frames",
                                     f"0:{wish.pictures - 1}", "-o", os.path.join(folder, "picture.png")],
                          f"{wish.pictures} pictures", env=environment, cwd=folder)
    sys.exit(0 if good else 1)


main()
