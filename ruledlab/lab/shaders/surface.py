"""The surface, its rulings and its striction curve."""

from __future__ import annotations

from .common import CLIPPED, RIBBON, RULINGS, WORLD

__all__ = [
    "LATTICE_VERTEX",
    "LINE_FRAGMENT",
    "STRICTION_VERTEX",
    "SURFACE_FRAGMENT",
    "SURFACE_VERTEX",
]

SURFACE_VERTEX = (
    RULINGS
    + WORLD
    + """
attribute vec2 place;     // fraction along t, fraction along the ruling
uniform float scalars;    // how many along a ruling; 0 for a plain surface
varying vec3 vRate;
varying vec3 vDirection;
varying vec3 vSeen;
varying vec2 vScalar;
varying float vValid;

vec2 scalar(float column, float index) {
  float cell = floor((index + 0.5) / 12.0);
  float inCell = index - 12.0 * cell;
  float number = floor((inCell + 0.5) / 3.0);
  vec4 mine = 1.0 - step(0.5, abs(vec4(0.0, 1.0, 2.0, 3.0) - number));
  float three = dot(texel(column, 6.0 + cell), mine);
  float place = inCell - 3.0 * number;
  float divisor = place < 0.5 ? 1.0 : (place < 1.5 ? 256.0 : 65536.0);
  float rest = floor(three / divisor);
  float byte = rest - 256.0 * floor(rest / 256.0);
  float known = step(0.5, byte);
  return vec2(known * (byte - 1.0) / 254.0, known);
}
vec2 scalarAt(float column, float fraction) {
  float index = fraction * (scalars - 1.0);
  float low = min(floor(index + 1e-4), max(scalars - 2.0, 0.0));
  return mix(scalar(column, low), scalar(column, min(low + 1.0, scalars - 1.0)), index - low);
}
void main() {
  float column = columnAt(place.x);
  vec4 base = texel(column, 0.0);
  vec4 direction = texel(column, 1.0);
  vec4 baseRate = texel(column, 2.0);
  vec4 directionRate = texel(column, 3.0);
  float w = mix(direction.a, baseRate.a, place.y);
  vec4 seen = toEye(base.xyz + w * direction.xyz);
  vRate = (modelViewMatrix * vec4(baseRate.xyz + w * directionRate.xyz, 0.0)).xyz;
  vDirection = (modelViewMatrix * vec4(direction.xyz, 0.0)).xyz;
  // where a surface covers itself twice, the front shows: its two sides would flicker otherwise
  vec3 normal = cross(vRate, vDirection);
  float facing = -dot(normal, seen.xyz) / max(length(normal) * length(seen.xyz), 1e-20);
  seen.xyz *= 1.0 - 0.0012 * clamp(10.0 * facing, 0.0, 1.0);
  vSeen = seen.xyz;
  vValid = base.a;
  vScalar = scalars > 0.5 ? scalarAt(column, place.y) : vec2(0.0);
  gl_Position = toClip(seen);
}
"""
)

SURFACE_FRAGMENT = """
uniform vec3 frontColour;
uniform vec3 backColour;
uniform vec3 missingColour;
uniform float scalars;
uniform float gloss;
uniform vec3 stop0;       // the colour map, evenly spaced
uniform vec3 stop1;
uniform vec3 stop2;
uniform vec3 stop3;
uniform vec3 stop4;
uniform vec3 stop5;
uniform vec3 stop6;
varying vec3 vRate;
varying vec3 vDirection;
varying vec3 vSeen;
varying vec2 vScalar;
varying float vValid;

vec3 scaled(vec2 scalar) {
  if (scalar.y < 0.5) return missingColour;
  float value = 6.0 * scalar.x / scalar.y;
  vec3 colour = mix(stop0, stop1, clamp(value, 0.0, 1.0));
  colour = mix(colour, stop2, clamp(value - 1.0, 0.0, 1.0));
  colour = mix(colour, stop3, clamp(value - 2.0, 0.0, 1.0));
  colour = mix(colour, stop4, clamp(value - 3.0, 0.0, 1.0));
  colour = mix(colour, stop5, clamp(value - 4.0, 0.0, 1.0));
  return mix(colour, stop6, clamp(value - 5.0, 0.0, 1.0));
}
void main() {
  if (vValid < 0.999) discard;
  vec3 normal = cross(vRate, vDirection);
  normal /= max(length(normal), 1e-20);
  vec3 view = normalize(-vSeen);
  float facing = dot(normal, view);
  float front = smoothstep(-0.03, 0.03, facing);
  normal *= facing < 0.0 ? -1.0 : 1.0;
  vec3 colour = mix(backColour, frontColour, front);
  if (scalars > 0.5) colour = scaled(vScalar) * mix(0.78, 1.0, front);
  vec3 key = normalize(vec3(-0.40, 0.62, 0.68));
  float wrapped = 0.5 + 0.5 * dot(normal, key);
  float shade = 0.50 + 0.56 * wrapped * wrapped + 0.10 * abs(facing);
  float shine = gloss * pow(max(dot(normal, normalize(key + view)), 0.0), 36.0);
  gl_FragColor = vec4(colour * shade + shine, 1.0);
}
"""

_LINE_VERTEX = """
attribute vec2 start;     // (fraction along t, fraction along the ruling) of either end
attribute vec2 finish;
attribute vec2 corner;
uniform vec2 width;       // half widths in pixels: with the casing, without it
uniform float cap;
varying float vAcross;
void main() {
  vec2 from = vec2(columnAt(start.x), start.y);
  vec2 to = vec2(columnAt(finish.x), finish.y);
  vec4 a = site(from);
  vec4 b = site(to);
  vAcross = corner.y * width.x;
  gl_Position = from == to || min(a.a, b.a) < 0.5 ? HIDDEN
      : worldRibbon(toEye(a.xyz), toEye(b.xyz), corner, width.x, cap);
}
"""

LATTICE_VERTEX = (
    RULINGS
    + WORLD
    + RIBBON
    + CLIPPED
    + """
vec4 site(vec2 place) {   // (column, fraction along the ruling)
  vec4 base = texel(place.x, 0.0);
  vec4 direction = texel(place.x, 1.0);
  float w = mix(direction.a, texel(place.x, 2.0).a, place.y);
  return vec4(base.xyz + w * direction.xyz, base.a);
}
"""
    + _LINE_VERTEX
)

STRICTION_VERTEX = (
    RULINGS
    + WORLD
    + RIBBON
    + CLIPPED
    + """
vec4 site(vec2 place) {
  return texel(place.x, 4.0);
}
"""
    + _LINE_VERTEX
)

LINE_FRAGMENT = """
uniform vec3 colour;
uniform vec3 casing;
uniform vec2 width;
uniform float strength;
varying float vAcross;
void main() {
  float edge = smoothstep(width.y - 0.5, width.y + 0.5, abs(vAcross));
  float rim = 1.0 - smoothstep(width.x - 1.0, width.x, abs(vAcross));
  gl_FragColor = vec4(mix(colour, casing, edge), strength * rim);
}
"""
