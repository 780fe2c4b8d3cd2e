// Elements of the page. Whatever comes from the store becomes text of an element, never HTML.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined)
      element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function byId(id) {
  return document.getElementById(id);
}

// A table. columns: {title, number}, rows: of text or elements. It scrolls by itself where the
// screen is narrow.
function makeTable(columns, rows, {caption = null, tall = false, label = null} = {}) {
  const head = make("tr", {}, ...columns.map(({title, number}) =>
    make("th", {scope: "col", class: number ? "number" : null}, title)));
  const body = rows.map((row) => make("tr", {}, ...row.map((cell, place) =>
    make("td", {class: columns[place].number ? "number" : columns[place].message ? "message" : null},
      cell instanceof Node ? cell : cell === null || cell === undefined ? noValue : String(cell)))));
  return make("div", {class: tall ? "wide tall" : "wide", tabindex: "0", role: "region",
      "aria-label": label ?? caption ?? "table"},
    make("table", {}, caption ? make("caption", {}, caption) : null, make("thead", {}, head),
      make("tbody", {}, ...body)));
}

function makeMeter(fraction, text) {
  const part = Math.min(1, Math.max(0, fraction || 0));
  const bar = make("span");
  bar.style.width = `${100 * part}%`;
  return make("span", {class: "meter", role: "img", "aria-label": text ?? percentText(part)}, bar);
}

function makeFigures(pairs) {
  return make("dl", {class: "figures"}, ...pairs.filter(Boolean).map(([term, value]) =>
    make("div", {}, make("dt", {}, term), make("dd", {}, value))));
}

function download(name, text, type = "text/csv") {
  const address = URL.createObjectURL(new Blob([text], {type}));
  const link = make("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
