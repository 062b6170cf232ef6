#!/usr/bin/env python3
"""Measures how the time and the memory of postform grow with its input. Each row measures one kind of input at two sizes.

    growth.py BINARY [--only TEXT] [--markdown] [--slack FACTOR]

Prints the CPU seconds and the peak memory of the whole process, and the exponent between the two sizes. The exit status
is 1 if a row exceeds a bound. The bounds are an exponent of 1.15, and 1 s and 100 MB for the larger input; a few rows have
other bounds. A wrong exit status of postform also breaks a bound. Needs only Python 3.9 and a Unix system.
"""
import argparse
import json
import math
import os
import resource
import signal
import sys
import tempfile
import time
from dataclasses import dataclass, field
from typing import Callable, Optional

FORM = """Name growth
Machine Mill
Units both
Control fanuc
X->4.>4
Y->4.>4
Z->4.>4
R->4.>4
Q >4.>4
F >5.>4
S >5
T >2
H >3
O 5
N >5
P 5
G >3~>1
M >3
%(head)s
StartCode
%%0
O[program#]
G[unitmode] G17 G40 G49 G80 G90
%(lines)s
End
1stToolChange
T[tool] M6
G[work] G0 X[h] Y[v] S[speed] M[direct]
G43 H[lcomp] Z[d] M[cool]
End
ToolChange
M9
G91 G28 Z0 M5
G90
T[tool] M6
G[work] G0 X[h] Y[v] S[speed] M[direct]
G43 H[lcomp] Z[d] M[cool]
End
SubStart
O[sub]
End
SubEnd
M99
End
SubCall
M98 P[sub]
End
EndCode
M9
G91 G28 Z0 M5
G90
M30
%%0
End
%(tail)s"""


def form(head="", lines="", tail=""):
    return FORM % {"head": head, "lines": lines, "tail": tail}


JOB = ('{"postform":1,"units":"mm","program":1,%s"tools":[%s],"subprograms":[%s],"operations":[%s]}')
TOOL = '{"number":%d,"length_offset":1}'
OPERATION = ('{"tool":%d,"work":54,"spindle":{"speed":500,"direction":"cw"},"path":[{"rapid":[0,0,50]},'
             '{"rapid":[0,0,2]},{"line":[0,0,-1],"feed":100},{"rapid":[0,0,50]}%s]}')
SUB = '{"number":%d,"path":[{"rapid":[0,0,2]},{"line":[0,0,-1],"feed":100},{"rapid":[0,0,50]}%s]}'


def job(tools=(1,), used=(1,), head="", subs=(), items=""):
    return JOB % (head, ",".join(TOOL % n for n in tools), ",".join(subs),
                  ",".join(OPERATION % (n, items) for n in used))


def cl(tools):
    lines = ["UNITS/MM"]
    for n in tools:
        lines += [f"LOADTL/{n}", "SPINDL/500,CLW", "RAPID", "GOTO/0,0,50", "FEDRAT/100,MMPM", "GOTO/0,0,-1", "RAPID",
                  "GOTO/0,0,50"]
    return "\n".join(lines + ["FINI", ""])


@dataclass
class Row:
    """One kind of input. `make` returns the files by name, and the arguments of the command that runs in their folder."""
    name: str
    sizes: tuple
    make: Callable
    status: tuple = (0, 1)
    seconds: float = 1.0
    megabytes: float = 100.0
    says: Optional[str] = None  # text that standard error must contain at the larger size
    linear: bool = True  # False: no exponent is checked, because the command stops at a limit


ROWS = []


def row(name, sizes, **more):
    def keep(make):
        ROWS.append(Row(name, sizes, make, **more))
        return make
    return keep


def lint(text):
    return {"f.pf": text}, ["lint", "f.pf"]


def many(part, n, sep=" "):
    return sep.join([part] * n)


# ---- forms

@row("lint: words of a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("M0", n)))

@row("lint: `X[h]` words of a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("X[h]", n)))

@row("lint: values in one word", (10_000, 100_000))
def _(n): return lint(form(lines=many("[h]", n, "")))

@row("lint: values in one comment", (10_000, 100_000))
def _(n): return lint(form(lines="(" + many("[h]", n) + ")"))

@row("lint: comments in a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("(a)", n)))

@row("lint: words that are not whole", (10_000, 100_000))
def _(n): return lint(form(lines=many("G", n)))

@row("lint: unknown variables of a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("X[q]", n)))

@row("lint: missing blanks in a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("X[h]Y[v]", n // 2)))

@row("lint: `#` in words of a line", (10_000, 100_000))
def _(n): return lint(form(lines=many("a#b", n)))

@row("lint: codes in one allow comment", (8_000, 80_000))
def _(n): return lint(form(head="# postform: allow " + many("PF103", n)))

@row("lint: unknown codes in one allow comment", (5_000, 50_000))
def _(n): return lint(form(head="# postform: allow " + many("PF999", n)))

@row("lint: allow comments above one line", (2_000, 20_000))
def _(n): return lint(form(head=many("# postform: allow PF103", n, "\n")))

@row("lint: words lost after a double blank, one line", (10_000, 100_000))
def _(n): return lint(form(lines="M0  " + many("M0", n)))

@row("lint: lines with a double blank", (7_000, 70_000))
def _(n): return lint(form(lines=many("G1  X1", n, "\n")))

@row("lint: M0 lines in a sequence", (17_000, 170_000))
def _(n): return lint(form(lines=many("M0", n, "\n")))

@row("lint: lines of two words", (6_000, 60_000))
def _(n): return lint(form(lines=many("G1 X[h]", n, "\n")))

@row("lint: unknown commands", (5_000, 50_000))
def _(n): return lint(form(head=many("Abcdefgh", n, "\n")))

@row("lint: 15 MB of comment lines", (100_000, 1_000_000), status=(0, 1, 2), seconds=5, megabytes=300)
def _(n): return lint(form(head=many("# a comment..", n, "\n")))

@row("lint: 15 MB of short comments", (750_000, 7_500_000), status=(0, 1, 2), seconds=15, megabytes=300)
def _(n): return lint(form(head=many("#", n, "\n")))

@row("lint: 15 MB of M0 lines", (400_000, 4_000_000), status=(0, 1, 2), seconds=15, megabytes=300)
def _(n): return lint(form(lines=many("M0", n, "\n")))

for name, part, count in (("M0 lines", "M0\n", 330_000), ("double blanks", "G1  X1\n", 140_000), ("unknown commands", "A3\n", 330_000),
                          ("empty lines and unknown names", "Abcd\n" + "\n" * 500, 1_900)):
    @row(f"lint: 1 MB of {name}", (count // 10, count), status=(1, 2), linear=False)
    def _(n, name=name, part=part):
        return lint(form(lines=part * n) if name in ("M0 lines", "double blanks") else form(head=part * n))

@row("lint: 1 MB of words of one line", (33_000, 330_000), status=(1, 2), linear=False)
def _(n): return lint(form(lines=many("M0", n)))

@row("lint: two halves of a line", (9_000, 90_000))
def _(n): return lint(form(lines=many("M3", n // 2) + " " + many("G1", n // 2) + " " + many("X[h]", n // 2)))

@row("lint: unknown variables without a letter", (3_000, 30_000))
def _(n): return lint(form(lines=many("[q]", n)))

@row("lint: commands times words", (4_000, 40_000))
def _(n): return lint(form(head=many("Rename q X", n // 2, "\n"), lines=many("M0", n)))

@row("lint: prompts times words", (3_000, 30_000))
def _(n): return lint(form(head=many("Ask [val1] a", n // 2, "\n"), lines=many("M0", n)))

@row("lint: `S[speed]` words of a Fadal", (5_000, 50_000))
def _(n): return lint(form(lines=many("S[speed]", n)).replace("Control fanuc", "Control fadal"))

@row("lint: files that one form calls", (300, 3_000))
def _(n):
    calls = "\n".join(f"Call c{i}.pf" for i in range(n))
    files = {f"c{i}.pf": "# nothing\n" for i in range(n)}
    files["f.pf"] = form(head=calls)
    return files, ["lint", "f.pf"]

@row("lint: a name of so many letters", (50_000, 500_000))
def _(n): return lint(form(head="A" + "b" * n))

@row("lint: a variable of so many letters", (50_000, 500_000))
def _(n): return lint(form(lines="X[" + "b" * n + "]"))

@row("lint: a kind of Custom of so many letters", (50_000, 500_000))
def _(n): return lint(form(tail="Custom1   " + "b" * n + "\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd\n"))

@row("lint: an allowance of so many letters", (50_000, 500_000))
def _(n): return lint(form(head="# postform: allow PF" + "b" * n))

@row("lint: names of 1,000 letters", (50, 500))
def _(n): return lint(form(head=many("A" + "b" * 999, n, "\n")))

for command in ("Replace ZZ ZZZ", "Rename X U", "Limits X -1 1", "Dummy X", "RevSigns X", "Mod text", "Ask [val1] a",
                "Tools a", "Thread G33", "Coolant M7 M8", "X->4.>4", "Rapid G0", "Call nothing.pf"):
    @row(f"lint: `{command}` so often", (3_000, 30_000))
    def _(n, command=command): return lint(form(head=many(command, n, "\n")))

@row("lint: Upon sequences", (2_000, 20_000))
def _(n): return lint(form(tail=many("Upon [work]\nG54\nEnd", n, "\n")))

@row("lint: sequences there twice", (3_000, 30_000))
def _(n): return lint(form(tail=many("Drill\nG81\nEnd", n, "\n")))

@row("lint --fix: double blanks of a form", (2_000, 20_000))
def _(n): return {"f.pf": form(lines=many("M0 M0", n, "\n"), head="# a  comment")}, ["lint", "--fix", "f.pf"]

@row("fmt: words of a line", (10_000, 100_000))
def _(n): return {"f.pf": form(lines=many("M0", n))}, ["fmt", "--check", "f.pf"]

@row("explain: a word of so many letters", (10_000, 100_000), status=(2,))
def _(n): return {}, ["explain", "a" * n]

@row("explain: so many words", (5_000, 50_000), status=(2,))
def _(n): return {}, ["explain", "a " * n]

@row("render: Replace rows that double a block", (10, 30), linear=False, status=(0, 1))
def _(n): return {"f.pf": form(head=many("Replace G GG", n, "\n")), "j.json": job()}, ["render", "j.json", "--form", "f.pf"]

@row("render: Replace rows that do nothing", (3_000, 30_000))
def _(n): return {"f.pf": form(head=many("Replace ~ !", n, "\n")), "j.json": job()}, ["render", "j.json", "--form", "f.pf"]

@row("render: words of a line", (10_000, 100_000))
def _(n): return ({"f.pf": form(lines=many("(a)", n)), "j.json": job()},
                  ["render", "j.json", "--form", "f.pf", "--limits", "extended"])


# ---- jobs

@row("check: tools listed in a job", (4_000, 28_000))
def _(n): return {"j.json": job(tools=range(1, n + 1))}, ["check", "j.json"]

@row("check: tools listed and used", (400, 4_000))
def _(n): return {"j.json": job(tools=range(1, n + 1), used=range(1, n + 1))}, ["check", "j.json"]

@row("render: tools listed and used", (400, 4_000))
def _(n): return ({"j.json": job(tools=range(1, n + 1), used=range(1, n + 1)), "f.pf": form().replace("T >2", "T >5")},
                  ["render", "j.json", "--form", "f.pf"])

@row("render: tool order", (10_000, 100_000))
def _(n): return ({"j.json": job(head='"tool_order":[%s],' % ",".join(map(str, range(n)))), "f.pf": form()},
                  ["render", "j.json", "--form", "f.pf"])

@row("check: tools of a CL file", (800, 8_000))
def _(n): return {"j.cl": cl(range(1, n + 1))}, ["check", "j.cl"]

@row("render: tools of a CL file", (800, 8_000))
def _(n): return {"j.cl": cl(range(1, n + 1)), "f.pf": form().replace("T >2", "T >5")}, ["render", "j.cl", "--form", "f.pf", "--program", "1"]

@row("render: subprograms", (700, 7_000))
def _(n): return ({"j.json": job(subs=[SUB % (i, "") for i in range(2, n + 2)]), "f.pf": form()},
                  ["render", "j.json", "--form", "f.pf"])

@row("render: subprograms, each called", (500, 5_000))
def _(n):
    calls = "".join(',{"call":{"sub":%d,"at":[0,0,50]}}' % i for i in range(2, n + 2))
    return ({"j.json": job(subs=[SUB % (i, "") for i in range(2, n + 2)], items=calls), "f.pf": form()},
            ["render", "j.json", "--form", "f.pf"])

@row("render: subprograms, each calls the one before", (500, 5_000))
def _(n):
    subs = [SUB % (2, "")]
    subs += [SUB % (i, ',{"call":{"sub":%d,"at":[0,0,50]}}' % (i - 1)) for i in range(3, n + 2)]
    calls = ',{"call":{"sub":%d,"at":[0,0,50]}}' % (n + 1)
    return {"j.json": job(subs=subs, items=calls), "f.pf": form()}, ["render", "j.json", "--form", "f.pf"]

@row("render: subprograms that call two before", (20, 80), linear=False)
def _(n):
    call = ',{"call":{"sub":%d,"at":[0,0,50]}}'
    subs = [SUB % (2, ""), SUB % (3, "")]
    subs += [SUB % (i, call % (i - 1) + call % (i - 2)) for i in range(4, n + 2)]
    return ({"j.json": job(subs=subs, items=call % (n + 1)), "f.pf": form()},
            ["render", "j.json", "--form", "f.pf"])

# both programs are larger than the buffer of 128 KB; jumps within this buffer need no further reading
@row("render: calls of one subprogram", (20_000, 80_000), seconds=2)
def _(n):
    calls = ',{"call":{"sub":2,"at":[0,0,50]}}' * n
    return {"j.json": job(subs=[SUB % (2, "")], items=calls), "f.pf": form()}, ["render", "j.json", "--form", "f.pf"]

@row("check: values of variables", (5_000, 50_000))
def _(n):
    return {"j.json": job(head='"set":{%s},' % ",".join('"val1":%d' % i for i in range(n)))}, ["check", "j.json"]

@row("check: unknown variables", (5_000, 50_000))
def _(n):
    items = "".join(',{"set":{"u%d":1}}' % i for i in range(n))
    return {"j.json": job(items=items), "f.pf": form()}, ["render", "j.json", "--form", "f.pf"]

@row("check: a key of so many letters", (90_000, 900_000))
def _(n): return {"j.json": '{"%s":1}' % ("a" * n)}, ["check", "j.json"]

@row("check: a string of a JSON job", (1_000_000, 100_000_000), status=(0, 1), linear=False)
def _(n): return {"j.json": job(head='"name":"%s",' % ("a" * n))}, ["check", "j.json"]

@row("check: brackets inside each other", (9_000, 90_000), linear=False, status=(1,))
def _(n): return {"j.json": "[" * n}, ["check", "j.json"]

PECKS = ('{"cycle":{"kind":"deep","depth":99,"clear":1,"feed":100,"step":0.01,"emulate":true,'
         '"points":[%s]}}')

@row("render: pecks made of single moves", (100, 1_000), linear=False, seconds=5)
def _(n):
    items = "," + PECKS % ",".join(["[0,0,0]"] * n)
    return ({"j.json": job(items=items), "f.pf": form()},
            ["render", "j.json", "--form", "f.pf"])


# ---- programs

def pair(n):
    words = " ".join(f"X{i}" for i in range(n))
    other = " ".join(f"X{i}.5" for i in range(n))
    return {"a.nc": f"G1 {words}\nM30\n", "b.nc": f"G1 {other}\nM30\n"}

for options in ((), ("--ignore", "all"), ("--ignore", "none"), ("--format", "json"), ("--format", "html"),
                ("--layout", "side")):
    @row(" ".join(("diff: words of one line", *options)), (10_000, 100_000), status=(1,), seconds=2.0)
    def _(n, options=options): return pair(n), ["diff", "a.nc", "b.nc", *options]

@row("diff: P words of one line", (50_000, 500_000))
def _(n): return {"a.nc": many("P1", n) + "\nM30\n", "b.nc": "G1 " + many("P1", n) + "\nM30\n"}, ["diff", "a.nc", "b.nc"]

@row("diff: codes of one line", (10_000, 100_000), status=(1,), seconds=2.0)
def _(n):
    return ({"a.nc": " ".join(f"G{i % 99}.{i}" for i in range(n)) + "\nM30\n",
             "b.nc": " ".join(f"M{i % 99}.{i}" for i in range(n)) + "\nM30\n"}, ["diff", "a.nc", "b.nc"])

@row("diff: changed comments that do not count", (10_000, 100_000), seconds=2.0)
def _(n):
    lines = lambda word: "\n".join(f"({word if i % 40 == 0 else 'line'} {i})" for i in range(n))
    return {"a.nc": lines("old") + "\n", "b.nc": lines("new") + "\n"}, ["diff", "a.nc", "b.nc", "--ignore", "comments"]

@row("diff: comments of one line", (10_000, 100_000), status=(1,), seconds=2.0)
def _(n):
    return ({"a.nc": " ".join(f"(a{i})" for i in range(n)) + "\nM30\n",
             "b.nc": " ".join(f"(b{i})" for i in range(n)) + "\nM30\n"}, ["diff", "a.nc", "b.nc"])

@row("diff: lines of many words", (10, 100), status=(1,), seconds=2.5)
def _(n):
    line = lambda k: "G1 " + " ".join(f"X{k}{i}" for i in range(1_000))
    return ({"a.nc": "\n".join(line(k) for k in range(n)) + "\n",
             "b.nc": "\n".join(line(k + 500) + ".5" for k in range(n + 40)) + "\n"}, ["diff", "a.nc", "b.nc"])

for control in ("linuxcnc", "fanuc"):
    @row(f"simulate {control}: three G83 of so many pecks", (9_000, 90_000), seconds=3)
    def _(n, control=control):
        r = f"G0 X0. Y0. Z1.\nM3 S500\nG98 G83 X0. Y0. Z-{n / 10:.1f} R0. Q0.1 F100.\nX1.\nX2.\nG80\nM30\n"
        return {"a.nc": f"G21 G17 G90 G94\n{r}"}, ["simulate", "a.nc", "--control", control]

    @row(f"simulate {control}: three G83 of so many pecks, --dry", (90_000, 900_000 // 4), seconds=3)
    def _(n, control=control):
        r = f"G0 X0. Y0. Z1.\nM3 S500\nG98 G83 X0. Y0. Z-{n / 1000:.3f} R0. Q0.001 F100.\nX1.\nX2.\nG80\nM30\n"
        return {"a.nc": f"G21 G17 G90 G94\n{r}"}, ["simulate", "a.nc", "--control", control, "--dry"]

for command in ("simulate", "plot", "fit"):
    @row(f"{command}: many tools", (9_000, 90_000), status=(0, 1))
    def _(n, command=command):
        files = {"a.nc": "G21 G90\n" + "".join(f"T{t + 1} M6\n" for t in range(n)) + "M30\n", "m.toml": 'name = "m"\n[tools.1]\nlength = 9\n'}
        more = {"simulate": [], "plot": ["-o", "a.svg"], "fit": ["--machine", "m.toml"]}[command]
        return files, [command, "a.nc", *more]

@row("simulate: lines passed over by `if [0]`", (210_000, 2_100_000), status=(0,))
def _(n): return {"a.nc": "o1 if [0]\n" + "G1 X1.\n" * n + "o1 endif\nM2\n"}, ["simulate", "a.nc", "--control", "linuxcnc"]

@row("simulate: lines of a subprogram before the program", (210_000, 2_100_000), status=(0,))
def _(n): return {"a.nc": "o1 sub\n" + "G1 X1.\n" * n + "o1 endsub\nM2\n"}, ["simulate", "a.nc", "--control", "linuxcnc"]

@row("simulate: a loop without end", (1, 1), status=(1,), linear=False, seconds=3)
def _(n): return {"a.nc": "o1 while [1]\no1 endwhile\nM2\n"}, ["simulate", "a.nc", "--control", "linuxcnc"]

@row("simulate: a loop that passes over lines", (1_000, 10_000), status=(1,), linear=False, seconds=15)
def _(n):
    return ({"a.nc": "o1 while [1]\no2 if [0]\n" + "G1 X1.\n" * n + "o2 endif\no1 endwhile\nM2\n"},
            ["simulate", "a.nc", "--control", "linuxcnc"])

@row("simulate: subprograms", (5_000, 50_000))
def _(n):
    return {"a.nc": "".join(f"o{i} sub\no{i} endsub\n" for i in range(n)) + "M2\n"}, ["simulate", "a.nc", "--control", "linuxcnc"]

@row("simulate: parameters", (5_000, 50_000))
def _(n):
    return ({"a.nc": "".join(f"#<a{i}>=1\n" for i in range(n)) + "M2\n"}, ["simulate", "a.nc", "--control", "linuxcnc"])

@row("simulate fanuc: 100 holes of 900,000 pecks", (1, 100), status=(0, 1), linear=False, seconds=2)
def _(n):
    r = "M3 S500\nG0 X0. Y0. Z1.\nG98 G83 X0. Y0. Z-900. R0. Q0.001 F100.\n" + "".join(f"X{i}.\n" for i in range(n)) + "G80\nM30\n"
    return {"a.nc": f"G21 G17 G90 G94\n{r}"}, ["simulate", "a.nc", "--control", "fanuc", "--dry"]

# after a far jump, that part of the file is read again
@row("simulate fanuc: M98 of subprograms behind the program", (2_000, 20_000), linear=False)
def _(n):
    calls = "".join(f"M98 P{i % 9000 + 1}\n" for i in range(n))
    return ({"a.nc": "O9999\n" + calls + "M30\n" + "".join(f"O{i + 1}\nM99\n" for i in range(min(n, 9000)))},
            ["simulate", "a.nc", "--control", "fanuc"])


# ---- measuring

STOP_AFTER = 30.0  # seconds of wall time


@dataclass
class Run:
    seconds: float = 0.0
    megabytes: float = 0.0
    status: int = 0
    stopped: bool = False
    errors: str = ""
    bytes: int = 0


def written(folder, make, size):
    """Writes a row's files in a separate process: on Linux, the peak memory of a program includes that of its parent."""
    pid = os.fork()
    if pid == 0:
        files, arguments = make(size)
        for name, text in files.items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        total = sum(map(len, files.values())) + sum(map(len, arguments))
        with open(os.path.join(folder, ".arguments"), "w") as file:
            json.dump([arguments, total], file)
        os._exit(0)
    os.waitpid(pid, 0)
    with open(os.path.join(folder, ".arguments")) as file:
        return json.load(file)


def run(binary, make, size):
    with tempfile.TemporaryDirectory() as folder:
        arguments, total = written(folder, make, size)
        with open(os.path.join(folder, "errors"), "w+b") as errors, open(os.devnull, "r+b") as null:
            pid = os.fork()
            if pid == 0:
                os.chdir(folder)
                os.dup2(null.fileno(), 0)
                os.dup2(null.fileno(), 1)
                os.dup2(errors.fileno(), 2)
                resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
                try:
                    os.execv(binary, [binary, *arguments])
                finally:
                    os._exit(127)
            end, stopped = time.monotonic() + STOP_AFTER, False
            while True:
                done, status, used = os.wait4(pid, os.WNOHANG)
                if done:
                    break
                if not stopped and time.monotonic() > end:
                    os.kill(pid, signal.SIGKILL)
                    stopped = True
                time.sleep(0.002)
            errors.seek(0)
            said = errors.read(4000).decode("utf-8", "replace")
        peak = used.ru_maxrss / (1 << 20 if sys.platform == "darwin" else 1 << 10)
        return Run(used.ru_utime + used.ru_stime, peak, os.waitstatus_to_exitcode(status), stopped, said, total)


def best(binary, make, size, runs):
    """The fastest of a few runs, because other programs can only make a run slower."""
    results = [run(binary, make, size)]
    while len(results) < runs and results[-1].seconds < 2:
        results.append(run(binary, make, size))
    return min(results, key=lambda result: result.seconds)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("binary")
    options.add_argument("--only", default="", help="rows whose name has this text")
    options.add_argument("--markdown", action="store_true", help="as a table of Markdown")
    options.add_argument("--slack", type=float, default=1.0, help="bounds so many times as wide, for a loaded machine")
    options.add_argument("--runs", type=int, default=2)
    options = options.parse_args()
    binary = os.path.abspath(options.binary)
    idle = best(binary, lambda _: ({}, ["--version"]), 0, 5).seconds
    marks = ("| ", " | ", " |") if options.markdown else ("", "  ", "")

    def line(*cells):
        widths = (58, 9, 9, 8, 8, 8, 8, 8, 6)
        fitted = [str(cell).ljust(width) if i == 0 else str(cell).rjust(width)
                  for i, (cell, width) in enumerate(zip(cells, widths))]
        print(marks[0] + marks[1].join(fitted) + marks[2] + ("" if options.markdown else "  " + cells[-1]), flush=True)

    head = ["dimension", "n", "N", "MB in", "s at n", "s at N", "exponent", "MB peak", "exit"]
    line(*head, "")
    if options.markdown:
        line(*["---"] * 9, "")
    broken = 0
    for row in ROWS:
        if options.only not in row.name:
            continue
        small, large = (best(binary, row.make, size, options.runs) for size in row.sizes)
        grown = max(large.seconds - idle, 1e-4) / max(small.seconds - idle, 5e-3)
        step = row.sizes[1] / row.sizes[0]
        # a time that is too short is not measured exactly, so it gives no exponent
        seen = large.seconds - idle > 0.1 and step > 1 and row.linear
        exponent = math.log(grown) / math.log(step) if seen else None
        wrong = []
        if large.stopped or small.stopped:
            wrong.append(f"not done after {STOP_AFTER:.0f} s")
        elif large.status not in row.status:
            wrong.append(f"exit {large.status}")
        if exponent is not None and exponent > 1.15 + 0.1 * (options.slack - 1):
            wrong.append("grows too fast")
        if large.seconds > row.seconds * options.slack:
            wrong.append(f"over {row.seconds:g} s")
        if large.megabytes > row.megabytes:
            wrong.append(f"over {row.megabytes:g} MB")
        broken += bool(wrong)
        line(row.name, *row.sizes, f"{large.bytes / 1e6:.2f}", f"{small.seconds:.2f}", f"{large.seconds:.2f}",
             "-" if exponent is None else f"{exponent:.1f}", f"{large.megabytes:.0f}", large.status, ", ".join(wrong))
    print(f"\n{broken} of the rows break their bound", file=sys.stderr)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
