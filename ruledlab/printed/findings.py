"""The findings: each printed formula beside the right one, typeset, with how it shows.

The words and formulas are here; what is evaluated stands in `as_printed` and `as_defined`.
"""

from __future__ import annotations

from . import as_defined, as_printed
from .entry import Finding

__all__ = ["PRINTED"]

# -- pieces of the typeset formulas ----------------------------------------------------------------

_KAPPA_SQUARE = r"u'^2\sin^2 v+v'^2"
_STRETCH = (
    r"u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)"
    r"+u'v'(\bar v_u+\bar u_v\sin^2 v)+v'^2\,\bar v_v"
)
_ADVANCE = r"\sin v\,(\bar u\,v'-\bar v\,u')"
_TAU = r"\cos v\,(u'^3\sin^2 v+2u'v'^2)+\sin v"
_TAU_PRINTED = rf"\frac{{{_TAU}\,(u'v''+u''v')}}{{{_KAPPA_SQUARE}}}"
_TAU_RIGHT = rf"\frac{{{_TAU}\,(u''v'-u'v'')}}{{{_KAPPA_SQUARE}}}"
_MU_ABOVE = r"\sin v\,(v'\bar u'-u'\bar v')+u'v'\,\bar v\cos v"
_MU = rf"\mu=\bar u\cos v+\frac{{{_MU_ABOVE}}}{{{_KAPPA_SQUARE}}}"
_REST = r"w\kappa\,(w\kappa\tau+\bar\kappa')"
_H11_PRINTED = rf"\bar\kappa\,(\bar\tau+w\kappa'-\tau)-{_REST}"
_H11_RIGHT = rf"\bar\kappa\,(\kappa\bar\tau+w\kappa'-\bar\kappa\tau)-{_REST}"
_MEAN_RIGHT = rf"\bar\kappa\,(w\kappa'-\kappa\bar\tau-\bar\kappa\tau)-{_REST}"
_AREA = r"(w\kappa)^2+\bar\kappa^2"
_DU, _DV = r"\Delta_u", r"\Delta_v"
_SQUARE_0 = rf"{_DU}^2\sin^2 v_0+{_DV}^2"
_STRETCH_0 = (
    rf"{_DU}^2\sin v_0\,(\bar v\cos v_0+\bar u_u\sin v_0)"
    rf"+{_DU}{_DV}\,(\bar v_u+\bar u_v\sin^2 v_0)+{_DV}^2\,\bar v_v"
)
_ADVANCE_0 = rf"\bar u\,{_DV}-\bar v\,{_DU}"
_TAU_0 = rf"n\cos v_0\,{_DU}({_DU}^2\sin^2 v_0+2{_DV}^2)+(n-1)\sin v_0"
_BEND_PRINTED = rf"{_DU}\Delta^2_v+{_DV}\Delta^2_u"
_BEND_RIGHT = rf"{_DV}\Delta^2_u-{_DU}\Delta^2_v"
_WHERE_0 = (
    r"\qquad\text{with }(\Delta_u,\Delta_v)=\mathbf p_1-\mathbf p_0,\ "
    r"(\Delta^2_u,\Delta^2_v)=\mathbf p_2-2\mathbf p_1+\mathbf p_0,\ v_0=\mathbf p_{0_2}"
)

PRINTED: tuple[Finding, ...] = (
    Finding(
        "x2bar_prime",
        "§2.2, (5)",
        "derivative of the moment x̄₂ of the second frame line",
        r"\bar{\mathbf x}_2'=-\bar\kappa\,\mathbf x_1+\bar\tau\,\mathbf x_3"
        r"-\kappa\,\bar{\mathbf x}_1+\tau\,\bar{\mathbf x}_2",
        r"\bar{\mathbf x}_2'=-\bar\kappa\,\mathbf x_1+\bar\tau\,\mathbf x_3"
        r"-\kappa\,\bar{\mathbf x}_1+\tau\,\bar{\mathbf x}_3",
        as_printed.x2bar_prime,
        as_defined.x2bar_prime,
        "Take the dual part of X₂′ = −κ̂X₁ + τ̂X₃: τ meets x̄₃. An index slipped, and only in this "
        "line: the matrix that follows (17) was made with x̄₃ and is right.",
        "Where τ = 0. Elsewhere the two differ by τ(x̄₂ − x̄₃).",
    ),
    Finding(
        "x3_length",
        "§2.2, after (5)",
        "dual arc length of the curve of X₃, as a pair (real part, dual part)",
        r"\int\|\mathbf X_3'\|\,dt=\int\hat\tau\,dt",
        r"\int\|\mathbf X_3'\|\,dt=\int|\hat\tau|\,dt,\qquad"
        r"|\hat\tau|=\operatorname{sgn}(\tau)\,(\tau+\varepsilon\bar\tau)",
        as_printed.x3_length,
        as_defined.x3_length,
        "X₃′ = −τ̂X₂ has the length |τ̂|. A length does not shrink where τ is negative, as ∫τ does. "
        "Both integrals are invariants of the surface; only one of them is the arc length.",
        "Where τ ≥ 0 all along, as in Example 2.",
        over="surface",
        design="ramp",
    ),
    Finding(
        "base_curve",
        "§2.4, (9)",
        "first fundamental form g₁₁ at the place w of the ruling",
        r"\mathbf r=\mathbf c+w\,\mathbf x,\quad g_{11}=\bar\tau^2+(w\kappa)^2+\bar\kappa^2",
        r"\mathbf r=\mathbf c+w\,\mathbf x,\quad "
        r"g_{11}=\langle\mathbf c',\mathbf x\rangle^2+(w-\mu)^2\kappa^2+\bar\kappa^2,"
        r"\quad\mathbf c+\mu\,\mathbf x=\mathbf m",
        as_printed.g11,
        as_defined.g11_from_foot,
        "(9) is announced for the patch (1), whose base curve is any c; by (7) its r_t is that of "
        "r = m + w x. Read this way all of §2.4 holds, apart from h₁₁. Seen from the foot point, "
        "w has to be replaced by w − μ, and the share of r_t along x by ⟨c′, x⟩.",
        "Where the foot point is the striction point, μ = 0, all along, as on a helicoid or a "
        "hyperboloid of revolution; on any surface with r = m + w x.",
        over="t, w",
    ),
    Finding(
        "h11",
        "§2.4, after (9)",
        "second fundamental form h₁₁",
        rf"h_{{11}}=\frac{{{_H11_PRINTED}}}{{\sqrt{{{_AREA}}}}}",
        rf"h_{{11}}=\frac{{{_H11_RIGHT}}}{{\sqrt{{{_AREA}}}}}",
        as_printed.h11,
        as_defined.h11,
        "Look at the units: τ is an angle per unit of t, τ̄ a length, wκ′ a length per unit of t "
        "squared, so they cannot be added. Differentiate r_t once more and the factors κ and κ̄ "
        "appear.",
        "Where κ̄ = 0 and where τ̄(1 − κ) = τ(1 − κ̄): for instance if τ = τ̄ = 0, or if κ = κ̄ = 1, "
        "which the choice of t and of the unit of length can bring about at one place.",
        over="t, w",
    ),
    Finding(
        "mean_curvature",
        "§2.4, K_M",
        "mean curvature H",
        rf"K_M=\frac{{{_H11_PRINTED}-2\kappa\bar\kappa\bar\tau}}{{2\,({_AREA})^{{3/2}}}}",
        rf"H=\frac{{{_MEAN_RIGHT}}}{{2\,({_AREA})^{{3/2}}}}",
        as_printed.mean_curvature,
        as_defined.mean_curvature,
        "It inherits h₁₁. Run through the same curve twice as fast: the surface, and so its mean "
        "curvature, is the same, but the printed value changes. K_G contains no h₁₁ and is right.",
        "Where h₁₁ agrees.",
        over="t, w",
    ),
    Finding(
        "angle_of_pitch_11",
        "§2.5, (11)",
        "angle of pitch λ",
        r"\lambda=\oint d\phi=\oint\langle\mathbf x_2',\mathbf x_3\rangle\,dt",
        r"\lambda=\oint d\phi=-\oint\langle\mathbf x_2',\mathbf x_3\rangle\,dt=-\oint\tau\,dt",
        as_printed.angle_of_pitch_11,
        as_defined.angle_of_pitch,
        "ξ = cos φ x₂ + sin φ x₃ changes by −κ cos φ x₁ + (φ′ + τ)(−sin φ x₂ + cos φ x₃). To span "
        "a developable without following an orthogonal trajectory it may change along x₁ only: "
        "φ′ = −τ. (25) has this sign.",
        "Where λ = 0.",
        over="surface",
    ),
    Finding(
        "domain",
        "§3, and Example 2",
        "whether the point (u, v) of the curve is in the domain of the chart: 1 or 0",
        r"\mathcal B=\{(u,v):0\le u\le\pi,\ 0\le v\le 2\pi\}",
        r"\mathcal B=\{(u,v):0\le u\le 2\pi,\ 0\le v\le\pi\}",
        as_printed.domain,
        as_defined.domain,
        "In (12) u is the longitude and v the angle from the pole: one needs 2π, the other π. The "
        "printed rectangle, too, covers the sphere, but with its line v = π all in one pole and, "
        "beyond it, turned inside out (sin v < 0): ∬ sin v du dv is 0 over it instead of 4π.",
        "For curves in the square 0 ≤ u, v ≤ π that both have in common, as in Example 2.",
        design="hyperboloid",
    ),
    Finding(
        "closing",
        "§3, after (14)",
        "what has to vanish for a closed curve to be C¹ at its seam",
        r"\mathbf p_{n-1},\mathbf p_0,\mathbf p_1\ \text{collinear}",
        r"\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}",
        as_printed.closing,
        as_defined.closing,
        "b′(0) = n(p₁ − p₀) and b′(1) = n(p₀ − pₙ₋₁): collinear points make them parallel, not "
        "equal. With p₀ between the others the seam is G¹ and κ = ‖x′‖ jumps; with both on one "
        "side of p₀ it is a cusp. τ and σ contain second derivatives and as a rule jump even at a "
        "C¹ seam; they do not where u″v′ − u′v″ agrees as well, for which u″ and v″ need not.",
        "Where p₀ is the midpoint of pₙ₋₁ and p₁, as in Example 2.",
        over="surface",
    ),
    Finding(
        "tau",
        "§4, (18)",
        "torsion τ",
        rf"\tau={_TAU_PRINTED}",
        rf"\tau={_TAU_RIGHT}",
        as_printed.tau,
        as_defined.tau,
        "κ²τ = [x, x′, x″] is a determinant, so u″ and v″ enter as a determinant with u′ and v′. "
        "Or run through the same path at another speed: (u″, v″) gains a multiple of (u′, v′), "
        "and the part with u″, v″ must not notice.",
        "Where u′v″ = 0, for instance if v is linear in t, as in Example 1. The difference is "
        "2 sin v u′v″/κ².",
    ),
    Finding(
        "tau_bar",
        "§4, (18)",
        "dual torsion τ̄",
        rf"\bar\tau={_ADVANCE}",
        rf"\bar\tau={_ADVANCE}+\mu',\qquad {_MU}",
        as_printed.tau_bar,
        as_defined.tau_bar,
        "What is printed is ⟨c′, x⟩ for the foot point c. By (7) τ̄ = ⟨m′, x⟩ belongs to the "
        "striction point m = c + μ x, which moves along the ruling at the rate μ′ besides. (6) "
        "gives the same.",
        "Where μ′ = 0; and ∮τ̄ dt is the same for both, as μ returns to its value.",
    ),
    Finding(
        "cot_sigma",
        "§4, Lemma 1, (22)",
        "cotangent of the striction σ",
        r"\cot\sigma=\frac{\bar\tau}{\bar\kappa}"
        rf"=\frac{{{_ADVANCE}\,\sqrt{{{_KAPPA_SQUARE}}}}}{{{_STRETCH}}}",
        rf"\cot\sigma=\frac{{\bar\tau}}{{\bar\kappa}}"
        rf"=\frac{{\bigl({_ADVANCE}+\mu'\bigr)\,\sqrt{{{_KAPPA_SQUARE}}}}}{{{_STRETCH}}}",
        as_printed.cot_sigma,
        as_defined.cot_sigma,
        "cot σ = τ̄/κ̄ is right; the τ̄ of (18) went into it. Compare with the direction in which the "
        "striction curve crosses the rulings.",
        "Where μ′ = 0.",
    ),
    Finding(
        "example_1_kappa_bar",
        "§4, Example 1",
        "dual curvature κ̄",
        r"\bar\kappa=\frac{t\sin 2t+3}{\sqrt{\sin^2 t+1}}",
        r"\bar\kappa=\frac{t\sin 2t+2}{\sqrt{\sin^2 t+1}}",
        as_printed.example_1_kappa_bar,
        as_defined.on("example_1", as_defined.kappa_bar),
        "The constant is sin²t (ū_u + ū_v) + v̄_u + v̄_v = 0 + 2, whatever functions with ū = 0 and "
        "v̄ = 2t along u = v = t are meant: sin²t + cos²t + 1 in the example's δ, which is right.",
        "Nowhere: the difference is 1/κ.",
        design="example_1",
        only=True,
    ),
    Finding(
        "example_1_tau_bar",
        "§4, Example 1",
        "dual torsion τ̄",
        r"\bar\tau=t\sin t",
        r"\bar\tau=-2t\sin t+\mu'"
        r"=-2t\sin t-\frac{2t\sin t\,(1+\sin^2 t)+2(t\cos t-\sin t)\sin 2t}{(1+\sin^2 t)^2}",
        as_printed.example_1_tau_bar,
        as_defined.on("example_1", as_defined.tau_bar),
        "With ū = 0, v̄ = 2t and u′ = v′ = 1 formula (18), as printed, gives −2t sin t; a factor −2 "
        "was lost. To this μ′ must be added, μ = 2(t cos t − sin t)/(1 + sin²t).",
        "Only towards t = 0, where the curve leaves the pole and both tend to 0. At t = 1/2 the "
        "printed value is 0.2397, the right one −0.8240.",
        design="example_1",
        only=True,
    ),
    Finding(
        "example_1_cot_sigma",
        "§4, Example 1",
        "cotangent of the striction σ",
        r"\cot\sigma=\frac{-t\sqrt{\sin^2 t+1}}{t\cos t+2\sin t}",
        r"\cot\sigma=\frac{\bar\tau\,\sqrt{1+\sin^2 t}}{t\sin 2t+2}",
        as_printed.example_1_cot_sigma,
        as_defined.on("example_1", as_defined.cot_sigma),
        "It is not the quotient of the two values printed above it: its sign is that of "
        "−2t sin t, and in place of the constant 2 in κκ̄ stands 4 sin²t.",
        "Where the two curves happen to cross; nowhere as a formula.",
        design="example_1",
        only=True,
    ),
    Finding(
        "pitch_24",
        "§4.1, (24)",
        "pitch l",
        rf"l=\oint {_ADVANCE}\,dt",
        rf"l=-\oint {_ADVANCE}\,dt",
        as_printed.pitch_24,
        as_defined.pitch,
        "(10) has the minus: along an orthogonal trajectory w′ = −⟨c′, x⟩. The integrand ⟨c′, x⟩ "
        "is right, and here no μ′ is missed, as ∮μ′ dt = 0.",
        "Where l = 0.",
        over="surface",
    ),
    Finding(
        "angle_of_pitch_25",
        "§4.1, (25)",
        "angle of pitch λ",
        rf"\lambda=-\oint {_TAU_PRINTED}\,dt",
        rf"\lambda=-\oint {_TAU_RIGHT}\,dt",
        as_printed.angle_of_pitch_25,
        as_defined.angle_of_pitch,
        "The sign in front is right; the τ of (18) stands under the integral. For a loop that goes "
        "round no pole ∮τ dt − ∮cos v du is a whole number of turns (Gauss and Bonnet), for the "
        "printed integrand it is not.",
        "Where ∮ 2 sin v u′v″/κ² dt = 0, for instance if v is constant.",
        over="surface",
    ),
    Finding(
        "tau_0",
        "§4.2",
        "torsion τ(0) from the first three control points",
        rf"\tau(0)=\frac{{{_TAU_0}\,({_BEND_PRINTED})}}{{{_SQUARE_0}}}{_WHERE_0}",
        rf"\tau(0)=\frac{{{_TAU_0}\,({_BEND_RIGHT})}}{{{_SQUARE_0}}}",
        as_printed.tau_0,
        as_defined.first(as_defined.tau),
        "It is (18) at t = 0 with the same sign. The powers of n are right.",
        "Where Δ_u Δ²_v = 0, as in Example 2, whose first leg lies on a meridian.",
        over="surface",
        design="ramp",
    ),
    Finding(
        "tau_bar_0",
        "§4.2",
        "dual torsion τ̄(0) from the control points",
        rf"\bar\tau(0)=n\sin v_0\,({_ADVANCE_0}){_WHERE_0}",
        rf"\bar\tau(0)=n\sin v_0\,({_ADVANCE_0})+\mu'(0)",
        as_printed.tau_bar_0,
        as_defined.first(as_defined.tau_bar),
        "It is (18) at t = 0. As μ contains first derivatives, μ′(0) depends on p₂ as well.",
        "Where μ′(0) = 0.",
        over="surface",
    ),
    Finding(
        "delta_0",
        "§4.2",
        "distribution parameter δ(0) from the first two control points",
        rf"\delta(0)=\frac{{n\,{_DU}^2\sin v_0\,(\bar v\cos v_0+\bar u_u\sin v_0)}}{{{_SQUARE_0}}}"
        rf"{_WHERE_0}",
        rf"\delta(0)=\frac{{{_STRETCH_0}}}{{{_SQUARE_0}}}",
        as_printed.delta_0,
        as_defined.first(as_defined.delta),
        "δ = κ̄/κ, and the n of κ̄(0) cancels against that of κ(0), both of which are right. The "
        "terms with Δ_v are missing. Raise the degree: the curve, and so δ, stays, but the printed "
        "value grows like n.",
        "For n = 1 and Δ_v = 0. With Δ_v = 0 alone the printed value is n δ(0).",
        over="surface",
        design="twisted_ring",
    ),
    Finding(
        "cot_sigma_0",
        "§4.2",
        "cotangent of the striction σ(0) from the control points",
        rf"\cot\sigma(0)=\frac{{({_ADVANCE_0})\,\sqrt{{{_SQUARE_0}}}}}"
        rf"{{{_DU}^2\,(\bar v\cos v_0+\bar u_u\sin v_0)}}{_WHERE_0}",
        rf"\cot\sigma(0)=\frac{{\bigl(\sin v_0\,({_ADVANCE_0})+\mu'(0)/n\bigr)"
        rf"\,\sqrt{{{_SQUARE_0}}}}}{{{_STRETCH_0}}}",
        as_printed.cot_sigma_0,
        as_defined.first(as_defined.cot_sigma),
        "It is (22) at t = 0 without the terms with Δ_v in κκ̄; only without them could sin v₀ be "
        "cancelled. And μ′(0) is missing. In Example 2, where Δ_u = 0, it divides by zero although "
        "cot σ(0) = 2.1213.",
        "Where Δ_v = 0 and μ′(0) = 0.",
        over="surface",
        design="twisted_ring",
    ),
    Finding(
        "example_2",
        "§4.2, Example 2",
        "the pair (λ, l) of the closed surface",
        r"\lambda=1.419793061,\qquad l=0.3381414433",
        r"\lambda=-6.115937783178,\qquad l=0.580104765135",
        as_printed.example_2,
        as_defined.on("example_2", as_defined.both_pitches),
        "Three routes give the same: the definitions; a vector ξ and an orthogonal trajectory "
        "followed round the loop, with the gap they leave; and for λ the area 0.16724752 that the "
        "loop encloses on the sphere, as ∮τ dt is 2π less this area. The slip behind the printed "
        "pair was searched for, long and in vain: `TRIED` says where.",
        "No: not modulo 2π, not up to sign, and not with the printed (24) and (25), which give "
        "λ = 1.1193 and l = −0.5801 here. Nor could it be: a simple loop in the square of these "
        "control points encloses at most 0.4251, and λ is ± the area enclosed, modulo 2π.",
        over="surface",
        only=True,
    ),
)
"""What was found, in the order of the paper."""
