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

import itertools

ROWS = 6
MARKS = 6
BYTES = 12  # scalars in a texel
OVERLAY_COLUMNS = 40  # of the texture of an overlay
INK_PLACES = 4096  # places an end of a label's stroke can have, across and upwards
INK_START, INK_STEP = -64.0, 0.125  # the first place, the next one: pixels
DOT_KIND, STUB_KIND = 0, 1
LINE_KIND, HEAD_KIND, DISC_KIND, LABEL_KIND = 0, 1, 2, 3

_SCREEN = """
uniform vec2 viewport;    // pixels
const vec4 HIDDEN = vec4(2.0, 2.0, 2.0, 1.0);
"""

_RULINGS = (
    _SCREEN
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

_MARK = (
    _SCREEN
    + f"""
uniform highp sampler2D mark;

vec4 marked(float column) {{
  return texture2D(mark, vec2((column + 0.5) / {MARKS}.0, 0.5));
}}
"""
)

_WORLD = """
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

_RIBBON = """
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

_CLIPPED = """
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

_GLOBE = """
uniform vec3 globe;       // centre in clip space, radius in pixels
vec3 turned(vec3 direction) {
  return (viewMatrix * vec4(direction, 0.0)).xyz;
}
// the sphere has a thin slice of depth of its own, before everything else
vec4 onGlobe(vec3 seen) {
  return vec4(globe.xy + 2.0 * seen.xy * globe.z / viewport, -0.98 - 0.01 * seen.z, 1.0);
}
"""

SURFACE_VERTEX = (
    _RULINGS
    + _WORLD
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
    _RULINGS
    + _WORLD
    + _RIBBON
    + _CLIPPED
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
    _RULINGS
    + _WORLD
    + _RIBBON
    + _CLIPPED
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

MARK_VERTEX = (
    _MARK
    + _WORLD
    + _RIBBON
    + _CLIPPED
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

GLOBE_VERTEX = (
    _SCREEN
    + _GLOBE
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
    _RULINGS
    + _RIBBON
    + _GLOBE
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
    _RULINGS
    + _RIBBON
    + _GLOBE
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
    _MARK
    + _RIBBON
    + _GLOBE
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

_OVERLAY = (
    _SCREEN
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
    + _WORLD
    + _RIBBON
    + _CLIPPED
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
    + _WORLD
    + _RIBBON
    + _CLIPPED
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
    + _WORLD
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
    + _WORLD
    + _RIBBON
    + _CLIPPED
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
