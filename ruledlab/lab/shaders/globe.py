"""The unit sphere: the image of the rulings, the control points, the direction of the cursor."""

from __future__ import annotations

from .common import DOT_KIND, GLOBE, MARK, RIBBON, RULINGS, SCREEN

__all__ = [
    "CONTROLS_FRAGMENT",
    "CONTROLS_VERTEX",
    "GLOBE_FRAGMENT",
    "GLOBE_VERTEX",
    "IMAGE_FRAGMENT",
    "IMAGE_VERTEX",
    "NEEDLE_FRAGMENT",
    "NEEDLE_VERTEX",
]

GLOBE_VERTEX = (
    SCREEN
    + GLOBE
    + """
attribute vec2 corner;
varying vec2 vDisc;
void main() {
  vDisc = 1.06 * corner;
  gl_Position = vec4(globe.xy + 2.0 * vDisc * globe.z / viewport, -0.96, 1.0);
}
"""
)

GLOBE_FRAGMENT = """
uniform vec3 globe;
uniform vec3 fill;
uniform vec3 gridColour;
uniform vec3 ink;
varying vec2 vDisc;

vec3 unturned(vec3 seen) {
  return (vec4(seen, 0.0) * viewMatrix).xyz;
}
float stroke(float angle, float halfWidth) {
  float pixels = abs(angle) * globe.z;
  return 1.0 - smoothstep(halfWidth - 0.5, halfWidth + 0.7, pixels);
}
// meridians and parallels every 30 degrees, the equator and u = 0 a little stronger, the poles
vec2 net(vec3 seen) {
  vec3 at = unturned(seen);
  float away = length(at.xy);
  float longitude = atan(at.y, at.x);
  float latitude = atan(at.z, away);
  float step30 = 0.5235987756;
  float slant = max(abs(seen.z), 0.25);
  float u = (longitude - step30 * floor(longitude / step30 + 0.5)) * away;
  float v = latitude - step30 * floor(latitude / step30 + 0.5);
  float thin = max(stroke(u * slant, 0.3), stroke(v * slant, 0.3)) * smoothstep(0.03, 0.3, away);
  float zero = at.x > 0.0 ? stroke(at.y, 0.6) : 0.0;
  return vec2(max(0.55 * thin, max(zero, stroke(latitude * slant, 0.6))), stroke(away, 2.6));
}
void main() {
  float radius = length(vDisc);
  float inside = 1.0 - smoothstep(globe.z - 0.5, globe.z + 0.9, radius * globe.z);
  if (inside < 0.01) discard;
  float depth = sqrt(max(1.0 - radius * radius, 0.0));
  vec3 seen = vec3(vDisc, depth);
  vec2 front = net(seen);
  vec2 back = net(vec3(vDisc, -depth));
  float light = 0.5 + 0.5 * dot(seen, normalize(vec3(-0.40, 0.62, 0.68)));
  vec3 colour = fill * (0.86 + 0.14 * light);
  colour = mix(colour, gridColour, 0.28 * back.x);
  colour = mix(colour, ink, 0.20 * back.y);
  colour = mix(colour, gridColour, 0.85 * front.x);
  colour = mix(colour, ink, 0.85 * front.y);
  float rim = smoothstep(globe.z - 2.2, globe.z - 0.6, radius * globe.z);
  colour = mix(colour, gridColour, rim);
  gl_FragColor = vec4(colour, 0.93 * inside);
}
"""

IMAGE_VERTEX = (
    RULINGS
    + RIBBON
    + GLOBE
    + """
attribute vec2 start;
attribute vec2 finish;
attribute vec2 corner;
uniform vec2 width;
varying float vAcross;
varying float vNear;
void main() {
  float first = columnAt(start.x);
  float second = columnAt(finish.x);
  vec3 a = turned(texel(first, 1.0).xyz);
  vec3 b = turned(texel(second, 1.0).xyz);
  bool valid = first != second && min(dot(a, a), dot(b, b)) > 0.25;
  vAcross = corner.y * width.x;
  vNear = corner.x < 0.5 ? a.z : b.z;
  gl_Position = valid ? ribbon(onGlobe(a), onGlobe(b), corner, width.x, 0.6) : HIDDEN;
}
"""
)

IMAGE_FRAGMENT = """
uniform vec3 colour;
uniform vec3 fill;
uniform vec2 width;
varying float vAcross;
varying float vNear;
void main() {
  float rim = 1.0 - smoothstep(width.x - 1.0, width.x, abs(vAcross));
  float dim = 0.66 * (1.0 - smoothstep(-0.06, 0.06, vNear));
  gl_FragColor = vec4(mix(colour, fill, dim), rim);
}
"""

CONTROLS_VERTEX = (
    RULINGS
    + RIBBON
    + GLOBE
    + """
attribute float number;   // of the control point
attribute vec2 corner;
uniform float chosen;
varying vec2 vCorner;
varying vec3 vLook;       // radius in pixels, chosen, depth
void main() {
  float column = min(number, extent.x - 1.0);
  vec4 point = texel(column, 5.0);
  vec3 seen = turned(point.xyz);
  float mine = 1.0 - step(0.5, abs(number - chosen));
  vCorner = corner;
  vLook = vec3(mix(4.2, 7.5, mine), mine, seen.z);
  gl_Position = point.a < 0.5 || column < number ? HIDDEN
      : moved(onGlobe(seen), vLook.x * corner);
}
"""
)

CONTROLS_FRAGMENT = """
uniform vec3 fill;
uniform vec3 casing;
uniform vec3 ink;
uniform vec3 chosenColour;
varying vec2 vCorner;
varying vec3 vLook;

vec3 coloured(float pixels) {
  if (vLook.y < 0.5) return mix(ink, casing, smoothstep(2.6, 3.4, pixels));
  float ring = smoothstep(4.4, 5.0, pixels) * (1.0 - smoothstep(6.4, 7.0, pixels));
  return mix(mix(chosenColour, casing, smoothstep(3.6, 4.2, pixels)), chosenColour, ring);
}
void main() {
  float pixels = length(vCorner) * vLook.x;
  float inside = 1.0 - smoothstep(vLook.x - 0.9, vLook.x, pixels);
  if (inside < 0.02) discard;
  float dim = 0.62 * (1.0 - smoothstep(-0.06, 0.06, vLook.z));
  gl_FragColor = vec4(mix(coloured(pixels), fill, dim), inside);
}
"""

NEEDLE_VERTEX = (
    MARK
    + RIBBON
    + GLOBE
    + f"""
attribute vec2 part;      // kind, not used
attribute vec2 corner;
varying vec2 vCorner;
varying vec2 vLook;       // kind, depth
void main() {{
  vec4 direction = marked(1.0);
  vec3 seen = turned(direction.xyz);
  vCorner = corner;
  vLook = vec2(part.x, seen.z);
  if (direction.a < 0.5) gl_Position = HIDDEN;
  else if (part.x < {DOT_KIND}.5) gl_Position = moved(onGlobe(seen), 5.0 * corner);
  else gl_Position = ribbon(onGlobe(seen), onGlobe(1.3 * seen), corner, 1.6, 0.0);
}}
"""
)

NEEDLE_FRAGMENT = f"""
uniform vec3 fill;
uniform vec3 casing;
uniform vec3 cursorColour;
varying vec2 vCorner;
varying vec2 vLook;
void main() {{
  float dim = 0.62 * (1.0 - smoothstep(-0.06, 0.06, vLook.y));
  bool dot_ = vLook.x < {DOT_KIND}.5;
  float pixels = dot_ ? 5.0 * length(vCorner) : 0.0;
  float inside = 1.0 - smoothstep(4.1, 5.0, pixels);
  if (inside < 0.02) discard;
  vec3 colour = mix(cursorColour, casing, smoothstep(3.3, 4.1, pixels));
  gl_FragColor = vec4(mix(colour, fill, dim), inside);
}}
"""
