"""The colours of the lab: one per quantity, the same in plots, in 3D and in read-outs.

The hues are Okabe and Ito's colour-blind-safe set, lightened for the dark theme. A barred (dual)
quantity has the hue of its real part and is told apart by a dashed line, never by colour alone.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours as ``#rrggbb`` for one background."""

    dark: bool
    ink: str
    faint: str
    grid: str
    paper: str
    cursor: str
    chosen: str
    kappa: str
    tau: str
    sigma: str
    delta: str
    surface: str
    ruling: str
    x2: str
    x3: str

    def quantity(self, name: str) -> str:
        """Return the colour of an invariant; barred ones share their real part's hue."""
        return str(getattr(self, name.removesuffix("_bar")))


LIGHT = Theme(
    dark=False,
    ink="#1f2328",
    faint="#57606a",
    grid="#d0d7de",
    paper="#ffffff",
    cursor="#9a6700",
    chosen="#111111",
    kappa="#0072b2",
    tau="#d55e00",
    sigma="#008060",
    delta="#aa4499",
    surface="#b8c7d9",
    ruling="#5b6b7f",
    x2="#0072b2",
    x3="#d55e00",
)

DARK = Theme(
    dark=True,
    ink="#e6e6e6",
    faint="#9da7b3",
    grid="#444c56",
    paper="#111111",
    cursor="#f0e442",
    chosen="#ffffff",
    kappa="#56b4e9",
    tau="#ff8c42",
    sigma="#2bd4a4",
    delta="#e58bc4",
    surface="#5f7187",
    ruling="#aab7c6",
    x2="#56b4e9",
    x3="#ff8c42",
)
