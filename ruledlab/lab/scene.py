"""What there is to draw, as plain arrays: the only thing a view ever sees.

A `Scene` is everything that depends on the design, a `Mark` everything that depends on the cursor.
No plotting library is imported here, and no view computes geometry of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.floating[Any]]


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """One design, sampled.

    Attributes
    ----------
    t
        (T,) parameter values.
    chart
        (T, 2) the curve (u, v) in radians.
    control
        (n+1, 2) control points in the chart.
    control_directions
        (n+1, 3) the same points on the unit sphere.
    direction, direction_rate
        (T, 3) unit direction x of each ruling and x′.
    base, base_rate
        (T, 3) the point of each ruling from which w is drawn, and its derivative.
    striction
        (T, 3) the striction point m.
    w
        (2,) the ends of the drawn rulings, measured from ``base``.
    curves
        name of an invariant (``kappa``, ``kappa_bar``, ``tau``, ``tau_bar``, ``sigma``, ``delta``)
        to its (T,) values; NaN where undefined. ``sigma`` is unwrapped.
    gaps
        sentences that say where and why values are undefined.
    colour
        (T, W) scalar the surface is coloured by, NaN where undefined, or None for plain.
    colour_label
        name of that scalar with its unit, as text.
    centre, radius
        a ball that holds most of the drawing, for framing.
    closed
        whether the last ruling is the first again (as a line).
    text
        the whole scene in words, for who cannot see the picture.
    """

    t: Array
    chart: Array
    control: Array
    control_directions: Array
    direction: Array
    direction_rate: Array
    base: Array
    base_rate: Array
    striction: Array
    w: Array
    curves: dict[str, Array]
    gaps: tuple[str, ...]
    colour: Array | None
    colour_label: str
    centre: Array
    radius: float
    closed: bool
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class Mark:
    """The cursor: one ruling and its frame.

    Attributes
    ----------
    t
        the parameter.
    chart
        (2,) the point (u, v).
    base, striction
        (3,) as in `Scene`, at t.
    frame
        (3, 3) rows x₁, x₂, x₃; NaN rows where undefined.
    values
        invariant name to value at t.
    text
        the same in words.
    """

    t: float
    chart: Array
    base: Array
    striction: Array
    frame: Array
    values: dict[str, float]
    text: str
