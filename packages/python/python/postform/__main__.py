"""`python -m postform`: the command line."""

import os
import sys
from pathlib import Path


def main() -> int:
    name = "postform.exe" if os.name == "nt" else "postform"
    command = Path(__file__).parent / "bin" / name
    if not command.is_file():
        print(f"error: this package was built without the command ({command} is missing)", file=sys.stderr)
        return 2
    if os.name == "nt":
        import subprocess

        return subprocess.call([str(command), *sys.argv[1:]])
    os.execv(command, [str(command), *sys.argv[1:]])
    return 2  # os.execv does not return


if __name__ == "__main__":
    sys.exit(main())
