"""postform as a post processor of FreeCAD: 0.20 (Path), 1.1 (CAM), and machines of later versions.

Put this file into FreeCAD's macro folder. In 0.20 and 1.1, choose `postform` as the post processor of the job, and enter
the arguments `--form haas.pf`. In later versions, choose `postform` as the post processor of a machine, and enter the
form in the properties of the machine.

The script writes the operations that FreeCAD gives it into a small document without geometry. The program `postform`
reads this document like a saved document, and prints the NC program.
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

try:
    from Path.Post.Processor import PostProcessor
except ImportError:  # 0.20
    PostProcessor = None

TOOLTIP = "Prints the NC program with a POSTFORM form."
TOOLTIP_ARGS = """
--form FILE      the form, in the folder of the document or in the macro folder (required)
--postform FILE  the program postform, if it is neither on the path nor in the macro folder
All other arguments are those of `postform render`: --program 1001, --units inch, --set NAME=VALUE
"""

HERE = os.path.dirname(os.path.abspath(__file__))


class Refused(Exception):
    """No program is printed. The text contains the reason."""


def export(objectslist, filename, argstring):
    """Called by FreeCAD. In 0.20, it writes the file. In 1.1, the file name is `-`, and it returns the program."""
    try:
        program = posted(objectslist, *arguments(argstring or ""))
        if filename == "-":
            return text(program)
        with open(filename, "wb") as file:
            file.write(program)
        return program.decode("latin-1")
    except (Refused, OSError) as error:
        why = str(error)
    FreeCAD.Console.PrintError("postform: " + why + "\n")
    if not FreeCAD.GuiUp:
        raise RuntimeError(why)
    from PySide import QtGui

    QtGui.QMessageBox.critical(None, "postform: no program was made", why)
    if filename != "-":
        raise RuntimeError(why)  # in 0.20, a return means success
    return None


def posted(objectslist, given, rest, author=None):
    """The program of these objects as bytes. `author` replaces the author of the document."""
    operations, fixtures = sorted_out(objectslist)
    if not operations:
        raise Refused("the job has no operation and no work offset to post.\nLook at its Output tab and at Active of its operations.")
    job = job_of(operations[0])
    template = form(given.form, job)
    document = packed(job, steps(job, operations), fixtures or job.Fixtures, author)
    command = [binary(given.postform), "render", "-", "--from", "freecad", "--form", template, *rest]
    hidden = {"creationflags": 0x08000000} if os.name == "nt" else {}  # no console window
    done = subprocess.run(command, input=document, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, **hidden)
    said = done.stderr.decode("utf-8", "replace").strip().replace("standard input", job.Label)
    if done.returncode != 0:
        raise Refused(said or "postform ended with status {}".format(done.returncode))
    if said:
        FreeCAD.Console.PrintWarning(said + "\n")
    return done.stdout


def text(program):
    """The program as text, for versions of FreeCAD that write the file themselves."""
    try:
        return program.decode("ascii")
    except UnicodeDecodeError:
        raise Refused("the program has bytes that FreeCAD can't write: a leader or parity.\nSave the document and use `postform render` on it.")


# Machines of FreeCAD after 1.1: its dialog chooses a machine, and the machine names the post processor

TEXTS = (
    "preamble",
    "postamble",
    "safetyblock",
    "pre_job",
    "post_job",
    "pre_fixture_change",
    "post_fixture_change",
    "pre_operation",
    "post_operation",
    "pre_tool_change",
    "post_tool_change",
    "tool_return",
    "pre_rotary_move",
    "post_rotary_move",
)
"""Properties of a machine with texts of the program. postform prints the texts of the form instead."""

PROCESSING = {
    "early_tool_prep": (False, "print T[nexttool] in the form"),
    "filter_inefficient_moves": (False, "postform prints all moves of the operations"),
    "split_arcs": (False, "use a form that prints arcs as the control reads them"),
    "tool_change": (True, "use a form whose ToolChange prints no M6"),
    "translate_drill_cycles": (False, "use a form without the sequences of the cycles: postform then prints moves"),
    "translate_rapid_moves": (False, "print G1 in the form's RapidCode"),
    "xy_before_z_after_tool_change": (False, "print X and Y before Z in the form's ToolChange"),
    "return_to": (None, "print the position in the form's EndCode"),
}
"""Options of a machine that change the moves: the value that changes nothing, and what to do instead."""

WAITS = ("spindle_wait", "toolhead_wait", "coolant_delay")
"""Waiting times of a spindle, in seconds."""


def options_without_effect(machine):
    """Refuse a machine with options that change the motions in FreeCAD's own posts; warn if it has texts."""
    for name, (plain, instead) in PROCESSING.items():
        if getattr(getattr(machine, "processing", None), name, plain) != plain:
            raise Refused("postform does not use the machine's option `{}`: set it to {}.\nInstead, {}.".format(name, plain, instead))
    for spindle in getattr(machine, "toolheads", None) or getattr(machine, "spindles", None) or []:
        for name in WAITS:
            if getattr(spindle, name, 0):
                raise Refused("postform does not use the machine's option `{}`: set it to 0.\nInstead, print the dwell in the form.".format(name))
    given = getattr(machine, "postprocessor_properties", None) or {}
    lost = [name for name in TEXTS if given.get(name)]
    if lost:
        FreeCAD.Console.PrintWarning(
            "postform: the program does not contain these texts of the machine: {}. The form contains its own texts.\n".format(", ".join(lost))
        )


if hasattr(PostProcessor, "export2"):

    class Postform(PostProcessor):
        """The post processor of a machine, and of a job without a machine."""

        def __init__(self, job):
            super().__init__(job, tooltip=TOOLTIP, tooltipargs=TOOLTIP_ARGS, units="Metric")

        @classmethod
        def get_common_property_schema(cls):
            """Of FreeCAD's common properties, only the extension of the file has an effect."""
            return [each for each in super().get_common_property_schema() if each["name"] == "file_extension"]

        @classmethod
        def get_property_schema(cls):
            """The properties of a machine that are postform's own."""
            return [
                {
                    "name": "form",
                    "type": "file",
                    "label": "Form",
                    "default": "",
                    "help": "The form, in the folder of the document or in the macro folder, or its whole path.",
                },
                {
                    "name": "arguments",
                    "type": "str",
                    "label": "Arguments",
                    "default": "",
                    "help": "Arguments of `postform render`, such as --program 1001 --set NAME=VALUE",
                },
                {
                    "name": "postform",
                    "type": "file",
                    "label": "Program postform",
                    "default": "",
                    "help": "The program postform, if it is neither on the path nor in the macro folder.",
                },
            ]

        @property
        def tooltip(self):
            """What the post processor does."""
            return TOOLTIP

        @property
        def tooltipArgs(self):
            """The arguments of a job without a machine."""
            return TOOLTIP_ARGS

        def apply_configuration_bundle(self, overrides=None):
            """Put the properties into `values`. Without a machine, FreeCAD has none."""
            if self._machine is not None:
                super().apply_configuration_bundle(overrides)
            else:
                self.values.update({name.upper(): value for name, value in (overrides or {}).items()})

        def export(self):
            """The programs of a job without a machine: parts of the output with their names."""
            return [(name, export(items, "-", self._job.PostProcessorArgs)) for name, items in self._buildPostList()]

        def export2(self):
            """The programs of a job with a machine: parts of the output with their names."""
            if not self.pre_processing_dialog():
                return None
            if not getattr(self, "_bundle_applied", False):
                self.apply_configuration_bundle()
            try:
                options_without_effect(self._machine)
                given, rest = arguments(self.values["ARGUMENTS"] or "", self.values["FORM"] or "", self.values["POSTFORM"])
                if not any(word.split("=")[0] in ("-u", "--units") for word in rest):
                    inch = getattr(self.values["OUTPUT_UNITS"], "value", "") == "imperial"
                    rest = ["--units", "inch" if inch else "mm"] + rest
                programs = [
                    (name, text(posted(items, given, rest, self.values.get("JOB_AUTHOR")))) for name, items in self._buildPostList()
                ]
            except (Refused, OSError) as error:
                raise RuntimeError("postform: {}".format(error))
            if any("\r" in program for _, program in programs):
                FreeCAD.Console.PrintWarning("postform: FreeCAD writes the line ends of this computer, not those of the form's LineEnd.\n")
            return [(name, program.replace("\r\n", "\n")) for name, program in programs]


# Arguments


class Parser(argparse.ArgumentParser):
    """An argument parser that does not end FreeCAD."""

    def error(self, message):
        raise Refused("{}\nThe post processor's arguments are, for example, --form haas.pf".format(message))


def arguments(argstring, template=None, program=None):
    """The arguments of this script, and those of `postform render`. A machine gives the form and the program postform."""
    parser = Parser(prog="postform", add_help=False, allow_abbrev=False)
    if template is None:
        parser.add_argument("--form", required=True)
        parser.add_argument("--postform")
    words = shlex.shlex(argstring, posix=True, punctuation_chars=False)
    words.whitespace_split, words.commenters, words.escape = True, "", ""  # a backslash parts folders
    try:
        given, rest = parser.parse_known_args(list(words))
    except ValueError as error:
        raise Refused("the arguments can't be read: {}".format(error))
    if any(word in ("-o", "--output", "--from", "--job") or word.startswith("--output=") for word in rest):
        raise Refused("FreeCAD gives the job and the file: take -o, --output, --from and --job out of the arguments")
    if template is not None:
        if not template:
            raise Refused("the machine has no form.\nEnter it in the properties of the machine's post processor, for example haas.pf")
        if any(word.split("=")[0] in ("--form", "--postform") for word in rest):
            raise Refused("the machine gives the form and the program postform: take --form and --postform out of the arguments")
        given.form, given.postform = template, program
    return given, rest


def form(name, job):
    """The file of the form, in the folder of the document or of this script."""
    folders = [os.path.dirname(job.Document.FileName or ""), HERE]
    for folder in folders:
        if os.path.isfile(os.path.join(folder, name)):
            return os.path.join(folder, name)
    raise Refused("there is no form {} in {}".format(name, " or ".join(folder for folder in folders if folder)))


def binary(name):
    """The program postform: of this name, in the folder of this script, or on the path."""
    if name:
        return name
    beside = os.path.join(HERE, "postform.exe" if os.name == "nt" else "postform")
    found = beside if os.path.isfile(beside) else shutil.which("postform")
    if not found:
        raise Refused("the program postform is not on the path.\nPut it into {}, or give --postform FILE.".format(HERE))
    return found


# The objects that FreeCAD gives


def sorted_out(objectslist):
    """The operations, and the names of the work offsets. The tool changes result from the operations.

    Until 1.1, the list contains objects of the document, and work offsets without a document. Later versions wrap each
    object, and the wrapper contains the kind of the object.
    """
    operations, fixtures = [], []
    for item in objectslist:
        kind_of_item = getattr(item, "item_type", None)
        if kind_of_item is None:
            kind_of_item = "fixture" if not hasattr(item, "Document") else "tool_controller" if hasattr(item, "ToolNumber") else "operation"
        else:
            item = getattr(item, "source", None) or item
        if kind_of_item == "operation":
            operations.append(item)
        elif kind_of_item == "fixture":
            fixtures.append(item.Path.Commands[0].Name)
        elif kind_of_item != "tool_controller":
            raise Refused("postform can't print `{}`, an item of the kind {}".format(item.Label, kind_of_item))
    return operations, list(dict.fromkeys(fixtures))


def job_of(operation):
    """The job in whose list an operation is."""
    for item in operation.Document.Objects:
        if hasattr(item, "Fixtures") and operation in getattr(getattr(item, "Operations", None), "Group", []):
            return item
    raise Refused("no job contains the operation {}".format(operation.Label))


def own(item, name):
    """A property of an operation. For a dressup without this property: of its base operation."""
    while item is not None:
        if hasattr(item, name):
            return getattr(item, name)
        base = getattr(item, "Base", None)
        base = base[0] if isinstance(base, (list, tuple)) and base else base
        item = base if hasattr(base, "Path") else None
    return None


def steps(job, operations):
    """The operations to post, in the order of the job. The list of 0.20 contains no comments and no stops. Those before
    the operations of the list, and after the last operation of the job, come from the job."""
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
            waiting, last = [], False  # this operation is in another file of a split output
    return found + (waiting if last else [])


def kind(item):
    """The class of an object's Python code."""
    return type(getattr(item, "Proxy", None)).__name__


# The document

OPERATION = ("Active", "CoolantMode", "StartDepth")
BARE = ("Comment", "Stop")
CONTROLLER = ("Label", "ToolNumber", "SpindleSpeed", "SpindleDir", "HorizFeed", "VertFeed")
TOOL = ("Diameter", "CornerRadius")


def packed(job, operations, fixtures, author=None):
    """A document of these operations as bytes. It contains only what postform reads in an .FCStd file."""
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
            prop("Placement", placement(item)),
        ]
        objects[name] += [prop(each, value(own(item, each))) for each in OPERATION]
        objects[name] += properties(item, BARE)
        controller = own(item, "ToolController")
        if controller is not None:
            objects[name].append(prop("ToolController", link(controller.Name)))
            tool, tool_name = controller.Tool, "tool:" + controller.Name
            objects[controller.Name] = properties(controller, CONTROLLER) + [prop("Tool", link(tool_name))]
            change = getattr(controller, "Path", None)
            if change is not None:
                paths[controller.Name + ".nc"] = change.toGCode()
                objects[controller.Name].append(prop("Path", "<Path file={}/>".format(quoteattr(controller.Name + ".nc"))))
            label = getattr(tool, "Label", None) or getattr(tool, "Name", None)  # tools before 0.19 have a name
            objects[tool_name] = [prop("Label", value(label))] + properties(tool, TOOL)
    version = ".".join(FreeCAD.Version()[:2]) + "R"
    label, author = (getattr(job.Document, "Label", None), author or getattr(job.Document, "CreatedBy", None))
    about = [prop("Label", value(label or "")), prop("CreatedBy", value(author or ""))]
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
    """The properties with these names that the object has."""
    return [prop(name, value(getattr(item, name, None))) for name in names]


def prop(name, held):
    """A property with this element. Without an element, the text is empty."""
    return "<Property name={}>{}</Property>".format(quoteattr(name), held) if held else ""


def placement(item):
    """The position and the rotation of an object, as a document contains them. postform refuses a path that is moved."""
    held = getattr(item, "Placement", None)
    if held is None:
        return ""
    numbers = [held.Base.x, held.Base.y, held.Base.z, *held.Rotation.Q]
    names = ("Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3")
    return "<PropertyPlacement {}/>".format(" ".join('{}="{!r}"'.format(*each) for each in zip(names, numbers)))


def value(given):
    """A value as a document contains it. Quantities are in mm, seconds and degrees."""
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
