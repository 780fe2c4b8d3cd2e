// The page of `campaign report` in a real Chromium: what a user does with it by mouse, keyboard and
// finger, and that the text of a store stays text. Pictures go to the folder PICTURES.
import assert from "node:assert/strict";
import {execFileSync, spawn} from "node:child_process";
import {mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const {CAMPAIGN, CHROMIUM, PICTURES} = process.env;
const attack = `x'"</title></script><script>window.owned = 1</script><img src=x onerror="window.owned=1">&lt;\\u003c`;

let folder, browser, store;

const campaign = (...words) => execFileSync(CAMPAIGN, words, {cwd: folder, encoding: "utf8"});
const query = (sql) => JSON.parse(campaign("query", sql, "--format", "json", "--store", store));

// A new page without a network. Errors in it, and requests to a network, are kept.
async function open(address, options = {}, offline = true) {
  const context = await browser.newContext({viewport: {width: 1200, height: 900}, ...options});
  await context.setOffline(offline);
  const page = await context.newPage();
  page.wrong = [];
  page.on("pageerror", (error) => page.wrong.push(error.message));
  page.on("console", (message) => message.type() === "error" && page.wrong.push(message.text()));
  page.on("dialog", (dialog) => { page.wrong.push("a dialog"); dialog.dismiss(); });
  page.on("request", (request) => {
    if (offline && !/^(file|blob|data):/.test(request.url())) page.wrong.push(request.url());
  });
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "all");
  return page;
}

const legend = (page) => page.locator("#curve-chart .legend button");
// Chooses a quantity; its curves have to be read, and are there a moment later.
async function choose(page, quantity) {
  await page.locator("#curve-choices select").first().selectOption(quantity);
  await page.waitForFunction(
    (name) => document.getElementById("curve-chart").dataset.quantity === name, quantity);
}
const reading = (page) => page.locator("#curve-chart [role=status]").textContent();

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "haff-report-"));
  mkdirSync(PICTURES, {recursive: true});
  store = "it's <b>bold<i> & \"quoted\".db";
  writeFileSync(join(folder, "grid.json"), JSON.stringify({e: [0.7, 0.8, 0.9], n: [0.2, 0.4], N: 500,
    seeds: 3, tau_max: 40, profiles_every: 20, observables: ["temperature", "laguerre", "correlations"]}));
  campaign("plan", "grid.json", "--store", store);
  campaign("run", "--store", store);
  browser = await chromium.launch({executablePath: CHROMIUM, args: ["--no-sandbox"]});
});

after(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

function report(name = store) {
  campaign("report", "--store", name, "--out", "out");
  return pathToFileURL(join(folder, "out", "report.html")).href;
}

test("it opens from a folder with no network, and says where the campaign stands", async () => {
  const page = await open(report());
  assert.equal(await page.locator("h1").textContent(), store);
  assert.match(await page.locator("#progress").textContent(), /100\.0 %/);
  assert.equal(await page.locator("#job-states tbody tr").count(), 6);
  assert.match(await page.locator("#physics-table").textContent(), /largest overlap/);
  assert.match(await page.locator("#origin-table").textContent(), /campaign \d/);
  await page.screenshot({path: join(PICTURES, "light.png"), fullPage: true});
  assert.deepEqual(page.wrong, []);
});

test("curves are switched off by e, n, N and one by one", async () => {
  const page = await open(report());
  assert.equal(await legend(page).count(), 6);
  await page.locator("#curve-filters fieldset", {hasText: "0.7"}).getByLabel("0.7").uncheck();
  assert.equal(await legend(page).count(), 4);
  await page.locator("#curve-filters").getByLabel("0.2").uncheck();
  assert.equal(await legend(page).count(), 2);
  await page.locator("#curve-filters").getByLabel("No e").click();
  assert.equal(await legend(page).count(), 0);
  await page.locator("#curve-filters").getByLabel("All e").click();
  await legend(page).first().click();
  assert.equal(await legend(page).first().getAttribute("aria-pressed"), "false");
  assert.deepEqual(page.wrong, []);
});

test("theory is drawn beside the curves, and is no curve of its own", async () => {
  const page = await open(report());
  assert.equal(await legend(page).count(), 6);
  await page.getByLabel("Haff's law").uncheck();
  assert.equal(await legend(page).count(), 6);
  await page.getByLabel("Haff's law").check();
  await legend(page).first().click();
  const [file] = await Promise.all([page.waitForEvent("download"),
    page.locator("#curve-chart").getByText("Download CSV").click()]);
  const rows = readFileSync(await file.path(), "utf8").trimEnd().split("\n");
  assert.equal(rows.length - 1, 5 * 41);  // without the curve that is switched off, and without theory
  assert.deepEqual(page.wrong, []);
});

test("theories are those of plot --theory, for columns and profiles, and are in the SQL", async () => {
  const page = await open(report());
  await choose(page, "a2");
  for (const line of ["Enskog–Boltzmann, first order in a₂", "Enskog–Boltzmann, direct simulation"])
    await page.getByLabel(line).uncheck();
  assert.equal(await legend(page).count(), 6);
  await page.getByLabel("first order in a₂").check();
  await page.locator("#curves").screenshot({path: join(PICTURES, "theory.png")});
  await choose(page, "gamma_ratio");
  await page.getByLabel("energy equation, Gaussian velocities").waitFor();
  await choose(page, "G_parallel");
  await page.getByLabel("incompressible theory").waitFor();
  await page.locator("#question-box textarea").fill("SELECT count(DISTINCT line) AS lines FROM theory WHERE name = 'a2'");
  await page.locator("#question-box").getByText("Ask", {exact: true}).click();
  await page.locator("#question-box td", {hasText: "2"}).first().waitFor();
  assert.deepEqual(page.wrong, []);
});

test("a point reads as the store has it, by keyboard and by mouse", async () => {
  const page = await open(report());
  await choose(page, "a2");
  await page.locator("#curve-chart .plot").focus();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("0");
  for (let k = 0; k < 3; ++k) await page.keyboard.press("ArrowRight");
  const said = await reading(page);
  const [, e, n, tau] = said.match(/^e = ([\d.]+), n = ([\d.]+): x ([\d.]+), y /);
  const [{a2}] = query(`SELECT a2 FROM mean_series WHERE e = ${e} AND n = ${n} AND tau = ${tau}`);
  assert.ok(Math.abs(Number(said.match(/y (-?[\d.e-]+)/)[1]) - a2) < 1e-3, `${said} beside ${a2}`);
  const box = await page.locator("#curve-chart .u-over").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  assert.match(await page.locator("#curve-chart .tip").textContent(), /e = .*x 20y /);
  assert.deepEqual(page.wrong, []);
});

test("zoom by keyboard, by numbers and by mouse; 0 and a double click show all", async () => {
  const page = await open(report());
  const from = page.getByLabel("From x"), to = page.getByLabel("To x");
  const range = async () => [Number(await from.inputValue()), Number(await to.inputValue())];
  assert.deepEqual(await range(), [0, 40]);
  await from.fill("10");
  await from.press("Tab");
  assert.deepEqual(await range(), [10, 40]);
  await page.locator("#curve-chart .plot").focus();
  await page.keyboard.press("+");
  const [low, high] = await range();
  assert.ok(high - low < 16);
  await page.keyboard.press("0");
  assert.deepEqual(await range(), [0, 40]);
  const box = await page.locator("#curve-chart .u-over").boundingBox();
  await page.mouse.move(box.x + 0.25 * box.width, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 52, {steps: 5});
  await page.mouse.up();
  const [a, b] = await range();
  assert.ok(Math.abs(a - 10) < 0.2 && Math.abs(b - 20) < 0.2, `${a} ${b}`);
  await page.locator("#curve-chart .u-over").dblclick();
  assert.deepEqual(await range(), [0, 40]);
  assert.deepEqual(page.wrong, []);
});

test("every quantity and every axis draws", async () => {
  const page = await open(report());
  const show = page.locator("#curve-choices select").first();
  const names = await show.locator("option").evaluateAll((options) => options.map((option) => option.value));
  for (const name of ["temperature", "gamma_ratio", "a2", "pressure", "G_parallel"])
    assert.ok(names.includes(name), `${name} is in ${names}`);
  for (const name of names.filter((one) => !/^a[3-6]$/.test(one))) {
    await choose(page, name);
    assert.equal(await legend(page).count(), 6, name);
    const against = page.locator("#curve-choices").getByLabel("against");
    if (await against.count() > 0)
      for (const x of await against.locator("option").evaluateAll((options) => options.map((option) => option.value)))
        await against.selectOption(x);
    await page.getByLabel("log x").check();
    await page.getByLabel("log y").check();
    await page.getByLabel("log x").uncheck();
    await page.getByLabel("log y").uncheck();
  }
  assert.deepEqual(page.wrong, []);
});

test("of two choices in a row the later one is shown", async () => {
  const page = await open(report());
  await page.evaluate(() => {
    const select = document.querySelector("#curve-choices select");
    for (const name of ["G_parallel", "a2"]) {  // the first takes one question more to be read
      select.value = name;
      select.dispatchEvent(new Event("change"));
    }
  });
  await page.waitForFunction(() => document.getElementById("curve-chart").dataset.quantity === "a2");
  await page.waitForTimeout(500);  // a late answer to the first one would have come
  assert.equal(await page.locator("#curve-choices select").first().inputValue(), "a2");
  assert.equal(await page.locator("#curve-choices").getByLabel("against").count(), 1);
  assert.deepEqual(page.wrong, []);
});

test("the CSV of the curves on show has the store's digits", async () => {
  const page = await open(report());
  await choose(page, "a2");
  await page.locator("#curve-filters").getByLabel("0.7").uncheck();
  const [file] = await Promise.all([page.waitForEvent("download"),
    page.locator("#curve-chart").getByText("Download CSV").click()]);
  assert.equal(file.suggestedFilename(), "a2.csv");
  const lines = readFileSync(await file.path(), "utf8").trimEnd().split("\n");
  assert.equal(lines[0], "d,e,n,particles,equilibrate,sample_every,effects,tau,a2,a2_se,realizations");
  const rows = query("SELECT e, tau, a2 FROM mean_series WHERE e <> 0.7 AND a2 IS NOT NULL ORDER BY n, e, tau");
  assert.equal(lines.length - 1, rows.length);
  assert.equal(Number(lines[7].split(",")[8]), rows[6].a2);  // the same double
});

test("SQL is answered in the browser as by campaign query", async () => {
  const page = await open(report());
  const sql = "SELECT e, n, tau, temperature FROM mean_series WHERE tau IN (10, 20) ORDER BY e, n, tau";
  await page.locator("#question textarea").fill(sql);
  await page.keyboard.press("Control+Enter");
  await page.waitForSelector("#question-box tbody tr td");
  const rows = query(sql);
  const [file] = await Promise.all([page.waitForEvent("download"),
    page.locator("#question").getByText("Download CSV").click()]);
  const lines = readFileSync(await file.path(), "utf8").trimEnd().split("\n").slice(1);
  assert.deepEqual(lines.map((line) => line.split(",").map(Number)), rows.map((row) => Object.values(row)));

  const ask = async (text) => {
    await page.locator("#question textarea").fill(text);
    await page.locator("#question").getByText("Ask", {exact: true}).click();
    await page.waitForFunction(() => !/…/.test(document.querySelector("#question-box [role=status]").textContent));
    return page.locator("#question-box [role=status]").textContent();
  };
  assert.match(await ask("SELECT colour FROM mean_series"), /no such column/);
  assert.match(await ask("DELETE FROM mean_series"), /readonly|read-only/i);
  assert.match(await ask("SELECT 1; SELECT 2"), /one statement/);
  assert.match(await ask("  "), /no statement/);
  assert.match(await ask("SELECT 1 -- and a remark"), /^1 row /);
  assert.deepEqual(page.wrong, []);
});

test("a question without end is stopped, and the page goes on", async () => {
  const page = await open(report());
  await page.locator("#question textarea").fill(
    "WITH RECURSIVE k(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM k) SELECT sum(i) FROM k");
  await page.locator("#question").getByText("Ask", {exact: true}).click();
  await page.locator("#question").getByText("Stop", {exact: true}).click();
  await page.waitForFunction(() => /stopped/.test(document.querySelector("#question-box [role=status]").textContent));
  await page.locator("#question textarea").fill("SELECT count(*) FROM jobs");
  await page.locator("#question").getByText("Ask", {exact: true}).click();
  await page.waitForFunction(() => /^1 row /.test(document.querySelector("#question-box [role=status]").textContent));
  assert.deepEqual(page.wrong, []);
});

test("text of a store stays text", async () => {
  const hostile = "hostile.db";
  writeFileSync(join(folder, hostile), readFileSync(join(folder, store)));
  const quoted = `'${attack.replace(/'/g, "''")}'`;
  execFileSync("sqlite3", [join(folder, hostile), `PRAGMA ignore_check_constraints = ON;
    UPDATE jobs SET status = 'failed', error = ${quoted} WHERE job_id = 7;
    UPDATE jobs SET host = ${quoted}, code_version = ${quoted};
    UPDATE profiles SET name = ${quoted} WHERE name = 'G_parallel';
    UPDATE digests SET jobs = NULL, profiles = NULL;`]);
  const page = await open(report(hostile));
  assert.match(await page.locator("#job-reasons").textContent(), /<script>window\.owned/);
  assert.match(await page.locator("#origin-table").textContent(), /<img src=x/);
  await page.locator("#question textarea").fill("SELECT DISTINCT name, host FROM mean_profiles, jobs");
  await page.keyboard.press("Control+Enter");
  await page.waitForSelector("#question-box tbody tr td");
  await choose(page, attack);
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.evaluate(() => window.owned), undefined);
  assert.deepEqual(page.wrong, []);
});

// A server as a child process; resolves with its address once it prints it.
function serve(...words) {
  const child = spawn(CAMPAIGN, ["report", "--store", "live.db", "--serve", ...words], {cwd: folder});
  const address = new Promise((resolve, reject) => {
    let text = "";
    child.stdout.on("data", (data) => {
      text += data;
      const found = text.match(/http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//);
      if (found) resolve(found[0]);
    });
    child.once("exit", (code) => reject(new Error(`it ended with ${code}: ${text}`)));
  });
  const ended = new Promise((resolve) => child.once("exit", resolve));
  return {child, address, ended};
}

test("the served page follows a run, answers no other address, and stops at SIGTERM", async () => {
  writeFileSync(join(folder, "live.json"), JSON.stringify({e: [0.8, 0.9], n: 0.4, N: 500, seeds: 2, tau_max: 30}));
  campaign("plan", "live.json", "--store", "live.db");
  const {child, address, ended} = serve();
  const url = new URL(await address);
  for (const path of ["/", "/data.json", `/${"0".repeat(32)}/`, url.pathname + "../jobs", url.pathname + "x"])
    assert.equal((await fetch(url.origin + path)).status, 404, path);
  assert.equal((await fetch(url, {method: "POST"})).status, 404);
  const data = await (await fetch(new URL("data.json", url))).json();
  assert.equal(data.jobs.pending, 6);

  const page = await open(url.href, {}, false);
  assert.match(await page.locator("#progress").textContent(), /0\.0 %/);
  assert.equal(await legend(page).count(), 0);
  campaign("run", "--store", "live.db");
  await page.waitForFunction(() => /100\.0 %/.test(document.querySelector("#progress").textContent));
  await page.waitForFunction(() => document.querySelectorAll("#curve-chart .legend button").length === 2);
  assert.deepEqual(page.wrong, []);

  child.kill("SIGTERM");
  assert.equal(await ended, 0);
  await page.waitForFunction(() => /does not answer/.test(document.querySelector("#live").textContent));
});

test("on a phone nothing sticks out, and two fingers stretch", async () => {
  const page = await open(report(), {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true,
    deviceScaleFactor: 2});
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
  await page.locator("#curve-chart .plot").scrollIntoViewIfNeeded();
  const box = await page.locator("#curve-chart .u-over").boundingBox();
  const client = await page.context().newCDPSession(page);
  const touch = (type, ...xs) => client.send("Input.dispatchTouchEvent",
    {type, touchPoints: xs.map((x, id) => ({x: box.x + x, y: box.y + 80, id}))});
  await touch("touchStart", 120);
  await touch("touchStart", 120, 180);
  for (let k = 1; k <= 6; ++k) await touch("touchMove", 120 - 10 * k, 180 + 10 * k);
  await touch("touchEnd");
  const range = [Number(await page.getByLabel("From x").inputValue()), Number(await page.getByLabel("To x").inputValue())];
  assert.ok(range[1] - range[0] < 25, `${range}`);
  await page.screenshot({path: join(PICTURES, "phone.png"), fullPage: true});
  assert.deepEqual(page.wrong, []);
});

test("in dark mode text stands off its ground", async () => {
  const page = await open(report(), {colorScheme: "dark"});
  const contrasts = await page.evaluate(() => {
    const channels = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map(Number);
    const luminance = (colour) => channels(colour).map((c) => c / 255)
      .map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
      .reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    const ground = luminance(getComputedStyle(document.body).backgroundColor);
    return ["body", ".quiet", "a", "td"].map((place) => {
      const ink = luminance(getComputedStyle(document.querySelector(place)).color);
      return (Math.max(ink, ground) + 0.05) / (Math.min(ink, ground) + 0.05);
    });
  });
  for (const contrast of contrasts) assert.ok(contrast > 4.5, String(contrasts));  // WCAG 2, AA
  await page.screenshot({path: join(PICTURES, "dark.png"), fullPage: true});
  assert.deepEqual(page.wrong, []);
});
