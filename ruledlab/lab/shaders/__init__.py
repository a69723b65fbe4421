"""The programs that draw a surface from its rulings (GLSL ES 1.00, also good as 3.00).

Nothing here knows a formula of ruled surfaces but b + w x and its normal (b′ + w x′) × x. Vertices
carry places, not positions; the positions come from the texture ``rulings``, whose column k holds
ruling k. Its rows (xyz; alpha) are

====  ========================  =========================================
0     base b                    1 if b and x are finite, otherwise 0
1     direction x               w at one end of the drawn ruling
2     rate b′ of the base       w at the other end
3     rate x′ of the direction  number of rulings
4     striction point m         1 if m is finite, otherwise 0
5     control direction k       1 if there is a k-th control point
6 …   scalars, see below
====  ========================  =========================================

A direction that is not finite is 0. The texture may be wider than the number of rulings, and a
mesh may have more rows than there are rulings: each row takes the nearest ruling, so that one mesh
serves many sizes and the number of rulings changes together with the rulings themselves.

Scalars are bytes, three to a number and so twelve to a texel: 0 means undefined, 1 to 255 the
place on the colour scale.

The texture ``mark`` holds the cursor in one row: base (alpha: w at one end), x₁, x₂, x₃ and m
(alpha: 1 if finite), then (arrow length, w at the other end).

The texture ``overlay`` holds what a lesson draws into space; its lines are those of
`ruledlab.lab.overlay`, where its layout stands.

No program reads more than one texture: pythreejs 2.4 gives every texture among the uniforms of a
material the name of the last uniform, so there can be one, and it has to be the last.

Lines are ribbons: their vertices are moved sideways in pixels after projection, because WebGL
draws its own lines one pixel wide. A ribbon is clipped at the near plane before it is widened; a
ruling that runs past the eye would otherwise turn inside out.
"""

from __future__ import annotations

from .common import (
    BYTES,
    DISC_KIND,
    DOT_KIND,
    HEAD_KIND,
    INK_PLACES,
    INK_START,
    INK_STEP,
    LABEL_KIND,
    LINE_KIND,
    MARKS,
    OVERLAY_COLUMNS,
    ROWS,
    STUB_KIND,
)
from .globe import (
    CONTROLS_FRAGMENT,
    CONTROLS_VERTEX,
    GLOBE_FRAGMENT,
    GLOBE_VERTEX,
    IMAGE_FRAGMENT,
    IMAGE_VERTEX,
    NEEDLE_FRAGMENT,
    NEEDLE_VERTEX,
)
from .mark import MARK_FRAGMENT, MARK_VERTEX
from .overlay import (
    DOTS_FRAGMENT,
    DOTS_VERTEX,
    LABELS_FRAGMENT,
    LABELS_VERTEX,
    SHEETS_FRAGMENT,
    SHEETS_VERTEX,
    STROKES_FRAGMENT,
    STROKES_VERTEX,
)
from .surface import (
    LATTICE_VERTEX,
    LINE_FRAGMENT,
    STRICTION_VERTEX,
    SURFACE_FRAGMENT,
    SURFACE_VERTEX,
)

__all__ = [
    "BYTES",
    "CONTROLS_FRAGMENT",
    "CONTROLS_VERTEX",
    "DISC_KIND",
    "DOTS_FRAGMENT",
    "DOTS_VERTEX",
    "DOT_KIND",
    "GLOBE_FRAGMENT",
    "GLOBE_VERTEX",
    "HEAD_KIND",
    "IMAGE_FRAGMENT",
    "IMAGE_VERTEX",
    "INK_PLACES",
    "INK_START",
    "INK_STEP",
    "LABELS_FRAGMENT",
    "LABELS_VERTEX",
    "LABEL_KIND",
    "LATTICE_VERTEX",
    "LINE_FRAGMENT",
    "LINE_KIND",
    "MARKS",
    "MARK_FRAGMENT",
    "MARK_VERTEX",
    "NEEDLE_FRAGMENT",
    "NEEDLE_VERTEX",
    "OVERLAY_COLUMNS",
    "ROWS",
    "SHEETS_FRAGMENT",
    "SHEETS_VERTEX",
    "STRICTION_VERTEX",
    "STROKES_FRAGMENT",
    "STROKES_VERTEX",
    "STUB_KIND",
    "SURFACE_FRAGMENT",
    "SURFACE_VERTEX",
]
