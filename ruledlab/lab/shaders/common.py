"""What several programs need: the layout of the textures, reading them, ribbons, the globe."""

from __future__ import annotations

__all__ = [
    "BYTES",
    "CLIPPED",
    "DISC_KIND",
    "DOT_KIND",
    "GLOBE",
    "HEAD_KIND",
    "INK_PLACES",
    "INK_START",
    "INK_STEP",
    "LABEL_KIND",
    "LINE_KIND",
    "MARK",
    "MARKS",
    "OVERLAY_COLUMNS",
    "RIBBON",
    "ROWS",
    "RULINGS",
    "SCREEN",
    "STUB_KIND",
    "WORLD",
]

ROWS = 6
MARKS = 6
BYTES = 12  # scalars in a texel
OVERLAY_COLUMNS = 40  # of the texture of an overlay
INK_PLACES = 4096  # places an end of a label's stroke can have, across and upwards
INK_START, INK_STEP = -64.0, 0.125  # the first place, the next one: pixels
DOT_KIND, STUB_KIND = 0, 1
LINE_KIND, HEAD_KIND, DISC_KIND, LABEL_KIND = 0, 1, 2, 3

SCREEN = """
uniform vec2 viewport;    // pixels
const vec4 HIDDEN = vec4(2.0, 2.0, 2.0, 1.0);
"""

RULINGS = (
    SCREEN
    + """
uniform highp sampler2D rulings;
uniform vec2 extent;      // width and height of the texture

vec4 texel(float column, float row) {
  return texture2D(rulings, (vec2(column, row) + 0.5) / extent);
}
float columnAt(float fraction) {
  return floor(fraction * (texel(0.0, 3.0).a - 1.0) + 0.5);
}
"""
)

MARK = (
    SCREEN
    + f"""
uniform highp sampler2D mark;

vec4 marked(float column) {{
  return texture2D(mark, vec2((column + 0.5) / {MARKS}.0, 0.5));
}}
"""
)

WORLD = """
uniform vec3 lens;        // shift of the picture in clip space, scale
uniform float pull;       // how far towards the eye, as a part of the distance: who lies on top

vec4 toEye(vec3 point) {
  vec4 seen = modelViewMatrix * vec4(point, 1.0);
  return vec4(seen.xyz * (1.0 - pull), 1.0);
}
vec4 toClip(vec4 seen) {
  vec4 place = projectionMatrix * seen;
  place.xy = place.xy * lens.z + lens.xy * place.w;
  return place;
}
"""

RIBBON = """
vec2 heading(vec4 from, vec4 to) {
  vec2 way = (to.xy / to.w - from.xy / from.w) * viewport;
  float size = length(way);
  return size > 1e-4 ? way / size : vec2(1.0, 0.0);
}
vec4 moved(vec4 place, vec2 pixels) {
  place.xy += 2.0 * pixels / viewport * place.w;
  return place;
}
// corner = (0 or 1: which end, -1 or 1: which side); cap: how far past its ends, in half widths
vec4 ribbon(vec4 from, vec4 to, vec2 corner, float halfWidth, float cap) {
  vec2 way = heading(from, to);
  vec2 past = cap * (2.0 * corner.x - 1.0) * way;
  vec2 aside = corner.y * vec2(-way.y, way.x);
  return moved(corner.x < 0.5 ? from : to, halfWidth * (past + aside));
}
"""

CLIPPED = """
float frontPlane() {
  return -1.001 * projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0);
}
// the part of an end point that lies before the eye; both are in eye coordinates, z < 0 in front
vec4 before(vec4 end, vec4 other, float front) {
  return end.z > front ? mix(end, other, (end.z - front) / (end.z - other.z)) : end;
}
vec4 worldRibbon(vec4 from, vec4 to, vec2 corner, float halfWidth, float cap) {
  float front = frontPlane();
  if (from.z > front && to.z > front) return HIDDEN;
  vec4 a = toClip(before(from, to, front));
  vec4 b = toClip(before(to, from, front));
  return ribbon(a, b, corner, halfWidth, cap);
}
"""

GLOBE = """
uniform vec3 globe;       // centre in clip space, radius in pixels
vec3 turned(vec3 direction) {
  return (viewMatrix * vec4(direction, 0.0)).xyz;
}
// the sphere has a thin slice of depth of its own, before everything else
vec4 onGlobe(vec3 seen) {
  return vec4(globe.xy + 2.0 * seen.xy * globe.z / viewport, -0.98 - 0.01 * seen.z, 1.0);
}
"""
