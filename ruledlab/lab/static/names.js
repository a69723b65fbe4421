// What ipywidgets leaves out for those who use keyboard or screen reader: names for slider handles,
// fields, menus and the player's buttons; toggles that say whether they are pressed; folds that open
// by keyboard; the role of what is spoken when it changes. It keeps the keys pressed in the app from
// JupyterLab, for which a letter is a command on the whole cell, and tells the kernel whether the
// page is dark.

const PLAYER = ["play or pause", "stop and go back to the start", "repeat"];
const TOGGLES = ":is(.widget-toggle-button, .widget-play button:nth-child(3)):not([aria-pressed])";
const QUIET = 20_000; // ms without a new part after which nothing more is expected

const said = (node) => (node?.textContent ?? "").replace(/\u200b/g, "").trim();

/** The words for a part: its row's title, its own, or what stands before it. */
function words(part) {
  const label = part.closest(".ruledlab-row")?.querySelector(".ruledlab-label");
  return label?.title || part.title || said(label);
}

/** What matches a selector in a part of the page, the part itself included. */
const within = (root, selector) => [
  ...(root.matches(selector) ? [root] : []),
  ...root.querySelectorAll(selector),
];

const given = new WeakMap(); // parts to the names they have from here
const followed = new WeakSet();

function name(root) {
  let named = 0;
  const give = (part, text) => {
    const has = part.getAttribute("aria-label");
    if (!text || has === text || (has !== null && has !== given.get(part))) return;
    part.setAttribute("aria-label", text);
    given.set(part, text);
    named++;
  };
  for (const label of within(root, ".ruledlab-label")) follow(label);
  for (const part of within(root, ".noUi-handle, input, select"))
    if (![...(part.labels ?? [])].some(said)) give(part, words(part));
  for (const part of within(root, ".ruledlab-live:not([role])")) part.setAttribute("role", "status");
  for (const button of within(root, ".widget-play button")) {
    const { title, children } = button.parentElement;
    give(button, [PLAYER[[...children].indexOf(button)], title].filter(Boolean).join(": "));
  }
  for (const head of within(root, ".jupyter-widget-Collapse-header:not([role])")) {
    unfold(head);
    named++;
  }
  for (const toggle of within(root, TOGGLES)) {
    reflect(toggle, "mod-active", toggle, "aria-pressed");
    named++;
  }
  return named;
}

/** Name a row's parts anew whenever its label changes. */
function follow(label) {
  const [host, row] = [".widget-html", ".ruledlab-row"].map((kind) => label.closest(kind));
  if (!host || !row || followed.has(host)) return;
  followed.add(host);
  new MutationObserver(() => name(row)).observe(host, { childList: true, subtree: true });
}

/** Make the head of a fold a button. */
function unfold(head) {
  const fold = head.parentElement;
  head.setAttribute("role", "button");
  head.tabIndex = 0;
  head.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    head.click();
  });
  reflect(fold, "jupyter-widget-Collapse-open", head, "aria-expanded");
}

/** Keep an attribute of a part saying whether a node has a class. */
function reflect(node, className, part, attribute) {
  const tell = () => part.setAttribute(attribute, node.classList.contains(className));
  new MutationObserver(tell).observe(node, { attributes: true, attributeFilter: ["class"] });
  tell();
}

/** Whether the page may have a key: shortcuts such as saving, and Shift + Enter, which runs on; in an
 *  exercise it is an Enter, and the answer is not lost. */
const isThePages = (event) =>
  event.ctrlKey ||
  event.metaKey ||
  (event.shiftKey && event.key === "Enter" && !event.target.closest(".ruledlab-exercise"));

/** Keep the app's keys from the page; return the function that ends it. */
function keepKeys(app) {
  const stop = (event) => isThePages(event) || event.stopPropagation();
  // For pages that look at a key before the app gets it: they pass over parts with this mark.
  const shield = (event) => {
    if (app.contains(event.target))
      event.target.toggleAttribute("data-lm-suppress-shortcuts", !isThePages(event));
  };
  app.addEventListener("keydown", stop);
  window.addEventListener("keydown", shield, true);
  return () => {
    app.removeEventListener("keydown", stop);
    window.removeEventListener("keydown", shield, true);
  };
}

const THEMED = {
  attributes: true,
  attributeFilter: ["data-jp-theme-light", "data-jp-theme-name", "data-theme", "class", "style"],
};

const PREFERS_DARK = matchMedia("(prefers-color-scheme: dark)");

/** Whether the page is dark: as JupyterLab says, else by the colour behind the app. */
function isDark(from) {
  const told = document.body.dataset.jpThemeLight;
  if (told !== undefined) return told === "false";
  for (let node = from; node; node = node.parentElement) {
    const [r, g, b, a = 1] = (getComputedStyle(node).backgroundColor.match(/[\d.]+/g) ?? []).map(Number);
    if (a > 0.5) return 0.299 * r + 0.587 * g + 0.114 * b < 128;
  }
  return PREFERS_DARK.matches;
}

/** Keep the model's `dark` true to the page; return the function that ends it. */
function watchTheme(model, app) {
  const report = () => {
    if (model.get("dark") === isDark(app)) return;
    model.set("dark", isDark(app));
    model.save_changes();
  };
  const observer = new MutationObserver(report);
  observer.observe(document.body, THEMED);
  observer.observe(document.documentElement, THEMED);
  PREFERS_DARK.addEventListener("change", report);
  report();
  return () => {
    observer.disconnect();
    PREFERS_DARK.removeEventListener("change", report);
  };
}

function render({ model, el }) {
  el.style.display = "none";
  let stops = [];
  let timer = 0;
  // Only what is new: numbers and pictures change with every move, and have no names to be given.
  const arrived = (changes) => changes.flatMap(({ addedNodes }) => [...addedNodes]);
  const observer = new MutationObserver((changes) => {
    const parts = arrived(changes).filter((node) => node.nodeType === Node.ELEMENT_NODE);
    if (parts.map(name).some(Boolean)) wait();
  });
  const wait = () => {
    clearTimeout(timer);
    timer = setTimeout(() => observer.disconnect(), QUIET);
  };
  const frame = requestAnimationFrame(() => {
    const app = el.closest(".ruledlab");
    if (!app) return;
    stops = [watchTheme(model, app), keepKeys(app)];
    name(app);
    observer.observe(app, { childList: true, subtree: true });
    wait();
  });
  return () => {
    cancelAnimationFrame(frame);
    for (const stop of stops) stop();
    clearTimeout(timer);
    observer.disconnect();
  };
}

export default { render };
