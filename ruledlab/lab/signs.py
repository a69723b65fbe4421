"""Signs on the chart of the sphere: what a field does at its places, as data for the domain pad.

The value here is frozen and says what is to be seen; `ruledlab.lab.pad.DomainPad` shows it under
the curve and the control points, where it is in the way of neither. Nothing is drawn here.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Final

import numpy as np

from ..geometry.checks import Array, GeometryError, finite_array, frozen
from .palette import Theme

__all__ = ["Signs"]

NAMES: Final = frozenset(field.name for field in fields(Theme)) - {"dark"}


@dataclass(frozen=True, eq=False, slots=True)
class Signs:
    """One sign at each of N places of the chart, each on a shaded tile.

    Attributes
    ----------
    places
        (N, 2) longitude and colatitude in radians; finite.
    signs
        N characters, one for each place, no blanks.
    colours
        N names of colours of the theme, such as ``"kappa"``: of the signs.
    shades
        (N,) how dark the tile about a place is: 0 (no tile) to 1.
    tile
        width and height of a tile in radians; the signs are made to fit.
    words
        what all this says, for readers who do not see it.

    Raises
    ------
    GeometryError
        if the attributes do not fit together.
    """

    places: Array
    signs: str
    colours: tuple[str, ...]
    shades: Array
    tile: tuple[float, float]
    words: str = ""

    def __post_init__(self) -> None:
        for name in ("places", "shades"):
            object.__setattr__(self, name, frozen(finite_array(getattr(self, name), name)))
        count = len(self.signs)
        _checked(self.places.shape == (count, 2), "places", f"({count}, 2)", self.places.shape)
        _checked(self.shades.shape == (count,), "shades", f"({count},)", self.shades.shape)
        _checked(len(self.colours) == count, "colours", f"({count},)", (len(self.colours),))
        if self.signs.split() not in ([], [self.signs]):
            raise GeometryError("`signs` must not have blanks; leave out what shall show no sign")
        if unknown := sorted(set(self.colours) - NAMES):
            known = ", ".join(sorted(NAMES))
            raise GeometryError(f"`colours` must be names of {known}; got {unknown[0]!r}")
        if not (min(self.tile) > 0.0 and ((self.shades >= 0.0) & (self.shades <= 1.0)).all()):
            raise GeometryError("`tile` must be positive and `shades` between 0 and 1")

    def packed(self) -> dict[str, Any]:
        """Return it as the pad sends it: bytes for the numbers, each colour named once."""
        names = tuple(dict.fromkeys(self.colours))
        which = {name: number for number, name in enumerate(names)}
        return {
            "places": self.places.astype("<f4").tobytes(),
            "signs": self.signs,
            "colours": list(names),
            "which": bytes(which[name] for name in self.colours),
            "shades": np.rint(255.0 * self.shades).astype("u1").tobytes(),
            "tile": [float(side) for side in self.tile],
            "words": self.words,
        }


def _checked(right: bool, name: str, wanted: str, got: tuple[int, ...]) -> None:
    if not right:
        raise GeometryError(f"`{name}` must have shape {wanted}, one for each sign; got {got}")
