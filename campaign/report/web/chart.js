// A plot of curves that one can hover, zoom and switch off, by mouse, finger and keyboard.
//
//   const chart = new Chart(container, "a2 against tau");
//   chart.draw({curves, x: {label, log, time}, y: {label, log}, errors: true});
//
// A curve: {key, label, colour, x, y, error, symbols, stepped, dash}. error may be missing, or have
// values that are not finite where none is known. Curves whose key is in `hidden` are not drawn. A curve
// with `of` goes along with the curve of that key: it is shown and hidden with it, and is not read.

class Chart {
  constructor(container, name, {legend = true, zoom = true, height = 400, onToggle = null} = {}) {
    this.hidden = new Set();
    this.curves = [];
    this.height = height;
    this.onToggle = onToggle;
    this.zoomed = null;  // the part of x that is shown, once chosen
    this.tip = make("div", {class: "tip", hidden: true});
    this.said = make("p", {class: "quiet", role: "status", "aria-live": "polite"});
    this.plot = make("div", {class: "plot", tabindex: "0", role: "application",
      "aria-label": `${name}. Left and right move along a curve, up and down to the next curve, ` +
        "plus and minus zoom, 0 shows all, Escape hides the reading.",
      onkeydown: (event) => this.key(event)});
    this.legend = legend ? make("div", {class: "legend", role: "group", "aria-label": "Curves"}) : null;
    container.replaceChildren(make("div", {class: "chart"}, zoom ? this.makeTools() : null, this.plot,
      this.tip, this.said, this.legend));
    this.fingers = new Map();
    new ResizeObserver(() => this.fit()).observe(this.plot);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
  }

  makeTools() {
    const number = (label) => make("input", {type: "number", step: "any", "aria-label": label,
      onchange: () => this.zoomTo(parseFloat(this.from.value), parseFloat(this.to.value))});
    this.from = number("From x");
    this.to = number("To x");
    this.tools = make("div", {class: "tools"},
      make("button", {type: "button", "aria-label": "Zoom in", onclick: () => this.zoom(0.5)}, "+"),
      make("button", {type: "button", "aria-label": "Zoom out", onclick: () => this.zoom(2)}, "−"),
      make("button", {type: "button", onclick: () => this.showAll()}, "All"),
      make("label", {}, "from ", this.from), make("label", {}, "to ", this.to));
    return this.tools;
  }

  draw({curves, x, y, errors = true}) {
    this.asked = {curves, x, y, errors};
    this.curves = curves;
    this.uplot?.destroy();
    this.uplot = null;
    this.tip.hidden = true;
    this.align(x, y);
    this.drawLegend();
    if (curves.length === 0 || this.data[0].length === 0) {
      this.plot.replaceChildren(make("p", {class: "quiet"}, "There is nothing to draw."));
      return;
    }
    this.plot.replaceChildren();
    this.uplot = new uPlot(this.options(x, y, errors), this.data, this.plot);
    this.listenToFingers(this.uplot.over);
    if (this.zoomed) this.uplot.setScale("x", this.zoomed);
    this.showRange();
  }

  redraw() {
    if (this.asked) this.draw({...this.asked, curves: this.asked.recolour?.() ?? this.asked.curves});
  }

  // One column of x for all curves, and for each a column of y and one of errors on it.
  align(x, y) {
    const usable = (value, log) => Number.isFinite(value) && (!log || value > 0);
    const all = new Set();
    for (const curve of this.curves)
      for (const value of curve.x) if (usable(value, x.log)) all.add(value);
    const xs = Float64Array.from(all).sort();
    const place = new Map();
    xs.forEach((value, k) => place.set(value, k));
    this.data = [Array.from(xs)];
    this.errors = [];
    for (const curve of this.curves) {
      const column = new Array(xs.length).fill(null), error = new Array(xs.length).fill(null);
      curve.x.forEach((value, k) => {
        const where = place.get(value);
        if (where === undefined || !usable(curve.y[k] ?? NaN, y.log)) return;
        column[where] = curve.y[k];
        if (Number.isFinite(curve.error?.[k] ?? NaN)) error[where] = curve.error[k];
      });
      this.data.push(column);
      this.errors.push(error);
    }
  }

  options(x, y, errors) {
    const axis = (which, {label, log}) => ({
      label, stroke: cssColour("--quiet"), labelFont: "13px system-ui, sans-serif",
      font: "12px system-ui, sans-serif", labelSize: 22, size: which === "y" ? 62 : 34,
      grid: {stroke: cssColour("--line"), width: 1}, ticks: {stroke: cssColour("--line"), width: 1},
      values: x.time && which === "x" ? undefined : (self, splits) => splits.map((value) =>
        value === null || (log && !isRound(value)) ? "" : numberText(value, 4)),
    });
    return {
      ...this.size(), legend: {show: false},
      scales: {x: {time: x.time === true, distr: x.log ? 3 : 1}, y: {distr: y.log ? 3 : 1}},
      axes: [axis("x", x), axis("y", y)],
      series: [{}, ...this.curves.map((curve) => ({
        label: curve.label, stroke: curve.colour, width: curve.symbols || curve.of ? 1 : 1.7, dash: curve.dash,
        spanGaps: !curve.stepped, show: !this.isHidden(curve),
        paths: curve.stepped ? uPlot.paths.stepped({align: 1}) : undefined,
        fill: curve.stepped ? withAlpha(curve.colour, 0.15) : undefined,
        points: curve.symbols ? {show: true, size: 7, fill: curve.colour} : {show: false},
      }))],
      cursor: {drag: {x: true, y: true, uni: 24}, dataIdx: nearestWithValue,
        points: {size: 6}},
      hooks: {
        drawAxes: [(self) => { if (errors) this.drawErrors(self); }],
        setCursor: [(self) => this.hover(self)],
        setScale: [(self, name) => { if (name === "x") this.showRange(); }],
        setSelect: [() => { this.zoomed = "pending"; }],
      },
    };
  }

  size() {
    const width = Math.max(240, this.plot.clientWidth);
    return {width, height: Math.min(this.height, Math.max(260, 0.8 * width))};
  }

  fit() {
    if (this.uplot && this.size().width !== this.uplot.width) this.uplot.setSize(this.size());
  }

  // A band behind a line, bars on symbols.
  drawErrors(self) {
    const {ctx, bbox} = self;
    const low = self.scales.y.min;
    const at = (value) => self.valToPos(self.scales.y.distr === 3 ? Math.max(value, low) : value, "y", true);
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    this.curves.forEach((curve, k) => {
      const errors = this.errors[k], values = this.data[k + 1];
      if (!self.series[k + 1].show || !errors.some((error) => error !== null)) return;
      const points = [];
      errors.forEach((error, i) => {
        if (error !== null)
          points.push([self.valToPos(this.data[0][i], "x", true), at(values[i] - error), at(values[i] + error)]);
      });
      if (curve.symbols) {
        ctx.strokeStyle = curve.colour;
        ctx.lineWidth = 1.2 * devicePixelRatio;
        ctx.beginPath();
        for (const [x, from, to] of points) {
          ctx.moveTo(x, from);
          ctx.lineTo(x, to);
        }
        ctx.stroke();
      } else {
        ctx.fillStyle = withAlpha(curve.colour, 0.2);
        ctx.beginPath();
        for (const [x, from] of points) ctx.lineTo(x, from);
        for (const [x, , to] of points.slice().reverse()) ctx.lineTo(x, to);
        ctx.fill();
      }
    });
    ctx.restore();
  }

  // ---- reading values ---------------------------------------------------------------------------

  readingText(k, i) {
    const curve = this.curves[k];
    const x = this.data[0][i];
    const error = this.errors[k][i];
    const value = this.data[k + 1][i];
    return {label: curve.label, x: this.asked.x.time ? timeText(x) : numberText(x),
      y: error !== null ? valueWithError(value, error) : numberText(value)};
  }

  hover(self) {
    const {left, top, idxs} = self.cursor;
    let best = null, least = Infinity;
    if (left >= 0)
      for (let k = 0; k < this.curves.length; ++k) {
        const i = idxs?.[k + 1];
        if (this.curves[k].of || !self.series[k + 1].show || i === null || i === undefined || this.data[k + 1][i] === null) continue;
        const dx = self.valToPos(this.data[0][i], "x") - left;
        const dy = self.valToPos(this.data[k + 1][i], "y") - top;
        const distance = Math.hypot(dx, dy);
        if (distance < least) [least, best] = [distance, {k, i}];
      }
    this.tip.hidden = best === null;
    if (best === null) return;
    this.at = best;
    const {label, x, y} = this.readingText(best.k, best.i);
    const swatch = make("b", {}, label);
    swatch.style.color = this.curves[best.k].colour;
    this.tip.replaceChildren(swatch, make("br"), `x ${x}`, make("br"), `y ${y}`);
    const over = self.over;
    const px = self.valToPos(this.data[0][best.i], "x") + over.offsetLeft;
    const py = self.valToPos(this.data[best.k + 1][best.i], "y") + over.offsetTop + this.plot.offsetTop;
    const flip = px > this.plot.clientWidth / 2;
    this.tip.style.left = flip ? "auto" : `${px + 12}px`;
    this.tip.style.right = flip ? `${this.plot.clientWidth - px + 12}px` : "auto";
    this.tip.style.top = `${Math.max(0, py - 18)}px`;
  }

  // ---- keyboard ---------------------------------------------------------------------------------

  key(event) {
    if (!this.uplot || event.ctrlKey || event.metaKey || event.altKey) return;
    const moves = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]};
    if (event.key in moves) this.move(...moves[event.key], event.shiftKey ? 10 : 1);
    else if (event.key === "+" || event.key === "=") this.zoom(0.5);
    else if (event.key === "-") this.zoom(2);
    else if (event.key === "0" || event.key === "Home") this.showAll();
    else if (event.key === "Escape") {
      this.uplot.setCursor({left: -10, top: -10});
      this.tip.hidden = true;
    } else return;
    event.preventDefault();
  }

  // To the next curve that is shown, and along it to the next point that has a value.
  move(curves, points, times) {
    const shown = this.curves.map((curve, k) => k).filter((k) => !this.curves[k].of && !this.isHidden(this.curves[k]));
    if (shown.length === 0) return;
    let place = Math.max(0, shown.indexOf(this.at?.k ?? -1));
    place = (place + curves + shown.length) % shown.length;
    const k = shown[place], column = this.data[k + 1];
    const {min, max} = this.uplot.scales.x;
    let i = this.at?.i ?? this.data[0].findIndex((x) => x >= min);
    i = nearestWithValue(this.uplot, k + 1, Math.max(0, i)) ?? 0;
    for (let step = 0; step < times && points !== 0; ++step) {
      let next = i + points;
      while (next >= 0 && next < column.length && column[next] === null) next += points;
      if (next < 0 || next >= column.length) break;
      i = next;
    }
    const x = this.data[0][i];
    if (x < min || x > max) this.zoomTo(x - (max - min) / 2, x + (max - min) / 2);
    this.uplot.setCursor({left: this.uplot.valToPos(x, "x"), top: this.uplot.valToPos(column[i], "y")});
    this.at = {k, i};
    const reading = this.readingText(k, i);
    this.said.textContent = `${reading.label}: x ${reading.x}, y ${reading.y}`;
  }

  // ---- zoom -------------------------------------------------------------------------------------

  zoom(factor) {
    if (!this.uplot) return;
    const {min, max} = this.uplot.scales.x;
    const log = this.asked.x.log;
    const [a, b] = log ? [Math.log(min), Math.log(max)] : [min, max];
    const chosen = this.at && !this.tip.hidden ? this.data[0][this.at.i] : null;
    const middle = chosen !== null ? (log ? Math.log(chosen) : chosen) : (a + b) / 2;
    const from = middle + (a - middle) * factor, to = middle + (b - middle) * factor;
    this.zoomTo(log ? Math.exp(from) : from, log ? Math.exp(to) : to);
  }

  zoomTo(from, to) {
    if (!this.uplot || !Number.isFinite(from) || !Number.isFinite(to) || !(from < to)) return;
    const xs = this.data[0], first = xs[0], last = xs[xs.length - 1];
    if (from <= first && to >= last) return this.showAll();
    this.zoomed = {min: Math.max(from, first), max: Math.min(to, last)};
    this.uplot.setScale("x", this.zoomed);
  }

  showAll() {
    this.zoomed = null;
    this.uplot?.setData(this.data);
  }

  showRange() {
    if (!this.uplot) return;
    const {min, max} = this.uplot.scales.x;
    if (this.zoomed === "pending") this.zoomed = {min, max};
    if (!this.tools || min === null || this.asked.x.time) return;
    this.from.value = numberText(min, 5);
    this.to.value = numberText(max, 5);
  }

  // Two fingers stretch x; what is under them stays there. One finger reads values.
  listenToFingers(over) {
    const place = (event) => event.clientX - over.getBoundingClientRect().left;
    over.addEventListener("pointerdown", (event) => {
      if (event.pointerType !== "touch") return;
      this.fingers.set(event.pointerId, place(event));
      if (this.fingers.size === 2)
        this.held = [...this.fingers.values()].map((x) => this.uplot.posToVal(x, "x"));
    });
    over.addEventListener("pointermove", (event) => {
      if (!this.fingers.has(event.pointerId)) return;
      this.fingers.set(event.pointerId, place(event));
      if (this.fingers.size === 1) {
        const box = over.getBoundingClientRect();
        this.uplot.setCursor({left: place(event), top: event.clientY - box.top});
      } else if (this.fingers.size === 2) this.pinch(over.clientWidth);
    });
    for (const end of ["pointerup", "pointercancel", "pointerleave"])
      over.addEventListener(end, (event) => this.fingers.delete(event.pointerId));
  }

  pinch(width) {
    const log = this.asked.x.log, bend = log ? Math.log : Number, unbend = log ? Math.exp : Number;
    const [p, q] = this.fingers.values();
    if (Math.abs(p - q) < 10) return;
    const [a, b] = this.held.map(bend);
    const perPixel = (b - a) / (q - p);
    if (!(perPixel > 0)) return;
    this.zoomTo(unbend(a - p * perPixel), unbend(a + (width - p) * perPixel));
  }

  // ---- legend -----------------------------------------------------------------------------------

  isHidden(curve) {
    return this.hidden.has(curve.of ?? curve.key);
  }

  drawLegend() {
    if (!this.legend) return;
    this.legend.replaceChildren(...this.curves.filter((curve) => !curve.of).map((curve) => {
      const line = make("i");
      line.style.borderTopColor = curve.colour;
      if (curve.dash) line.style.borderTopStyle = "dashed";
      return make("button", {type: "button", "aria-pressed": String(!this.hidden.has(curve.key)),
        onclick: (event) => this.toggle(curve.key, event.currentTarget)}, line, curve.label);
    }));
  }

  toggle(key, button) {
    this.hidden.has(key) ? this.hidden.delete(key) : this.hidden.add(key);
    this.curves.forEach((curve, k) => {
      if ((curve.of ?? curve.key) === key) this.uplot?.setSeries(k + 1, {show: !this.isHidden(curve)});
    });
    button.setAttribute("aria-pressed", String(!this.hidden.has(key)));
    this.onToggle?.();
  }

  shown() {
    return this.curves.filter((curve) => !curve.of && !this.isHidden(curve));
  }
}

// The point nearest to the cursor's at which this curve has a value.
function nearestWithValue(self, series, index) {
  const column = self.data[series], xs = self.data[0];
  if (column[index] !== null && column[index] !== undefined) return index;
  let below = index - 1, above = index + 1;
  while (below >= 0 && column[below] === null) --below;
  while (above < column.length && column[above] === null) ++above;
  if (below < 0 && above >= column.length) return null;
  if (below < 0) return above;
  if (above >= column.length) return below;
  return xs[index] - xs[below] <= xs[above] - xs[index] ? below : above;
}

function isRound(value) {
  const digits = Math.log10(Math.abs(value));
  return Math.abs(digits - Math.round(digits)) < 1e-9;
}

function withAlpha(colour, alpha) {
  return `color-mix(in srgb, ${colour} ${100 * alpha}%, transparent)`;
}
