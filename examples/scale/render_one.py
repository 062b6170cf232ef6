"""One job, as a pure function of files: what Dask, Ray and Slurm call. `python render_one.py FORM OUT JOB..` is the same by hand."""

import os
import sys
from functools import lru_cache
from pathlib import Path

import postform


@lru_cache(maxsize=8)
def post(form):
    """The form, read once by each process."""
    return postform.Post.from_file(form)


def render_one(job, form, out):
    """Prints a job into the folder `out`: the verdict, or the error. A program that is there and newer is left as it is."""
    job, form, out = Path(job), Path(form), Path(out)
    to = out / f"{job.stem}.nc"
    if to.is_file() and to.stat().st_mtime > max(job.stat().st_mtime, form.stat().st_mtime):
        return job.name, "there"
    try:
        program = post(str(form)).render(job)
    except postform.Error as error:
        return job.name, f"error: {error}"
    # whole or not at all, also where two workers get the same job
    part = out / f".{job.stem}.{os.getpid()}"
    part.write_text(program.program)
    os.replace(part, to)
    return job.name, program.verdict


if __name__ == "__main__":
    form, out, *jobs = sys.argv[1:]
    failed = 0
    for job in jobs:
        name, verdict = render_one(job, form, out)
        print(name, verdict)
        failed += verdict.startswith("error")
    sys.exit(failed > 0)
