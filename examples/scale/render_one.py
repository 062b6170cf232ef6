"""A function that prints one job, for Dask and Ray. `python render_one.py FORM OUT JOB..` calls this function for each JOB."""

import os
import sys
from functools import lru_cache
from pathlib import Path

import postform


@lru_cache(maxsize=8)
def post(form):
    """The compiled form. Each process reads a form only once."""
    return postform.Post.from_file(form)


def render_one(job, form, out):
    """Prints a job into the folder `out`. Returns the verdict or the error. A program that is newer than its job and form is kept."""
    job, form, out = Path(job), Path(form), Path(out)
    to = out / f"{job.stem}.nc"
    if to.is_file() and to.stat().st_mtime > max(job.stat().st_mtime, form.stat().st_mtime):
        return job.name, "there"
    try:
        program = post(str(form)).render(job)
    except postform.Error as error:
        return job.name, f"error: {error}"
    # the program is written completely or not at all, even if two workers get the same job
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
