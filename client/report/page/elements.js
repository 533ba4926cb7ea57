"use strict";
// Elements of the page, sections and tables.
const SVG = "http://www.w3.org/2000/svg";
const page = document.getElementById("page");
const { nonce: NONCE } = document.currentScript; // without which a page that is served runs no script

// An element with attributes and children; strings become text. The attribute `on` holds handlers by event.
function el(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "on") for (const [event, handler] of Object.entries(value)) element.addEventListener(event, handler);
    else if (value !== null && value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children.flat(3).filter((child) => child !== null && child !== undefined));
  return element;
}

function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children.flat(3).filter((child) => child !== null && child !== undefined));
  return element;
}

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// Appends a section with a heading that the table of contents can name.
function section(title, note, ...content) {
  const id = title.toLowerCase().replace(/[^a-z0-9]+/g, "-");
  const made = el(
    "section",
    { id, "aria-labelledby": `${id}-title` },
    el("h2", { id: `${id}-title` }, title),
    note ? el("p", { class: "note" }, note) : null,
    ...content,
  );
  page.append(made);
  return made;
}

// A table that scrolls sideways in its own box; `numeric` holds the columns that are set flush right.
function table(head, rows, numeric, caption) {
  const cell = (value, i) =>
    el(i === 0 ? "th" : "td", { class: numeric.includes(i) ? "n" : null, scope: i === 0 ? "row" : null }, value);
  return el(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption || "Table" },
    el(
      "table",
      { class: rows.length > 8 ? null : "short" },
      el(
        "thead",
        {},
        el(
          "tr",
          {},
          head.map((h, i) => el("th", { class: numeric.includes(i) ? "n" : null, scope: "col" }, h)),
        ),
      ),
      el(
        "tbody",
        {},
        rows.map((row) => el("tr", {}, row.map(cell))),
      ),
    ),
  );
}

const button = (label, handler, attributes = {}) =>
  el("button", { type: "button", on: { click: handler }, ...attributes }, label);

// Buttons of which one is pressed; `choose(value)` is called with the value of the one that is.
function choice(name, options, first, choose) {
  const group = el("div", { class: "seg", role: "group", "aria-label": name });
  for (const [value, label] of options) {
    group.append(
      button(
        label,
        () => {
          for (const other of group.children) other.setAttribute("aria-pressed", String(other.dataset.value === value));
          choose(value);
        },
        { "data-value": value, "aria-pressed": String(value === first) },
      ),
    );
  }
  return group;
}

function switchBox(label, on, change) {
  const box = el("input", {
    type: "checkbox",
    ...(on ? { checked: "" } : {}),
    on: { change: () => change(box.checked) },
  });
  return el("label", { class: "switch" }, box, ` ${label}`);
}

// Hands a file to the browser.
function download(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
