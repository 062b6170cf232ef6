"""The post script without FreeCAD: stand-ins with the properties that FreeCAD's objects have, made of what was dumped inside it.

`python3 integrations/freecad/test_postform_post.py`; the program postform is target/debug/postform, or $POSTFORM.
`integrations/freecad/run` does the same inside FreeCAD.
"""

import importlib.util
import io
import json
import os
import subprocess
import sys
import tempfile
import types
import unittest
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
DATA = os.path.join(ROOT, "tests", "data", "freecad")
POSTFORM = os.environ.get("POSTFORM") or os.path.join(ROOT, "target", "debug", "postform")
FORM = os.path.join(ROOT, "postforms", "linuxcnc.pf")
ARGUMENTS = '--form "{}" --postform "{}"'.format(FORM, POSTFORM)
DOCUMENTS = ["bracket-0.20", "by-tool-0.20", "inch-names-0.20", "holes-1.1", "dressups-1.1"]


class Console:
    """FreeCAD's report view."""

    def __init__(self):
        self.errors, self.warnings = "", ""

    def PrintError(self, text):
        self.errors += text

    def PrintWarning(self, text):
        self.warnings += text


freecad = types.ModuleType("FreeCAD")
sys.modules["FreeCAD"] = freecad
import machines  # noqa: E402, found beside this file
import postform_post as post  # noqa: E402, found beside this file


class Thing:
    """An object with these properties."""

    def __init__(self, **properties):
        self.__dict__.update(properties)


class Length:
    """A quantity in FreeCAD's own units."""

    def __init__(self, value):
        self.Value = value


class Path:
    """A path: commands with floats."""

    def __init__(self, commands):
        self.Commands = [Thing(Name=name, Parameters=words) for name, words in commands]

    def toGCode(self):
        """As FreeCAD saves it: words by letter, six decimals."""
        lines = []
        for command in self.Commands:
            words = ["{}{:.6f}".format(letter, value) for letter, value in sorted(command.Parameters.items())]
            lines.append(" ".join([command.Name] + words))
        return "\n".join(lines) + "\n"


def python_class(name):
    """An object's Python side, of which only the class counts."""
    return type(name.rpartition(".")[2], (), {})()


def document(name):
    """A dumped document: its job, and the parts that FreeCAD hands over."""
    with open(os.path.join(DATA, name + ".dump.json"), encoding="utf-8") as file:
        dump = json.load(file)
    freecad.Version = lambda: dump["freecad"].split(".")[:3]
    job = dump["jobs"][0]
    whole = Thing(FileName=os.path.join(DATA, name + ".FCStd"), Label=dump["document"])
    controllers, operations = {}, {}
    for tool in job["tools"]:
        bit = Thing(Label=tool["bit"]["label"])
        if tool["bit"]["diameter"] is not None:
            bit.Diameter = Length(tool["bit"]["diameter"])
        controllers[tool["name"]] = Thing(
            Document=whole,
            Name=tool["name"],
            Label=tool["label"],
            ToolNumber=tool["tool_number"],
            SpindleSpeed=tool["spindle_speed"],
            SpindleDir=tool["spindle_dir"],
            HorizFeed=Length(tool["horiz_feed"]),
            VertFeed=Length(tool["vert_feed"]),
            Tool=bit,
        )
    for given in job["operations"]:
        item = Thing(Document=whole, Name=given["name"], Label=given["label"], Path=Path(given["commands"]))
        item.Proxy = python_class(given["proxy"])
        if given["controller"] is None:
            item.Comment = given["comment"]
            if item.Comment is None:
                item.Stop = {"M1": "Optional", "M0": "Mandatory"}[given["commands"][0][0]]
        else:
            # a dressup has none of these itself
            dressed = Thing(Path=item.Path) if given["base"] else item
            dressed.ToolController = controllers[given["controller"]]
            dressed.CoolantMode = given["coolant"]
            dressed.Active = given["active"]
            dressed.StartDepth = Length(given["start_depth"])
            if dressed is not item:
                item.Base = dressed
        operations[given["name"]] = item
    fake = Thing(
        Document=whole,
        Label=job["label"],
        Fixtures=job["fixtures"],
        OrderOutputBy=job["order_by"],
        Operations=Thing(Group=list(operations.values())),
    )
    whole.Objects = [*controllers.values(), *operations.values(), fake]

    def handed(item):
        if item["kind"] == "fixture":
            return Thing(Label=item["label"], Path=Path(item["commands"]))
        return controllers[item["controller"]] if item["kind"] == "tool" else operations[item["name"]]

    return fake, [[handed(item) for item in part["items"]] for part in job["post_list"]]


def rendered(name):
    """The program of the saved document."""
    command = [POSTFORM, "render", os.path.join(DATA, name + ".FCStd"), "--form", FORM]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True).stdout


class Posts(unittest.TestCase):
    def setUp(self):
        freecad.Console, freecad.GuiUp = Console(), False
        freecad.Version = lambda: ["1", "1", "3"]

    def refused(self, objects, arguments, filename="-"):
        """Why there is no program."""
        with self.assertRaises(RuntimeError) as refused:
            post.export(objects, filename, arguments)
        self.assertIn(str(refused.exception), freecad.Console.errors)
        return str(refused.exception)

    def test_it_prints_what_the_saved_document_gives(self):
        for name in DOCUMENTS:
            with self.subTest(name):
                _, parts = document(name)
                self.assertEqual(len(parts), 1)
                self.assertEqual(post.export(parts[0], "-", ARGUMENTS).encode(), rendered(name))

    def test_0_20_gets_its_file_written(self):
        _, (objects,) = document("by-tool-0.20")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "part.ngc")
            post.export(objects, file, ARGUMENTS)
            with open(file, "rb") as written:
                self.assertEqual(written.read(), rendered("by-tool-0.20"))

    def test_a_part_of_the_output_is_a_program_of_its_own(self):
        _, (objects,) = document("by-tool-0.20")
        drill = [at for at, item in enumerate(objects) if getattr(item, "Name", "") == "TC__Bohrer_4"][0]
        program = post.export(objects[:drill - 1], "-", ARGUMENTS)
        self.assertEqual([line for line in program.splitlines() if "M6" in line], ["T1 M6"])
        self.assertIn("G55", program)

    def test_stops_and_comments_that_0_20_leaves_out_are_there(self):
        job, (objects,) = document("inch-names-0.20")
        self.assertFalse([item for item in objects if hasattr(item, "Stop")])
        kinds = [post.kind(item) for item in post.steps(job, objects[2:])]
        self.assertEqual(kinds, [post.kind(item) for item in job.Operations.Group])
        program = post.export(objects, "-", ARGUMENTS)
        self.assertIn("M0\n", program)
        self.assertIn("M1\n", program)

    def test_a_stop_of_another_part_stays_there(self):
        job, _ = document("by-tool-0.20")
        stop = Thing(Name="Stop", Proxy=python_class("a.Stop"))
        group = [item for item in job.Operations.Group if post.own(item, "Active")]
        job.Operations.Group = [group[0], stop, group[1]]
        self.assertEqual(post.steps(job, [group[0]]), [group[0]])
        self.assertEqual(post.steps(job, [group[1]]), [stop, group[1]])
        job.Operations.Group = [group[0], group[1], stop]
        self.assertEqual(post.steps(job, [group[1]]), [group[1], stop])

    def test_names_are_text_whatever_they_hold(self):
        job, (objects,) = document("holes-1.1")
        job.Label = job.Operations.Group[0].Label = '<a "b" & c>'
        with zipfile.ZipFile(io.BytesIO(post.packed(job, job.Operations.Group, ["G54"]))) as archive:
            text = archive.read("Document.xml").decode()
        self.assertEqual(text.count("&lt;a \"b\" &amp; c&gt;"), 2)
        self.assertTrue(post.export(objects, "-", ARGUMENTS))

    def test_what_keeps_postform_from_printing_is_said(self):
        _, (objects,) = document("holes-1.1")
        tool = [item for item in objects if hasattr(item, "ToolNumber")][0]
        tool.SpindleSpeed = 0.0
        self.assertIn("has no spindle speed", self.refused(objects, ARGUMENTS))

    def test_nothing_is_written_where_something_is_wrong(self):
        _, (objects,) = document("by-tool-0.20")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "part.ngc")
            self.refused(objects, ARGUMENTS + " --units furlong", file)
            self.assertFalse(os.path.exists(file))
            self.refused(objects, ARGUMENTS, os.path.join(folder, "missing", "part.ngc"))

    def test_arguments(self):
        _, (objects,) = document("holes-1.1")
        for arguments, why in [
            ("", "--form"),
            ("--form", "--form"),
            ("--form 'a", "can't be read"),
            ("--form gone.pf", "there is no form gone.pf in " + DATA),
            (ARGUMENTS + " -o here.nc", "take -o"),
            (ARGUMENTS + " --bogus", "--bogus"),
            ('--form "{}" --postform /gone/postform'.format(FORM), "/gone/postform"),
        ]:
            with self.subTest(arguments):
                self.assertIn(why, self.refused(objects, arguments))
        given, rest = post.arguments(r'--form "C:\my posts\haas.pf" --program 7 # 8')
        self.assertEqual((given.form, rest), (r"C:\my posts\haas.pf", ["--program", "7", "#", "8"]))
        self.assertIn("no operation", self.refused([], ARGUMENTS))

    def test_in_the_window_a_message_says_why(self):
        shown = []
        gui = types.ModuleType("PySide.QtGui")
        gui.QMessageBox = Thing(critical=lambda parent, title, text: shown.append(text))
        module = types.ModuleType("PySide")
        module.QtGui = gui
        sys.modules["PySide"] = module
        freecad.GuiUp = True
        self.assertIsNone(post.export([], "-", ARGUMENTS))
        with self.assertRaises(RuntimeError):
            post.export([], "part.ngc", ARGUMENTS)  # 0.20 would say that all is well
        self.assertEqual(len(shown), 2)
        self.assertIn("no operation", shown[0])

    def test_warnings_reach_the_report_view(self):
        _, (objects,) = document("holes-1.1")
        with tempfile.TemporaryDirectory() as folder:
            warns = os.path.join(folder, "postform")
            with open(warns, "w", encoding="utf-8") as script:
                script.write('#!/bin/sh\necho "careful: $*" >&2\necho "G0 X1"\n')
            os.chmod(warns, 0o755)
            program = post.export(objects, "-", '--form "{}" --postform {} --program 7'.format(FORM, warns))
        self.assertEqual(program, "G0 X1\n")
        self.assertEqual(freecad.Console.warnings, "careful: render - --from freecad --form {} --program 7\n".format(FORM))


class Base:
    """The post processor of FreeCAD 1.1, as far as a machine's post processor uses it."""

    def __init__(self, job, tooltip, tooltipargs, units):
        self._job, self._parts = job

    def _buildPostList(self):
        return [("allitems" if len(self._parts) == 1 else str(at), part) for at, part in enumerate(self._parts)]


def with_machines():
    """The script as FreeCAD after 1.1 loads it."""
    names = ("Path", "Path.Post", "Path.Post.Processor")
    for name in names:
        sys.modules[name] = types.ModuleType(name)
    sys.modules[names[-1]].PostProcessor = machines.later(Base)
    try:
        spec = importlib.util.spec_from_file_location("postform_post_later", os.path.join(HERE, "postform_post.py"))
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    finally:
        for name in names:
            del sys.modules[name]
    return module


class Machines(unittest.TestCase):
    def setUp(self):
        freecad.Console, freecad.GuiUp = Console(), False
        freecad.Version = lambda: ["26", "3", "0"]
        self.post = with_machines()

    def generated(self, name, chosen=None, **overrides):
        """The programs of this document for a machine."""
        chosen = chosen or machines.machine(form=FORM, postform=POSTFORM)
        return machines.generated(self.post.Postform(document(name)), chosen, **overrides)

    def by_form(self, change, **overrides):
        """The program of a machine with a changed form."""
        with open(FORM, encoding="utf-8") as file:
            text = file.read()
        with tempfile.TemporaryDirectory() as folder:
            template = os.path.join(folder, "changed.pf")
            with open(template, "w", encoding="utf-8") as file:
                file.write(change(text))
            ((_, program),) = self.generated("holes-1.1", machines.machine(form=template, postform=POSTFORM), **overrides)
        return program

    def refused(self, change, **overrides):
        """The reason why there is no program for a changed machine."""
        chosen = machines.machine(form=FORM, postform=POSTFORM)
        change(chosen)
        freecad.Version = lambda: ["26", "3", "0"]
        with self.assertRaises(RuntimeError) as refused:
            self.generated("holes-1.1", chosen, **overrides)
        return str(refused.exception)

    def test_without_machines_freecad_gets_no_class(self):
        self.assertFalse(hasattr(post, "Postform"))

    def test_a_machine_prints_what_the_saved_document_gives(self):
        for name in ("holes-1.1", "dressups-1.1"):
            with self.subTest(name):
                ((part, program),) = self.generated(name)
                self.assertEqual((part, program.encode()), ("allitems", rendered(name)))

    def test_a_job_without_a_machine_prints_the_same(self):
        job, parts = document("holes-1.1")
        job.PostProcessorArgs = ARGUMENTS
        processor = self.post.Postform((job, parts))
        processor.apply_configuration_bundle({"job_author": "A. Smith"})
        ((_, program),) = processor.export()
        self.assertEqual(program.encode(), rendered("holes-1.1"))

    def test_the_units_are_those_of_the_machine(self):
        chosen = machines.machine(form=FORM, postform=POSTFORM)
        chosen.output.units = machines.OutputUnits.IMPERIAL
        self.assertIn("G20", self.generated("holes-1.1", chosen)[0][1])
        self.assertIn("G21", self.generated("holes-1.1", chosen, arguments="--units mm")[0][1])

    def test_the_properties_are_those_that_have_an_effect(self):
        names = [each["name"] for each in self.post.Postform.get_full_property_schema()]
        self.assertEqual(names, ["file_extension", "form", "arguments", "postform"])
        processor = self.post.Postform(document("holes-1.1"))
        machines.generated(processor, machines.machine(form=FORM, postform=POSTFORM, file_extension="ngc"))
        self.assertEqual(processor.get_file_extension(), "ngc")

    def test_the_author_of_the_dialog_is_printed(self):
        program = self.by_form(lambda text: text.replace("StartCode\n", "StartCode\n(BY [author])\n", 1), job_author="A. Smith")
        self.assertIn("(BY A. SMITH)", program)

    def test_options_that_would_change_the_moves_are_refused(self):
        for name in ("split_arcs", "translate_drill_cycles", "translate_rapid_moves", "early_tool_prep"):
            why = self.refused(lambda chosen: setattr(chosen.processing, name, True))
            self.assertIn("the machine's option `{}`: set it to False".format(name), why)
        self.assertIn("set it to True", self.refused(lambda chosen: setattr(chosen.processing, "tool_change", False)))
        self.assertIn("`toolhead_wait`: set it to 0", self.refused(lambda chosen: setattr(chosen.toolheads[0], "toolhead_wait", 2.0)))

    def test_texts_of_the_machine_are_reported(self):
        self.generated("holes-1.1", machines.machine(form=FORM, postform=POSTFORM, preamble="G17 G54", postamble=""))
        self.assertIn("does not contain these texts of the machine: preamble.", freecad.Console.warnings)

    def test_what_a_machine_must_give(self):
        self.assertIn("the machine has no form", self.refused(lambda chosen: chosen.postprocessor_properties.pop("form")))
        self.assertIn("the machine has no form", self.refused(lambda chosen: chosen.postprocessor_properties.update(form=None)))
        self.assertIn("take --form", self.refused(lambda chosen: None, arguments="--form other.pf"))
        self.assertIn("there is no form gone.pf", self.refused(lambda chosen: None, form="gone.pf"))

    def test_an_item_of_another_kind_is_refused(self):
        job, parts = document("holes-1.1")
        parts[0].append(Thing(Document=None, Label="Turn"))
        processor = self.post.Postform((job, parts))
        listed = processor._buildPostList()
        listed[0][1][-1].item_type = "rotation"
        processor._buildPostList = lambda: listed
        with self.assertRaises(RuntimeError) as refused:
            machines.generated(processor, machines.machine(form=FORM, postform=POSTFORM))
        self.assertIn("postform can't print `Turn`, an item of the kind rotation", str(refused.exception))

    def test_a_moved_operation_is_refused(self):
        job, parts = document("holes-1.1")
        operation = [item for item in job.Operations.Group if hasattr(item, "ToolController")][0]
        operation.Placement = Thing(Base=Thing(x=0.0, y=0.0, z=4.0), Rotation=Thing(Q=(0.0, 0.0, 0.0, 1.0)))
        with self.assertRaises(RuntimeError) as refused:
            machines.generated(self.post.Postform((job, parts)), machines.machine(form=FORM, postform=POSTFORM))
        self.assertIn("has a Placement (X0 Y0 Z4)", str(refused.exception))

    def test_line_ends_are_those_of_freecad(self):
        program = self.by_form(lambda text: "LineEnd crlf\n" + text)
        self.assertNotIn("\r", program)
        self.assertIn("LineEnd", freecad.Console.warnings)


if __name__ == "__main__":
    unittest.main()
