"""The command ``asperity``."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from . import _asperity


def main() -> int:
    """Run the command line of the process, and return its exit code."""
    return _asperity.run(["asperity", *sys.argv[1:]], _command(), _asperity.__file__)


def _command() -> Path:
    """The path that runs this command again."""
    script = Path(sys.argv[0]).absolute()
    if script.name != "__main__.py" and script.is_file():
        return script
    beside = Path(sys.executable).with_name("asperity")
    return beside if beside.is_file() else Path(shutil.which("asperity") or "asperity")


if __name__ == "__main__":
    sys.exit(main())
