"""The compiler for POSTFORM files. It prints NC programs from toolpaths, and verifies each program against its job."""

from ._postform import Error, Finding, Post, Program, Refused, __version__, lint

__all__ = ["Error", "Finding", "Post", "Program", "Refused", "__version__", "lint"]
