"""The menu of choices ū(u, v), v̄(u, v), each with its geometric meaning (see `field`)."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CHOICES", "Choice"]


@dataclass(frozen=True, slots=True)
class Choice:
    """A named pair of formulas ū, v̄ with its geometric meaning.

    Attributes
    ----------
    key
        short name for files.
    title
        what a menu shows.
    ubar, vbar
        the formulas, with plain numbers where the meaning speaks of a length: edit them.
    meaning
        one or two sentences: which lines these are.
    """

    key: str
    title: str
    ubar: str
    vbar: str
    meaning: str


CHOICES: tuple[Choice, ...] = (
    Choice(
        "origin",
        "Lines through the origin",
        "0",
        "0",
        "Every line passes through the origin: the surface is a cone with its apex there.",
    ),
    Choice(
        "cone",
        "Cone with its apex on the axis",
        "1",
        "0",
        "ū = h: every line passes through the point (0, 0, h) of the z-axis, here h = 1.",
    ),
    Choice(
        "bundle",
        "Cone with any apex",
        "0.5 - (cos(u) + 0.8*sin(u))*cos(v)/sin(v)",
        "0.8*cos(u) - sin(u)",
        "x̄ = a × x: every line passes through one point a, here (1, 0.8, 0.5).",
    ),
    Choice(
        "hyperboloid",
        "Touching a sphere along its equator",
        "0",
        "1",
        "v̄ = r: every line touches the sphere of radius r = 1 about the origin at a point of its "
        "equator, and there the cylinder of radius r about the z-axis too; "
        "for constant v they form a hyperboloid of one sheet.",
    ),
    Choice(
        "sphere",
        "Touching a sphere anywhere",
        "cos(pi/3)/sin(v)",
        "sin(pi/3)",
        "ū = r cos α / sin v, v̄ = r sin α: every line touches the sphere of radius r = 1 about "
        "the origin, at a point turned by the angle α = π/3 from the meridian through the line's "
        "direction; not defined at the poles.",
    ),
    Choice(
        "helicoid",
        "Helicoidal, meeting the axis",
        "0.5*u",
        "0",
        "ū = p u: every line meets the z-axis, at a height that grows by p = 0.5 for each radian "
        "of longitude; for v = π/2 a right helicoid, for other constant v an oblique one.",
    ),
    Choice(
        "helix",
        "Helicoidal around a cylinder",
        "0.5*u",
        "-1",
        "ū = p u, v̄ = −r: every line touches the cylinder of radius r = 1 about the z-axis, at a "
        "point of a helix that climbs p = 0.5 for each radian; "
        "for v = arctan(r/p) they are the helix's own tangents.",
    ),
    Choice(
        "linear_complex",
        "Lines of a linear complex",
        "0",
        "0.5*cos(v)/sin(v)",
        "v̄ = p cos v / sin v, with any ū: every line is perpendicular, in each of its points, to "
        "the path of that point in the screw motion about the z-axis with pitch p = 0.5 for each "
        "radian; not defined at the poles.",
    ),
    Choice(
        "twist",
        "Twisted bundle",
        "0",
        "0.5*sin(v)/cos(v)",
        "v̄ = k tan v: a line at the distance d from the z-axis is turned against it by "
        "arctan(d/k), here k = 0.5, so that through every point of space passes exactly one "
        "(an elliptic linear congruence); not defined for v = π/2.",
    ),
    Choice(
        "torus_normals",
        "Normals of a torus",
        "-cos(v)/sin(v)",
        "0",
        "ū = −R cos v / sin v: every line meets the z-axis and the circle of radius R = 1 about it "
        "in the plane z = 0, so it is normal to all tori around that circle; "
        "not defined at the poles.",
    ),
    Choice(
        "ellipsoid_normals",
        "Normals of an ellipsoid",
        "3*cos(v)/sqrt(sin(v)**2 + 4*cos(v)**2)",
        "0",
        "Every line is normal to the ellipsoid of revolution x² + y² + z²/4 = 1 in the point where "
        "its outward normal has the line's direction.",
    ),
    Choice(
        "saddle_normals",
        "Normals, from a support function",
        "-cos(v)*sin(2*u)",
        "sin(v)*cos(2*u)",
        "Every line is normal to the surface whose tangent plane with normal (x, y, z) has the "
        "distance x y from the origin, and to all its parallel surfaces.",
    ),
    Choice(
        "conoid",
        "Conoid",
        "sin(2*u)",
        "0",
        "Every line meets the z-axis, at a height that swings up and down twice in one turn; "
        "for v = π/2 this is Plücker's conoid z = 2xy/(x² + y²).",
    ),
    Choice(
        "coil",
        "Coil on a torus",
        "0.3*sin(5*u)",
        "1 + 0.3*cos(5*u)",
        "The point of each line nearest the z-axis lies on the torus with the radii 1 and 0.3 and "
        "winds five times round its tube while u makes one turn.",
    ),
    Choice(
        "waves",
        "Waves",
        "0.2*sin(6*u)*sin(v)",
        "1 + 0.2*cos(6*v)",
        "A hyperboloid disturbed: the lines' nearest points to the z-axis rise and fall by at most "
        "0.2 with u, and keep a distance from it between 0.8 and 1.2 that depends on v alone.",
    ),
    Choice(
        "paper",
        "The paper's examples: u − v, u + v",
        "u - v",
        "u + v",
        "The common perpendicular of each line and the z-axis leaves the axis at the height u − v "
        "and has the length u + v: the choice of the paper's two examples.",
    ),
)
"""The menu. In every entry ū is the height at which the common perpendicular of the line and the
z-axis leaves the axis, v̄ its signed length along (−sin u, cos u, 0)."""
