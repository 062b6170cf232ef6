"""A stand-in for the post processors of FreeCAD after 1.1, which have machines. The tests use it, because Debian has no
later FreeCAD.

It has the functions and properties that postform_post.py uses, with the names and the order of calls of FreeCAD's source
of August 2026 (`Path/Post/Processor.py`, `PostList.py`, `Gui/DlgPostProcess.py`, `Machine/models/machine.py`).
"""

import enum
import types


class OutputUnits(enum.Enum):
    """The units of a machine."""

    METRIC = "metric"
    IMPERIAL = "imperial"


class Postable:
    """The wrapper of each object that a post processor gets: its kind, label and path, and the object itself."""

    def __init__(self, item_type, label, path, source):
        self.item_type, self.label, self.path, self.source = item_type, label, path, source

    @property
    def Path(self):
        return self.path

    @property
    def Label(self):
        return self.label

    def __getattr__(self, name):
        if self.__dict__.get("source") is not None:
            return getattr(self.source, name)
        raise AttributeError(name)


def wrapped(item):
    """An object of the list of 1.1 as later versions wrap it."""
    if not hasattr(item, "Document"):
        return Postable("fixture", "Fixture", item.Path, None)
    kind = "tool_controller" if hasattr(item, "ToolNumber") else "operation"
    return Postable(kind, item.Label, getattr(item, "Path", None), item)


def machine(**properties):
    """A machine with the defaults of FreeCAD, and with these properties of its post processor."""
    processing = types.SimpleNamespace(
        early_tool_prep=False,
        filter_inefficient_moves=False,
        split_arcs=False,
        tool_change=True,
        translate_drill_cycles=False,
        translate_rapid_moves=False,
        xy_before_z_after_tool_change=False,
        return_to=None,
    )
    return types.SimpleNamespace(
        name="Mill",
        postprocessor_file_name="postform",
        postprocessor_properties=properties,
        processing=processing,
        output=types.SimpleNamespace(units=OutputUnits.METRIC),
        toolheads=[types.SimpleNamespace(toolhead_wait=0.0, coolant_delay=0.0)],
    )


def later(base):
    """The class PostProcessor of later versions, on top of a class that has the job and its list of objects."""

    class PostProcessor(base):
        @classmethod
        def get_common_property_schema(cls):
            names = {"file_extension": "nc", "supports_tool_radius_compensation": False, "preamble": "", "tool_change": True}
            return [{"name": name, "type": "str", "label": name, "default": default, "help": ""} for name, default in names.items()]

        @classmethod
        def get_property_schema(cls):
            return []

        @classmethod
        def get_full_property_schema(cls):
            return cls.get_common_property_schema() + cls.get_property_schema()

        def __init__(self, job, tooltip, tooltipargs, units):
            super().__init__(job, tooltip, tooltipargs, units)
            self._machine, self.values = None, {}

        @property
        def tooltip(self):
            raise NotImplementedError

        def get_file_extension(self):
            return self.values["FILE_EXTENSION"]

        def _buildPostList(self):
            return [(name, [wrapped(item) for item in items]) for name, items in super()._buildPostList()]

        def apply_configuration_bundle(self, overrides=None):
            bundle = dict(self._machine.postprocessor_properties)
            for each in self.get_full_property_schema():
                bundle.setdefault(each["name"], each["default"])
            bundle.update(job_author="", comment="", selected_fixtures=[])
            bundle.update((name, value) for name, value in (overrides or {}).items() if name in bundle)
            self._machine.postprocessor_properties.update(bundle)
            self.values = {"OUTPUT_UNITS": self._machine.output.units}
            for name, value in bundle.items():
                self.values.setdefault(name.upper(), value)

        def pre_processing_dialog(self):
            return True

        def export2(self):
            raise AssertionError("FreeCAD prints the program itself")

    return PostProcessor


def generated(post, chosen, **overrides):
    """The programs, as the dialog generates them for a chosen machine: names of the parts with their programs."""
    post._machine = chosen
    post.apply_configuration_bundle(overrides={"job_author": "", "comment": "", "selected_fixtures": [], **overrides})
    post._dialog_handled = post._bundle_applied = True
    return post.export2()
