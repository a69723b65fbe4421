// Carries what moves into the textures of pythreejs, all of it in one message, and has the picture
// drawn at once. Sent the usual way every texture is a message of its own, answers with another
// one, and waits for the next frame of the page.

const NAMES = ["rulings", "cursor", "overlay"];

/** A Float32Array over a trait's bytes, which need not lie at a multiple of four. */
function floats(view) {
  return new Float32Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
}

/** Draw now; if something was drawn since the last frame of the page, with the next one. */
function draw(view, fresh) {
  if (!view.renderer) return; // not on the page yet: its first picture will have the data
  if (fresh.has(view)) {
    view.tick();
    return;
  }
  fresh.add(view);
  requestAnimationFrame(() => fresh.delete(view));
  view.renderScene();
}

function initialize({ model }) {
  const manager = model.widget_manager;
  const fresh = new Set();
  const changed = new Set();
  let carrying = Promise.resolve();
  // Versions of our own: pythreejs sets a texture's back to 2 soon after it was made, and the picture
  // would take the next 3 for the one it has.
  let version = 1000;

  async function put(name) {
    const { into, data } = model.get(name);
    if (!into) return;
    const texture = await manager.get_model(into);
    await texture.initPromise;
    const values = floats(data);
    texture.get("data").data.set(values); // what pythreejs returns to when anything else changes
    texture.obj.image.data.set(values);
    texture.obj.version = ++version;
  }

  async function carry() {
    const names = [...changed];
    changed.clear();
    await Promise.all(names.map(put));
    const renderer = await manager.get_model(model.get("renderer"));
    const views = await Promise.all(Object.values(renderer.views ?? {}));
    for (const view of views) draw(view, fresh);
  }

  const report = (error) => console.error("ruledlab: a picture could not be drawn.", error);
  const change = (name) => () => {
    if (!changed.size) queueMicrotask(() => (carrying = carrying.then(carry).catch(report)));
    changed.add(name);
  };
  const listeners = NAMES.map((name) => [`change:${name}`, change(name)]);
  for (const [event, listener] of listeners) {
    model.on(event, listener);
    listener(); // what was sent before this began to listen
  }
  return () => {
    for (const [event, listener] of listeners) model.off(event, listener);
  };
}

export default { initialize };
