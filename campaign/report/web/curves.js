// Averages over realizations against τ, time or x: a curve for each gas.

// What the tables hold, with its symbol; others appear under their column's name.
const quantityLabels = {
  temperature: "T / E(0), granular temperature", gamma_ratio: "γ / γ₀, decay rate",
  collision_rate: "ω, collision rate", pressure: "p, pressure [E(0) σ⁻ᵈ]",
  a2: "a₂", a3: "a₃", a4: "a₄", a5: "a₅", a6: "a₆",
  correlation_trace: "Tr G⁺(0)", largest_cluster: "largest cluster, part of the particles",
  rotational_temperature: "temperature of rotation [E(0)]",
  temperature_1: "temperature of species 1 [E(0)]", temperature_2: "temperature of species 2 [E(0)]",
  rho: "ρ(c), velocity distribution", G_parallel: "G∥(r)", G_perpendicular: "G⊥(r)", S: "S(k)",
  tail: "ρ(c) beyond c = 3", g: "g(r), first point at contact", E_perpendicular: "E⊥(k) [E(0) σ]",
  E_parallel: "E∥(k) [E(0) σ]", enstrophy: "k² E⊥(k) [E(0)/σ]", cluster_sizes: "share of particles in clusters of s to 2s−1",
  mean_cluster: "mean size of a particle's cluster", msd: "mean square displacement [σ²]",
  diffusion: "D / ω [σ²]", vacf: "correlation of velocities with those at τ_w",
  free_times: "density of free times", impacts: "density of impact parameters",
  normal_speeds: "density of speeds of approach", time: "t, time",
};
const profileX = {rho: "c = v / v₀", tail: "c = v / v₀", G_parallel: "r / σ", G_perpendicular: "r / σ", S: "k σ",
  g: "r / σ", E_perpendicular: "k σ", E_parallel: "k σ", enstrophy: "k σ", cluster_sizes: "s, particles",
  msd: "τ − τ_w", diffusion: "τ − τ_w", vacf: "τ − τ_w", free_times: "ω t", impacts: "(b / σ)ᵈ⁻¹",
  normal_speeds: "v_n (μ / T)^½"};
const ofInterval = new Set(["gamma_ratio", "collision_rate", "pressure"]);  // before its τ
const gasNames = ["d", "e", "n", "particles", "equilibrate", "sample_every", "effects"];
const filterLabels = {d: "d", e: "e", n: "n", particles: "N", equilibrate: "equilibrate",
  sample_every: "sample every", effects: "effects"};

// Theories are drawn beside each curve, in its colour, the k-th of them with the k-th of these dashes.
const theoryDashes = [[2, 3], [9, 3], [9, 3, 2, 3], [4, 4], [14, 4], [1, 5]];

// A colour for each value of the parameter that has most of them among these gases, a dash for each of
// the next one.
function stylesOf(gases) {
  const values = new Map(gasNames.map((name) => [name, [...new Set(gases.map((gas) => gas[name]))]
    .sort((a, b) => typeof a === "number" ? a - b : String(a).localeCompare(String(b)))]));
  const [first, second] = [...gasNames].sort((a, b) => values.get(b).length - values.get(a).length);
  const dashes = [undefined, [8, 4], [12, 3, 3, 3], [5, 5], [12, 3, 3, 3, 3, 3]];
  return (gas) => ({
    colour: colourOf(values.get(first).indexOf(gas[first]), values.get(first).length),
    dash: dashes[values.get(second).indexOf(gas[second]) % dashes.length],
  });
}

// A piece of a dashed line, for a label.
function dashSample(dash) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
  for (const [name, value] of Object.entries({width: 30, height: 8, "aria-hidden": "true"})) svg.setAttribute(name, value);
  for (const [name, value] of Object.entries({x1: 0, y1: 4, x2: 30, y2: 4, stroke: "currentColor", "stroke-width": 2,
    "stroke-dasharray": dash.join(" ")})) line.setAttribute(name, value);
  svg.append(line);
  return svg;
}

class Curves {
  constructor(database) {
    this.database = database;
    this.off = new Map();  // by name of a parameter: the values that are switched off
    this.chosen = {quantity: null, x: "tau", tau: null, logX: false, logY: false, errors: true};
    this.withoutTheories = new Set();  // theories, by their names, that are switched off
    this.chart = new Chart(byId("curve-chart"), "Averages over realizations",
      {height: 460, onToggle: () => {}});
    this.chart.tools.append(make("button", {type: "button", onclick: () => this.save()}, "Download CSV"));
  }

  // Everything again from the tables; choices stay where they still mean something.
  async refresh() {
    const {rows: columns} = await this.database.query(
      "SELECT 'mean_series', name FROM pragma_table_info('mean_series') UNION ALL " +
      "SELECT 'mean_temperatures', name FROM pragma_table_info('mean_temperatures')");
    this.quantities = [];
    for (const table of ["mean_series", "mean_temperatures"]) {
      const names = columns.filter(([of]) => of === table).map(([, name]) => name)
        .filter((name) => columns.some(([of, other]) => of === table && other === name + "_se"))
        .filter((name) => !this.quantities.some((known) => known.name === name));
      if (names.length === 0) continue;
      const {rows: [counts]} = await this.database.query(
        `SELECT ${names.map((name) => `count(${name})`).join(", ")} FROM ${table}`);
      names.forEach((name, k) => { if (counts[k] > 0) this.quantities.push({name, table}); });
    }
    const profiles = await this.database.query("SELECT DISTINCT name FROM mean_profiles ORDER BY name");
    for (const [name] of profiles.rows) this.quantities.push({name, table: "mean_profiles"});
    const order = Object.keys(quantityLabels);
    const placeOf = ({name}) => order.includes(name) ? order.indexOf(name) : order.length;
    this.quantities.sort((a, b) => placeOf(a) - placeOf(b));
    if (!this.quantities.some(({name}) => name === this.chosen.quantity)) {
      this.chosen.quantity = this.quantities[0]?.name ?? null;
      this.chosen.logY = this.chosen.quantity === "temperature";
    }
    await this.show();
  }

  quantity() {
    return this.quantities.find(({name}) => name === this.chosen.quantity);
  }

  // Reads what is chosen and shows it, one choice after the other: answers to an earlier choice must
  // not replace those to a later one.
  show() {
    this.shown = (this.shown ?? Promise.resolve()).catch(() => {}).then(() => this.showChosen());
    return this.shown;
  }

  async showChosen() {
    const quantity = this.quantity();
    if (!quantity) {
      byId("curve-choices").replaceChildren(make("p", {class: "quiet"},
        "No cooling run is done yet: averages are of finished runs."));
      byId("curve-filters").replaceChildren();
      this.chart.draw({curves: [], x: {label: ""}, y: {label: ""}});
      return;
    }
    this.taus = [];
    if (quantity.table === "mean_profiles") {
      const {rows} = await this.database.query(
        "SELECT DISTINCT tau FROM mean_profiles WHERE name = ? ORDER BY tau", {parameters: [quantity.name]});
      this.taus = rows.map(([tau]) => tau);
      if (!this.taus.includes(this.chosen.tau)) this.chosen.tau = this.taus[this.taus.length - 1];
    }
    this.gases = await this.read(quantity);
    await this.readTheories(quantity);
    this.showChoices(quantity);
    this.showFilters();
    this.draw();
    byId("curve-chart").dataset.quantity = quantity.name;
  }

  // [{d, e, ..., x, y, se, realizations}], a gas each.
  async read({name, table}) {
    const isProfile = table === "mean_profiles";
    const time = table === "mean_series" ? "time" : "NULL";
    const {rows} = await this.database.query(isProfile
      ? `SELECT ${gasNames.join(", ")}, x, NULL, value, value_se, realizations FROM mean_profiles ` +
        "WHERE name = ? AND tau = ? AND value IS NOT NULL ORDER BY d, n, particles, e, effects, equilibrate, sample_every, x"
      : `SELECT ${gasNames.join(", ")}, tau, ${time}, "${name}", "${name}_se", realizations FROM ${table} ` +
        `WHERE "${name}" IS NOT NULL ORDER BY d, n, particles, e, effects, equilibrate, sample_every, tau`,
      {parameters: isProfile ? [name, this.chosen.tau] : null});
    const gases = new Map();
    for (const row of rows) {
      const key = JSON.stringify(row.slice(0, gasNames.length));
      if (!gases.has(key))
        gases.set(key, {key, ...Object.fromEntries(gasNames.map((gas, k) => [gas, row[k]])),
          tau: [], time: [], y: [], se: [], realizations: []});
      const gas = gases.get(key);
      const [x, t, y, se, realizations] = row.slice(gasNames.length);
      gas.tau.push(ofInterval.has(name) ? x - gas.sample_every / 2 : x);
      gas.time.push(t);
      gas.y.push(y);
      gas.se.push(se);
      gas.realizations.push(realizations);
    }
    return [...gases.values()];
  }

  // Of each gas [{line, tau, time, y}], as the program has computed them.
  async readTheories({name, table}) {
    const tau = table === "mean_profiles" ? this.chosen.tau : null;
    const {rows} = await this.database.query(
      `SELECT ${gasNames.join(", ")}, line, x, time, value FROM theory WHERE name = ? AND tau IS ? ORDER BY rowid`,
      {parameters: [name, tau]});
    const gases = new Map(this.gases.map((gas) => [gas.key, gas]));
    for (const gas of this.gases) gas.theories = [];
    this.theories = [];  // their names
    for (const row of rows) {
      const gas = gases.get(JSON.stringify(row.slice(0, gasNames.length)));
      if (!gas) continue;
      const [line, x, time, value] = row.slice(gasNames.length);
      if (!this.theories.includes(line)) this.theories.push(line);
      let theory = gas.theories.find((one) => one.line === line);
      if (!theory) gas.theories.push(theory = {line, tau: [], time: [], y: []});
      theory.tau.push(x);
      theory.time.push(time);
      theory.y.push(value);
    }
  }

  // x of a gas's points, or of those of a theory, by what is chosen.
  xOf(gas, {tau, time} = gas) {
    if (this.chosen.x === "time" && gas.time[0] !== null) return time;
    if (this.chosen.x === "haff") {
      const rate = gas.e === null ? NaN : (1 - gas.e * gas.e) / gas.d;
      return tau.map((each) => rate * each);
    }
    return tau;
  }

  showChoices({name, table}) {
    const isProfile = table === "mean_profiles";
    const change = (key, value, readAgain = false) => {
      this.chosen[key] = value;
      this.chart.zoomed = null;
      readAgain ? this.show() : this.draw();
    };
    const box = (key, label) => make("label", {}, make("input", {type: "checkbox",
      checked: this.chosen[key], onchange: (event) => change(key, event.target.checked)}), " " + label);
    const theoryBox = (line, k) => make("label", {class: "theory"}, make("input", {type: "checkbox",
      checked: !this.withoutTheories.has(line), onchange: (event) => {
        event.target.checked ? this.withoutTheories.delete(line) : this.withoutTheories.add(line);
        this.draw();
      }}), " ", dashSample(theoryDashes[k % theoryDashes.length]), " " + line);
    const select = (label, options, chosen, onchange) => make("label", {}, label + " ",
      make("select", {onchange: (event) => onchange(event.target.value)}, ...options.map(([value, text]) =>
        make("option", {value, selected: String(value) === String(chosen)}, text))));
    byId("curve-choices").replaceChildren(...[
      select("Show", this.quantities.map((one) => [one.name, quantityLabels[one.name] ?? one.name]), name,
        (value) => {
          this.chosen.logY = value === "temperature" || value === "rho";
          change("quantity", value, true);
        }),
      isProfile
        ? select("at τ", this.taus.map((tau) => [tau, numberText(tau)]), this.chosen.tau,
          (value) => change("tau", Number(value), true))
        : select("against", [["tau", "τ"], ["haff", "2γ₀τ"], ...table === "mean_series" && name !== "time" ? [["time", "t"]] : []],
          this.chosen.x, (value) => change("x", value)),
      box("logX", "log x"), box("logY", "log y"), box("errors", "errors"), ...this.theories.map(theoryBox),
    ].filter(Boolean));
  }

  // A box for each value of a parameter that has more than one.
  showFilters() {
    const parts = [];
    for (const name of gasNames) {
      const values = [...new Set(this.gases.map((gas) => gas[name]))];
      if (values.length < 2 && !["e", "n", "particles"].includes(name)) continue;
      values.sort((a, b) => typeof a === "number" ? a - b : String(a).localeCompare(String(b)));
      if (!this.off.has(name)) this.off.set(name, new Set());
      const off = this.off.get(name);
      const text = (value) => name === "particles" ? countText(value) : value === null ? "none"
        : value === "{}" ? "none" : numberText(value);
      const boxes = values.map((value) => make("input", {type: "checkbox", checked: !off.has(value),
        onchange: (event) => {
          event.target.checked ? off.delete(value) : off.add(value);
          this.draw();
        }}));
      const all = (on) => make("button", {type: "button", "aria-label": `${on ? "All" : "No"} ${filterLabels[name]}`,
        onclick: () => {
          values.forEach((value, k) => {
            on ? off.delete(value) : off.add(value);
            boxes[k].checked = on;
          });
          this.draw();
        }}, on ? "all" : "none");
      parts.push(make("fieldset", {}, make("legend", {}, filterLabels[name]),
        ...values.map((value, k) => make("label", {}, boxes[k], " " + text(value))),
        ...values.length > 2 ? [all(true), " ", all(false)] : []));
    }
    byId("curve-filters").replaceChildren(...parts);
  }

  // What sets the gases on show apart, as the label of a curve.
  labelOf(gas, shown) {
    const apart = gasNames.filter((name) => new Set(shown.map((one) => one[name])).size > 1);
    const names = apart.length > 0 ? apart : ["e", "n", "particles"];
    const order = ["e", "n", "particles", "d", "effects", "equilibrate", "sample_every"];
    return order.filter((name) => names.includes(name)).map((name) => {
      const value = gas[name];
      return `${filterLabels[name]} = ${name === "particles" ? countText(value) : value === null ? "none" : numberText(value)}`;
    }).join(", ");
  }

  draw() {
    const quantity = this.quantity();
    const shown = this.gases.filter((gas) => gasNames.every((name) => !this.off.get(name)?.has(gas[name])));
    const isProfile = quantity.table === "mean_profiles";
    const style = stylesOf(shown);
    const curves = shown.map((gas) => ({
      key: gas.key, gas, label: this.labelOf(gas, shown), ...style(gas), x: this.xOf(gas), y: gas.y,
      error: gas.se.map((se, i) => se === null ? NaN : se * studentFactor(gas.realizations[i])),
    }));
    for (const curve of curves.slice())
      for (const theory of curve.gas.theories) {
        const x = this.xOf(curve.gas, theory);
        if (this.withoutTheories.has(theory.line) || x.some((each) => each === null)) continue;
        const dash = theoryDashes[this.theories.indexOf(theory.line) % theoryDashes.length];
        curves.push({key: `theory ${theory.line} ${curve.key}`, of: curve.key, label: theory.line,
          colour: curve.colour, dash, x, y: theory.y});
      }
    const labels = {tau: "τ, collisions per particle", time: "t [σ (m/E(0))^½]", haff: "2γ₀τ"};
    this.chart.draw({curves, errors: this.chosen.errors,
      x: {label: isProfile ? profileX[quantity.name] ?? "x" : labels[this.chosen.x], log: this.chosen.logX},
      y: {label: quantityLabels[quantity.name] ?? quantity.name, log: this.chosen.logY}});
  }

  save() {
    const quantity = this.quantity();
    if (!quantity) return;
    const isProfile = quantity.table === "mean_profiles";
    const x = isProfile ? "x" : this.chosen.x === "haff" ? "2_gamma_0_tau" : this.chosen.x;
    const rows = [[...gasNames, ...isProfile ? ["tau"] : [], x, quantity.name, quantity.name + "_se", "realizations"]];
    for (const {gas, x: xs} of this.chart.shown())
      gas.y.forEach((y, k) => rows.push([...gasNames.map((name) => gas[name]),
        ...isProfile ? [this.chosen.tau] : [], xs[k], y, gas.se[k], gas.realizations[k]]));
    download(`${quantity.name}.csv`, csvText(rows));
  }
}
