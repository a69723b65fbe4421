"""What lessons draw into space: strokes, dots, sheets and labels."""

from __future__ import annotations

from .common import (
    CLIPPED,
    INK_PLACES,
    INK_START,
    INK_STEP,
    LINE_KIND,
    OVERLAY_COLUMNS,
    RIBBON,
    SCREEN,
    WORLD,
)

__all__ = [
    "DOTS_FRAGMENT",
    "DOTS_VERTEX",
    "LABELS_FRAGMENT",
    "LABELS_VERTEX",
    "SHEETS_FRAGMENT",
    "SHEETS_VERTEX",
    "STROKES_FRAGMENT",
    "STROKES_VERTEX",
]

_OVERLAY = (
    SCREEN
    + f"""
uniform highp sampler2D overlay;
float lines;              // of the texture; stands in its first texel

void open_() {{
  lines = texture2D(overlay, vec2(0.5 / {OVERLAY_COLUMNS}.0, 0.0)).x;
}}
vec4 item(float index) {{
  float line = floor((index + 0.5) / {OVERLAY_COLUMNS}.0);
  vec2 place = vec2(index - {OVERLAY_COLUMNS}.0 * line, line) + 0.5;
  return texture2D(overlay, place / vec2({OVERLAY_COLUMNS}.0, lines));
}}
vec3 inkOf(float code) {{
  float high = floor(code / 65536.0);
  float middle = floor((code - 65536.0 * high) / 256.0);
  return vec3(high, middle, code - 65536.0 * high - 256.0 * middle) / 255.0;
}}
"""
)

STROKES_VERTEX = (
    _OVERLAY
    + WORLD
    + RIBBON
    + CLIPPED
    + f"""
attribute vec2 part;      // number of the segment, or of the stroke whose arrow's head it is; kind
attribute vec2 corner;
uniform float period;     // of dashes, in space
uniform float rim;        // 1 with a casing, 0 without
varying vec3 vColour;
varying vec3 vAcross;     // pixels from the middle; half width without and with the casing
varying vec3 vDash;       // along, in periods; pixels in a period; 1 if dashed

float firstPoint;
float lengths;

float lengthAt(float point) {{
  float cell = floor((point + 0.5) / 4.0);
  vec4 mine = 1.0 - step(0.5, abs(vec4(0.0, 1.0, 2.0, 3.0) - (point - 4.0 * cell)));
  return dot(item(lengths + cell), mine);
}}
float pixelsBetween(vec4 a, vec4 b) {{
  return 0.5 * length((b.xy / b.w - a.xy / a.w) * viewport);
}}
float headPixels(float halfWidth) {{
  return 6.0 + 4.0 * halfWidth;
}}
// how much of a stroke its arrow's head takes, in space
float headLength(vec4 style) {{
  vec4 a = toEye(item(firstPoint + style.w - 1.0).xyz);
  vec4 b = toEye(item(firstPoint + style.w).xyz);
  if (max(a.z, b.z) > frontPlane()) return 0.0;
  float inSpace = distance(a.xyz, b.xyz);
  float onScreen = max(pixelsBetween(toClip(a), toClip(b)), 1e-3);
  return min(headPixels(style.y) * inSpace / onScreen, 0.8 * lengthAt(style.w));
}}
vec4 line(float number, float count, float styles) {{
  vec4 a = item(firstPoint + number);
  vec4 b = item(firstPoint + number + 1.0);
  if (number + 1.5 > count || a.a < 0.5 || a.a != b.a) return HIDDEN;
  vec4 style = item(styles + a.a - 1.0);
  float from = lengthAt(number);
  float to = lengthAt(number + 1.0);
  if (style.z > 1.5) {{
    float neck = lengthAt(style.w) - 0.85 * headLength(style);
    if (from >= neck) return HIDDEN;
    b.xyz = mix(a.xyz, b.xyz, min((neck - from) / max(to - from, 1e-20), 1.0));
    to = min(to, neck);
  }}
  vec4 start = toEye(a.xyz);
  vec4 finish = toEye(b.xyz);
  float front = frontPlane();
  float onScreen = pixelsBetween(toClip(before(start, finish, front)),
      toClip(before(finish, start, front)));
  float dashed = mod(style.z, 2.0) > 0.5 ? 1.0 : 0.0;
  float core = style.y;
  float full = core + rim * clamp(2.0 * core - 1.0, 0.0, 1.0);  // many thin lines stay lines
  vColour = inkOf(style.x);
  vAcross = vec3(corner.y * (full + 0.5), core, full);
  vDash = vec3(mix(from, to, corner.x) / period, onScreen * period / max(to - from, 1e-20), dashed);
  return worldRibbon(start, finish, corner, full + 0.5, (1.0 - dashed) * 0.7 * rim);
}}
vec4 head(float number, float styles) {{
  if (number + 0.5 > lengths - styles) return HIDDEN;
  vec4 style = item(styles + number);
  vec4 tip = item(firstPoint + style.w);
  vec4 tail = item(firstPoint + max(style.w - 1.0, 0.0));
  if (style.z < 1.5 || tip.a != number + 1.0 || tail.a != tip.a) return HIDDEN;
  float size = headLength(style);
  if (size <= 0.0) return HIDDEN;
  vec4 a = toClip(toEye(tip.xyz - size * normalize(tip.xyz - tail.xyz)));
  vec4 b = toClip(toEye(tip.xyz));
  float full = headPixels(style.y);
  float wide = 0.40 * full * clamp(2.0 * pixelsBetween(a, b) / full, 0.4, 1.0);
  vec2 way = heading(a, b);
  vColour = inkOf(style.x);
  vAcross = vec3(0.0, 1.0, 2.0);
  vDash = vec3(0.0);
  vec4 place = corner.x < 0.5 ? moved(a, wide * corner.y * vec2(-way.y, way.x)) : b;
  place.z -= 0.0004 * place.w;  // over its own line
  return place;
}}
void main() {{
  open_();
  vec4 header = item(0.0);
  firstPoint = header.y;
  lengths = item(1.0).x;
  vColour = vec3(0.0);
  vAcross = vec3(0.0);
  vDash = vec3(0.0);
  gl_Position = part.y < {LINE_KIND}.5 ? line(part.x, header.z, header.w) : head(part.x, header.w);
}}
"""
)

STROKES_FRAGMENT = """
uniform vec3 casing;
uniform float strength;
varying vec3 vColour;
varying vec3 vAcross;
varying vec3 vDash;

float dash() {
  float phase = fract(vDash.x);
  float away = min(abs(phase - 0.29), 1.29 - phase);
  float sharp = smoothstep(-0.5, 0.5, (0.29 - away) * vDash.y);
  return mix(1.0, mix(0.55, sharp, smoothstep(3.0, 6.0, vDash.y)), vDash.z);
}
void main() {
  float across = abs(vAcross.x);
  float seen = dash() * (1.0 - smoothstep(vAcross.z - 0.5, vAcross.z + 0.5, across));
  if (seen < 0.02) discard;
  float edge = smoothstep(vAcross.y - 0.5, vAcross.y + 0.5, across);
  edge *= step(vAcross.y + 0.01, vAcross.z);
  gl_FragColor = vec4(mix(vColour, casing, edge), strength * seen);
}
"""

DOTS_VERTEX = (
    _OVERLAY
    + WORLD
    + RIBBON
    + CLIPPED
    + """
attribute float number;
attribute vec2 corner;
varying vec3 vColour;
varying vec2 vCorner;     // pixels from the middle
varying vec2 vLook;       // radius, 1 if a ring
void main() {
  open_();
  vec4 header = item(1.0);
  vec4 point = item(header.y + 2.0 * number);
  vec4 look = item(header.y + 2.0 * number + 1.0);
  vec4 seen = toEye(point.xyz);
  vColour = inkOf(look.x);
  vLook = look.yz;
  vCorner = corner * (look.y + 2.0);
  gl_Position = number + 0.5 > header.z || point.a < 0.5 || seen.z > frontPlane() ? HIDDEN
      : moved(toClip(seen), vCorner);
}
"""
)

DOTS_FRAGMENT = """
uniform vec3 casing;
uniform float strength;
varying vec3 vColour;
varying vec2 vCorner;
varying vec2 vLook;
void main() {
  float away = length(vCorner);
  float rim = 1.2;
  float seen = 1.0 - smoothstep(vLook.x + rim - 0.5, vLook.x + rim + 0.5, away);
  float edge = smoothstep(vLook.x - 0.5, vLook.x + 0.5, away);
  if (vLook.y > 0.5) {
    float inner = vLook.x - max(1.8, 0.3 * vLook.x);
    edge = max(edge, 1.0 - smoothstep(inner - 0.5, inner + 0.5, away));
    seen *= smoothstep(inner - rim - 0.5, inner - rim + 0.5, away);
  }
  if (seen < 0.02) discard;
  gl_FragColor = vec4(mix(vColour, casing, edge), strength * seen);
}
"""

SHEETS_VERTEX = (
    _OVERLAY
    + WORLD
    + """
attribute float number;   // of the cell
attribute vec2 corner;    // of the cell: 0 or 1 along the rows, 0 or 1 along the columns
varying vec3 vColour;
varying vec3 vNormal;
varying vec3 vSeen;
varying float vOpacity;

float base;               // first point of the sheet
vec2 size;                // its columns and rows

vec4 grid(vec2 place) {
  vec2 inside = clamp(place, vec2(0.0), size - 1.0);
  return item(base + inside.y * size.x + inside.x);
}
vec3 slope(vec3 here, vec2 place, vec2 step_) {
  vec4 next = grid(place + step_);
  vec4 last = grid(place - step_);
  return (next.a == 0.0 ? here : next.xyz) - (last.a == 0.0 ? here : last.xyz);
}
void main() {
  open_();
  vec4 header = item(2.0);
  vec4 cell = item(header.x + number);
  vColour = vNormal = vSeen = vec3(0.0);
  vOpacity = 0.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (number + 0.5 > header.y || cell.a < 0.5) return;
  vec4 look = item(header.z + 2.0 * cell.a - 2.0);
  size = item(header.z + 2.0 * cell.a - 1.0).xy;
  base = header.x + look.z;
  float row = floor((number - look.z + 0.5) / size.x);
  vec2 place = vec2(number - look.z - row * size.x, row) + corner.yx;
  vec3 here = grid(place).xyz;
  vec3 normal = cross(slope(here, place, vec2(1.0, 0.0)), slope(here, place, vec2(0.0, 1.0)));
  vec4 seen = toEye(here);
  vColour = inkOf(look.x);
  vOpacity = look.y;
  vNormal = (modelViewMatrix * vec4(normal / max(length(normal), 1e-20), 0.0)).xyz;
  vSeen = seen.xyz;
  gl_Position = toClip(seen);
}
"""
)

SHEETS_FRAGMENT = """
varying vec3 vColour;
varying vec3 vNormal;
varying vec3 vSeen;
varying float vOpacity;
void main() {
  vec3 normal = vNormal / max(length(vNormal), 1e-20);
  vec3 view = normalize(-vSeen);
  normal *= dot(normal, view) < 0.0 ? -1.0 : 1.0;
  float facing = dot(normal, view);
  float light = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.40, 0.62, 0.68)));
  // a sheet seen edge on is denser, as glass is
  float slant = (1.0 - facing) * (1.0 - facing);
  float opacity = mix(vOpacity, min(1.0, 1.5 * vOpacity), slant);
  gl_FragColor = vec4(vColour * (0.82 + 0.22 * light), opacity);
}
"""

LABELS_VERTEX = (
    _OVERLAY
    + WORLD
    + RIBBON
    + CLIPPED
    + f"""
vec2 end(float code) {{
  float x = floor(code / {INK_PLACES}.0);
  return {INK_START} + {INK_STEP} * vec2(x, code - {INK_PLACES}.0 * x);
}}
"""
    + """
attribute vec2 part;      // number of the stroke; 0 for the halo, 1 for the letter
attribute vec2 corner;
varying vec3 vColour;
varying vec4 vPlace;      // pixels along and across the stroke; its length; halo or letter
const float MARGIN = 3.6;

void main() {
  open_();
  vec4 header = item(3.0);
  vec4 stroke = item(header.y + part.x);
  vec4 anchor = item(header.x + 2.0 * stroke.z);
  vec4 look = item(header.x + 2.0 * stroke.z + 1.0);
  vec4 seen = toEye(anchor.xyz);
  vec2 a = end(stroke.x);
  vec2 b = end(stroke.y);
  float size = length(b - a);
  vec2 way = size > 1e-3 ? (b - a) / size : vec2(1.0, 0.0);
  float along = corner.x < 0.5 ? -MARGIN : size + MARGIN;
  float across = MARGIN * corner.y;
  vColour = inkOf(look.x);
  vPlace = vec4(along, across, size, part.y);
  gl_Position = part.x + 0.5 > header.z || anchor.a < 0.5 || seen.z > frontPlane() ? HIDDEN
      : moved(toClip(seen), a + along * way + across * vec2(-way.y, way.x));
}
"""
)

LABELS_FRAGMENT = """
uniform vec3 casing;
varying vec3 vColour;
varying vec4 vPlace;
void main() {
  float away = length(vec2(vPlace.x - clamp(vPlace.x, 0.0, vPlace.z), vPlace.y));
  bool letter = vPlace.w > 0.5;
  float ends = letter ? 0.80 : 2.8;
  float seen = 1.0 - smoothstep(ends - 0.6, ends + 0.6, away);
  if (seen < 0.02) discard;
  gl_FragColor = vec4(letter ? vColour : casing, letter ? seen : 0.8 * seen);
}
"""
