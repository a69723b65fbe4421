"""What was confirmed, the smaller remarks, and where the slip of Example 2 was looked for."""

from __future__ import annotations

from .entry import Note

__all__ = ["CONFIRMED", "REMARKS", "TRIED"]

# The search was done outside the package: more than 3·10¹⁰ comparisons. A match is nine equal
# digits, up to sign and, for λ, a multiple of 2π. The bound and a part of the search are in the
# tests.
TRIED: tuple[Note, ...] = (
    Note(
        "A bound instead of a search",
        "A simple loop in the square π/8 ≤ u, v ≤ 3π/8 encloses at most the square's area, 0.4251. "
        "By Gauss–Bonnet λ is ± the loop's area modulo 2π: 1.4198 is out of reach. With ū = u − v, "
        "v̄ = u + v the pitch is, by Stokes, between 2.65 and 5.79 times the area: "
        "l = 0.3381 asks for an area between 0.058 and 0.128. So no order of the six points, no "
        "degree and no spline makes such a loop, if the formulas were right.",
    ),
    Note(
        "Other control points",
        "All closed C¹ curves of degree 6 with points on the grid of π/8, 0 ≤ u ≤ π and either "
        "0 ≤ v ≤ π or π ≤ v ≤ 2π; all closed ones, C¹ or not, for u ≤ π/2, v ≤ π; smaller grids "
        "in the degrees 5, 7 and 8, and with 24 other units in place of π/8; points left out or "
        "repeated, u and v in separate orders; squares of other sizes and places. Among nearly "
        "2·10¹⁰ curves l fits about as often as chance allows, and never together with λ.",
    ),
    Note(
        "Other formulas",
        "Right and printed formulas, (11) as well as (25), every term with the factors 0, ±1, ±2, "
        "divided by κ⁰ to κ⁴; (6) with terms dropped or with the largest coordinate of x′ for its "
        "length; κ, κ̄, δ, products of powers, and all inner and triple products of x, x̄, c and "
        "their derivatives; u and v exchanged, latitude for colatitude, degrees for radians; no "
        "binomials, terms of u, v or of u′, v′ left out. A handful give one of the numbers to nine "
        "digits, as many as chance allows, each by a contrived formula.",
    ),
    Note(
        "Other ū and v̄",
        "All au + bv + c with half-integers up to 3, and combinations of up to two of 29 simple "
        "functions of u, v or t. None gives l; λ does not depend on them.",
    ),
    Note(
        "Other integration",
        "Sums, trapezoids, Simpson, Boole, Romberg, Newton–Cotes, Gauss, Lobatto, Radau and "
        "Clenshaw–Curtis with few nodes: nothing nearer than 2·10⁻⁵. All ranges of t between two "
        "fractions with denominators up to 30, from −1/2 to 3/2. The nearest to a pattern: ∫τ dt "
        "from 0 reaches the printed λ at t = 0.1708, and −∫⟨c′, x⟩ dt the printed l at t = 0.1700: "
        "near, but not one place.",
    ),
)
"""What was varied in search of the slip behind Example 2's numbers, and what came of it: nothing.

For comparison, from the printed points: ∫κ dt = 1.4473, and the pair asked for is
λ = −6.1159, l = 0.5801.
"""

REMARKS: tuple[Note, ...] = (
    Note(
        "§2.1",
        "⟨U, V⟩ = cos θ − ε d sin θ: the dual part holds the distance together with the angle, and "
        "d has a sign, that of the turn about the common perpendicular.",
    ),
    Note(
        "§2.2",
        "In m′ = a x₁ + b x₃ the numbers a and b depend on t. κ = 0 makes a cylinder where it "
        "holds all along. d = 1/δ has no value on a torsal ruling.",
    ),
    Note(
        "§2.3",
        "Theorem 2 and Corollary 1: the invariants, with κ ≠ 0, fix the surface up to its position "
        "in space. σ in (8) is one value in 0 ≤ σ < 2π, as 0 and 2π are the same direction.",
    ),
    Note(
        "§2.5",
        "The pitch: it is on an orthogonal trajectory that a point comes back to another place of "
        "its ruling; (10) says so, the words do not. It has a sign, so it is not a length.",
    ),
    Note("§3, (13)", "In a pole, sin v = 0, x_u vanishes, and (13) gives part of the lines only."),
    Note(
        "§3, (14)",
        "n + 1 control points make a curve of degree n, of order n + 1. It is closed for "
        "0 ≤ t ≤ 1 only, not for t ∈ ℝ: as a polynomial it cannot be periodic.",
    ),
    Note(
        "§4, after (17)",
        "The matrix acts on the real vectors x₁, x₂, x₃, although capitals are printed, as in "
        "(21); α₁, α₂, α₃ are the coordinates of the striction point, αᵢ = ⟨m, xᵢ⟩.",
    ),
    Note(
        "§4, (22)",
        "A cotangent leaves σ open by π; the signs of τ̄ and κ̄ tell which of the two it is.",
    ),
    Note(
        "§4, Example 1",
        "The example 3.1.1 it starts from is not in the text. ū = u − v and v̄ = u + v, the choice "
        "of Example 2, give the ū = 0 and v̄ = 2t it goes on with. At t = 0 the curve starts in a "
        "pole of the chart, where x̄ depends on the direction from which one comes.",
    ),
    Note(
        "§4.2, Example 2",
        "The exponent n of 1 − t is 6. Figures 4.3 to 4.5 are those with the captions 2 to 4.",
    ),
    Note(
        "§5",
        "The map from the chart to the sphere is one-to-one for 0 < v < π and 0 ≤ u < 2π, but not "
        "on the whole domain: each of the lines v = 0 and v = π goes to one pole.",
    ),
    Note(
        "§3 to §4.2, numbers",
        "There is no equation (23), no section 3.2 and no reference [14], to which the text sends.",
    ),
)
"""Smaller things, on which no number depends."""

CONFIRMED: tuple[Note, ...] = (
    Note("§2.1", "the ring; f(x + εx̄) and its three examples; ⟨U, V⟩; foot point c = x × x̄"),
    Note("§2.2", "(2) to (4); x̄₁′ and x̄₃′ in (5); (6), with both terms of τ̄; δ"),
    Note("§2.2", "(7), the arc length s(t), and the striction curve m"),
    Note("§2.4", "n, g₁₁, g₁₂, g₂₂, h₁₂, h₂₂ and K_G, on the patch m + w x"),
    Note("§2.5", "(10), sign and integrand"),
    Note("§3", "(12), (13), (15) and (16); p₀ = pₙ closes the curve"),
    Note("§4", "(17); the matrix after it, with x₁, x₂, x₃; α₁, α₂, α₃"),
    Note("§4, (18)", "κ and κ̄"),
    Note("§4", "(19), (20) and the formula for the foot point a(t); (21)"),
    Note("§4, Example 1", "κ, τ and δ"),
    Note("§4.2", "the derivatives of u and v; κ(0) and κ̄(0)"),
)
"""What was checked in the same way and stands as printed."""
