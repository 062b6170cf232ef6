"""`python make_jobs.py FOLDER COUNT` writes COUNT different jobs of a few holes and cuts into FOLDER."""

import json
import sys
from pathlib import Path

folder, count = Path(sys.argv[1]), int(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
for n in range(count):
    holes = [[10 * i + n % 7, 5 + (n * 3 + i) % 40, 0] for i in range(5 + n % 20)]
    cuts = [{"line": [i, (n + i) % 30, -1]} for i in range(1, 10 + n % 50)]
    job = {
        "postform": 1,
        "program": 1 + n % 9999,
        "units": "mm",
        "tools": [{"number": 1, "diameter": 6}, {"number": 2, "diameter": 5}],
        "operations": [
            {
                "name": "contour", "tool": 1, "work": 54, "spindle": {"speed": 3000, "direction": "cw"}, "feed": 400,
                "path": [{"rapid": [0, 0, 50]}, {"rapid": [0, 0, 2]}, *cuts, {"rapid": [None, None, 50]}],
            },
            {
                "name": "holes", "tool": 2, "work": 54, "spindle": {"speed": 2000, "direction": "cw"},
                "path": [
                    {"rapid": [*holes[0][:2], 50]},
                    {"cycle": {"kind": "drill", "depth": 8, "clear": 2, "return": 50, "feed": 150, "points": holes}},
                ],
            },
        ],
    }
    (folder / f"part{n:05}.json").write_text(json.dumps(job))
