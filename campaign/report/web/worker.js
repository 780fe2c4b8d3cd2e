// SQLite in a thread of its own: a question that takes long, or never ends, leaves the page alive.
let database = null;

async function load({wasm, bytes}) {
  const sqlite = await initSqlJs({wasmBinary: wasm});
  database?.close();
  database = new sqlite.Database(bytes);
  database.exec("PRAGMA query_only = ON");
}

function query({sql, parameters, most}) {
  const statements = database.iterateStatements(sql);
  const first = statements.next();
  if (first.done) throw new Error("there is no statement");
  const statement = first.value;
  const rest = statements.getRemainingSQL().replace(/--[^\n]*|\/\*[\s\S]*?\*\//g, "").trim();
  if (rest) throw new Error("one statement at a time; not expected: " + rest);
  if (parameters) statement.bind(parameters);
  const rows = [];
  let isWhole = true;
  while (statement.step()) {
    if (rows.length === most) {
      isWhole = false;
      break;
    }
    rows.push(statement.get());
  }
  const answer = {columns: statement.getColumnNames(), rows, isWhole};
  statement.free();
  return answer;
}

self.onmessage = async ({data}) => {
  try {
    const answer = data.load ? await load(data.load) : query(data.query);
    self.postMessage({id: data.id, answer});
  } catch (error) {
    self.postMessage({id: data.id, error: String(error.message ?? error)});
  }
};
