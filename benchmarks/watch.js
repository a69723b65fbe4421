// Notes when new pixels can be read back, the same way for every contender, and counts what goes
// through the kernel's websocket. A picture counts as drawn when its last change has been read.
// Reading waits for the drawing and so slows it: where many pictures follow one another only those
// after the last move are read, the others are noted as their drawing is asked for.
(wanted) => {
  const { plots, image } = wanted;
  const watch = { drawn: [], keys: [], received: 0, sent: 0, reading: true };
  window.watch = watch;
  const last = new WeakMap();
  const hash = (values) => {
    let h = 0x811c9dc5;
    for (const x of values) h = Math.imul(h ^ x, 0x01000193);
    return h;
  };

  const note = (kind, owner, print) => {
    if (last.get(owner) === print) return;
    last.set(owner, print);
    watch.drawn.push([performance.now(), kind]);
  };

  const noteOnly = (kind) => watch.drawn.push([performance.now(), kind]);

  function readSurface(gl) {
    if (!watch.reading) return noteOnly("surface");
    if (gl.isContextLost() || gl.getParameter(gl.FRAMEBUFFER_BINDING)) return;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels); // waits for the drawing
    note("surface", document.body, hash(new Uint32Array(pixels.buffer)));
  }
  const copy = new OffscreenCanvas(300, 150).getContext("2d", { willReadFrequently: true });
  function readPlots(pen) {
    if (!watch.reading) return noteOnly("plots");
    copy.clearRect(0, 0, 300, 150);
    copy.drawImage(pen.canvas, 0, 0, 300, 150);
    note("plots", pen.canvas, hash(new Uint32Array(copy.getImageData(0, 0, 300, 150).data.buffer)));
  }

  // Read as soon as the code that draws has returned.
  const due = new Map();
  const after = (pen, read) => {
    if (!due.size) queueMicrotask(readAll);
    due.set(pen, read);
  };
  function readAll() {
    const now = [...due];
    due.clear();
    for (const [pen, read] of now) read(pen);
  }
  const patch = (prototype, name, read, concerns) => {
    const original = prototype[name];
    prototype[name] = function (...values) {
      if (concerns(this)) after(this, read);
      return original.apply(this, values);
    };
  };
  for (const kind of [WebGLRenderingContext, WebGL2RenderingContext])
    for (const name of ["drawElements", "drawArrays"])
      patch(kind.prototype, name, readSurface, () => true);
  patch(CanvasRenderingContext2D.prototype, "stroke", readPlots, (pen) => pen.canvas.matches?.(plots));

  new MutationObserver((changes) => {
    for (const { addedNodes } of changes)
      for (const node of addedNodes) {
        if (node.nodeType !== Node.ELEMENT_NODE) continue;
        const shown = node.matches(image) ? node : node.querySelector(image);
        if (shown) shown.decode().then(() => note("plots", shown, shown.src), () => {});
      }
  }).observe(document.body, { childList: true, subtree: true });

  document.addEventListener("keydown", (event) => watch.keys.push(event.timeStamp), true);

  // Sockets that are open already show themselves with the next thing they send.
  const sockets = new WeakSet();
  const size = (data) => data.byteLength ?? data.size ?? new TextEncoder().encode(data).length;
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) {
    if (!sockets.has(this)) {
      sockets.add(this);
      this.addEventListener("message", (event) => (watch.received += size(event.data)));
    }
    watch.sent += size(data);
    return send.call(this, data);
  };
}
