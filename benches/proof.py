#!/usr/bin/env python3
"""Measures the cost of the proof: renders with and without the proof, in turn, on all cores and on one core.

`benches/proof.py POSTFORM FLOOR [ROUNDS]` makes the jobs with the example `floor`. For each job, it prints the time with
--no-verify, and the time with the proof as a multiple of that time. The multiples are those of the elapsed time on all
cores, of the elapsed time on one core, and of the processor time (CPU). Each command runs several times in turn, and the
best time is used, because the times vary. `two at once` is the time of two renders without the proof that run at the same
time, as a multiple of the time of one render: 1.00 if the machine has two free cores. Goals: 1.25 on two cores, 2.0 on one
core, and 32 MB of memory for a program of any length.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time

FORM = "postforms/linuxcnc.pf"
JOBS = [
    ("1,000,000 moves", "moves", 1_000_000, "jsonl", False),
    ("the same from standard input", "moves", 1_000_000, "jsonl", True),
    ("10,000,000 moves", "moves", 10_000_000, "jsonl", False),
    ("2,000,000 holes", "holes", 2_000_000, "jsonl", False),
    ("1,000,000 moves of a CL file", "cl", 1_000_000, "cl", False),
]


def run(command, source):
    """The elapsed seconds, the seconds of processor time, and the peak kilobytes of one run."""
    with open(source or os.devnull, "rb") as given:
        start = time.perf_counter()
        child = subprocess.Popen(command, stdin=given, stderr=subprocess.PIPE)
        told = child.stderr.read().decode()
        _, status, used = os.wait4(child.pid, 0)
        passed = time.perf_counter() - start
    if status != 0 or ("--no-verify" not in command and not told.startswith(("identical", "equivalent"))):
        sys.exit(f"{' '.join(command)}: status {status}: {told}")
    return passed, used.ru_utime + used.ru_stime, used.ru_maxrss


def twice(commands, source):
    """The elapsed seconds until two commands that run at the same time have ended."""
    with open(source or os.devnull, "rb") as one, open(source or os.devnull, "rb") as other:
        start = time.perf_counter()
        given = zip(commands, (one, other))
        children = [subprocess.Popen(command, stdin=file, stderr=subprocess.DEVNULL) for command, file in given]
        failed = [child.wait() for child in children] != [0, 0]
    if failed:
        sys.exit(f"{' '.join(commands[0])}: it fails beside another")
    return time.perf_counter() - start


def best(runs):
    """The best elapsed time, the best processor time, and the highest memory of several runs."""
    return min(run[0] for run in runs), min(run[1] for run in runs), max(run[2] for run in runs)


def measure(postform, job, piped, rounds, prefix, out):
    """Renders a job without and with the proof, in turn, and returns the best results."""
    what = ["-", "--from", "jsonl"] if piped else [job]
    render = prefix + [postform, "render", *what, "--form", FORM, "--set", "header=off", "-o"]
    command = render + [out]
    both = [render + [out + number, "--no-verify"] for number in ("1", "2")]
    source = job if piped else None
    plain, proven, pairs = [], [], []
    for _ in range(rounds):
        plain.append(run(command + ["--no-verify"], source))
        proven.append(run(command, source))
        if not prefix:
            pairs.append(twice(both, source))
    return best(plain), best(proven), min(pairs, default=0.0)


def main():
    postform, floor = sys.argv[1:3]
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    folder = tempfile.mkdtemp()
    out = os.path.join(folder, "out.nc")
    print("| job | --no-verify | proven | two at once | one core | CPU | memory |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    try:
        for name, kind, count, ending, piped in JOBS:
            job = os.path.join(folder, f"{kind}-{count}.{ending}")
            if not os.path.exists(job):
                with open(job, "wb") as file:
                    subprocess.run([floor, "make", kind, str(count)], stdout=file, check=True)
            plain, proven, pair = measure(postform, job, piped, rounds, [], out)
            plain_one, proven_one, _ = measure(postform, job, piped, rounds, ["taskset", "-c", "0"], out)
            print(
                f"| {name} | {plain[0]:.2f} s | {proven[0] / plain[0]:.2f} times | {pair / plain[0]:.2f} times"
                f" | {proven_one[0] / plain_one[0]:.2f} times"
                f" | {proven_one[1] / plain_one[1]:.2f} times | {max(proven[2], proven_one[2]) / 1024:.0f} MB |",
                flush=True,
            )
    finally:
        shutil.rmtree(folder)


main()
