// The averaged tables, asked in SQL.

function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

class Database {
  constructor(bytes) {
    this.bytes = bytes;
    this.wasm = bytesOf(byId("sqlite-wasm").textContent);
    this.start();
  }

  start() {
    const source = byId("sqlite-script").textContent + "\n" + byId("worker-script").textContent;
    const address = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
    this.waiting = new Map();
    this.next = 0;
    this.worker = new Worker(address);
    this.worker.onmessage = ({data}) => this.settle(data);
    this.worker.onerror = (event) => this.failAll(event.message || "SQLite could not be started");
    this.ready = this.send({load: {wasm: this.wasm, bytes: this.bytes}});
    this.ready.catch(() => {});
  }

  send(message) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      this.worker.postMessage({id, ...message});
    });
  }

  settle({id, answer, error}) {
    const one = this.waiting.get(id);
    this.waiting.delete(id);
    if (!one) return;
    if (error === undefined) one.resolve(answer);
    else one.reject(new Error(error));
  }

  failAll(reason) {
    for (const {reject} of this.waiting.values()) reject(new Error(reason));
    this.waiting.clear();
  }

  // {columns, rows, isWhole}; at most so many rows.
  async query(sql, {parameters = null, most = Infinity} = {}) {
    await this.ready;
    return this.send({query: {sql, parameters, most}});
  }

  // Rows as objects.
  async rows(sql, parameters) {
    const {columns, rows} = await this.query(sql, {parameters});
    return rows.map((row) => Object.fromEntries(columns.map((name, k) => [name, row[k]])));
  }

  replace(bytes) {
    this.bytes = bytes;
    this.ready = this.send({load: {wasm: this.wasm, bytes}});
    return this.ready;
  }

  // Ends what is being answered. The tables are there again at once.
  stop(reason) {
    this.worker.terminate();
    this.failAll(reason);
    this.start();
  }
}
