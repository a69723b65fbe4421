// Handles over a picture. They are not moved here: the page says where a handle is wanted,
// in pixels of the picture, and Python answers with the new places of all.

const SVG = "http://www.w3.org/2000/svg";
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const STEP = 6; // pixels for an arrow key, one with Shift
const PAUSE = 800; // ms without a key after which the next is a new step of undo
const REST = 350; // ms after which the camera has come to rest, and Python has heard of it

function make(name, attributes, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** A disc that carries a point, or a diamond that carries a direction. */
function handle({ kind, colour, label }) {
  const seen =
    kind === "point"
      ? make("circle", { r: 7 })
      : make("rect", { x: -6, y: -6, width: 12, height: 12, transform: "rotate(45)" });
  const touch = make("circle", { r: 15, class: "rl-touch" });
  const group = make("g", {
    class: `rl-grip ruledlab-hue is-${colour}`,
    role: "button",
    tabindex: 0,
    "aria-roledescription": "handle",
    "aria-label": `${label}: arrow keys move it`,
    "data-lm-suppress-shortcuts": "true", // else JupyterLab takes the arrow keys
  });
  group.append(make("title", {}), touch, seen);
  group.firstChild.textContent = label;
  return group;
}

function render({ model, el }) {
  el.classList.add("ruledlab-grips");
  const svg = make("svg", { role: "group", "aria-label": "Handles in the picture" });
  el.append(svg);
  const view = Math.random().toString(36).slice(2);
  const ends = new AbortController();
  const on = (target, kinds, action) =>
    kinds.split(" ").forEach((kind) =>
      target.addEventListener(kind, action, { signal: ends.signal, capture: true })
    );
  let grips = [];
  let drags = 0;
  let held = null; // the handle in hand, and how far from its middle it was taken
  let keyed = null; // where a run of arrow keys has led, and when
  let turning = false;
  let timer = 0;

  const shown = () => model.get("picture").handles ?? [];
  const picture = () => el.parentElement?.querySelector("canvas, .jupyter-threejs img, svg[role=img]");

  function draw() {
    const { size = [1, 1] } = model.get("picture");
    svg.setAttribute("viewBox", `0 0 ${size[0]} ${size[1]}`);
    if (grips.length !== shown().length) {
      grips = shown().map(handle);
      grips.forEach(listen);
      svg.replaceChildren(...grips);
    }
    shown().forEach(({ x, y }, index) => {
      const grip = grips[index];
      grip.style.display = x === null ? "none" : "";
      grip.setAttribute("transform", `translate(${x ?? 0} ${y ?? 0})`);
    });
    if (!turning) svg.classList.remove("is-off");
    lay();
  }

  /** Lay the handles over the picture, which shrinks on a narrow page. */
  function lay() {
    const under = picture()?.getBoundingClientRect();
    const from = el.parentElement?.getBoundingClientRect();
    if (!under || !from) return;
    const place = { left: under.left - from.left, top: under.top - from.top };
    Object.assign(place, { width: under.width, height: under.height });
    for (const [name, value] of Object.entries(place)) svg.style[name] = `${value}px`;
  }

  function ask(index, x, y) {
    model.set("motion", [view, drags, index, x, y]);
    model.save_changes();
  }

  /** Where the pointer is, in pixels of the picture as Python has it. */
  function at(event) {
    const box = svg.getBoundingClientRect();
    const { size } = model.get("picture");
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return [(x * size[0]) / box.width, (y * size[1]) / box.height];
  }

  function listen(grip, index) {
    on(grip, "pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      event.stopPropagation();
      grip.focus({ preventScroll: true });
      grip.setPointerCapture(event.pointerId);
      const [x, y] = at(event);
      held = { index, off: [shown()[index].x - x, shown()[index].y - y] };
      drags++;
    });
    on(grip, "pointermove", (event) => {
      if (held?.index !== index) return;
      const [x, y] = at(event);
      ask(index, x + held.off[0], y + held.off[1]);
    });
    on(grip, "pointerup pointercancel lostpointercapture", () => (held = null));
    on(grip, "keydown", (event) => {
      const way = ARROWS[event.key];
      if (!way) return;
      event.preventDefault();
      event.stopPropagation();
      const fresh = keyed?.index !== index || event.timeStamp - keyed.when > PAUSE;
      if (fresh) drags++;
      const { x, y } = fresh ? shown()[index] : keyed;
      const step = event.shiftKey ? 1 : STEP;
      keyed = { index, when: event.timeStamp, x: x + way[0] * step, y: y + way[1] * step };
      ask(index, keyed.x, keyed.y);
    });
  }

  /** While the picture is turned the handles are out of the way; Python does not know the camera. */
  function off(event) {
    if (svg.contains(event.target) || picture() instanceof SVGElement) return;
    turning = event.type === "pointerdown";
    svg.classList.add("is-off");
    back();
  }

  function back() {
    clearTimeout(timer);
    timer = setTimeout(() => turning || svg.classList.remove("is-off"), REST);
  }

  const frame = requestAnimationFrame(() => {
    const stage = el.parentElement;
    if (!stage) return;
    on(stage, "pointerdown wheel", off);
    on(window, "pointerup pointercancel", () => {
      if (!turning) return;
      turning = false;
      back();
    });
    sizes.observe(stage);
    lay();
  });
  const sizes = new ResizeObserver(lay);
  model.on("change:picture", draw);
  draw();
  return () => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    sizes.disconnect();
    ends.abort();
    model.off("change:picture", draw);
  };
}

export default { render };
