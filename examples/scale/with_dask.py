"""`python with_dask.py FORM JOBS OUT [WORKERS]` prints all jobs of a folder on workers of Dask, which are processes of this machine."""

import sys
from collections import Counter
from pathlib import Path

from dask.distributed import Client, LocalCluster, as_completed

from render_one import render_one


def main():
    form, jobs, out, *workers = sys.argv[1:]
    Path(out).mkdir(exist_ok=True)
    # to use a cluster, connect the client to the address of its scheduler instead
    with LocalCluster(
        n_workers=int(workers[0]) if workers else 2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
    ) as cluster, Client(cluster) as client:
        client.upload_file(str(Path(__file__).with_name("render_one.py")))
        print("workers", *sorted(worker.pid for worker in cluster.workers.values()), flush=True)
        # the jobs of a killed worker go to another worker
        futures = client.map(render_one, sorted(map(str, Path(jobs).glob("*.json"))), form=form, out=out, retries=3, batch_size=500)
        verdicts = Counter(future.result()[1].split(":")[0] for future in as_completed(futures))
    print(dict(verdicts))


if __name__ == "__main__":
    main()
