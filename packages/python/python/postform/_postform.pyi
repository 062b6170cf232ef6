from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any, Literal, Optional, Union, final

__version__: str

Job = Union[str, PathLike[str], Mapping[str, Any], Iterable[Mapping[str, Any]]]
Units = Literal["mm", "inch"]
Format = Literal["json", "jsonl", "cl", "nc", "nci", "freecad"]

@final
class Finding:
    """A finding about a form, a job or a program."""

    code: str
    """`PF101`: see docs/rules and docs/errors.md."""
    severity: Literal["error", "warning", "note"]
    message: str
    help: Optional[str]
    """The text to type instead."""
    file: Optional[str]
    line: Optional[int]
    """The line, counted from 1."""
    column: Optional[int]
    """The column in bytes, counted from 1."""
    path: Optional[str]
    """The position in a job: `operations[0].path[3]`."""
    program_line: Optional[int]
    """The line of the program, from 1."""

class Error(Exception):
    """The error if no program can be printed from a form, a job or an option."""

    findings: list[Finding]

class Refused(Error):
    """The error if a program differs from its job."""

    program: str
    verdict: str

@final
class Program:
    """A complete program."""

    program: str
    verdict: str
    """The verdict. It begins with `identical`, `equivalent` or `not proven`. With `verify=False`, it begins with `not proven`."""
    findings: list[Finding]
    """Warnings and notes about the job and the printing, and each part that is not proven, with the reason."""
    file_name: str
    """The file name, which the form and the job determine."""
    def __str__(self) -> str: ...

@final
class Post:
    """A form that prints programs. Threads can share a post."""

    @staticmethod
    def from_file(path: Union[str, PathLike[str]]) -> Post: ...
    @staticmethod
    def from_text(text: str, name: str = "form.pf") -> Post: ...
    @staticmethod
    def shipped(control: str) -> Post:
        """A post that is shipped with postform, by its name: `haas`."""
    control: Optional[str]
    findings: list[Finding]
    """Warnings and notes about the form."""
    properties: list[str]
    """Names of the properties that `render` accepts in `properties`."""
    def render(
        self,
        job: Job,
        *,
        properties: Optional[Mapping[str, Union[str, bool, float]]] = None,
        set: Optional[Mapping[str, float]] = None,
        program: Optional[int] = None,
        units: Optional[Units] = None,
        date: Optional[str] = None,
        assume_units: Optional[Units] = None,
        verify: bool = True,
    ) -> Program:
        """Prints a job and verifies the program.

        A `str` or path is the name of a file. A mapping is a job (docs/job.md). An iterable contains the items of a job
        (JSON Lines of docs/job.md).
        """
    def render_text(
        self,
        text: str,
        format: Format,
        *,
        properties: Optional[Mapping[str, Union[str, bool, float]]] = None,
        set: Optional[Mapping[str, float]] = None,
        program: Optional[int] = None,
        units: Optional[Units] = None,
        date: Optional[str] = None,
        assume_units: Optional[Units] = None,
        verify: bool = True,
    ) -> Program:
        """Prints a job that is given as a text, and verifies the program."""
    def verify(self, job: Job, program: str, *, assume_units: Optional[Units] = None) -> str:
        """The verdict about a program; it may be `different`."""

def lint(path: Union[str, PathLike[str]]) -> list[Finding]:
    """Every finding of a form."""
