"""The compiler for POSTFORM files: NC programs from toolpaths, each verified against its job."""

from ._postform import Error, Finding, Post, Program, Refused, __version__, lint

__all__ = ["Error", "Finding", "Post", "Program", "Refused", "__version__", "lint"]
