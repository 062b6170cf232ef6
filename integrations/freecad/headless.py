"""Posts documents inside FreeCAD, as its own command does, and writes what comes: run by `integrations/freecad/run`.

The environment says what: POSTFORM_DOCUMENTS (a folder; those of its version are taken), POSTFORM_ARGUMENTS, POSTFORM_OUT.
"""

import os
import re
import shlex
import shutil
import sys
import zipfile

import FreeCAD

sys.path.insert(0, os.path.dirname(os.environ["POSTFORM_POST"]))
import machines  # noqa: E402, found beside the post

def install():
    """Puts the post into the macro folder, as a user does."""
    folder = FreeCAD.getUserMacroDir(True)
    os.makedirs(folder, exist_ok=True)
    shutil.copy(os.environ["POSTFORM_POST"], folder)


def opened(file):
    """A document with its saved label. FreeCAD replaces the label by the name of the file when it opens a document."""
    with zipfile.ZipFile(file) as archive:
        text = archive.read("Document.xml").decode("utf-8")
    document = FreeCAD.openDocument(file)
    document.Label = re.search(r'<Property name="Label"[^>]*>\s*<String value="([^"]*)"', text).group(1)
    return document


def jobs(document):
    """The jobs of a document."""
    return [item for item in document.Objects if hasattr(item, "Fixtures") and hasattr(item, "Operations")]


def posted_by_0_20(job):
    """The programs, by FreeCAD's own way to them: list of objects, loaded post, file."""
    from PathScripts.PathPost import CommandPathPost
    from PathScripts.PathPostProcessor import PostProcessor

    programs = []
    for part, objects in enumerate(CommandPathPost().buildPostList(job)):
        file = os.path.join(os.environ["POSTFORM_OUT"], "written-{}.nc".format(part))
        PostProcessor.load("postform").export(objects, file, os.environ["POSTFORM_ARGUMENTS"])
        with open(file, newline="") as written:
            programs.append(written.read())
        os.remove(file)
    return programs


def posted_by_1_1(job):
    """The programs that FreeCAD gets and would write."""
    from Path.Post.Processor import PostProcessorFactory

    # a job made before the post was installed does not know its name
    job.PostProcessor = sorted(set(job.getEnumerationsOfProperty("PostProcessor")) | {"postform"})
    job.PostProcessor = "postform"
    job.PostProcessorArgs = os.environ["POSTFORM_ARGUMENTS"]
    return [program for _, program in PostProcessorFactory.get_post_processor(job, "postform").export()]


def posted_by_machine(job):
    """The programs of a machine: the class that later versions of FreeCAD load, with the objects of this FreeCAD."""
    from Path.Post import Processor

    plain = Processor.PostProcessor
    Processor.PostProcessor = machines.later(plain)
    try:
        post = Processor.PostProcessorFactory.get_post_processor(job, "postform")
    finally:
        Processor.PostProcessor = plain
    _, form, _, program = shlex.split(os.environ["POSTFORM_ARGUMENTS"])
    return [program for _, program in machines.generated(post, machines.machine(form=form, postform=program))]


def moved(document, posted):
    """An operation with a Placement: FreeCAD gets the message as an error, and no program."""
    group = jobs(document)[0].Operations.Group
    operation = [item for item in group if getattr(item, "Active", True) and type(item.Proxy).__name__ not in ("Comment", "Stop")][0]
    kept, operation.Placement = operation.Placement, FreeCAD.Placement(FreeCAD.Vector(0, 5, 0), FreeCAD.Rotation())
    try:
        posted(jobs(document)[0])
    except RuntimeError as error:
        assert "has a Placement (X0 Y5 Z0)" in str(error), error
    else:
        raise AssertionError("a moved operation was posted")
    operation.Placement = kept


def turned(document, posted):
    """A tool of FreeCAD 1.1 that turns in another direction than its controller: an error, and no program."""
    controller = jobs(document)[0].Operations.Group[0].ToolController
    controller.Tool.SpindleDirection = "Reverse"
    document.recompute()
    try:
        posted(jobs(document)[0])
    except RuntimeError as error:
        assert "has the spindle direction Forward" in str(error), error
    else:
        raise AssertionError("a tool with another direction was posted")
    controller.Tool.SpindleDirection = "Forward"
    document.recompute()


def refused(document, posted):
    """A tool without a speed: FreeCAD gets the message as an error, and no program."""
    for item in document.Objects:
        if hasattr(item, "SpindleSpeed"):
            item.SpindleSpeed = 0
    try:
        posted(jobs(document)[0])
    except RuntimeError as error:
        assert "has no spindle speed" in str(error), error
    else:
        raise AssertionError("a tool without a speed was posted")


def main():
    install()
    posted = posted_by_0_20 if FreeCAD.Version()[0] == "0" else posted_by_1_1
    version = ".".join(FreeCAD.Version()[:2])
    folder = os.environ["POSTFORM_DOCUMENTS"]
    for file in sorted(file for file in os.listdir(folder) if file.endswith("-{}.FCStd".format(version))):
        name = file[: -len(".FCStd")]
        document = opened(os.path.join(folder, file))
        for job in jobs(document):
            for split in (False, True):
                job.SplitOutput = split
                programs = posted(job)
                if posted is posted_by_1_1:
                    assert posted_by_machine(job) == programs
                for part, program in enumerate(programs):
                    file = "{}.{}{}.nc".format(name, "split-" if split else "", part)
                    with open(os.path.join(os.environ["POSTFORM_OUT"], file), "w", newline="") as out:
                        out.write(program)
                    if split:
                        assert program.count(" M6") == 1 or job.OrderOutputBy != "Tool", program
        moved(document, posted)
        if name == "holes-1.1":
            turned(document, posted)
        refused(document, posted)
        FreeCAD.closeDocument(document.Name)
    print("posted inside FreeCAD", ".".join(FreeCAD.Version()[:3]))


main()
