// The parts of an exercise that need the browser: rows to choose from, a field, a plane to draw in.
// It draws what it is sent and reports what the reader does; it judges nothing and computes no curve.

const SVG = "http://www.w3.org/2000/svg";

function element(tag, className, parent, attributes = {}, text = "") {
  const made = document.createElement(tag);
  if (className) made.className = className;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  parent?.append(made);
  return made;
}

function svg(tag, parent, attributes = {}, text = "") {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  parent?.append(made);
  return made;
}

const button = (words, parent, action, className = "") => {
  const made = element("button", `jupyter-button widget-button ruledlab-button ${className}`, parent, { type: "button" }, words);
  made.addEventListener("click", action);
  return made;
};

function follow(model, names, handler) {
  for (const name of names) model.on(`change:${name}`, handler);
  return () => names.forEach((name) => model.off(`change:${name}`, handler));
}

// ---- mathematics in words ----------------------------------------------------------------------
// What a radio button contains is not read but its name, and there formulas are left out: two answers
// that differ in a formula only would sound the same.

const MARKS = { "¯": "bar", "‾": "bar", "^": "hat", "ˆ": "hat", "˙": "dot", "→": "vector" };

function raised(base, exponent) {
  const [, primes, power] = exponent.match(/^([′″‴*\s]*)(.*)$/s);
  return ` ${base}${primes.replace(/\s/g, "")}${power && ` to the ${power}`} `;
}

function inWords(node) {
  if (node.nodeType === Node.TEXT_NODE) return node.textContent;
  if (node.nodeType !== Node.ELEMENT_NODE) return "";
  if (node.localName === "mjx-container") return ` ${inWords(node.querySelector("math") ?? document.createTextNode(node.textContent))} `;
  const parts = [...node.childNodes].map(inWords);
  const [a, b, c] = parts.map((part) => part.trim());
  switch (node.localName) {
    case "msub": return ` ${a} sub ${b} `;
    case "msup": return raised(a, b);
    case "msubsup": return ` ${a} sub ${b} to the ${c} `;
    case "mfrac": return ` ${a} over ${b} `;
    case "msqrt": return ` root of ${parts.join(" ")} `;
    case "mover": return ` ${a} ${MARKS[b] ?? b} `;
    case "mi": case "mn": case "mo": return ` ${parts.join("")} `;
    default: return parts.join("");
  }
}

const named = (row) => inWords(row).replace(/[\u2061-\u2064]/g, "").replace(/\s+/g, " ").replace(/ ([.,;:?!)])/g, "$1").trim();

// ---- rows to choose from ---------------------------------------------------------------------
// The rows are widgets of their own, typeset by the notebook; here they become a radio group.

function renderChoose({ model, el }) {
  let scope = null;
  let rows = [];
  let chosen = model.get("chosen");
  let ended = false;
  const stops = [];

  function dress() {
    rows = [...scope.querySelectorAll(".ruledlab-option")].filter(
      (row) => row.closest(".ruledlab-options") === scope,
    );
    rows.forEach((row, i) => {
      if (row.getAttribute("role") !== "radio") row.setAttribute("role", "radio");
      const name = named(row);
      if (row.getAttribute("aria-label") !== name) row.setAttribute("aria-label", name);
      const on = String(i === chosen);
      if (row.getAttribute("aria-checked") !== on) row.setAttribute("aria-checked", on);
      const stop = i === (chosen < 0 ? 0 : chosen) ? "0" : "-1";
      if (row.getAttribute("tabindex") !== stop) row.setAttribute("tabindex", stop);
    });
  }

  function choose(i, focus) {
    chosen = (i + rows.length) % rows.length;
    dress();
    if (focus) rows[chosen].focus();
  }

  const submit = () => model.send({ chosen: chosen < 0 ? null : chosen });
  const rowOf = (target) => rows.indexOf(target.closest?.(".ruledlab-option"));

  function clicked(event) {
    const row = rowOf(event.target);
    if (row >= 0) choose(row, true);
  }

  function keyed(event) {
    const row = rowOf(event.target);
    if (row < 0 || event.ctrlKey || event.altKey || event.metaKey) return;
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    if (step) choose(row + step, true);
    else if (event.key === " ") choose(row, true);
    else if (event.key === "Enter") {
      if (chosen < 0) choose(row, true);
      submit();
    } else return;
    event.preventDefault();
  }

  function attach() {
    if (ended || scope) return;
    scope = el.closest(".ruledlab-options");
    if (!scope) return void requestAnimationFrame(attach);
    scope.setAttribute("role", "radiogroup");
    scope.setAttribute("aria-label", model.get("label"));
    const observer = new MutationObserver(dress);
    observer.observe(scope, { childList: true, subtree: true });
    scope.addEventListener("click", clicked);
    scope.addEventListener("keydown", keyed);
    stops.push(() => {
      observer.disconnect();
      scope.removeEventListener("click", clicked);
      scope.removeEventListener("keydown", keyed);
    });
    dress();
  }

  button(model.get("button"), el, submit, "ruledlab-main");
  stops.push(
    follow(model, ["chosen"], () => {
      chosen = model.get("chosen");
      if (scope) dress();
    }),
  );
  attach();
  return () => {
    ended = true;
    stops.forEach((stop) => stop());
  };
}

// ---- a field ---------------------------------------------------------------------------------

function renderField({ model, el }) {
  const root = element("div", "ruledlab-field", el);
  const name = `ruledlab-${Math.random().toString(36).slice(2, 10)}`;
  element("label", "ruledlab-field-label", root, { for: name }, model.get("label"));
  const input = element("input", "", root, { type: "text", id: name, spellcheck: "false", autocomplete: "off", autocapitalize: "off" });
  const unit = model.get("unit");
  if (unit) {
    element("span", "ruledlab-unit", root, { id: `${name}-unit` }, unit);
    input.setAttribute("aria-describedby", `${name}-unit`);
  }
  input.placeholder = model.get("example");
  const submit = () => model.send({ text: input.value });
  button(model.get("button"), root, submit, "ruledlab-main");
  const keyed = (event) => event.key === "Enter" && !event.isComposing && submit();
  const typed = () => {
    model.set("text", input.value);
    model.save_changes();
  };
  const show = () => {
    if (input.value !== model.get("text") && document.activeElement !== input) input.value = model.get("text");
  };
  input.addEventListener("keydown", keyed);
  input.addEventListener("change", typed);
  const stops = [follow(model, ["text"], show)];
  input.value = model.get("text");
  return () => stops.forEach((stop) => stop());
}

// ---- a plane to draw in ----------------------------------------------------------------------

const STRIDE = 4; // every fourth height is a handle for the keys
const MARGIN = { left: 46, right: 14, top: 12, bottom: 30 };
const HEIGHT = 250;

function renderSketch({ model, el }) {
  const root = element("div", "ruledlab-sketch", el);
  const plot = model.get("plot");
  const [t0, t1] = plot.span;
  const [y0, y1] = plot.heights;
  const last = plot.knots - 1;
  root.style.setProperty("--rl-truth-light", plot.colours[0]);
  root.style.setProperty("--rl-truth-dark", plot.colours[1]);
  const stage = svg("svg", root, {
    class: "ruledlab-stage",
    role: "slider",
    tabindex: "0",
    "aria-label": `sketch of ${plot.label} over t`,
    "aria-valuemin": y0,
    "aria-valuemax": y1,
    "aria-orientation": "vertical",
  });
  const axes = svg("g", stage, { "aria-hidden": "true" });
  const truth = svg("path", stage, { class: "ruledlab-truth" });
  const drawing = svg("path", stage, { class: "ruledlab-drawing" });
  const handles = svg("g", stage, { class: "ruledlab-handles" });
  const bar = element("div", "ruledlab-sketch-bar", root);
  const compare = button(model.get("button"), bar, () => model.send({ sketch: heights() }), "ruledlab-main");
  const again = button("Draw again", bar, clear);
  element("span", "ruledlab-key is-mine", bar, {}, "your sketch");
  const keyOfTruth = element("span", "ruledlab-key is-true", bar, {}, "the curve");
  element("span", "ruledlab-keys", bar, {}, "Draw with the pointer. By keys: ← → choose a handle, ↑ ↓ move it, Enter compares.");

  let width = 600;
  let y = read();
  let chosen = 0;
  let before = null; // [knot, height] where the pointer was

  const px = (knot) => MARGIN.left + (knot / last) * (width - MARGIN.left - MARGIN.right);
  const py = (value) => MARGIN.top + ((y1 - value) / (y1 - y0)) * (HEIGHT - MARGIN.top - MARGIN.bottom);
  const heights = () => y.map((value) => (value === null ? null : Math.round(value * 1e6) / 1e6));
  const revealed = () => model.get("truth").length > 0;

  function read() {
    const sent = model.get("sketch");
    return sent.length === last + 1 ? [...sent] : Array(last + 1).fill(null);
  }

  function path(values) {
    let text = "";
    let pen = false;
    values.forEach((value, i) => {
      if (value !== null) text += `${pen ? "L" : "M"}${px(i).toFixed(1)} ${py(value).toFixed(1)}`;
      pen = value !== null;
    });
    return text;
  }

  const label = (value) => String(Math.round(value * 100) / 100).replace("-", "−");

  const EIGHTH = Math.PI / 4;
  const isWhole = (value) => Math.abs(value - Math.round(value)) < 1e-9;
  const byAngle = isWhole(t0 / EIGHTH) && isWhole(t1 / EIGHTH);

  /** A t as text: a fraction of π where t runs between such. */
  function place(t) {
    const eighths = Math.round(t / EIGHTH);
    if (!byAngle || !isWhole(t / EIGHTH) || eighths === 0) return label(t);
    const under = [4, 2, 1].find((part) => eighths % part === 0);
    const over = Math.abs(eighths / under);
    return `${t < 0 ? "−" : ""}${over === 1 ? "" : over}π${under === 4 ? "" : `/${4 / under}`}`;
  }

  function drawAxes() {
    axes.replaceChildren();
    const [bottom, right] = [HEIGHT - MARGIN.bottom, width - MARGIN.right];
    svg("rect", axes, { class: "ruledlab-frame", x: MARGIN.left, y: MARGIN.top, width: right - MARGIN.left, height: bottom - MARGIN.top });
    for (let k = 0; k <= 4; k++) {
      const x = px((k * last) / 4);
      svg("path", axes, { class: "ruledlab-grid-line", d: `M${x} ${MARGIN.top}V${bottom}` });
      svg("text", axes, { x, y: bottom + 16, "text-anchor": "middle" }, place(t0 + ((t1 - t0) * k) / 4));
    }
    if (y0 < 0 && y1 > 0) {
      svg("path", axes, { class: "ruledlab-zero", d: `M${MARGIN.left} ${py(0)}H${right}` });
      svg("text", axes, { x: MARGIN.left - 7, y: py(0) + 4, "text-anchor": "end" }, "0");
    }
    svg("text", axes, { class: "ruledlab-axis", x: MARGIN.left + 7, y: MARGIN.top + 15 }, plot.label);
    svg("text", axes, { class: "ruledlab-axis", x: right - 4, y: bottom - 6, "text-anchor": "end" }, "t");
  }

  function draw() {
    drawing.setAttribute("d", path(y));
    truth.setAttribute("d", revealed() ? path(model.get("truth")) : "");
    root.classList.toggle("is-empty", y.every((value) => value === null));
    root.classList.toggle("is-revealed", revealed());
    keyOfTruth.hidden = !revealed();
    compare.disabled = revealed();
    again.disabled = !revealed() && y.every((value) => value === null);
    handles.replaceChildren();
    for (let i = 0; i <= last; i += STRIDE) {
      const here = i === chosen;
      svg("circle", handles, { cx: px(i), cy: py(y[i] ?? rest()), r: here ? 6 : 3.5, class: `${here ? "is-here" : ""} ${y[i] === null ? "is-bare" : ""}` });
    }
    speak();
  }

  function speak() {
    const value = y[chosen];
    const t = t0 + ((t1 - t0) * chosen) / last;
    stage.setAttribute("aria-valuenow", value ?? rest());
    stage.setAttribute("aria-valuetext", `t = ${t.toFixed(2)}: ${value === null ? "not drawn" : `${plot.label} = ${value.toFixed(2)}`}`);
  }

  const rest = () => (y0 < 0 && y1 > 0 ? 0 : (y0 + y1) / 2);

  function keep() {
    model.set("sketch", heights());
    model.save_changes();
  }

  function clear() {
    y = Array(last + 1).fill(null);
    model.send({ again: true });
    draw();
    stage.focus();
  }

  // -- the pointer --

  function at(event) {
    const box = stage.getBoundingClientRect();
    const x = (event.clientX - box.left - MARGIN.left) / (width - MARGIN.left - MARGIN.right);
    const h = (event.clientY - box.top - MARGIN.top) / (HEIGHT - MARGIN.top - MARGIN.bottom);
    const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
    return [clamp(x, 0, 1) * last, clamp(y1 - h * (y1 - y0), y0, y1)];
  }

  /** Heights between two places of the hand, on the straight line between them. */
  function fill([a, ya], [b, yb]) {
    const [from, to] = [Math.ceil(Math.min(a, b) - 1e-9), Math.floor(Math.max(a, b) + 1e-9)];
    for (let i = from; i <= to; i++) y[i] = a === b ? yb : ya + ((yb - ya) * (i - a)) / (b - a);
  }

  function pressed(event) {
    if (event.button !== 0 || revealed()) return;
    stage.setPointerCapture(event.pointerId);
    before = at(event);
    y[Math.round(before[0])] = before[1];
    draw();
  }

  function moved(event) {
    if (before === null) return;
    for (const part of event.getCoalescedEvents?.() ?? [event]) {
      const now = at(part);
      fill(before, now);
      before = now;
    }
    draw();
  }

  function released() {
    if (before === null) return;
    before = null;
    keep();
  }

  // -- the keys --

  function keyed(event) {
    if (event.ctrlKey || event.metaKey) return;
    const tall = ((y1 - y0) / 40) * (event.shiftKey ? 5 : event.altKey ? 0.2 : 1);
    const across = { ArrowRight: STRIDE, ArrowLeft: -STRIDE, Home: -last, End: last }[event.key];
    const up = { ArrowUp: tall, ArrowDown: -tall, PageUp: 8 * tall, PageDown: -8 * tall }[event.key];
    if (across) chosen = Math.min(last, Math.max(0, chosen + across));
    else if (revealed()) return;
    else if (up) lift(up);
    else if (event.key === "Enter") model.send({ sketch: heights() });
    else return;
    event.preventDefault();
    draw();
  }

  /** Move the chosen handle; between neighbouring handles the sketch follows in straight lines. */
  function lift(up) {
    const value = (y[chosen] ?? nearest()) + up;
    y[chosen] = Math.min(y1, Math.max(y0, value));
    for (const next of [chosen - STRIDE, chosen + STRIDE])
      if (y[next] !== null && y[next] !== undefined) fill([chosen, y[chosen]], [next, y[next]]);
    keep();
  }

  function nearest() {
    for (const next of [chosen - STRIDE, chosen + STRIDE])
      if (y[next] !== null && y[next] !== undefined) return y[next];
    return rest();
  }

  function resize() {
    const room = Math.floor(root.clientWidth);
    if (room < 50) return;
    width = Math.min(room, 760);
    stage.setAttribute("width", width);
    stage.setAttribute("height", HEIGHT);
    drawAxes();
    draw();
  }

  const observer = new ResizeObserver(resize);
  observer.observe(root);
  stage.addEventListener("pointerdown", pressed);
  stage.addEventListener("pointermove", moved);
  stage.addEventListener("pointerup", released);
  stage.addEventListener("pointercancel", released);
  stage.addEventListener("keydown", keyed);
  const stops = [
    follow(model, ["sketch"], () => {
      if (before !== null) return;
      y = read();
      draw();
    }),
    follow(model, ["truth"], draw),
  ];
  resize();
  return () => {
    observer.disconnect();
    stops.forEach((stop) => stop());
  };
}

function render(view) {
  const part = { choose: renderChoose, field: renderField, sketch: renderSketch }[view.model.get("part")];
  return part(view);
}

export default { render };
