// Files and the clipboard: what only the browser can do. No geometry here.

const LARGEST = 1_000_000;

function button(words, tooltip, action) {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = words;
  element.title = tooltip;
  element.className = "jupyter-button widget-button ruledlab-share-button";
  element.addEventListener("click", action);
  return element;
}

function field(label) {
  const input = document.createElement("input");
  input.type = "text";
  input.spellcheck = false;
  input.setAttribute("aria-label", label);
  input.placeholder = label;
  return input;
}

function download(name, mime, data) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([data], { type: mime }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

async function open(model, file) {
  if (file.size > LARGEST) {
    const size = (file.size / 1e6).toFixed(1);
    model.send({ refused: `${file.name}: a design is a few kB; this file has ${size} MB; choose another` });
    return;
  }
  try {
    model.send({ open: await file.text(), name: file.name });
  } catch (error) {
    model.send({ refused: `${file.name}: the browser cannot read it (${error.message})` });
  }
}

async function copy(model, input) {
  input.select();
  try {
    await navigator.clipboard.writeText(model.get("text"));
    model.set("said", "copied: paste it into a chat");
  } catch {
    model.set("said", "selected: press Ctrl+C to copy");
  }
  model.save_changes();
}

function row(...children) {
  const element = document.createElement("div");
  element.className = "ruledlab-share-row";
  element.append(...children);
  return element;
}

function render({ model, el }) {
  el.classList.add("ruledlab-share");
  const chooser = document.createElement("input");
  chooser.type = "file";
  chooser.accept = ".json,application/json";
  chooser.className = "ruledlab-share-file";
  chooser.setAttribute("aria-label", "open a design saved as JSON");
  chooser.addEventListener("change", () => {
    if (chooser.files.length) open(model, chooser.files[0]);
    chooser.value = "";
  });
  const text = field("this design as a text");
  text.readOnly = true;
  const pasted = field("paste a design's text here");
  const load = () => {
    if (pasted.value.trim()) model.send({ paste: pasted.value });
  };
  pasted.addEventListener("keydown", (event) => event.key === "Enter" && load());
  const error = document.createElement("div");
  error.className = "ruledlab-error";
  error.setAttribute("role", "alert");
  const said = document.createElement("div");
  said.className = "ruledlab-note";
  said.setAttribute("role", "status");
  el.append(
    row(
      button("Save design", "save the design as a JSON file", () => model.send({ ask: "json" })),
      button("Open design…", "open a JSON file", () => chooser.click()),
      chooser,
      button("Plots as PNG", "save the plots as a picture", () => model.send({ ask: "png" })),
      button("Plots as SVG", "save the plots as a drawing", () => model.send({ ask: "svg" })),
    ),
    row(text, button("Copy", "copy this text", () => copy(model, text))),
    row(pasted, button("Load", "load the design in the text", load)),
    error,
    said,
  );
  const show = () => {
    text.value = model.get("text");
    error.textContent = model.get("error");
    said.textContent = model.get("said");
  };
  const save = (content, buffers) => {
    if (content.save) download(content.save, content.mime, buffers[0]);
  };
  model.on("change:text change:error change:said", show);
  model.on("msg:custom", save);
  show();
  return () => {
    model.off("change:text change:error change:said", show);
    model.off("msg:custom", save);
  };
}

export default { render };
