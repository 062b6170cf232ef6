#!/usr/bin/env python3
"""Two binaries of postform for the same work, in turn: for each kind of work the least CPU time of both, and the median of the ratios of the pairs.

Usage: benches/pairs.py OLD NEW [RUNS [ITEMS]]; needs target/dist/examples/floor (`cargo build --profile dist --example floor`).
The files are in the folder of temporary files; the programs that are printed are compared byte for byte.
"""

import filecmp
import os
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FLOOR = os.path.join(ROOT, "target/dist/examples/floor")
FORM = os.path.join(ROOT, "postforms/linuxcnc.pf")

# name, input of the floor program, arguments; {in} and {out} are files
WORK = [
    ("moves of JSON Lines, without the proof", "moves", "render {in} --form {form} --no-verify -o {out}"),
    ("the same, proven", "moves", "render {in} --form {form} -o {out}"),
    ("moves of a CL file, without the proof", "cl", "render {in} --form {form} --no-verify -o {out}"),
    ("holes of a machine cycle, without the proof", "holes", "render {in} --form {form} --no-verify -o {out}"),
    ("the same, proven", "holes", "render {in} --form {form} -o {out}"),
    ("simulate, printed as text", "nc", "simulate --control linuxcnc {in}"),
    ("simulate --dry", "nc", "simulate --dry --control linuxcnc {in}"),
    ("diff --motion of a program with itself", "nc", "diff --motion --control linuxcnc {in} {in}"),
]


def cpu(binary: str, arguments: list[str]) -> float:
    """CPU seconds of one run; stops at an exit status other than 0."""
    process = subprocess.Popen([binary, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{binary} {' '.join(arguments)}: status {status}")
    return used.ru_utime + used.ru_stime


def main() -> None:
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    binaries = sys.argv[1:3]
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 7
    items = sys.argv[4] if len(sys.argv) > 4 else "1000000"
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'':46} {'old':>7} {'new':>7}  ratio", flush=True)
        for name, kind, command in WORK:
            suffix = {"cl": ".cl", "nc": ".nc"}.get(kind, ".jsonl")
            given = os.path.join(folder, kind + suffix)
            if not os.path.exists(given):
                with open(given, "wb") as file:
                    subprocess.run([FLOOR, "make", kind, items], stdout=file, check=True)
            outputs = [os.path.join(folder, f"{number}.out") for number in range(2)]
            arguments = [
                [word.format_map({"in": given, "out": out, "form": FORM}) for word in command.split()] for out in outputs
            ]
            times: list[tuple[float, float]] = []
            for run in range(runs):
                # the binary that runs first changes, because the second one finds warm files
                order = (0, 1) if run % 2 == 0 else (1, 0)
                pair = {at: cpu(binaries[at], arguments[at]) for at in order}
                times.append((pair[0], pair[1]))
            if "{out}" in command and not filecmp.cmp(*outputs, shallow=False):
                sys.exit(f"{name}: the binaries print other bytes")
            old, new = (min(pair[at] for pair in times) for at in range(2))
            ratio = statistics.median(pair[1] / pair[0] for pair in times)
            print(f"{name:46} {old:6.2f}s {new:6.2f}s  {ratio:5.2f}", flush=True)


main()
