"""postform as a post processor of FreeCAD: 0.20 (Path) and 1.1 (CAM).

Put this file into FreeCAD's macro folder, choose `postform` as the job's post processor and give it the arguments
`--form haas.pf`. It packs what FreeCAD hands over as a small document without geometry; the program `postform` reads
that as it reads every saved document, and prints the NC program.
"""

import argparse
import io
import os
import shlex
import shutil
import subprocess
import sys
import zipfile
from xml.sax.saxutils import quoteattr

import FreeCAD

TOOLTIP = "Prints the NC program with a POSTFORM form."
TOOLTIP_ARGS = """
--form FILE      the form, beside the document or in the macro folder (required)
--postform FILE  the program postform, where it is not on the path
All other arguments are those of `postform render`: --program 1001, --units inch, --set NAME=VALUE
"""

HERE = os.path.dirname(os.path.abspath(__file__))


class Refused(Exception):
    """No program comes of this; the text says why."""


def export(objectslist, filename, argstring):
    """Called by FreeCAD: 0.20 wants the file written, 1.1 wants the program returned (its filename is `-`)."""
    try:
        program = posted(objectslist, argstring or "")
        if filename == "-":
            return program.decode("ascii")
        with open(filename, "wb") as file:
            file.write(program)
        return program.decode("latin-1")
    except UnicodeDecodeError:
        why = "the program has bytes that FreeCAD can't write: a leader or parity.\nSave the document and use `postform render` on it."
    except (Refused, OSError) as error:
        why = str(error)
    FreeCAD.Console.PrintError("postform: " + why + "\n")
    if not FreeCAD.GuiUp:
        raise RuntimeError(why)
    from PySide import QtGui

    QtGui.QMessageBox.critical(None, "postform: no program was made", why)
    if filename != "-":
        raise RuntimeError(why)  # 0.20 takes a return for success
    return None


def posted(objectslist, argstring):
    """The program of these objects as bytes."""
    given, rest = arguments(argstring)
    operations = [item for item in objectslist if hasattr(item, "Document") and not hasattr(item, "ToolNumber")]
    if not operations:
        raise Refused("the job has no operation and no work offset to post.\nLook at its Output tab and at Active of its operations.")
    job = job_of(operations[0])
    template = form(given.form, job)
    fixtures = list(dict.fromkeys(item.Path.Commands[0].Name for item in objectslist if not hasattr(item, "Document")))
    document = packed(job, steps(job, operations), fixtures or job.Fixtures)
    command = [binary(given.postform), "render", "-", "--from", "freecad", "--form", template, *rest]
    hidden = {"creationflags": 0x08000000} if os.name == "nt" else {}  # no console window
    done = subprocess.run(command, input=document, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, **hidden)
    said = done.stderr.decode("utf-8", "replace").strip().replace("standard input", job.Label)
    if done.returncode != 0:
        raise Refused(said or "postform ended with status {}".format(done.returncode))
    if said:
        FreeCAD.Console.PrintWarning(said + "\n")
    return done.stdout


# What the user asks for


class Parser(argparse.ArgumentParser):
    """An argument parser that does not end FreeCAD."""

    def error(self, message):
        raise Refused("{}\nThe post processor's arguments are, for example, --form haas.pf".format(message))


def arguments(argstring):
    """The arguments: ours, and those of `postform render`."""
    parser = Parser(prog="postform", add_help=False, allow_abbrev=False)
    parser.add_argument("--form", required=True)
    parser.add_argument("--postform")
    words = shlex.shlex(argstring, posix=True, punctuation_chars=False)
    words.whitespace_split, words.commenters, words.escape = True, "", ""  # a backslash parts folders
    try:
        given, rest = parser.parse_known_args(list(words))
    except ValueError as error:
        raise Refused("the arguments can't be read: {}".format(error))
    if any(word in ("-o", "--output", "--from", "--job") or word.startswith("--output=") for word in rest):
        raise Refused("FreeCAD says the job and the file: take -o, --output, --from and --job out of the arguments")
    return given, rest


def form(name, job):
    """The form's file: beside the document, or beside this script."""
    places = [os.path.dirname(job.Document.FileName or ""), HERE]
    for place in places:
        if os.path.isfile(os.path.join(place, name)):
            return os.path.join(place, name)
    raise Refused("there is no form {} in {}".format(name, " or ".join(place for place in places if place)))


def binary(name):
    """The program postform: as named, beside this script, or on the path."""
    if name:
        return name
    beside = os.path.join(HERE, "postform.exe" if os.name == "nt" else "postform")
    found = beside if os.path.isfile(beside) else shutil.which("postform")
    if not found:
        raise Refused("the program postform is not on the path.\nPut it into {}, or give --postform FILE.".format(HERE))
    return found


# What is posted


def job_of(operation):
    """The job in whose list an operation is."""
    for item in operation.Document.Objects:
        if hasattr(item, "Fixtures") and operation in getattr(getattr(item, "Operations", None), "Group", []):
            return item
    raise Refused("the operation {} is in no job".format(operation.Label))


def own(item, name):
    """A property of an operation, or of what it dresses up."""
    while item is not None:
        if hasattr(item, name):
            return getattr(item, name)
        base = getattr(item, "Base", None)
        base = base[0] if isinstance(base, (list, tuple)) and base else base
        item = base if hasattr(base, "Path") else None
    return None


def steps(job, operations):
    """The operations that FreeCAD wants posted, in the job's order. 0.20 leaves comments and stops out of what it hands
    over: those before its operations, and after the last of all, are taken from the job."""
    if not FreeCAD.Version()[0] == "0":
        return list(dict.fromkeys(operations))
    found, waiting, last = [], [], False
    for item in job.Operations.Group:
        if item in operations:
            found += waiting + [item]
            waiting, last = [], True
        elif kind(item) in ("Comment", "Stop"):
            waiting.append(item)
        elif own(item, "Active"):
            waiting, last = [], False  # of another file, where output is split
    return found + (waiting if last else [])


def kind(item):
    """The class of an object's Python code."""
    return type(getattr(item, "Proxy", None)).__name__


# The document

OPERATION = ("Active", "CoolantMode", "StartDepth")
BARE = ("Comment", "Stop")
CONTROLLER = ("Label", "ToolNumber", "SpindleSpeed", "SpindleDir", "HorizFeed", "VertFeed")
TOOL = ("Diameter", "CornerRadius")


def packed(job, operations, fixtures):
    """A document of these operations as bytes: what postform reads of an .FCStd, and nothing else."""
    objects, paths = {}, {}
    objects["Job"] = [
        prop("Label", value(job.Label)),
        prop("Proxy", '<Python class="ObjectJob"/>'),
        prop("Operations", link("Operations")),
        prop("Fixtures", value([str(name) for name in fixtures])),
        prop("OrderOutputBy", value(job.OrderOutputBy)),
    ]
    objects["Operations"] = [prop("Group", links("op:" + item.Name for item in operations))]
    for item in operations:
        name = "op:" + item.Name
        paths[name + ".nc"] = item.Path.toGCode()
        objects[name] = [
            prop("Label", value(item.Label)),
            prop("Proxy", "<Python class={}/>".format(quoteattr(kind(item)))),
            prop("Path", "<Path file={}/>".format(quoteattr(name + ".nc"))),
        ]
        objects[name] += [prop(each, value(own(item, each))) for each in OPERATION]
        objects[name] += properties(item, BARE)
        controller = own(item, "ToolController")
        if controller is not None:
            objects[name].append(prop("ToolController", link(controller.Name)))
            tool, tool_name = controller.Tool, "tool:" + controller.Name
            objects[controller.Name] = properties(controller, CONTROLLER) + [prop("Tool", link(tool_name))]
            label = getattr(tool, "Label", None) or getattr(tool, "Name", None)  # tools before 0.19 have a name
            objects[tool_name] = [prop("Label", value(label))] + properties(tool, TOOL)
    version = ".".join(FreeCAD.Version()[:2]) + "R"
    document = job.Document
    about = [prop(each, value(getattr(document, each, None) or "")) for each in ("Label", "CreatedBy")]
    text = "<Document ProgramVersion={}><Properties>{}</Properties><ObjectData>".format(quoteattr(version), "".join(about))
    for name, held in objects.items():
        text += "<Object name={}><Properties>{}</Properties></Object>".format(quoteattr(name), "".join(held))
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("Document.xml", text + "</ObjectData></Document>")
        for name, path in paths.items():
            archive.writestr(name, path)
    return whole.getvalue()


def link(name):
    """A link to another object."""
    return "<Link value={}/>".format(quoteattr(name))


def links(names):
    """Links to other objects, in order."""
    return "<LinkList>{}</LinkList>".format("".join(link(name) for name in names))


def properties(item, names):
    """Those of these properties that an object has."""
    return [prop(name, value(getattr(item, name, None))) for name in names]


def prop(name, held):
    """A property that holds this element; nothing for none."""
    return "<Property name={}>{}</Property>".format(quoteattr(name), held) if held else ""


def value(given):
    """A value as a document holds it. Quantities are in mm, seconds and degrees."""
    given = getattr(given, "Value", given)
    if given is None:
        return ""
    if isinstance(given, bool):
        return '<Bool value="{}"/>'.format(str(given).lower())
    if isinstance(given, int):
        return '<Integer value="{}"/>'.format(given)
    if isinstance(given, float):
        return '<Float value="{!r}"/>'.format(given)
    if isinstance(given, list):
        return "<StringList>{}</StringList>".format("".join(value(each) for each in given))
    return "<String value={}/>".format(quoteattr(given))
