// The page: first what the store says of its jobs, then the tables.

let data = JSON.parse(byId("data").textContent);
showOverview(data);

const database = new Database(bytesOf(byId("averages").textContent));
const curves = new Curves(database);
const question = new Question(database);

async function showTables() {
  try {
    await curves.refresh();
    await question.showTables();
  } catch (error) {
    byId("curve-choices").replaceChildren(make("p", {class: "bad"},
      `The tables cannot be read: ${error.message}`));
  }
}
const shown = showTables();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  showOverview(data);
  shown.then(() => curves.quantities?.length && curves.draw());
});

if (document.documentElement.dataset.served === "yes") followRun();
document.documentElement.dataset.ready = "yes";
shown.then(() => { document.documentElement.dataset.ready = "all"; });
