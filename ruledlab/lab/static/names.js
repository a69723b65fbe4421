// What ipywidgets leaves out for those who use keyboard or screen reader: names for slider handles,
// fields, menus and the player's buttons; folds that open by keyboard.

const PLAYER = ["play or pause", "stop and go back to the start", "repeat"];
const QUIET = 20_000; // ms without a new part after which nothing more is expected

const said = (node) => (node?.textContent ?? "").replace(/\u200b/g, "").trim();

/** The words for a part: its row's title, its own, or what stands before it. */
function words(part) {
  const label = part.closest(".ruledlab-row")?.querySelector(".ruledlab-label");
  return label?.title || part.title || said(label);
}

function name(root) {
  let named = 0;
  const give = (part, text) => {
    if (!text || part.hasAttribute("aria-label")) return;
    part.setAttribute("aria-label", text);
    named++;
  };
  for (const part of root.querySelectorAll(".noUi-handle, input, select"))
    if (![...(part.labels ?? [])].some(said)) give(part, words(part));
  for (const player of root.querySelectorAll(".widget-play"))
    player.querySelectorAll("button").forEach((button, i) => give(button, PLAYER[i]));
  for (const head of root.querySelectorAll(".jupyter-widget-Collapse-header:not([role])")) {
    unfold(head);
    named++;
  }
  return named;
}

/** Make the head of a fold a button. */
function unfold(head) {
  const fold = head.parentElement;
  const tell = () =>
    head.setAttribute("aria-expanded", fold.classList.contains("jupyter-widget-Collapse-open"));
  head.setAttribute("role", "button");
  head.tabIndex = 0;
  head.dataset.lmSuppressShortcuts = "true"; // else JupyterLab takes Enter
  head.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    head.click();
  });
  new MutationObserver(tell).observe(fold, { attributes: true, attributeFilter: ["class"] });
  tell();
}

function render({ el }) {
  el.style.display = "none";
  let timer = 0;
  const observer = new MutationObserver(() => name(observed) && wait());
  let observed = null;
  const wait = () => {
    clearTimeout(timer);
    timer = setTimeout(() => observer.disconnect(), QUIET);
  };
  const frame = requestAnimationFrame(() => {
    observed = el.closest(".ruledlab");
    if (!observed) return;
    name(observed);
    observer.observe(observed, { childList: true, subtree: true });
    wait();
  });
  return () => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    observer.disconnect();
  };
}

export default { render };
