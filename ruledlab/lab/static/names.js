// Sliders of ipywidgets have no accessible name: give each handle and field the name of its row.

function name(root) {
  for (const row of root.querySelectorAll(".ruledlab-row")) {
    const words = row.querySelector(".ruledlab-label")?.title;
    if (!words) continue;
    for (const part of row.querySelectorAll(".noUi-handle, input, select")) {
      if (!part.hasAttribute("aria-label")) part.setAttribute("aria-label", words);
    }
  }
}

function render({ el }) {
  el.style.display = "none";
  let observer = null;
  const frame = requestAnimationFrame(() => {
    const root = el.closest(".ruledlab");
    if (!root) return;
    name(root);
    observer = new MutationObserver(() => name(root));
    observer.observe(root, { childList: true, subtree: true });
    setTimeout(() => observer.disconnect(), 20_000);
  });
  return () => {
    cancelAnimationFrame(frame);
    observer?.disconnect();
  };
}

export default { render };
