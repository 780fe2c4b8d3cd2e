// Served by `campaign report --serve`, the page asks its server how things stand; a page that is not
// looked at does not.

const askEvery = 3000;  // [ms]

function followRun() {
  let version = data.averages_version;
  const say = (text) => {
    byId("live").hidden = text === "";
    byId("live").textContent = text;
  };
  const fetched = async (name) => {
    const answer = await fetch(name, {cache: "no-store"});
    if (!answer.ok) throw new Error(await answer.text());
    return answer;
  };
  const look = async () => {
    if (document.hidden) return;
    try {
      data = await (await fetched("data.json")).json();
      showOverview(data);
      if (data.averages_version !== version) {
        await database.replace(new Uint8Array(await (await fetched("averages.db")).arrayBuffer()));
        version = data.averages_version;
        await showTables();
      }
      say("");
    } catch (error) {
      say(`The server does not answer (${error.message}); this is what it said last.`);
    }
  };
  const again = async () => {
    await look();
    setTimeout(again, askEvery);
  };
  document.addEventListener("visibilitychange", look);
  setTimeout(again, askEvery);
}
