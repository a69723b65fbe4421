// Draws what it is sent: typeset axes (SVG), curves and cursor as pixel positions. It computes no
// curve and no invariant; the only thing it moves by itself is the cursor line under the pointer.

const GAP_PIXELS = 2; // a single undefined sample must still be seen
const NOTE_FONT = "12px system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif";

/** A Float32Array over a trait's bytes, which need not lie at a multiple of four. */
function floats(view) {
  if (!view || !view.byteLength) return new Float32Array(0);
  return new Float32Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
}

function element(tag, className, parent, attributes = {}) {
  const made = document.createElement(tag);
  made.className = className;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

// ---------------------------------------------------------------------------------- drawing

function drawGaps(pen, axis, note, frame) {
  pen.fillStyle = frame.colours.faint;
  for (let i = 0; i + 1 < (note.gaps || []).length; i += 2) {
    const [from, to] = [note.gaps[i], note.gaps[i + 1]];
    const wide = Math.max(to - from, GAP_PIXELS);
    pen.globalAlpha = wide > GAP_PIXELS * 3 ? 0.16 : 0.4;
    pen.fillRect((from + to - wide) / 2, axis.top, wide, axis.bottom - axis.top);
  }
  pen.globalAlpha = 1;
}

function drawCurve(pen, axis, across, down, frame) {
  pen.save();
  pen.beginPath();
  pen.rect(frame.left - 2, axis.top - 1.5, frame.right - frame.left + 4, axis.bottom - axis.top + 3);
  pen.clip();
  pen.beginPath();
  let drawing = false;
  for (let i = 0; i < across.length; i++) {
    if (Number.isNaN(down[i])) {
      drawing = false;
    } else {
      if (!drawing) pen.moveTo(across[i], down[i]);
      pen.lineTo(across[i], down[i]); // after moveTo too: a lone sample is a dot
      drawing = true;
    }
  }
  pen.strokeStyle = axis.colour;
  pen.lineWidth = 2;
  pen.lineJoin = "round";
  pen.lineCap = "round";
  pen.setLineDash(axis.dashed ? [7, 6] : []);
  pen.stroke();
  pen.restore();
}

function halo(pen, text, x, y, colour, paper) {
  pen.strokeStyle = paper;
  pen.lineWidth = 4;
  pen.lineJoin = "round";
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
}

/** Small arrows where the curve leaves the frame, and how far it goes at the farthest. */
function drawPeaks(pen, axis, note, frame, valueWidth) {
  pen.font = NOTE_FONT;
  (note.peaks || []).forEach(([x, up], i) => {
    const tip = up ? axis.top - 6 : axis.bottom + 6;
    const foot = up ? axis.top + 2 : axis.bottom - 2;
    pen.beginPath();
    pen.moveTo(x, tip);
    pen.lineTo(x - 5, foot);
    pen.lineTo(x + 5, foot);
    pen.closePath();
    pen.fillStyle = axis.colour;
    pen.fill();
    if (i > 0) return;
    // Beside the arrow, where there is room: never under the value in the right corner.
    const value = up === !note.below ? valueWidth + 6 : 2;
    const [text, start] = fitting(pen, note.texts, x, frame.left + 4, frame.right - value);
    pen.textAlign = "left";
    pen.textBaseline = up ? "top" : "alphabetic";
    halo(pen, text, start, up ? axis.top + 3 : axis.bottom - 5, axis.colour, frame.colours.paper);
  });
}

/** The longest text that fits to the right or left of x, and where it starts. */
function fitting(pen, texts, x, first, last) {
  for (const text of texts) {
    const width = pen.measureText(text).width;
    if (x + 10 + width <= last) return [text, Math.max(x + 10, first)];
    if (x - 10 - width >= first) return [text, Math.min(x - 10, last) - width];
  }
  return ["", x];
}

function drawEmpty(pen, axis, note, frame) {
  if (!note.empty) return;
  pen.font = NOTE_FONT;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  const [x, y] = [(frame.left + frame.right) / 2, (axis.top + axis.bottom) / 2];
  const width = pen.measureText(note.empty).width + 16;
  pen.fillStyle = frame.colours.paper;
  pen.fillRect(x - width / 2, y - 11, width, 22);
  pen.fillStyle = frame.colours.ink;
  pen.fillText(note.empty, x, y);
}

function drawCursor(pen, frame, x, cursor, notes) {
  const axes = frame.axes;
  pen.strokeStyle = frame.colours.cursor;
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(x, axes[0].top - 5);
  pen.lineTo(x, axes[axes.length - 1].bottom + 5);
  pen.stroke();
  axes.forEach((axis, k) => {
    const y = cursor.y && cursor.y[k];
    if (y == null || y < axis.top - 2 || y > axis.bottom + 2) return;
    pen.beginPath();
    pen.arc(cursor.x, y, 4.5, 0, 2 * Math.PI);
    pen.fillStyle = axis.colour;
    pen.fill();
    pen.lineWidth = 2;
    pen.strokeStyle = frame.colours.paper;
    pen.stroke();
  });
}

// ---------------------------------------------------------------------------------- the view

function render({ model, el }) {
  const root = element("div", "ruledlab-plots", el);
  const stage = element("div", "ruledlab-plots-stage", root);
  const picture = element("div", "ruledlab-plots-picture", stage, { role: "img" });
  // A shadow tree of its own: ids and the style rule inside the SVG stay inside.
  const axesHost = element("div", "ruledlab-plots-axes", picture);
  const axesRoot = axesHost.attachShadow({ mode: "open" });
  axesRoot.innerHTML = "<style>svg{display:block}</style>";
  const canvas = element("canvas", "ruledlab-plots-curves", picture);
  const values = element("div", "ruledlab-plots-values", stage, { "aria-hidden": "true" });
  const label = element("span", "ruledlab-plots-label", values);
  const slider = element("div", "ruledlab-plots-cursor", stage, {
    role: "slider",
    tabindex: "0",
    "aria-label": "cursor t",
    "aria-orientation": "horizontal",
  });
  const reasons = element("p", "ruledlab-plots-reasons", root);

  let across = new Float32Array(0);
  let curves = [];
  const shown = []; // the axes: {host, svg}
  let held = null; // the t under the pointer, ahead of what Python has answered
  let release = 0; // timer that lets go of it
  let pending = false; // an update will come
  let changed = false; // and more than the cursor has changed
  let resizing = 0;
  let outputs = [];

  const frame = () => model.get("frame");
  const ready = () => Boolean(frame() && frame().axes);
  const clamp = (t) => Math.min(Math.max(t, frame().t[0]), frame().t[1]);

  function place(t) {
    const { left, right, t: [low, high] } = frame();
    return left + ((t - low) / (high - low)) * (right - left);
  }

  // -- in: from the model to the page

  /** Once per message, and at once: it costs less than waiting for a frame would save. */
  function redraw() {
    if (!pending) queueMicrotask(update);
    pending = true;
  }

  /** A message changes traits in no fixed order; nothing is drawn before all of it is read. */
  function update() {
    pending = false;
    if (!ready()) return;
    if (changed) read();
    changed = false;
    readCursor();
    draw();
  }

  function read() {
    readStrips(model.get("strips"));
    across = floats(model.get("across"));
    const all = floats(model.get("curves"));
    curves = frame().axes.map((_, k) => all.subarray(k * across.length, (k + 1) * across.length));
    describe();
    arrange();
  }

  /** Put in place only the axes that have changed. */
  function readStrips(strips) {
    while (shown.length > strips.length) shown.pop().host.remove();
    strips.forEach((svg, k) => {
      if (shown.length === k) shown.push({ host: element("div", "", axesRoot) });
      if (shown[k].svg !== svg) shown[k].host.innerHTML = svg;
      shown[k].svg = svg;
    });
  }

  function describe() {
    const text = model.get("reasons");
    if (picture.getAttribute("aria-label") !== model.get("summary"))
      picture.setAttribute("aria-label", model.get("summary"));
    if (reasons.title === text) return;
    reasons.textContent = text;
    reasons.title = text;
  }

  /** Sizes, colours, and one value field per axis. */
  function arrange() {
    const { width, height, left, right, axes, colours } = frame();
    const notes = model.get("notes");
    for (const [name, colour] of Object.entries(colours))
      root.style.setProperty(`--ruledlab-${name}`, colour);
    stage.style.width = `${width}px`;
    stage.style.height = `${height}px`;
    const top = axes[0].top;
    const bottom = axes[axes.length - 1].bottom;
    Object.assign(slider.style, {
      left: `${left - 3}px`,
      top: `${top - 4}px`,
      width: `${right - left + 6}px`,
      height: `${bottom - top + 7}px`,
    });
    while (outputs.length < axes.length)
      outputs.push(element("span", "ruledlab-plots-value", values));
    while (outputs.length > axes.length) outputs.pop().remove();
    axes.forEach((axis, k) => {
      outputs[k].style.color = axis.colour;
      outputs[k].style.top = `${notes[k] && notes[k].below ? axis.bottom - 21 : axis.top + 1}px`;
      outputs[k].style.right = `${width - right}px`;
    });
    label.style.top = `${bottom + 20}px`;
    [slider.ariaValueMin, slider.ariaValueMax] = frame().t.map(String);
  }

  function readCursor() {
    const cursor = model.get("cursor") || {};
    if (held !== null && release && Math.abs(place(held) - cursor.x) < 0.5) forget();
    outputs.forEach((output, k) => {
      const text = cursor.values ? cursor.values[k] : "";
      if (output.textContent !== text) output.textContent = text;
      output.classList.toggle("ruledlab-plots-none", text === "undefined");
    });
    label.textContent = cursor.label || "";
    label.hidden = !cursor.label;
    if (cursor.t !== undefined) {
      slider.ariaValueNow = String(cursor.t);
      slider.ariaValueText = cursor.spoken;
    }
  }

  function draw() {
    const { width, height, axes } = frame();
    const notes = model.get("notes");
    const density = window.devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * density), Math.round(height * density)];
    if (canvas.width !== wide || canvas.height !== high) {
      [canvas.width, canvas.height] = [wide, high];
      [canvas.style.width, canvas.style.height] = [`${width}px`, `${height}px`];
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(density, 0, 0, density, 0, 0);
    pen.clearRect(0, 0, width, height);
    const valueWidth = Math.max(76, ...outputs.map((output) => output.offsetWidth));
    axes.forEach((axis, k) => drawGaps(pen, axis, notes[k] || {}, frame()));
    axes.forEach((axis, k) => drawCurve(pen, axis, across, curves[k], frame()));
    axes.forEach((axis, k) => {
      drawPeaks(pen, axis, notes[k] || {}, frame(), valueWidth);
      drawEmpty(pen, axis, notes[k] || {}, frame());
    });
    placeCursor(pen);
  }

  function placeCursor(pen) {
    const cursor = model.get("cursor") || {};
    if (held === null && cursor.x === undefined) return;
    const x = held === null ? cursor.x : place(held);
    drawCursor(pen, frame(), x, cursor);
    const half = label.offsetWidth / 2;
    const end = frame().width - half;
    label.style.left = `${Math.min(Math.max(x, frame().left + half - 8), end)}px`;
  }

  // -- out: from the reader to the model

  /** One trait, so that ipywidgets keeps only the latest while the kernel is busy. */
  function pick(t) {
    const [count] = model.get("picked");
    model.set("picked", [(count || 0) + 1, t]);
    model.save_changes();
  }

  /** A pointer is no more exact than a ten-thousandth of the axis: short numbers are to be read. */
  function byHand(t, span) {
    return Number(t.toFixed(Math.min(Math.max(4 - Math.floor(Math.log10(span)), 0), 12)));
  }

  function pickAt(event) {
    const { left, right, t: [low, high] } = frame();
    const x = event.clientX - stage.getBoundingClientRect().left;
    clearTimeout(release);
    release = 0;
    held = clamp(byHand(low + ((x - left) / (right - left)) * (high - low), high - low));
    pick(held);
    redraw();
  }

  function forget() {
    clearTimeout(release);
    release = 0;
    held = null;
  }

  function letGo() {
    forget();
    redraw();
  }

  function pressed(event) {
    if (event.button !== 0 || !ready()) return;
    slider.setPointerCapture(event.pointerId);
    pickAt(event);
  }

  function moved(event) {
    if (slider.hasPointerCapture(event.pointerId)) pickAt(event);
  }

  /** The line stays where it was left until Python's answer for that place is here. */
  function released() {
    if (held === null || release) return;
    release = setTimeout(letGo, 600);
    redraw();
  }

  /** Arrow keys; read at the window, before JupyterLab takes them to move between cells. */
  function keyed(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !ready()) return;
    const [low, high] = frame().t;
    const small = ((high - low) / 100) * (event.shiftKey ? 0.1 : 1);
    const now = held !== null ? held : (model.get("cursor") || {}).t ?? low;
    const to = {
      ArrowRight: now + small,
      ArrowUp: now + small,
      ArrowLeft: now - small,
      ArrowDown: now - small,
      PageUp: now + 10 * small,
      PageDown: now - 10 * small,
      Home: low,
      End: high,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    clearTimeout(release);
    held = clamp(to);
    pick(held);
    redraw();
    release = setTimeout(letGo, 600);
  }

  const listenKeys = () => window.addEventListener("keydown", keyed, true);
  const ignoreKeys = () => window.removeEventListener("keydown", keyed, true);

  function measure() {
    const width = Math.floor(root.clientWidth);
    if (width < 1 || width === model.get("width")) return;
    model.set("width", width);
    model.save_changes();
  }

  const observer = new ResizeObserver(() => {
    clearTimeout(resizing);
    resizing = setTimeout(measure, 100);
  });

  slider.addEventListener("pointerdown", pressed);
  slider.addEventListener("pointermove", moved);
  slider.addEventListener("lostpointercapture", released);
  slider.addEventListener("focus", listenKeys);
  slider.addEventListener("blur", ignoreKeys);
  window.addEventListener("resize", redraw);
  observer.observe(root);

  const traits = ["strips", "frame", "across", "curves", "notes", "reasons", "summary"];
  const change = () => {
    changed = true;
    redraw();
  };
  for (const name of traits) model.on(`change:${name}`, change);
  model.on("change:cursor", redraw);
  change();

  return () => {
    observer.disconnect();
    ignoreKeys();
    window.removeEventListener("resize", redraw);
    clearTimeout(resizing);
    clearTimeout(release);
    for (const name of traits) model.off(`change:${name}`, change);
    model.off("change:cursor", redraw);
  };
}

export default { render };
