#!/usr/bin/env python3
"""`kills.py POSTFORM COUNT [SEED]` kills, at random moments, each command that writes files. Afterwards, an output must be complete or missing,
earlier files must still exist, and no other file may remain. Prints a line for each command. The exit status is 1 if a command fails."""

import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
POSTFORM, COUNT = str(Path(sys.argv[1]).resolve()), int(sys.argv[2])
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 0


def prepared(folder: Path) -> None:
    shutil.copy(ROOT / "postforms/haas.pf", folder / "haas.pf")
    subprocess.run([sys.executable, ROOT / "examples/scale/make_jobs.py", folder / "jobs", "20"], check=True)
    for sample in ("bracket", "plate"):
        shutil.copy(ROOT / f"samples/{sample}/job.json", folder / f"{sample}.json")
    shutil.copy(ROOT / "samples/bracket/expected.haas.nc", folder / "old.nc")
    # a form that fmt and lint --fix change
    text = (folder / "haas.pf").read_text()
    (folder / "messy.pf").write_text(text.replace("M30", "M30   ").replace("End\n", "End \n"))


# the arguments of each command, and the files that it writes
COMMANDS = {
    "render": (["render", "bracket.json", "--form", "haas.pf", "-o", "out.nc", "-q"], ["out.nc"]),
    "render over": (["render", "plate.json", "--form", "haas.pf", "-o", "old.nc", "-q"], ["old.nc"]),
    "render .gz": (["render", "bracket.json", "--form", "haas.pf", "-o", "out.nc.gz", "-q"], ["out.nc.gz"]),
    "render --trace": (["render", "bracket.json", "--form", "haas.pf", "-o", "out.nc", "--trace", "map.jsonl", "-q"], ["out.nc", "map.jsonl"]),
    "render --out-dir": (["render", "jobs", "--form", "haas.pf", "--out-dir", "nc", "-q"], [f"nc/part{n:05}.nc" for n in range(20)]),
    "plot": (["plot", "bracket.json", "--form", "haas.pf", "-o", "part.svg"], ["part.svg"]),
    "sheet": (["sheet", "bracket.json", "--form", "haas.pf", "-o", "sheet.html"], ["sheet.html"]),
    "restart": (["restart", "old.nc", "--control", "haas", "--tool", "3", "-o", "again.nc"], ["again.nc"]),
    "fmt": (["fmt", "messy.pf"], ["messy.pf"]),
    "test --new": (["test", "--new", "haas.pf", "cases"], None),
}


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def main() -> int:
    rng = random.Random(SEED)
    worst = 0
    for name, (arguments, outputs) in COMMANDS.items():
        failures, killed, slowest = [], 0, 0.0
        with tempfile.TemporaryDirectory() as work:
            clean = Path(work) / "clean"
            clean.mkdir()
            prepared(clean)
            before = contents(clean)
            whole = Path(work) / "whole"
            shutil.copytree(clean, whole)
            start = time.perf_counter()
            subprocess.run([POSTFORM, *arguments], cwd=whole, capture_output=True)
            slowest = time.perf_counter() - start
            right = contents(whole)
            for turn in range(COUNT):
                folder = Path(work) / "turn"
                shutil.copytree(clean, folder)
                child = subprocess.Popen([POSTFORM, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(rng.uniform(0, slowest * 1.1))
                child.send_signal(rng.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT]))
                killed += child.wait() < 0
                for file, text in contents(folder).items():
                    expected = [files[file] for files in (before, right) if file in files]
                    if text not in expected:
                        failures.append(f"turn {turn}: {file} is {'another one' if expected else 'left behind'}")
                failures += [f"turn {turn}: {file} is lost" for file in before if not (folder / file).exists()]
                shutil.rmtree(folder)
        print(f"{name:18} {COUNT} times, killed {killed}: {len(failures)} wrong")
        for failure in failures[:3]:
            print(f"  {failure}")
        worst |= bool(failures)
    return worst


if __name__ == "__main__":
    sys.exit(main())
