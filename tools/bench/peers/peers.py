#!/usr/bin/env python3
"""Times IRIS and OpenCV side by side: every operation that both have, on the same pictures, in one run, on one processor.

    peers.py --iris PROGRAM --port NAME [--sizes 640x480,...] [--only PART] [--json FILE] PYTHON...

Each PYTHON has a wheel of OpenCV; it runs this file with --serve. All sides are children that take the same lines
(main.c); they are asked in turn, round by round, so that a machine that is slow for a while is slow for all. A child
measures itself, calls one after the other, in processor time. Given are medians of the rounds, in milliseconds; OpenCV's
include the call from Python, which takes less than a microsecond. The best OpenCV is what counts."""
import argparse
import json
import os
import pickle
import re
import shutil
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROUND_NS = 2000000
SECONDS = 3  # for a row; five rounds in any case


# --- a side ---

class Side:
    def __init__(self, name, command):
        self.name, self.command = name, command
        quiet = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", PYTHONDONTWRITEBYTECODE="1")
        self.child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=quiet)

    def ask(self, line):
        self.child.stdin.write(line + "\n")
        self.child.stdin.flush()
        answer = self.child.stdout.readline()
        if not answer:
            sys.exit("peers.py: %s ended at: %s" % (self.name, line))
        return answer.strip()

    def case(self, folder, size, row):
        """The line that prepares the case; None when this side cannot do it."""
        files = [os.path.join(folder, row[k] + "." + k) if row[k] != "-" else "-" for k in ("gray", "color", "mask")]
        line = "case %d %d|%s|%s" % (*size, "|".join(files), row["name"])
        return line if self.ask(line) == "ok" else None

    def time(self, calls):
        return int(self.ask("run %d" % calls)) / calls

    def calls_of_a_round(self):
        self.time(1)
        return max(1, int(ROUND_NS / max(min(self.time(1), self.time(2)), 1)))


def serve():
    """OpenCV's side. A row that this OpenCV does not have is answered by -."""
    import cv2
    from pictures import Pictures
    from rows import ROWS
    cv2.setNumThreads(1)
    cv2.ocl.setUseOpenCL(False)
    now = None
    for line in sys.stdin:
        word, _, rest = line.strip().partition(" ")
        if word == "version":
            answer = cv2.__version__
        elif word == "case":
            size, *files, name = rest.split("|")
            row = next(r for r in ROWS if r["name"] == name)
            folder = os.path.dirname(next(f for f in files if f != "-"))
            try:
                now = row["make"](Pictures(folder, *map(int, size.split()), row))
                now()
                answer = "ok"
            except (AttributeError, cv2.error) as lack:
                answer = "- %s" % str(lack).replace("\n", " ")
        elif word == "run":
            start = time.process_time_ns()
            for _ in range(int(rest)):
                now()
            answer = time.process_time_ns() - start
        else:
            with open(rest, "wb") as file:
                pickle.dump(now(), file)
            answer = "ok"
        print(answer, flush=True)


# --- measuring ---

def read_ours(answer, path):
    import numpy as np
    from pictures import unpacked
    w, h, kind = map(int, answer.split())
    shape, pixel = {1: ((h, w), np.uint8), 2: ((h, w), np.int16), 3: ((h, w), np.uint16), 4: ((h, w), np.uint32),
                    5: (None, np.uint8)}.get(kind, ((h, w, 3), np.uint8))
    data = np.fromfile(path, pixel)
    return unpacked(data, w, h) if shape is None else data.reshape(shape)


def compare(row, folder, size, ours, best):
    from pictures import Pictures
    a, b = os.path.join(folder, "ours"), os.path.join(folder, "theirs")
    mine = read_ours(ours.ask("result " + a), a)
    best.ask("result " + b)
    with open(b, "rb") as file:
        theirs = pickle.load(file)
    return row["agree"](mine, theirs, Pictures(folder, *size, row))


def goal_of(row, port, size):
    """The goals are for AVX2 at 640x480; with SSE 1.4 is asked where they say 2 or more, and nothing of plain C."""
    if size != (640, 480):
        return 0
    if port == "avx2":
        return row["goal"]
    return 1.4 if port == "sse" and row["goal"] >= 2 else 0


def measure(row, folder, size, sides, options):
    """One row of the table; None when no OpenCV here has the operation."""
    ours, *peers = sides
    able = [ours] + [p for p in peers if p.case(folder, size, row)]
    if len(able) == 1:
        return None
    ours.case(folder, size, row)
    calls = {side: side.calls_of_a_round() for side in able}
    took = {side: [] for side in able}
    end = time.monotonic() + SECONDS
    for turn in range(options.rounds):
        if turn >= 5 and time.monotonic() > end:
            break
        for side in able[turn % len(able):] + able[:turn % len(able)]:
            if calls[side] > 1:
                side.time(1)
            took[side].append(side.time(calls[side]))
    ms = {side: statistics.median(t) / 1e6 for side, t in took.items()}
    best = min(able[1:], key=ms.get)
    agrees, how = compare(row, folder, size, ours, best)
    goal, ratio = goal_of(row, options.port, size), ms[best] / ms[ours]
    return dict(operation=row["name"], size="%dx%d" % size, ours=round(ms[ours], 5), theirs=round(ms[best], 5),
                ratio=round(ratio, 3), agrees=bool(agrees), difference=how, peer=best.name,
                peers={p.name: round(ms[p], 5) for p in able[1:]}, goal=goal or None,
                reached=ratio >= goal if goal else None, pictures=row)


def by_samples(result, ours, folder):
    """Samples of the running child, which works meanwhile."""
    data = os.path.join(folder, "perf.data")
    calls = max(1, int(2e7 / (result["ours"] * 1e6)))
    perf = subprocess.Popen(["perf", "record", "-q", "-F", "5000", "-o", data, "-p", str(ours.child.pid), "--",
                             "sleep", "0.3"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while perf.poll() is None:
        ours.time(calls)
    report = subprocess.run(["perf", "report", "-i", data, "--stdio", "--no-children", "-F", "overhead,symbol"],
                            capture_output=True, text=True).stdout
    words = [line.split() for line in report.splitlines() if line.strip() and not line.startswith("#")]
    return [(word[-1], word[0]) for word in words]


def by_instructions(ours, folder, line):
    """Instructions of some calls, counted in an emulator."""
    data = os.path.join(folder, "callgrind")
    subprocess.run(["valgrind", "-q", "--tool=callgrind", "--callgrind-out-file=" + data, "--toggle-collect=run",
                    *ours.command],
                   input=line + "\nrun 9\n", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
    report = subprocess.run(["callgrind_annotate", data], capture_output=True, text=True).stdout
    found = re.findall(r"\( ?([0-9.]+%)\) +\S*:(\S+)", report)
    return [(name.replace("'2", ""), share) for share, name in found]


def profile(result, ours, folder, size):
    """The functions that take the time, with their shares; nothing when neither tool is there."""
    line = ours.case(folder, size, result["pictures"])
    found = []
    if shutil.which("perf"):
        found = by_samples(result, ours, folder)
    if not found and shutil.which("valgrind"):
        found = by_instructions(ours, folder, line)
    return ["%s %s" % pair for pair in found[:3]]


# --- the table ---

HEAD = "%-42s %9s %9s %7s %6s  %-9s %s"


def show(result):
    print(HEAD % (result["operation"], "%.4f" % result["ours"], "%.4f" % result["theirs"], "%.2f" % result["ratio"],
                  result["goal"] or "", "" if result["goal"] is None else "reached" if result["reached"] else "MISSED",
                  ("" if result["agrees"] else "DISAGREES: ") + result["difference"]), flush=True)
    if result.get("profile"):
        print("    " + ", ".join(result["profile"]), flush=True)


def progress(text):
    if sys.stderr.isatty():
        sys.stderr.write("\r%-60s\r" % text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--iris", required=True, help="the program of IRIS's side")
    parser.add_argument("--port", required=True, help="which port that is: the goals depend on it")
    parser.add_argument("--sizes", default="640x480")
    parser.add_argument("--only", default="", help="rows with this in their name")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--json", help="where the rows go, as JSON")
    parser.add_argument("--work", required=True, help="a folder for pictures and results")
    parser.add_argument("python", nargs="+", help="a Python with a wheel of OpenCV")
    options = parser.parse_args()
    import pictures
    from rows import ROWS
    rows = [row for row in ROWS if options.only in row["name"]]
    if not rows:
        parser.error("no row has %r in its name" % options.only)
    if not all(re.fullmatch(r"[1-9]\d*x[1-9]\d*", text) for text in options.sizes.split(",")):
        parser.error("a size is WxH: %s" % options.sizes)
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    peers = [Side("", [python, os.path.join(HERE, "peers.py"), "--serve"]) for python in options.python]
    for peer in peers:
        peer.name = "OpenCV " + peer.ask("version")
    sides = [Side("IRIS", [options.iris])] + peers
    results = []
    for text in options.sizes.split(","):
        size = tuple(map(int, text.split("x")))
        folder = os.path.join(options.work, text)
        pictures.make(folder, *size)
        print("%s, milliseconds, IRIS (%s) beside the best of %s" % (text, options.port, ", ".join(p.name for p in peers)))
        print(HEAD % ("", "IRIS", "OpenCV", "ratio", "goal", "", "the results"))
        for row in rows:
            progress(row["name"])
            result = measure(row, folder, size, sides, options)
            if result is None:
                print("%s: no OpenCV here has it" % row["name"])
                continue
            if result["reached"] is False:
                result["profile"] = profile(result, sides[0], folder, size)
            del result["pictures"]
            progress("")
            show(result)
            results.append(result)
    goals = [r for r in results if r["goal"]]
    print("%d of %d goals reached; %d of %d results agree" % (
        sum(r["reached"] for r in goals), len(goals), sum(r["agrees"] for r in results), len(results)))
    if options.json:
        with open(options.json, "w") as file:
            json.dump(results, file, indent=1)
    return 0 if all(r["agrees"] for r in results) else 1


if __name__ == "__main__":
    sys.exit(serve() if sys.argv[1:] == ["--serve"] else main())
