// A question in SQL over the averaged tables, answered by the browser.

const shownRows = 500;
const examples = [
  ["τc by gas", "SELECT e, n, particles, tau_c, tau_c_se, realizations, reached\nFROM mean_tau_c ORDER BY n, particles, e"],
  ["a₂ around τ = 10", "SELECT e, n, particles, avg(a2) AS a2, max(realizations) AS realizations\nFROM mean_series WHERE tau BETWEEN 5 AND 15\nGROUP BY e, n, particles"],
  ["jobs that took longer than expected", "SELECT job_id, kind, e, n, particles, seed, cpu_seconds / expected_cpu_seconds AS ratio\nFROM jobs WHERE status = 'done' AND cpu_seconds > expected_cpu_seconds\nORDER BY ratio DESC"],
  ["CPU time by host", "SELECT host, count(*) AS jobs, sum(cpu_seconds) AS cpu_seconds FROM jobs GROUP BY host"],
  ["the tables", "SELECT name, sql FROM sqlite_schema"],
];

class Question {
  constructor(database) {
    this.database = database;
    this.text = make("textarea", {spellcheck: "false", autocapitalize: "off", autocomplete: "off",
      "aria-label": "One SQL statement", onkeydown: (event) => {
        if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.ask();
      }});
    this.text.value = examples[0][1];
    this.run = make("button", {type: "button", onclick: () => this.ask()}, "Ask");
    this.end = make("button", {type: "button", hidden: true,
      onclick: () => this.database.stop("it was stopped")}, "Stop");
    this.save = make("button", {type: "button", hidden: true, onclick: () =>
      download("rows.csv", csvText([this.answer.columns, ...this.answer.rows]))}, "Download CSV");
    const example = make("select", {"aria-label": "Examples", onchange: (event) => {
      if (event.target.value !== "") this.text.value = examples[Number(event.target.value)][1];
    }}, make("option", {value: ""}, "examples …"),
      ...examples.map(([title], k) => make("option", {value: k}, title)));
    this.said = make("p", {class: "quiet", role: "status"});
    this.rows = make("div");
    this.tables = make("div");
    byId("question-box").replaceChildren(
      make("p", {class: "quiet"}, "The averaged tables are in this page; SQLite in your browser answers, " +
        "and nothing leaves it. Ctrl+Enter asks."),
      this.text, make("div", {class: "tools"}, this.run, this.end, example, this.save), this.said, this.rows,
      make("details", {}, make("summary", {}, "Tables and their columns"), this.tables));
  }

  async showTables() {
    const {rows} = await this.database.query(
      "SELECT m.name, group_concat(c.name, ', ') FROM sqlite_schema AS m, pragma_table_info(m.name) AS c " +
      "WHERE m.type = 'table' GROUP BY m.name");
    const counts = await Promise.all(rows.map(([name]) => this.database.query(`SELECT count(*) FROM "${name}"`)));
    this.tables.replaceChildren(makeTable([{title: "table"}, {title: "rows", number: true},
      {title: "columns", message: true}],
      rows.map(([name, columns], k) => [make("code", {}, name), countText(counts[k].rows[0][0]), columns])));
  }

  async ask() {
    if (this.run.disabled) return;
    const start = performance.now();
    this.run.disabled = true;
    this.end.hidden = false;
    this.said.className = "quiet";
    this.said.textContent = "…";
    try {
      this.answer = await this.database.query(this.text.value, {most: 200000});
      this.show((performance.now() - start) / 1000);
    } catch (error) {
      this.said.className = "bad";
      this.said.textContent = `SQL: ${error.message}`;
      this.rows.replaceChildren();
      this.save.hidden = true;
    } finally {
      this.run.disabled = false;
      this.end.hidden = true;
    }
  }

  show(seconds) {
    const {columns, rows, isWhole} = this.answer;
    const few = rows.slice(0, shownRows);
    this.said.textContent = `${isWhole ? "" : "the first "}${countText(rows.length)} row${rows.length === 1 ? "" : "s"} ` +
      `in ${durationText(seconds)}` + (few.length < rows.length ? `; ${few.length} are shown, the CSV has them all` : "");
    const isNumber = (k) => few.some((row) => typeof row[k] === "number") &&
      few.every((row) => row[k] === null || typeof row[k] === "number");
    this.rows.replaceChildren(makeTable(
      columns.map((title, k) => ({title, number: isNumber(k), message: !isNumber(k)})),
      few.map((row) => row.map((value) => value === null ? "NULL" : typeof value === "number" ? numberText(value, 8)
        : value instanceof Uint8Array ? `${value.length} bytes` : value)),
      {tall: true, label: "Answer"}));
    this.save.hidden = false;
  }
}
