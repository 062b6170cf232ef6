"""`python with_ray.py FORM JOBS OUT [WORKERS]` prints all jobs of a folder on workers of Ray, which are processes of this machine."""

import os
import sys
from collections import Counter
from pathlib import Path

os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
import ray  # noqa: E402

from render_one import render_one  # noqa: E402


# the jobs of a killed worker are printed again
@ray.remote(max_retries=3)
def render_some(jobs, form, out):
    return os.getpid(), [render_one(job, form, out) for job in jobs]


def main():
    form, jobs, out, *workers = sys.argv[1:]
    Path(out).mkdir(exist_ok=True)
    here = str(Path(__file__).parent)
    # to use a cluster, pass its address instead
    ray.init(
        num_cpus=int(workers[0]) if workers else 2, include_dashboard=False, _node_ip_address="127.0.0.1",
        runtime_env={"env_vars": {"PYTHONPATH": here}}, logging_level="error",
    )
    paths = sorted(map(str, Path(jobs).glob("*.json")))
    waiting = [render_some.remote(paths[at : at + 50], form, out) for at in range(0, len(paths), 50)]
    verdicts, seen = Counter(), set()
    while waiting:
        done, waiting = ray.wait(waiting)
        for pid, results in ray.get(done):
            if pid not in seen:
                seen.add(pid)
                print("worker", pid, flush=True)
            verdicts.update(verdict.split(":")[0] for _, verdict in results)
    print(dict(verdicts))


if __name__ == "__main__":
    main()
