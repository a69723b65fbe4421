"""The paper read with a computer: what is printed beside what the definitions give.

Each `Finding` holds one formula of F. Taş, *On the Design and Invariants of a Ruled Surface*, two
times: as it is printed, and as it follows from the definitions (3) to (8). Both can be evaluated
on any design, so that the difference can be seen instead of believed. What is printed is evaluated
literally, from u, v, ū, v̄ and their derivatives (`as_printed`); what is right is taken from the
definitions, without the formula in question (`as_defined`). The ideas of the paper are untouched by
any of this, and most of its formulas stand as printed: `CONFIRMED` names them.

Conventions: x̄ = c × x, μ = ⟨m − c, x⟩ is the place of the striction point on the ruling, seen from
the foot point c. Values that are undefined are NaN.
"""

from __future__ import annotations

from ..geometry import GeometryError
from .entry import Finding, Note
from .findings import PRINTED
from .notes import CONFIRMED, REMARKS, TRIED

__all__ = ["CONFIRMED", "PRINTED", "REMARKS", "TRIED", "Finding", "Note", "finding"]


def finding(key: str) -> Finding:
    """Return the finding with this key.

    Raises
    ------
    GeometryError
        if there is none.
    """
    by_key = {entry.key: entry for entry in PRINTED}
    if key not in by_key:
        raise GeometryError(f"`key` must be one of {', '.join(by_key)}; got {key!r}")
    return by_key[key]
