"""Compare the lessons in a wheel with those in the tree: check_wheel.py WHEEL LESSONS."""

from __future__ import annotations

import sys
from pathlib import Path
from zipfile import ZipFile

INSIDE = "ruledlab/_lessons/"


def main(wheel: str, lessons: str) -> str | None:
    """Return what is wrong, or None."""
    tree = {path.name: path.read_bytes() for path in Path(lessons).glob("*.ipynb")}
    with ZipFile(wheel) as archive:
        names = archive.namelist()
        inside = {
            name.removeprefix(INSIDE): archive.read(name)
            for name in names
            if name.startswith(INSIDE) and name.endswith(".ipynb") and "/." not in name
        }
    if not tree or inside != tree:
        return (
            f"lessons in the tree: {sorted(tree)}, in the wheel: {sorted(inside)}, or they differ"
        )
    if stray := [name for name in names if "/." in name or "__pycache__" in name]:
        return f"stray files in the wheel: {stray}"
    print(f"{Path(wheel).name}: {len(names)} files, {len(inside)} lessons")
    return None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
