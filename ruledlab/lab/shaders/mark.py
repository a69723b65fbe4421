"""The cursor: its ruling, the moving frame and the letters at its arrows."""

from __future__ import annotations

import itertools

from .common import CLIPPED, DISC_KIND, HEAD_KIND, LINE_KIND, MARK, RIBBON, WORLD

__all__ = ["MARK_FRAGMENT", "MARK_VERTEX"]

MARK_VERTEX = (
    MARK
    + WORLD
    + RIBBON
    + CLIPPED
    + f"""
attribute vec2 part;      // which of the marks: 0 the ruling, 1 to 3 the frame, 4 the point; kind
attribute vec2 corner;
uniform vec3 cursorColour;
uniform vec3 secondColour;
uniform vec3 thirdColour;
uniform vec3 pointColour;
varying vec3 vColour;
varying vec2 vCorner;
varying vec2 vKind;       // kind, which
const float HEAD = 11.0;  // pixels
const float DISC = 6.5;
const float LABEL = 9.0;

vec3 colourOf(float item) {{
  if (item < 1.5) return cursorColour;
  if (item < 2.5) return secondColour;
  return item < 3.5 ? thirdColour : pointColour;
}}
vec4 head(vec4 from, vec4 to) {{
  vec4 a = toClip(from);
  vec4 b = toClip(to);
  vec2 way = heading(a, b);
  vec2 back = -HEAD * (1.0 - corner.x) * way;
  return moved(b, back + 5.5 * (1.0 - corner.x) * corner.y * vec2(-way.y, way.x));
}}
vec4 label(vec4 from, vec4 to) {{
  vec4 a = toClip(from);
  vec4 b = toClip(to);
  return moved(b, 13.0 * heading(a, b) + LABEL * corner * vec2(1.25, 1.0));
}}
vec4 arrow(float item, float kind, vec3 origin) {{
  vec3 tip = origin + marked(5.0).x * marked(item).xyz;
  vec4 from = toEye(origin);
  vec4 to = toEye(tip);
  if (max(from.z, to.z) > frontPlane()) return HIDDEN;
  if (kind < {LINE_KIND}.5) {{
    vec4 end = toClip(to);
    vec2 way = heading(toClip(from), end);
    vec4 neck = moved(end, -0.8 * HEAD * way);
    return ribbon(toClip(from), neck, corner, 2.2, 0.0);
  }}
  return kind < {HEAD_KIND}.5 ? head(from, to) : label(from, to);
}}
vec4 ruling() {{
  vec4 base = marked(0.0);
  vec3 direction = marked(1.0).xyz;
  vec4 from = toEye(base.xyz + base.a * direction);
  vec4 to = toEye(base.xyz + marked(5.0).y * direction);
  return worldRibbon(from, to, corner, 3.0, 0.0);
}}
vec4 placed(float item, float kind) {{
  vec4 point = marked(4.0);
  if (item < 0.5) return marked(1.0).a < 0.5 ? HIDDEN : ruling();
  if (point.a < 0.5) return HIDDEN;
  vec4 seen = toEye(point.xyz);
  if (item > 3.5) return seen.z > frontPlane() ? HIDDEN : moved(toClip(seen), DISC * corner);
  return marked(item).a < 0.5 ? HIDDEN : arrow(item, kind, point.xyz);
}}
void main() {{
  vColour = colourOf(part.x);
  vCorner = corner;
  vKind = vec2(part.y, part.x);
  gl_Position = placed(part.x, part.y);
}}
"""
)

_CROSS = (((-0.95, 0.38), (-0.30, -0.42)), ((-0.95, -0.42), (-0.30, 0.38)))
_ONE = (((0.10, -0.15), (0.30, 0.02), (0.30, -0.70)),)
_TWO = (((0.08, -0.10), (0.24, 0.02), (0.43, -0.12), (0.36, -0.32), (0.08, -0.70), (0.47, -0.70)),)
_THREE = (((0.08, 0.0), (0.43, 0.0), (0.24, -0.30), (0.44, -0.45), (0.36, -0.67), (0.08, -0.65)),)


def _distance(*paths: tuple[tuple[float, float], ...]) -> str:
    """Return the GLSL expression of the distance of ``p`` from polylines."""
    pairs = [pair for path in paths for pair in itertools.pairwise(path)]
    text = "9.0"
    for (a, b), (c, d) in pairs:
        text = f"min({text}, segment(p, vec2({a}, {b}), vec2({c}, {d})))"
    return text


_LETTERS = f"""
float segment(vec2 p, vec2 a, vec2 b) {{
  vec2 way = b - a;
  return length(p - a - way * clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0));
}}
float digit(vec2 p, float which) {{
  if (which < 1.5) return {_distance(*_ONE)};
  if (which < 2.5) return {_distance(*_TWO)};
  return {_distance(*_THREE)};
}}
// distance from the strokes of x with the index 1, 2 or 3
float letter(vec2 p, float which) {{
  return min({_distance(*_CROSS)}, digit(p, which));
}}
"""

MARK_FRAGMENT = (
    _LETTERS
    + f"""
uniform vec3 casing;
uniform float strength;
varying vec3 vColour;
varying vec2 vCorner;
varying vec2 vKind;
const float LABEL = 9.0;

void disc() {{
  float radius = length(vCorner);
  float inside = 1.0 - smoothstep(0.85, 1.0, radius);
  if (inside < 0.02) discard;
  gl_FragColor = vec4(mix(vColour, casing, smoothstep(0.58, 0.74, radius)), strength * inside);
}}
void label() {{
  float far = LABEL * letter(vec2(1.25, 1.0) * vCorner, vKind.y);
  float halo = 1.0 - smoothstep(2.0, 3.2, far);
  if (halo < 0.02) discard;
  gl_FragColor = vec4(mix(vColour, casing, smoothstep(0.5, 1.3, far)), strength * halo);
}}
void main() {{
  if (vKind.x > {DISC_KIND}.5) {{ label(); return; }}
  if (vKind.x > {HEAD_KIND}.5) {{ disc(); return; }}
  bool cased = vKind.y < 0.5;
  float edge = cased ? smoothstep(0.60, 0.84, abs(vCorner.y)) : 0.0;
  gl_FragColor = vec4(mix(vColour, casing, edge), strength);
}}
"""
)
