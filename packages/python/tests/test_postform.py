"""Tests of the installed package. Run the tests outside of this folder, with POSTFORM_ROOT set to the repository."""

import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import postform
import pytest

ROOT = Path(os.environ["POSTFORM_ROOT"])
BRACKET = ROOT / "samples/bracket/job.json"
EXPECTED = (ROOT / "samples/bracket/expected.haas.nc").read_text()


@pytest.fixture(scope="module")
def post():
    return postform.Post.from_file(ROOT / "postforms/haas.pf")


def test_a_path_a_mapping_and_a_text_are_the_same_job(post):
    program = post.render(BRACKET)
    assert program.program == EXPECTED
    assert program.verdict.split()[0] == "equivalent:"
    assert program.file_name == "job.nc"
    assert str(program) == EXPECTED
    job = json.loads(BRACKET.read_text())
    assert post.render(str(BRACKET)).program == EXPECTED
    assert post.render(job).program == EXPECTED
    assert post.render_text(json.dumps(job), "json").program == EXPECTED


def items(holes):
    yield {"start": {"postform": 1, "program": 7, "units": "mm", "tools": [{"number": 1}]}}
    yield {"operation": {"tool": 1, "work": 54, "spindle": {"speed": 1000, "direction": "cw"}, "coolant": "flood"}}
    yield {"cycle": {"kind": "drill", "depth": 5, "clear": 2, "return": 10, "feed": 100}}
    for hole in range(holes):
        yield {"point": [hole, 0, 0]}
    yield {"cycle_end": True}
    yield {"end": True}


def test_items_one_after_the_other(post):
    program = post.render(items(1000))
    assert program.verdict == "identical"
    assert program.program.count("\n") > 1000


def test_an_error_of_the_iterator_is_its_own(post):
    def broken():
        yield from list(items(3))[:4]
        raise KeyError("lost")

    with pytest.raises(KeyError):
        post.render(broken())
    # an iterable that ends too early is an incomplete job
    with pytest.raises(postform.Error) as error:
        post.render(list(items(3))[:4])
    assert error.value.findings[-1].code == "PJ007"


def test_a_wrong_program_is_refused_with_all_that_is_known(tmp_path):
    text = (ROOT / "postforms/haas.pf").read_text().replace("G43 H[lcomp]", "H[lcomp]")
    form = tmp_path / "wrong.pf"
    form.write_text(text)
    with pytest.raises(postform.Refused) as refused:
        postform.Post.from_file(form).render(BRACKET)
    assert refused.value.program.startswith("%")
    assert refused.value.verdict.startswith("different")
    finding = next(finding for finding in refused.value.findings if finding.code == "PV014")
    assert Path(finding.file) == form and finding.line > 80  # the line of the form that printed it
    # with verify=False, the program is printed without the proof
    program = postform.Post.from_file(form).render(BRACKET, verify=False)
    assert program.verdict.startswith("not proven")


def test_findings_of_a_form(tmp_path):
    form = tmp_path / "a.pf"
    form.write_text("StartCode\n%\nEnd\n1stToolChange\nT[tool]  M6\nEnd\nEndCode\nM30\nEnd\n")
    finding = next(finding for finding in postform.lint(form) if finding.code == "PF101")
    assert (finding.line, finding.severity, Path(finding.file)) == (5, "warning", form)
    assert finding.help and "PF101" in str(finding)
    with pytest.raises(postform.Error) as error:
        postform.Post.from_file(form)
    assert any(finding.severity == "error" for finding in error.value.findings)


def test_a_form_calls_others_in_its_folder_alone(tmp_path):
    folder = tmp_path / "forms"
    folder.mkdir()
    text = (ROOT / "postforms/haas.pf").read_text()
    (tmp_path / "outside.pf").write_text("")
    (folder / "link.pf").symlink_to(tmp_path / "outside.pf")
    for name in ["link.pf", "../outside.pf"]:
        (folder / "my.pf").write_text(text + f"Call {name}\n")
        with pytest.raises(postform.Error, match="outside"):
            postform.Post.from_file(folder / "my.pf")


@pytest.mark.parametrize(
    ("job", "error"),
    [
        (3, TypeError),
        ("nowhere.json", OSError),
        ({"postform": 1, "operations": []}, postform.Error),
        ({"x": float("nan")}, ValueError),
    ],
)
def test_what_is_no_job(post, job, error):
    with pytest.raises(error):
        post.render(job)


def test_wrong_options(post):
    for options in [{"units": "cm"}, {"properties": {"nothing": 1}}, {"set": {"x": 1}}, {"date": "today"}]:
        with pytest.raises(ValueError):
            post.render(BRACKET, **options)
    for date in ["2026-02-30", "20260331", "2026-03-31T25:00"]:
        with pytest.raises(ValueError):
            post.render(BRACKET, date=date)
    with pytest.raises(TypeError, match="assume_units"):
        post.render(BRACKET, unit="mm")
    with pytest.raises(ValueError, match="haas-4axis"):
        postform.Post.shipped("nobody")


def test_options(post):
    assert "header" in post.properties
    assert post.control == "haas"
    program = post.render(BRACKET, program=12, properties={"header": False}).program
    assert "O00012" in program
    assert postform.Post.shipped("haas").render(BRACKET).program == EXPECTED
    assert post.verify(BRACKET, EXPECTED).startswith("equivalent")
    assert post.verify(BRACKET, EXPECTED.replace("G0 Z1.", "G0 Z-1.")).startswith("different")


def test_threads_share_a_post(post):
    """Rendering releases the interpreter, so that other threads continue."""
    programs = []
    threads = [threading.Thread(target=lambda: programs.append(post.render(BRACKET).program)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert programs == [EXPECTED] * 8


def test_posts_and_jobs_go_to_other_processes(post):
    """Dask and Ray must send functions and paths, not posts: pickling a post raises an error."""
    import pickle

    with pytest.raises(TypeError):
        pickle.dumps(post)


def test_the_command():
    done = subprocess.run([sys.executable, "-m", "postform", "--version"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["postform", postform.__version__]
