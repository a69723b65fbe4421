// The domain pad: the (u, v) chart of the unit sphere.
//
// This file moves handles and draws what it is sent. It computes no curve and no invariant; the only
// geometry in it is that of the drawing: pixels to radians and back, and which leg a click is near.
//
// A request carries a growing number `seq`, a picture says the last `seq` of this view it has seen.
// Until then a point that the reader moved is "held": drawn where the reader put it.

const SVG = "http://www.w3.org/2000/svg";
const PI = Math.PI;
const TURN = 2 * PI;
const REACH = { mouse: 14, pen: 18, touch: 24 }; // px from a handle's centre
const SLACK = 5; // px a pointer may wander and still be a click
const MARGIN = { left: 47, right: 13, top: 9, bottom: 46 };
const PAUSE = 600; // ms without a key press that end a run of arrow keys

// ---- elements --------------------------------------------------------------------------------

function element(space, name, attributes = {}, ...children) {
  const made = space ? document.createElementNS(space, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}
// Writes only what differs: an attribute set again costs the browser a restyle all the same.
function set(node, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    const text = String(value);
    if (node.getAttribute(key) !== text) node.setAttribute(key, text);
  }
}

const svg = (...parts) => element(SVG, ...parts);
const html = (...parts) => element(null, ...parts);

const listen = (target, names, handler, options) => {
  for (const name of names.split(" ")) target.addEventListener(name, handler, options);
  return () => {
    for (const name of names.split(" ")) target.removeEventListener(name, handler, options);
  };
};

const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
const plain = (x) => x.toFixed(3).replace("-", "−");

// Bytes that came as a DataView, copied because a typed array needs aligned memory.
const numbers = (Kind, view) =>
  view ? new Kind(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength)) : new Kind();

// ---- the extent of the chart -----------------------------------------------------------------

function boxOf(...lists) {
  const box = { u0: Infinity, u1: -Infinity, v0: Infinity, v1: -Infinity };
  for (const list of lists) {
    for (let i = 0; i + 1 < list.length; i += 2) {
      const u = list[i],
        v = list[i + 1];
      if (!Number.isFinite(u) || !Number.isFinite(v)) continue;
      box.u0 = Math.min(box.u0, u);
      box.u1 = Math.max(box.u1, u);
      box.v0 = Math.min(box.v0, v);
      box.v1 = Math.max(box.v1, v);
    }
  }
  return box.u0 <= box.u1 ? box : { u0: 0, u1: TURN, v0: 0, v1: PI };
}

const inside = (box, view, slack) =>
  box.u0 >= view.u0 + slack * (view.u1 - view.u0) &&
  box.u1 <= view.u1 - slack * (view.u1 - view.u0) &&
  box.v0 >= view.v0 + slack * (view.v1 - view.v0) &&
  box.v1 <= view.v1 - slack * (view.v1 - view.v0);

// Where the sheet of the chart begins that holds the box: 0 or −π, else 0 and more than one sheet.
const sheetOf = (box) =>
  (box.u0 < -1e-9 || box.u1 > TURN + 1e-9) && box.u0 >= -PI - 1e-9 && box.u1 <= PI + 1e-9 ? -PI : 0;

// Room beyond a pole for its name, in radians, where `span` radians get the rest of the height.
const BAND = 19; // px
const beyond = (span, height) => (BAND * span) / (height - 2 * BAND);

function wholeChart(box, width, height) {
  const sheet = sheetOf(box),
    band = beyond(PI, height);
  const u0 = Math.min(sheet, Math.floor(box.u0 / (PI / 2) + 1e-9) * (PI / 2));
  const u1 = Math.max(sheet + TURN, Math.ceil(box.u1 / (PI / 2) - 1e-9) * (PI / 2));
  const edge = 0.03 * (u1 - u0);
  return {
    u0: u0 - edge,
    u1: u1 + edge,
    v0: Math.min(-band, box.v0 - 0.1),
    v1: Math.max(PI + band, box.v1 + 0.1),
    sheet,
  };
}

// The points with a margin, a pole where it is not far, and scales that differ at most twofold.
function fitted(box, width, height) {
  const tall = Math.max(box.v1 - box.v0, 0.4),
    wide = Math.max(box.u1 - box.u0, 0.4);
  const side = Math.min(0.14 * wide, 0.4);
  let [u0, u1] = [box.u0 - side, box.u1 + side];
  let [v0, v1] = [box.v0 - 0.2 * tall, box.v1 + 0.2 * tall];
  if (box.v0 < 0.75 * tall) v0 = Math.min(0, v0);
  if (PI - box.v1 < 0.75 * tall) v1 = Math.max(PI, v1);
  const perU = width / (u1 - u0),
    perV = height / (v1 - v0);
  if (perU > 2 * perV) [u0, u1] = widened(u0, u1, perU / (2 * perV));
  if (perV > 2 * perU) [v0, v1] = widened(v0, v1, perV / (2 * perU));
  [v0, v1] = kept(v0, v1, box, height);
  return { u0, u1, v0, v1, sheet: sheetOf(box) };
}

const widened = (low, high, factor) => {
  const half = (factor * (high - low)) / 2,
    middle = (low + high) / 2;
  return [middle - half, middle + half];
};

// A range of v that ends just beyond a pole it reaches, unless points lie further out; what is cut
// off at one side is given to the other.
function kept(v0, v1, box, height) {
  const span = Math.min(v1 - v0, PI),
    band = beyond(span, height);
  const top = Math.min(-band, box.v0 - 0.2),
    bottom = Math.max(PI + band, box.v1 + 0.2);
  const atTop = v0 <= 0,
    atBottom = v1 >= PI;
  if (atTop && atBottom) return [box.v0 < 0 ? top : -band, box.v1 > PI ? bottom : PI + band];
  if (atTop) return [box.v0 < 0 ? top : -band, Math.min(bottom, Math.max(v1, span))];
  if (atBottom) return [Math.max(top, Math.min(v0, PI - span)), box.v1 > PI ? bottom : PI + band];
  return [v0, v1];
}

// ---- ticks -----------------------------------------------------------------------------------

const STEPS = [1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16];

function ticks(low, high, pixels, least) {
  const wide = (step) => ((step * PI) / (high - low)) * pixels;
  const step = STEPS.find((s) => wide(s) >= (s < 1 / 4 ? 2.7 * least : least)) ?? 32;
  const list = [];
  for (let k = Math.ceil(low / (step * PI)); k * step * PI <= high; k++) list.push(k * step);
  return list; // in units of π
}

function asFraction(multiple) {
  let denominator = 1;
  while (denominator < 32 && !Number.isInteger(multiple * denominator)) denominator *= 2;
  const n = Math.abs(Math.round(multiple * denominator));
  const top = n === 0 ? "0" : n === 1 ? "π" : `${n}π`;
  return { minus: multiple < 0, top, bottom: denominator === 1 ? "" : `${denominator}` };
}

// A typeset multiple of π; (x, y) is the middle of its left, middle or right side.
function tickLabel(multiple, x, y, side) {
  const { minus, top, bottom } = asFraction(multiple);
  const width = 6.2 * Math.max(top.length, bottom.length) + (minus ? 8 : 0);
  const left = side === "end" ? x - width : x - width / 2;
  const middle = left + (minus ? 8 : 0) + (width - (minus ? 8 : 0)) / 2;
  const label = svg("g", { class: "rl-tick" });
  const write = (text, tx, ty) => label.append(svg("text", { x: tx, y: ty }, text));
  if (minus) write("−", left + 3, y + 4);
  if (!bottom) write(top, middle, y + 4);
  else {
    const half = 3.1 * Math.max(top.length, bottom.length) + 1;
    write(top, middle, y - 3.5);
    write(bottom, middle, y + 11);
    label.append(svg("path", { d: `M${middle - half} ${y + 0.5}h${2 * half}` }));
  }
  return label;
}

// ---- one view --------------------------------------------------------------------------------

const ICONS = {
  add: "M8 3v10M3 8h10",
  remove: "M3 8h10",
  fit: "M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3M6 6h4v4h-4z",
  whole: "M8 2a6 6 0 100 12a6 6 0 100-12zM2 8h12M8 2c-3.6 3.6-3.6 8.4 0 12M8 2c3.6 3.6 3.6 8.4 0 12",
};

const HELP =
  "Arrow keys move the chosen control point, with Shift ten times as far, with Alt a tenth as far. " +
  "Page Up and Page Down, or the square brackets, choose another point. " +
  "Plus or Insert adds a point after the chosen one, Delete removes it. " +
  "A click on an empty place adds a point there.";
const LOOKS = " Dragging across an empty place moves the ring, the place that is looked at.";

const BUTTONS = [
  ["add", "Add a point after the chosen one (+)"],
  ["remove", "Remove the chosen point (Delete)"],
  ["fit", "Fit the view to the points"],
  ["whole", "Show the whole chart"],
];

class View {
  constructor(model, el) {
    Object.assign(this, {
      model,
      el,
      id: Math.random().toString(36).slice(2, 10),
      seq: 0,
      drags: 0,
      hold: new Map(),
      choice: -1,
      chosen: 0,
      closing: "open",
      sent: new Float64Array(),
      points: new Float64Array(),
      curve: new Float32Array(),
      mode: "fit",
      extent: null,
      drag: null,
      run: null,
      press: null,
      gaze: null,
      held: null,
      signs: { places: new Float32Array(), signs: [], colours: [], which: [], shades: [], tile: [1, 1] },
      handles: [],
      size: null,
      frame: 0,
      spoken: "",
      lastAdd: 0,
      followFocus: false,
      fresh: true,
      stops: [],
    });
    this.build();
    this.connect();
    this.paint();
    this.receiveSigns();
    this.receive();
    this.offerLooks();
    this.showCursor();
  }

  // -- building --

  build() {
    const clip = `rl-clip-${this.id}`,
      hatch = `rl-hatch-${this.id}`,
      help = `rl-help-${this.id}`,
      said = `rl-said-${this.id}`;
    const layer = (name, more = {}) => (this[name] = svg("g", { class: `rl-${name}`, ...more }));
    const path = (name) => (this[name] = svg("path", { class: `rl-${name}` }));
    this.hatchUrl = `url(#${hatch})`;
    this.clip = svg("rect");
    this.stage = svg(
      "svg",
      {
        class: "rl-stage",
        role: "application",
        "aria-roledescription": "chart",
        "aria-label": "Chart of the unit sphere with control points",
        "aria-describedby": `${said} ${help}`,
      },
      svg(
        "defs",
        {},
        svg("clipPath", { id: clip }, this.clip),
        svg(
          "pattern",
          { id: hatch, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
          svg("path", { class: "rl-hatch", d: "M0 0v6" }),
        ),
      ),
      layer("axes", { "aria-hidden": "true" }),
      svg(
        "g",
        { "clip-path": `url(#${clip})`, "aria-hidden": "true" },
        (this.signsLayer = svg("g", { class: "rl-signs" })),
        path("seam"),
        path("polygon"),
        path("ticked"),
        path("line"),
        this.makeCursor(),
        this.makeRing(),
      ),
      layer("knobs"),
    );
    this.readout = html("div", { class: "rl-readout", "aria-hidden": "true" });
    this.buttons = Object.fromEntries(BUTTONS.map(([name, title]) => [name, this.makeButton(name, title)]));
    this.words = html("div", { class: "rl-hidden rl-said", id: said });
    this.looking = html("span");
    this.live = html("div", { class: "rl-hidden", "aria-live": "polite", role: "status" });
    this.root = html(
      "div",
      {
        class: "rl-pad",
        role: "group",
        "aria-label": "Domain pad",
      },
      html("div", { class: "rl-bar" }, this.readout, ...Object.values(this.buttons)),
      this.stage,
      this.live,
      this.words,
      html("div", { class: "rl-hidden", id: help }, HELP, this.looking),
    );
    this.el.append(this.root);
  }

  makeButton(name, title) {
    const icon = svg("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, svg("path", { d: ICONS[name] }));
    const button = html(
      "button",
      { type: "button", class: `rl-button rl-${name}`, title, "aria-label": title },
      icon,
    );
    const act = {
      add: () => this.addAfter(),
      remove: () => this.remove(),
      fit: () => this.setMode("fit"),
      whole: () => this.setMode("whole"),
    };
    this.stops.push(listen(button, "click", act[name]));
    return button;
  }

  makeCursor() {
    this.dot = svg(
      "g",
      { class: "rl-cursor", visibility: "hidden" },
      svg("circle", { class: "rl-halo", r: 7.5 }),
      svg("circle", { r: 6 }),
      svg("circle", { class: "rl-core", r: 2.6 }),
    );
    return this.dot;
  }

  makeRing() {
    this.ring = svg(
      "g",
      { class: "rl-place", visibility: "hidden" },
      svg("circle", { class: "rl-halo", r: 8 }),
      svg("circle", { r: 8 }),
      svg("path", { d: "M-13 0h5M8 0h5M0-13v5M0 8v5" }),
    );
    return this.ring;
  }

  makeHandle(index) {
    const g = svg(
      "g",
      { class: "rl-handle", role: "button", tabindex: -1, "aria-roledescription": "movable point" },
      svg("circle", { class: "rl-hit", r: REACH.touch }),
      svg("circle", { class: "rl-focus", r: 15 }),
      svg("circle", { class: "rl-joint", r: 9 }),
      svg("circle", { class: "rl-ring", r: 10.5 }),
      svg("circle", { class: "rl-disc", r: 5 }),
      svg("path", { class: "rl-diamond", d: "M0-6.8L6.8 0L0 6.8L-6.8 0Z" }),
      svg("text", { class: "rl-number" }),
    );
    g.dataset.index = index;
    this.knobs.append(g);
    return g;
  }

  connect() {
    const { model, stage, root, stops } = this;
    const on = (name, handler) => {
      model.on(name, handler);
      stops.push(() => model.off(name, handler));
    };
    on("change:picture", () => this.receive());
    on("change:cursor", () => this.showCursor());
    on("change:ring", () => this.showCursor());
    on("change:signs", () => this.receiveSigns());
    on("change:looks", () => this.offerLooks());
    on("change:colours", () => this.paint());
    on("change:aspect", () => this.resize());
    on("change:min_height", () => this.resize());
    stops.push(
      listen(stage, "pointerdown", (e) => this.onDown(e)),
      listen(stage, "pointermove", (e) => this.onMove(e)),
      listen(stage, "pointerup", (e) => this.onUp(e)),
      listen(stage, "pointercancel lostpointercapture", (e) => this.onLost(e)),
      // Says no to scrolling where `touch-action` is not heeded inside an SVG; pointerdown came first.
      listen(stage, "touchstart", (e) => this.isTaken() && e.cancelable && e.preventDefault(), {
        passive: false,
      }),
      listen(stage, "pointerleave", () => this.hover(-1)),
      listen(root, "keydown", (e) => this.onKey(e)),
      listen(root, "keyup keypress", (e) => this.isOurs(e) && e.stopPropagation()),
      listen(stage, "focusin", (e) => this.onFocus(e)),
      listen(stage, "focusout", () => this.endRun()),
      this.watchSize(),
      () => {
        this.dropRun();
        this.finishTravel(false);
        clearTimeout(this.speech);
      },
    );
  }

  watchSize() {
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(this.root);
    return () => observer.disconnect();
  }

  destroy() {
    for (const stop of this.stops.splice(0)) stop();
    this.root.remove();
  }

  // -- what Python sends --

  receive() {
    const picture = this.model.get("picture") ?? {};
    const sent = numbers(Float64Array, picture.points);
    if (sent.length !== this.sent.length) this.letGo();
    const grown = sent.length - this.sent.length;
    this.sent = sent;
    this.curve = numbers(Float32Array, picture.curve);
    this.closing = picture.closing ?? "open";
    const seen = picture.seen?.[this.id] ?? -1;
    for (const [index, held] of this.hold) {
      if (seen >= held.seq && !this.isMoving(index)) this.hold.delete(index);
    }
    if (seen >= this.choice) this.chosen = picture.chosen ?? 0;
    if (seen >= this.held?.seq && !this.gaze) this.held = null;
    this.merge();
    if (grown && this.size)
      this.say(
        `${grown > 0 ? "Added" : "Removed"}; ${this.count} control points. ${this.describe(this.chosen)}`,
      );
    const follow = this.followFocus || this.hasFocus();
    this.redraw();
    if (follow && !this.drag) this.handles[this.chosen]?.focus({ preventScroll: true });
    this.followFocus = false;
    this.settle();
  }

  receiveSigns() {
    const sent = this.model.get("signs") ?? {};
    this.signs = {
      places: numbers(Float32Array, sent.places),
      signs: [...(sent.signs ?? "")],
      colours: sent.colours ?? [],
      which: numbers(Uint8Array, sent.which),
      shades: numbers(Uint8Array, sent.shades),
      tile: sent.tile ?? [1, 1],
    };
    this.words.textContent = sent.words ?? "";
    this.signsKey = null;
    this.drawSigns();
    this.settle();
  }

  offerLooks() {
    this.looking.textContent = this.model.get("looks") ? LOOKS : "";
  }

  hasFocus() {
    return this.knobs.contains(this.root.getRootNode().activeElement);
  }

  get count() {
    return this.sent.length / 2;
  }

  merge() {
    this.points = this.sent.slice();
    for (const [index, { u, v }] of this.hold) {
      this.points[2 * index] = u;
      this.points[2 * index + 1] = v;
    }
    this.chosen = this.canonical(clamp(this.chosen, 0, Math.max(0, this.count - 1)));
  }

  letGo() {
    if (this.drag) this.finishDrag(false);
    this.dropRun();
    this.hold.clear();
  }

  isMoving(index) {
    const at = this.drag?.index ?? this.run?.index;
    return at !== undefined && (index === at || index === this.twin(at));
  }

  // -- the seam: which points are one --

  // How many turns the last point is from the first, or null where they are not tied.
  turns() {
    const n = this.count - 1,
      p = this.sent;
    if (this.closing === "open" || n < 2) return null;
    const turns = Math.round((p[2 * n] - p[0]) / TURN);
    const near = Math.abs(p[2 * n] - p[0] - turns * TURN) < 1e-6 && Math.abs(p[2 * n + 1] - p[1]) < 1e-6;
    return near ? turns : null;
  }

  // The other end of the joint; first and last move as one.
  twin(index) {
    if (this.turns() === null) return -1;
    return index === 0 ? this.count - 1 : index === this.count - 1 ? 0 : -1;
  }

  // First and last drawn at one place are one handle, the first.
  canonical(index) {
    return index > 0 && index === this.count - 1 && this.turns() === 0 ? 0 : index;
  }

  // -- requests --

  request(kind, index, u, v, drag = 0) {
    const seq = ++this.seq;
    this.model.send({ kind, view: this.id, seq, drag, index, u, v });
    return seq;
  }

  // Puts a point somewhere at once, and asks for it.
  put(index, u, v, drag) {
    const seq = ++this.seq;
    this.keep(index, u, v, seq);
    this.model.set("motion", [this.id, seq, drag, index, u, v]);
    this.model.save_changes();
    this.merge();
    this.drawShape();
    this.drawHandles();
  }

  keep(index, u, v, seq) {
    this.hold.set(index, { u, v, seq });
    const twin = this.twin(index);
    if (twin < 0) return;
    const turn = this.turns() * TURN;
    this.hold.set(twin, { u: twin === 0 ? u - turn : u + turn, v, seq });
  }

  // The last word of a drag: it goes as a message of its own and takes the exact place along.
  end(index, drag) {
    const [u, v] = this.at(index);
    this.keep(index, u, v, this.request("end", index, u, v, drag));
    this.say(this.describe(index));
  }

  at(index) {
    return [this.points[2 * index], this.points[2 * index + 1]];
  }

  askToChoose(index, drag = 0) {
    this.choice = this.request("choose", index, ...this.at(index), drag);
    this.choose(index);
  }

  choose(index) {
    this.chosen = this.canonical(clamp(index, 0, Math.max(0, this.count - 1)));
    this.drawHandles();
  }

  add(index, u, v) {
    this.request("add", index, u, v);
  }

  addAfter() {
    if (this.count < 2) return;
    this.endRun();
    const i = Math.min(this.chosen, this.count - 2),
      [u, v] = this.at(i),
      [u2, v2] = this.at(i + 1);
    this.add(i + 1, (u + u2) / 2, (v + v2) / 2);
  }

  remove() {
    if (this.count <= 2) return this.say("Two control points are the least.");
    this.endRun();
    this.request("remove", this.chosen, ...this.at(this.chosen));
  }

  // -- pointer --

  place(event) {
    const box = this.stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  nearest(x, y, reach) {
    let best = -1,
      least = reach * reach;
    for (const g of this.handles) {
      const i = Number(g.dataset.index);
      if (this.canonical(i) !== i) continue;
      const [px, py] = this.toPixel(...this.at(i));
      const far = (px - x) ** 2 + (py - y) ** 2 - (i === this.chosen ? 1 : 0);
      if (far < least) [best, least] = [i, far];
    }
    return best;
  }

  onDown(event) {
    if (event.button !== 0 || this.drag || this.gaze || !this.extent || !this.count) return;
    const [x, y] = this.place(event),
      reach = REACH[event.pointerType] ?? REACH.mouse;
    const index = this.nearest(x, y, reach);
    this.endRun();
    if (index < 0) {
      // A finger that begins elsewhere than at the ring scrolls the page.
      const looks = this.model.get("looks") && (event.pointerType !== "touch" || this.atRing(x, y, reach));
      this.press = this.inFrame(x, y) ? { pointer: event.pointerId, x, y, looks } : null;
      return;
    }
    event.preventDefault();
    this.startDrag(event, index, x, y);
  }

  startDrag(event, index, x, y) {
    this.finishTravel();
    this.stage.setPointerCapture(event.pointerId);
    const [px, py] = this.toPixel(...this.at(index));
    this.drag = {
      pointer: event.pointerId,
      index,
      number: ++this.drags,
      dx: px - x,
      dy: py - y,
      x,
      y,
      moved: false,
      from: this.at(index),
    };
    this.root.classList.add("rl-dragging");
    this.askToChoose(index, this.drag.number);
    this.handles[index].focus({ preventScroll: true });
  }

  onMove(event) {
    const { drag, press } = this,
      [x, y] = this.place(event);
    if (this.gaze?.pointer === event.pointerId) return this.look(x, y);
    if (press?.looks && press.pointer === event.pointerId && Math.hypot(x - press.x, y - press.y) > SLACK)
      return this.startLook(event, x, y);
    if (drag?.pointer !== event.pointerId) {
      if (!drag && this.extent && event.pointerType !== "touch")
        this.hover(this.nearest(x, y, REACH.mouse), this.inFrame(x, y), this.atRing(x, y, REACH.mouse));
      return;
    }
    if (!drag.moved && Math.hypot(x - drag.x, y - drag.y) < 1) return;
    drag.moved = true;
    this.put(drag.index, ...this.toChart(x + drag.dx, y + drag.dy), drag.number);
  }

  onUp(event) {
    if (this.drag?.pointer === event.pointerId) return this.finishDrag(true);
    if (this.gaze?.pointer === event.pointerId) return this.finishLook();
    const { press } = this,
      [x, y] = this.place(event);
    this.press = null;
    if (press?.pointer !== event.pointerId || Math.hypot(x - press.x, y - press.y) > SLACK) return;
    if (event.timeStamp - this.lastAdd < 350) return; // the second half of a double click
    this.lastAdd = event.timeStamp;
    this.followFocus = true;
    this.add(this.slot(x, y), ...this.toChart(x, y));
  }

  onLost(event) {
    if (this.press?.pointer === event.pointerId) this.press = null;
    if (this.drag?.pointer === event.pointerId) this.finishDrag(true);
    // A finger's first element loses it to the stage when a look begins; that is no end.
    if (this.gaze?.pointer === event.pointerId && !this.stage.hasPointerCapture(event.pointerId))
      this.finishLook();
  }

  finishDrag(report) {
    const { drag } = this;
    this.drag = null;
    this.root.classList.remove("rl-dragging");
    if (this.stage.hasPointerCapture(drag.pointer)) this.stage.releasePointerCapture(drag.pointer);
    if (!report || !drag.moved) return;
    this.end(drag.index, drag.number);
    this.settle();
  }

  cancelDrag() {
    const { drag } = this;
    if (drag.moved) this.put(drag.index, ...drag.from, drag.number);
    this.finishDrag(true);
  }

  // -- looks: a drag across the empty chart takes the ring along --

  isTaken() {
    return this.drag || this.gaze || this.press?.looks;
  }

  // The place that is looked at: off the curve the ring's, else the cursor's.
  eye() {
    if (this.held) return [this.held.u, this.held.v];
    const ring = this.model.get("ring") ?? [];
    return ring.length === 2 ? ring : (this.model.get("cursor") ?? []);
  }

  atRing(x, y, reach) {
    const at = this.eye();
    if (!this.model.get("looks") || at.length !== 2) return false;
    const [px, py] = this.toPixel(...at);
    return Math.hypot(px - x, py - y) <= reach;
  }

  startLook(event, x, y) {
    this.press = null;
    this.gaze = { pointer: event.pointerId };
    this.stage.setPointerCapture(event.pointerId);
    this.root.classList.add("rl-dragging");
    this.look(x, y);
  }

  look(x, y) {
    const [u, v] = this.toChart(x, y),
      seq = ++this.seq;
    this.held = { u, v, seq };
    this.model.set("glance", [this.id, seq, u, v]);
    this.model.save_changes();
    this.showCursor();
  }

  // As at the end of a drag: the last place goes as a message of its own, which none can overtake.
  finishLook() {
    const { pointer } = this.gaze,
      { u, v } = this.held;
    this.gaze = null;
    this.root.classList.remove("rl-dragging");
    if (this.stage.hasPointerCapture(pointer)) this.stage.releasePointerCapture(pointer);
    this.held.seq = this.request("look", 0, u, v);
    this.say(`Looking at u = ${plain(u)}, v = ${plain(v)}`);
  }

  inFrame(x, y) {
    const { left, top, width, height } = this.size;
    return x >= left && x <= left + width && y >= top && y <= top + height;
  }

  hover(index, adds = false, looks = false) {
    this.stage.style.cursor = index >= 0 || (adds && looks) ? "grab" : adds ? "copy" : "";
    for (const g of this.handles) g.classList.toggle("rl-hover", Number(g.dataset.index) === index);
  }

  // Where in the polygon a new point belongs: in the nearest leg, or beyond an open end.
  slot(x, y) {
    let best = this.count,
      least = Infinity;
    for (let i = 0; i + 1 < this.count; i++) {
      const [ax, ay] = this.toPixel(...this.at(i)),
        [bx, by] = this.toPixel(...this.at(i + 1));
      const length = (bx - ax) ** 2 + (by - ay) ** 2;
      const along = length ? ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length : 0.5;
      const s = clamp(along, 0, 1);
      const far = (ax + s * (bx - ax) - x) ** 2 + (ay + s * (by - ay) - y) ** 2;
      if (far >= least) continue;
      least = far;
      const open = this.turns() === null;
      best =
        open && i === 0 && along < 0 ? 0 : open && i + 2 === this.count && along > 1 ? this.count : i + 1;
    }
    return best;
  }

  // -- keys --

  isOurs(event) {
    return !event.ctrlKey && !event.metaKey;
  }

  onKey(event) {
    if (!this.isOurs(event)) return;
    event.stopPropagation();
    if (!this.stage.contains(event.target)) return; // the buttons keep their own keys
    if (this.drag) {
      if (event.key === "Escape") this.cancelDrag();
      if (event.key !== "Tab") event.preventDefault();
      return;
    }
    if (this.key(event)) event.preventDefault();
  }

  key(event) {
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (arrow) return this.nudge(arrow, event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    const step = { PageUp: -1, "[": -1, PageDown: 1, "]": 1 }[event.key];
    if (step) return this.walk(step);
    if (event.key === "Home" || event.key === "End")
      return this.walkTo(event.key === "Home" ? 0 : this.count - 1);
    if (event.key === "Delete" || event.key === "Backspace") {
      this.remove();
      return true;
    }
    if (event.key === "+" || event.key === "Insert") {
      this.addAfter();
      return true;
    }
    return false;
  }

  // One press is 0.01 radian on the whole chart, less where the view is nearer, in round numbers.
  step() {
    const near = (this.extent.v1 - this.extent.v0) / PI;
    return 0.01 * ([1, 0.5, 0.2, 0.1, 0.05].find((s) => near >= 0.9 * s) ?? 0.02);
  }

  nudge([du, dv], times) {
    if (!this.count || !this.extent) return true;
    const index = this.chosen,
      step = this.step() * times,
      [u, v] = this.at(index);
    if (this.run?.index !== index) {
      this.endRun();
      this.run = { index, number: ++this.drags };
    }
    clearTimeout(this.run.timer);
    this.run.timer = setTimeout(() => this.endRun(), PAUSE);
    const round = (x) => Math.round(x * 1e12) / 1e12;
    this.put(index, round(u + du * step), round(v + dv * step), this.run.number);
    return true;
  }

  dropRun() {
    clearTimeout(this.run?.timer);
    this.run = null;
  }

  endRun() {
    const { run } = this;
    if (!run) return;
    this.dropRun();
    this.end(run.index, run.number);
    this.settle();
  }

  walk(step) {
    const last = this.count - (this.turns() === 0 ? 2 : 1);
    return this.walkTo((this.chosen + step + last + 1) % (last + 1));
  }

  walkTo(index) {
    const to = this.canonical(index);
    if (!this.handles[to]) return true;
    this.endRun();
    this.askToChoose(to);
    this.handles[to].focus({ preventScroll: true });
    this.say(this.describe(to));
    return true;
  }

  onFocus(event) {
    const g = event.target.closest?.(".rl-handle");
    if (!g || this.drag) return;
    const index = Number(g.dataset.index);
    if (index !== this.chosen) this.askToChoose(index);
  }

  // -- words --

  describe(index) {
    if (index >= this.count) return "";
    const [u, v] = this.at(index);
    const joint = this.twin(index) >= 0 ? `, joined to control point ${this.twin(index)}` : "";
    return `control point ${index} of 0 to ${this.count - 1}, u = ${plain(u)}, v = ${plain(v)}${joint}`;
  }

  say(text) {
    clearTimeout(this.speech);
    this.speech = setTimeout(() => (this.live.textContent = text), 150);
  }

  // -- size and extent --

  resize() {
    const full = this.root.clientWidth;
    if (!full) return;
    const w = Math.max(260, full),
      h = Math.max(this.model.get("min_height"), w / this.model.get("aspect"));
    if (this.size && this.size.full === w && this.size.tall === h) return;
    const { left, right, top, bottom } = MARGIN;
    this.size = { full: w, tall: h, left, top, width: w - left - right, height: h - top - bottom };
    this.stage.setAttribute("width", w);
    this.stage.setAttribute("height", h);
    for (const [name, value] of Object.entries({
      x: left,
      y: top,
      width: this.size.width,
      height: this.size.height,
    }))
      this.clip.setAttribute(name, value);
    if (!this.extent) {
      this.extent = this.wanted();
      this.fresh = !this.count;
    }
    this.redraw();
  }

  // What is to be in view. The whole chart is that of the curve, wherever there are signs.
  box() {
    const own = [this.points, this.curve];
    return boxOf(...(this.mode === "whole" ? own : [...own, this.signs.places]));
  }

  wanted() {
    const shape = this.mode === "whole" ? wholeChart : fitted,
      sheet = sheetOf(boxOf(this.points, this.curve));
    return { ...shape(this.box(), this.size.width, this.size.height), sheet };
  }

  setMode(mode) {
    this.mode = mode;
    this.markMode();
    this.travel(this.wanted());
  }

  markMode() {
    for (const name of ["fit", "whole"]) this.buttons[name].setAttribute("aria-pressed", this.mode === name);
  }

  // Looks after the extent, never while a point is being moved: it stays unless something has left it,
  // or has become so small in it that it must be another design.
  settle() {
    if (this.drag || this.run || !this.extent || !this.count) return;
    const box = this.box(),
      next = this.wanted();
    const seen = this.goal ?? this.extent;
    const tiny =
      this.mode === "fit" &&
      (next.u1 - next.u0 < 0.4 * (seen.u1 - seen.u0) || next.v1 - next.v0 < 0.4 * (seen.v1 - seen.v0));
    if (!inside(box, seen, 0.015) || tiny || this.fresh) this.travel(next, this.fresh);
    this.fresh = false;
  }

  // Goes over to another extent in a few frames, so that the eye can follow.
  travel(goal, atOnce = false) {
    this.finishTravel(false);
    if (!this.size) return;
    const from = this.extent,
      still = atOnce || !from || matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.goal = goal;
    if (still) return this.finishTravel();
    const begin = performance.now();
    const tick = (now) => {
      const s = clamp((now - begin) / 180, 0, 1),
        ease = s * s * (3 - 2 * s);
      if (s >= 1) return this.finishTravel();
      this.extent = { sheet: goal.sheet };
      for (const k of ["u0", "u1", "v0", "v1"]) this.extent[k] = from[k] + ease * (goal[k] - from[k]);
      this.redraw();
      this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  finishTravel(arrive = true) {
    cancelAnimationFrame(this.frame);
    if (arrive && this.goal) {
      this.extent = this.goal;
      this.redraw();
    }
    this.goal = null;
  }

  toPixel(u, v) {
    const { left, top, width, height } = this.size,
      { u0, u1, v0, v1 } = this.extent;
    return [left + ((u - u0) / (u1 - u0)) * width, top + ((v - v0) / (v1 - v0)) * height];
  }

  // Back to radians, kept inside the frame, to a ten-thousandth: far finer than a pixel.
  toChart(x, y) {
    const { left, top, width, height } = this.size,
      { u0, u1, v0, v1 } = this.extent;
    const s = clamp((x - left) / width, 0, 1),
      r = clamp((y - top) / height, 0, 1);
    const round = (a) => Math.round(a * 1e4) / 1e4;
    return [round(u0 + s * (u1 - u0)), round(v0 + r * (v1 - v0))];
  }

  // -- drawing --

  paint() {
    for (const [name, colour] of Object.entries(this.model.get("colours") ?? {})) {
      if (typeof colour === "string") this.root.style.setProperty(`--rl-${name}`, colour);
    }
    const dark = Boolean(this.model.get("colours")?.dark);
    this.root.style.setProperty("color-scheme", dark ? "dark" : "light");
    this.root.classList.toggle("rl-dark", dark);
    this.markMode();
  }

  redraw() {
    if (!this.size || !this.extent) return;
    this.drawAxes();
    this.drawSigns();
    this.drawShape();
    this.drawHandles();
    this.showCursor();
  }

  drawAxes() {
    const key = JSON.stringify([this.extent, this.size]);
    if (key === this.axesKey) return;
    this.axesKey = key;
    const { left, top, width, height } = this.size,
      { u0, u1, v0, v1 } = this.extent;
    const right = left + width,
      bottom = top + height,
      parts = [];
    const path = (cls, d) => parts.push(svg("path", { class: cls, d }));
    const text = (cls, x, y, words, more = {}) =>
      parts.push(svg("text", { class: cls, x, y, ...more }, words));
    const rect = (cls, y, tall, more = {}) =>
      tall > 0 && parts.push(svg("rect", { class: cls, x: left, y, width, height: tall, ...more }));
    const yOf = (v) => this.toPixel(0, v)[1],
      xOf = (u) => this.toPixel(u, 0)[0];
    const us = ticks(u0, u1, width, 26),
      vs = ticks(v0, v1, height, 28);

    rect("rl-paper", top, height);
    path(
      "rl-grid",
      us.map((k) => `M${xOf(k * PI)} ${top}V${bottom}`).join("") +
        vs.map((k) => `M${left} ${yOf(k * PI)}H${right}`).join(""),
    );
    rect("rl-beyond", top, Math.min(yOf(0), bottom) - top, { fill: this.hatchUrl });
    rect("rl-beyond", Math.max(yOf(PI), top), bottom - Math.max(yOf(PI), top), { fill: this.hatchUrl });
    for (let u = this.extent.sheet + TURN * Math.ceil((u0 - this.extent.sheet) / TURN); u <= u1; u += TURN)
      path("rl-edge", `M${xOf(u)} ${Math.max(top, yOf(0))}V${Math.min(bottom, yOf(PI))}`);
    rect("rl-frame", top, height);
    this.drawPole(path, text, yOf(0), "north pole", 1);
    this.drawPole(path, text, yOf(PI), "south pole", -1);

    path(
      "rl-mark",
      us.map((k) => `M${xOf(k * PI)} ${bottom}v4`).join("") +
        vs.map((k) => `M${left} ${yOf(k * PI)}h-4`).join(""),
    );
    for (const k of us)
      parts.push(tickLabel(k, xOf(k * PI), bottom + (asFraction(k).bottom ? 17 : 12), "middle"));
    for (const k of vs) parts.push(tickLabel(k, left - 8, yOf(k * PI), "end"));
    this.nameAxes(parts, left + width / 2, bottom + 42, top + height / 2);
    this.axes.replaceChildren(...parts);
  }

  // A pole is a whole edge of the chart; out of view, an arrow says where it is.
  drawPole(path, text, y, name, sign) {
    const { left, top, width, height } = this.size,
      bottom = top + height,
      middle = left + width / 2;
    if (y >= top - 0.5 && y <= bottom + 0.5) {
      const roomy = (sign > 0 ? y - top : bottom - y) > 15;
      path("rl-pole", `M${left} ${y}h${width}`);
      text("rl-note", middle, y + (roomy === sign > 0 ? -6 : 13.5), name);
    } else if (y < top) text("rl-note", middle, top + 14, `↑ ${name}`);
    else text("rl-note", middle, bottom - 6, `↓ ${name}`);
  }

  nameAxes(parts, x, y, middle) {
    const name = (words, symbol, more) =>
      svg("text", { class: "rl-name", ...more }, words, svg("tspan", { class: "rl-math" }, symbol));
    parts.push(
      name("longitude ", "u", { x, y }),
      name("colatitude ", "v", { transform: `translate(12 ${middle}) rotate(-90)` }),
    );
  }

  trace(list) {
    let d = "",
      pen = "M";
    for (let i = 0; i + 1 < list.length; i += 2) {
      if (!Number.isFinite(list[i]) || !Number.isFinite(list[i + 1])) {
        pen = "M";
        continue;
      }
      const [x, y] = this.toPixel(list[i], list[i + 1]);
      d += `${pen}${x.toFixed(2)} ${y.toFixed(2)}`;
      pen = "L";
    }
    return d;
  }

  // One path for all tiles of a shade and one text for all signs of a colour: few elements, however
  // many places there are.
  drawSigns() {
    if (!this.size || !this.extent) return;
    const key = JSON.stringify([this.extent, this.size]);
    if (key === this.signsKey) return;
    this.signsKey = key;
    const { places, signs, colours, which, shades, tile } = this.signs,
      { left, top, width, height } = this.size;
    const at = signs.map((_, i) => this.toPixel(places[2 * i], places[2 * i + 1]));
    const [x0, y0] = this.toPixel(0, 0),
      [x1, y1] = this.toPixel(...tile),
      wide = x1 - x0,
      high = y1 - y0,
      size = clamp(0.6 * Math.min(wide, high), 6, 16);
    const across = (x) => clamp(x, left, left + width).toFixed(1),
      down = (y) => clamp(y, top, top + height).toFixed(1);
    const tiles = new Map();
    at.forEach(([x, y], i) => {
      const d = `M${across(x - wide / 2)} ${down(y - high / 2)}H${across(x + wide / 2)}V${down(y + high / 2)}H${across(x - wide / 2)}z`;
      if (shades[i]) tiles.set(shades[i], (tiles.get(shades[i]) ?? "") + d);
    });
    const written = (colour, k) => {
      const here = signs.flatMap((sign, i) => (which[i] === k && this.inFrame(...at[i]) ? [[sign, ...at[i]]] : []));
      const text = {
        x: here.map(([, x]) => x.toFixed(1)).join(" "),
        y: here.map(([, , y]) => (y + 0.35 * size).toFixed(1)).join(" "),
        style: `fill: var(--rl-${colour}); font-size: ${size.toFixed(1)}px`,
      };
      return svg("text", text, here.map(([sign]) => sign).join(""));
    };
    this.signsLayer.replaceChildren(
      ...[...tiles].map(([shade, d]) => svg("path", { d, "fill-opacity": (shade / 255).toFixed(3) })),
      ...colours.map(written),
    );
  }

  drawShape() {
    if (!this.size || !this.extent) return;
    this.polygon.setAttribute("d", this.trace(this.points));
    this.line.setAttribute("d", this.trace(this.curve));
    this.drawSeam();
  }

  // The marks of the seam: the neighbours of the joint linked through it, equal legs ticked as equal
  // (C1), the next neighbours linked by a parallel (C2).
  drawSeam() {
    const turns = this.turns(),
      n = this.count - 1;
    let links = "",
      marks = "";
    if (turns !== null && this.closing !== "C0") {
      for (const base of turns ? [0, turns * TURN] : [0]) {
        const near = (i) => [this.points[2 * i] + base, this.points[2 * i + 1]];
        const far = (i) => [this.points[2 * i] - turns * TURN + base, this.points[2 * i + 1]];
        links += this.trace([...far(n - 1), ...near(0), ...near(1)]);
        marks += this.legMark(near(0), near(1)) + this.legMark(far(n - 1), near(0));
        if (this.closing === "C2" && n > 3) links += this.trace([...far(n - 2), ...near(2)]);
      }
    }
    this.seam.setAttribute("d", links);
    this.ticked.setAttribute("d", marks);
  }

  legMark(a, b) {
    const [ax, ay] = this.toPixel(...a),
      [bx, by] = this.toPixel(...b),
      length = Math.hypot(bx - ax, by - ay);
    if (length < 24) return "";
    const nx = (-4.5 * (by - ay)) / length,
      ny = (4.5 * (bx - ax)) / length,
      x = (ax + bx) / 2,
      y = (ay + by) / 2;
    return `M${x - nx} ${y - ny}L${x + nx} ${y + ny}`;
  }

  drawHandles() {
    if (!this.size || !this.extent) return;
    this.matchHandles();
    const joint = this.turns();
    this.handles.forEach((g, i) => this.drawHandle(g, i, joint));
    const [u, v] = this.count ? this.at(this.chosen) : [NaN, NaN];
    const shown = this.count
      ? [
          ["p", this.chosen],
          ["u", plain(u)],
          ["v", plain(v)],
        ]
      : [];
    this.readout.replaceChildren(
      ...shown.map(([symbol, value], k) =>
        html("span", {}, html("i", {}, symbol), k ? html("b", {}, ` ${value}`) : html("sub", {}, `${value}`)),
      ),
    );
    this.buttons.remove.disabled = this.count <= 2;
  }

  matchHandles() {
    while (this.handles.length > this.count) this.handles.pop().remove();
    while (this.handles.length < this.count) this.handles.push(this.makeHandle(this.handles.length));
  }

  drawHandle(g, index, joint) {
    const [x, y] = this.toPixel(...this.at(index)),
      chosen = index === this.chosen,
      last = this.count - 1;
    const hidden = this.canonical(index) !== index;
    set(g, {
      transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})`,
      visibility: hidden ? "hidden" : "inherit",
      tabindex: chosen && !hidden ? 0 : -1,
      "aria-pressed": chosen,
      "aria-label": this.describe(index),
    });
    g.classList.toggle("rl-chosen", chosen);
    g.classList.toggle("rl-tied", joint !== null && (index === 0 || index === last));
    const label = g.lastChild,
      [lx, ly] = this.outward(index, joint);
    const words = joint === 0 && index === 0 ? `0=${last}` : `${index}`;
    if (label.textContent !== words) label.textContent = words;
    set(label, { x: lx.toFixed(1), y: (ly + 4).toFixed(1) });
  }

  // Where a point's number stands: away from the legs that meet there, and inside the frame.
  outward(index, joint) {
    const last = this.count - 1,
      [x, y] = this.toPixel(...this.at(index));
    const before = index > 0 ? index - 1 : joint === 0 ? last - 1 : -1,
      after = index < last ? index + 1 : -1;
    let sx = 0,
      sy = 0,
      ax = 0,
      ay = 0;
    for (const other of [before, after]) {
      if (other < 0) continue;
      const [ox, oy] = this.toPixel(...this.at(other)),
        length = Math.hypot(ox - x, oy - y);
      if (length < 1e-6) continue;
      [ax, ay] = [(ox - x) / length, (oy - y) / length];
      sx -= ax;
      sy -= ay;
    }
    if (Math.hypot(sx, sy) < 0.25) [sx, sy] = ax || ay ? (ax > 0 ? [ay, -ax] : [-ay, ax]) : [0.7, -0.7];
    const length = Math.hypot(sx, sy),
      far = joint === 0 && index === 0 ? 22 : index === this.chosen ? 19 : 16;
    let dx = (far * sx) / length,
      dy = (far * sy) / length;
    const { left, top, width, height } = this.size;
    if (x + dx < left - 2 || x + dx > left + width + 2) dx = -dx;
    if (y + dy < top - 4 || y + dy > top + height - 2) dy = -dy;
    return [dx, dy];
  }

  showCursor() {
    const ring = this.held ? this.eye() : (this.model.get("ring") ?? []);
    this.showAt(this.dot, this.model.get("cursor") ?? []);
    this.showAt(this.ring, ring);
    this.dot.classList.toggle("rl-left", ring.length === 2);
  }

  showAt(node, place) {
    const shown = place.length === 2 && this.size && this.extent;
    node.setAttribute("visibility", shown ? "inherit" : "hidden");
    if (shown)
      node.setAttribute(
        "transform",
        `translate(${this.toPixel(...place)
          .map((a) => a.toFixed(2))
          .join(" ")})`,
      );
  }
}

export default {
  render({ model, el }) {
    const view = new View(model, el);
    return () => view.destroy();
  },
};
