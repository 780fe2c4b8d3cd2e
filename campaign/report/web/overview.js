// Where the campaign stands: what `campaign status` says, as parts of the page.

const gasColumns = [{title: "e", number: true}, {title: "n", number: true}, {title: "N", number: true}];

function gasCells({e, n, particles}) {
  return [e === null ? noValue : numberText(e), numberText(n), countText(particles)];
}

function gasText({kind, d, e, n, particles, seed, effects}) {
  const others = effects && Object.keys(effects).length > 0 ? " " + JSON.stringify(effects) : "";
  return [kind, d === 2 ? "disks" : null, kind === "cooling" && e !== null ? `e = ${numberText(e)}` : null,
    `n = ${numberText(n)}`, `N = ${countText(particles)}`, seed === undefined ? null : `seed ${seed}`]
    .filter(Boolean).join(" ") + others;
}

function showProgress(data) {
  const name = data.store.split("/").pop();
  document.title = `${percentText(data.fraction_done)} · ${name}`;
  byId("title").textContent = name;
  byId("read").textContent = `${data.store}, as it was on ${timeText(data.read)}`;
  const all = Object.values(data.jobs).reduce((sum, count) => sum + count, 0);
  const left = data.seconds_left !== null ? `${durationText(data.seconds_left)}`
    : data.remaining_cpu_seconds > 0 ? "nothing runs" : "nothing is left";
  byId("progress").replaceChildren(
    make("progress", {max: "1", value: data.fraction_done, "aria-label": "Work done"}),
    makeFigures([
      ["work done", percentText(data.fraction_done)],
      ["remaining time", left],
      ["jobs done", `${countText(data.jobs.done)} of ${countText(all)}`],
      ["CPU time spent", durationText(data.cpu_seconds)],
      ["CPU time to come", durationText(data.remaining_cpu_seconds)],
      data.jobs.failed > 0 ? ["failed", make("span", {class: "bad"}, countText(data.jobs.failed))] : null,
    ]),
    data.next.length === 0 ? "" : make("p", {class: "quiet"}, "Next: ",
      ...data.next.flatMap((command) => [make("code", {}, command), " "])));
}

function showJobs(data) {
  byId("job-states").replaceChildren(makeTable(
    [{title: "status"}, {title: "jobs", number: true}, {title: ""}],
    data.statuses.map(({status, meaning}) => [status, countText(data.jobs[status]), meaning])));

  const reasons = data.failures.map((failure) =>
    [String(failure.job_id), gasText(failure), failure.status, failure.error ?? "for no reason known"]);
  const blockedBy = new Map();
  for (const {equilibration_id: id} of data.blocked) blockedBy.set(id, (blockedBy.get(id) ?? 0) + 1);
  for (const [id, count] of blockedBy)
    reasons.push([noValue, `${countText(count)} cooling job${count === 1 ? "" : "s"}`, "blocked",
      `the equilibration, job ${id}, failed: retry that first`]);
  byId("job-reasons").replaceChildren(...reasons.length === 0 ? [] : [make("h3", {}, "Reasons"),
    makeTable([{title: "job", number: true}, {title: "what"}, {title: "status"},
      {title: "reason", message: true}], reasons, {tall: true, label: "Failures and their reasons"})]);

  byId("job-running").replaceChildren(...data.running.length === 0 ? [] : [make("h3", {}, "Running"),
    makeTable([{title: "job", number: true}, {title: "what"}, {title: "τ", number: true}, {title: ""},
      {title: "host"}, {title: "process", number: true}, {title: ""}],
      data.running.map((job) => [job.job_id, gasText(job),
        `${job.tau_reached.toFixed(1)} of ${numberText(job.tau_max)}`, makeMeter(job.tau_reached / job.tau_max),
        job.host, job.pid, job.abandoned ? "is gone; the next run takes the job back" : ""]),
      {tall: true, label: "Running jobs"})]);

  byId("job-shards").replaceChildren(...data.shards.length === 0 ? [] : [make("h3", {}, "Shards"),
    makeTable([{title: "shard"}, {title: "jobs", number: true}, {title: "still lent", number: true},
      {title: "done", number: true}, {title: "CPU time", number: true}, {title: "merged"},
      {title: "Slurm"}, {title: "file"}],
      data.shards.map((shard) => [shard.shard, countText(shard.jobs), countText(shard.still_lent),
        shard.fraction_done === null ? noValue : percentText(shard.fraction_done),
        durationText(shard.cpu_seconds), shard.merged, shard.slurm, shard.path]),
      {tall: true, label: "Shards"})]);
}

let occupancyChart = null;

function showOccupancy(data) {
  const place = byId("occupancy");
  if (data.occupancy.length === 0) {
    place.replaceChildren(make("p", {class: "quiet"}, "No job has ended yet."));
    occupancyChart = null;
    return;
  }
  if (!occupancyChart) {
    occupancyChart = new Chart(make("div"), "Processors at work over time", {height: 220, zoom: false});
    place.replaceChildren(occupancyChart.plot.parentElement, make("p", {class: "quiet"},
      "The CPU time of each job, spread evenly between its start and its end."));
  }
  const curves = data.occupancy.map(({host, time, busy}, k) => ({key: host, label: host, stepped: true,
    colour: colourOf(k, data.occupancy.length), x: time, y: busy}));
  occupancyChart.draw({curves, x: {label: "time", time: true}, y: {label: "processors"}});
}

let tauChart = null;

function showTauC(data) {
  const series = data.series.filter((one) => one.kind === "cooling" && one.e !== null);
  const rows = series.map((one) => [...gasCells(one), Object.keys(one.effects).length ? JSON.stringify(one.effects) : "",
    `${one.realizations} of ${one.realizations_planned}`,
    `${one.tau_reached.toFixed(1)} of ${numberText(one.tau_max)}`,
    one.tau_c === null ? noValue : valueWithError(one.tau_c, barOf(one)) +
      (one.reached < one.realizations ? ` (${one.reached} of ${one.realizations})` : ""),
    one.published_tau_c === null ? noValue : numberText(one.published_tau_c)]);
  byId("tau-c-table").replaceChildren(makeTable([...gasColumns, {title: "effects"},
    {title: "realizations", number: true}, {title: "τ reached", number: true},
    {title: "τc", number: true}, {title: "published", number: true}], rows,
    {tall: true, label: "Crossover by gas"}),
    make("p", {class: "quiet"}, "±: 68 % interval of the mean over realizations, by Student's t. Published: " +
      "R. Kawahara and H. Nakanishi, cond-mat/0309130 (N = 600 000, n = 0.40)."));
  const groups = new Map();
  const add = (key, point) => groups.set(key, [...(groups.get(key) ?? []), point]);
  for (const one of series) {
    const others = Object.keys(one.effects).length ? " " + JSON.stringify(one.effects) : "";
    if (one.tau_c !== null)
      add(`n = ${numberText(one.n)}, N = ${countText(one.particles)}${others}`,
        {x: one.e, y: one.tau_c, error: barOf(one)});
    if (one.published_tau_c !== null) add("published", {x: one.e, y: one.published_tau_c, error: NaN});
  }
  const place = byId("tau-c-chart");
  if (groups.size === 0) {
    place.replaceChildren(make("p", {class: "quiet"}, "No finished run has reached its τc yet."));
    tauChart = null;
    return;
  }
  tauChart ??= new Chart(place, "Crossover against restitution", {height: 300, zoom: false});
  const names = [...groups.keys()];
  tauChart.draw({x: {label: "e"}, y: {label: "τc", log: true}, curves: names.map((name, k) => {
    const points = [...new Map(groups.get(name).map((p) => [p.x, p])).values()].sort((a, b) => a.x - b.x);
    return {key: name, label: name, symbols: true, colour: colourOf(k, names.length),
      dash: name === "published" ? [4, 4] : undefined,
      x: points.map((p) => p.x), y: points.map((p) => p.y), error: points.map((p) => p.error)};
  })});
}

function barOf({tau_c_se: error, reached}) {
  return error === null ? NaN : error * studentFactor(reached);
}

function showTargets(data) {
  byId("target-table").replaceChildren(data.targets.length === 0
    ? make("p", {class: "quiet"}, "The grids of this store ask for no standard error (key \"target\").")
    : makeTable([...gasColumns, {title: "quantity"}, {title: "mean", number: true},
      {title: "standard error", number: true}, {title: "wanted", number: true},
      {title: "realizations", number: true}, {title: "expected", number: true},
      {title: "CPU time", number: true}, {title: "to come", number: true}, {title: ""}],
      data.targets.map((target) => [...gasCells(target),
        target.quantity + (target.tau[1] > target.tau[0]
          ? `, τ ${numberText(target.tau[0])} to ${numberText(target.tau[1])}` : ""),
        numberText(target.mean, 5), numberText(target.se, 3), numberText(target.se_wanted, 3),
        countText(target.realizations), countText(target.realizations_expected),
        durationText(target.cpu_seconds), durationText(target.cpu_seconds_to_come),
        make("span", {class: target.verdict === "met" ? "good" : ""}, target.verdict)]),
      {tall: true, label: "Targets"}));
}

function showCost(data) {
  const most = Math.max(...data.cost.map((one) => Math.max(one.expected_cpu_seconds, one.cpu_seconds)), 1e-9);
  byId("cost-table").replaceChildren(data.cost.length === 0
    ? make("p", {class: "quiet"}, "There are no jobs.")
    : makeTable([{title: "kind"}, ...gasColumns, {title: "jobs done", number: true},
      {title: "expected", number: true}, {title: ""}, {title: "spent", number: true}, {title: ""},
      {title: "spent / expected, done jobs", number: true}],
      data.cost.map((one) => [one.kind + (one.d === 2 ? ", disks" : "") +
          (one.effects === "{}" ? "" : " " + one.effects),
        ...gasCells(one), `${countText(one.done)} of ${countText(one.jobs)}`,
        durationText(one.expected_cpu_seconds), makeMeter(one.expected_cpu_seconds / most, "expected"),
        durationText(one.cpu_seconds), makeMeter(one.cpu_seconds / most, "spent"),
        one.expected_cpu_seconds_of_done > 0
          ? (one.cpu_seconds_of_done / one.expected_cpu_seconds_of_done).toFixed(2) : noValue]),
      {tall: true, label: "CPU time by gas"}));
}

function showPhysics(data) {
  const worst = data.invariants;
  byId("physics-table").replaceChildren(worst === null
    ? make("p", {class: "quiet"}, "No run has been checked yet.")
    : makeTable([{title: "of all runs"}, {title: "", number: true}, {title: "meaning"}], [
      ["largest overlap", `${numberText(worst.largest_overlap, 3)} σ`, "how far two particles were inside each other"],
      ["events in the past", countText(worst.past_events), "predicted for a time that was over"],
      ["unresolved collisions", countText(worst.unresolved_collisions), "that left the pair approaching"],
      ["energy mismatch", numberText(worst.energy_mismatch, 3), "of the energy beside the losses counted, relative"],
      ["momentum", numberText(worst.momentum_removed, 3), "that had gathered, over √N thermal speeds"],
    ]),
    ...data.notes.map((note) => make("p", {class: "notice"}, note)));
}

function showOrigin(data) {
  byId("origin-table").replaceChildren(
    make("p", {}, `This page was made on a machine with ${countText(data.origin.processors)} ` +
      `processor${data.origin.processors === 1 ? "" : "s"} and ${bytesText(data.origin.memory_bytes)} of memory, by`),
    make("pre", {}, data.origin.program),
    makeTable([{title: "jobs computed by"}, {title: "on"}, {title: "jobs", number: true}],
      data.origin.written_by.map((one) => [`campaign ${one.code_version}`, one.host, countText(one.jobs)]),
      {label: "Programs and hosts"}));
}

function showOverview(data) {
  showProgress(data);
  showJobs(data);
  showOccupancy(data);
  showTauC(data);
  showTargets(data);
  showCost(data);
  showPhysics(data);
  showOrigin(data);
}
