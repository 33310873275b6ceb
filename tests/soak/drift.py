#!/usr/bin/env python3
"""Memory and file descriptors of vasa over a long time: a session of the app that resizes its window and opens files, and, with
--pictures, a long film of a swaying body's leg artery, 64 pixels wide (of all vessels a hundred thousand pictures would take hours).
Samples what the process holds beyond files ("Private_Dirty" of /proc/PID/smaps_rollup) and its descriptors; the
median of the last quarter may be 2 MiB above that of the second quarter (an opening holds two scenes for a while), and
descriptors none. With --validate a message fails it and memory does not: the layer's own grows.
  tests/soak/drift.py PROGRAM BODY.glb NETWORK.vasa [--frames 20000] [--resizes 500] [--openings 20] [--validate] [--clip NAME] [--pictures 0]"""
import argparse, math, os, statistics, subprocess, sys, tempfile, time

ALLOWED_KIB = 2048
ARTERY = """1 2 0.09 0.85 0.02 0.005 -1
2 2 0.09 0.7 0.02 0.0045 1
3 2 0.09 0.6 0.02 0.004 2
4 2 0.10 0.5 0.01 0.003 3
5 2 0.10 0.4 0.0 0.003 4
6 2 0.08 0.5 0.01 0.002 3
7 2 0.08 0.42 0.0 0.002 6
"""
# Joint, the one that it hangs on, its place there [m].
JOINTS = (("Hips", None, "0 0.95 0"), ("Spine", "Hips", "0 0.2 0"), ("Head", "Spine", "0 0.4 0"),
          ("LeftArm", "Spine", "0.18 0.3 0"), ("LeftForeArm", "LeftArm", "0.28 0 0"), ("LeftHand", "LeftForeArm", "0.25 0 0"),
          ("RightArm", "Spine", "-0.18 0.3 0"), ("RightForeArm", "RightArm", "-0.28 0 0"), ("RightHand", "RightForeArm", "-0.25 0 0"),
          ("LeftUpLeg", "Hips", "0.1 0 0"), ("LeftLeg", "LeftUpLeg", "0 -0.42 0"), ("LeftFoot", "LeftLeg", "0 -0.42 0"),
          ("RightUpLeg", "Hips", "-0.1 0 0"), ("RightLeg", "RightUpLeg", "0 -0.42 0"), ("RightFoot", "RightLeg", "0 -0.42 0"))


def sway(frames):
    """A motion of so many frames, as BVH: knee, elbow and back bend by up to 20 degrees, in four seconds."""
    order = []

    def tree(name, at):
        order.append(name)
        text = f"{'JOINT' if len(order) > 1 else 'ROOT'} {name}\n{{\nOFFSET {at}\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
        below = "".join(tree(child, place) for child, parent, place in JOINTS if parent == name)
        return text + (below or "End Site\n{\nOFFSET 0 0.1 0\n}\n") + "}\n"

    text = "HIERARCHY\n" + tree(*JOINTS[0][::2])
    bending = {"LeftLeg", "LeftForeArm", "Spine"}
    lines = []
    for frame in range(frames):
        angle = f"0 {20 * math.sin(2 * math.pi * frame / 120):.3f} 0"
        lines.append(" ".join(angle if name in bending else "0 0 0" for name in order))
    return text + f"MOTION\nFrames: {frames}\nFrame Time: 0.0333333\n" + "\n".join(lines) + "\n"


def dirty(pid):
    with open(f"/proc/{pid}/smaps_rollup") as rollup:
        return next(int(line.split()[1]) for line in rollup if line.startswith("Private_Dirty"))


def watch(name, command, expected, pictures=None, allowed=ALLOWED_KIB, **more):
    """Runs it and samples ten times a second, until it ends; takes the pictures away from their folder."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **more)
    samples = []
    while process.poll() is None:
        try:
            samples.append((dirty(process.pid), len(os.listdir(f"/proc/{process.pid}/fd"))))
        except (FileNotFoundError, ProcessLookupError, StopIteration, PermissionError):
            pass
        for picture in os.scandir(pictures) if pictures else ():
            os.remove(picture.path)
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
    return growth <= allowed and opened <= 0


def main():
    parse = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parse.add_argument("program")
    parse.add_argument("body")
    parse.add_argument("network")
    parse.add_argument("--frames", type=int, default=20000)
    parse.add_argument("--resizes", type=int, default=500)
    parse.add_argument("--openings", type=int, default=20)
    parse.add_argument("--pictures", type=int, default=0, help="of render")
    parse.add_argument("--clip", default="", help="of the app")
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
                              f"{wish.frames} frames, {wish.resizes} resizes, {wish.openings} openings", allowed=float("inf") if wish.validate else ALLOWED_KIB, env=environment, cwd=folder)
            finally:
                server.terminate()
                server.wait()
        if wish.pictures:
            artery, motion, pictures = (os.path.join(folder, name) for name in ("leg.swc", "sway.bvh", "pictures"))
            os.mkdir(pictures)
            for path, text in (artery, ARTERY), (motion, sway(wish.pictures)):
                with open(path, "w") as file:
                    file.write(text)
            network = os.path.join(folder, "leg.vasa")
            subprocess.run([program, "convert", artery, "--kind", "artery", "-o", network], check=True, stdout=subprocess.DEVNULL)
            good &= watch("render", [program, "render", *scene[:2], "--network", network, "--quiet", "--size", "64x64", "--quads", "4x2", "--samples", "1",
                                     "--hide", "skin,bones,organs", "--clip", motion, "-o", os.path.join(pictures, "{frame}.png")],
                          f"{wish.pictures} pictures", pictures, env=environment, cwd=folder)
    sys.exit(0 if good else 1)


main()
