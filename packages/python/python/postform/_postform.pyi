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
    """What to type instead."""
    file: Optional[str]
    line: Optional[int]
    """From 1."""
    column: Optional[int]
    """In bytes, from 1."""
    path: Optional[str]
    """The position in a job: `operations[0].path[3]`."""
    program_line: Optional[int]
    """The line of the program, from 1."""

class Error(Exception):
    """A form, a job or an option that makes no program."""

    findings: list[Finding]

class Refused(Error):
    """A program that does not do what its job asks for."""

    program: str
    verdict: str

@final
class Program:
    """A program, whole."""

    program: str
    verdict: str
    """Its first words are `identical`, `equivalent` or `not proven`, as with `verify=False`."""
    findings: list[Finding]
    """Warnings and notes of the job and of printing it; what is not proven, and why."""
    file_name: str
    """The name that form and job give the file."""
    def __str__(self) -> str: ...

@final
class Post:
    """A form that prints programs. It can be shared by threads."""

    @staticmethod
    def from_file(path: Union[str, PathLike[str]]) -> Post: ...
    @staticmethod
    def from_text(text: str, name: str = "form.pf") -> Post: ...
    @staticmethod
    def shipped(control: str) -> Post:
        """A post that ships, by its name: `haas`."""
    control: Optional[str]
    findings: list[Finding]
    """Warnings and notes about the form."""
    properties: list[str]
    """Names of the properties that `properties` takes."""
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

        A `str` or path is a file, a mapping a job (docs/job.md), an iterable its items (JSON Lines of docs/job.md).
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
        """The same for the text of a job."""
    def verify(self, job: Job, program: str, *, assume_units: Optional[Units] = None) -> str:
        """The verdict about a program; it may be `different`."""

def lint(path: Union[str, PathLike[str]]) -> list[Finding]:
    """Every finding of a form."""
