// Does to the project what Vite does for people, and prints what happens, a JSON document in a line
// for each step. The test runs it in the project: `node driver.mjs build`, or `serve`.
//
// While it serves, it reads lines: a file and its new text, in JSON. It writes the file, and
// waits for what Vite tells the page.

import { writeFile } from "node:fs/promises";
import readline from "node:readline";
import { build, createServer } from "vite";

const LIMIT = 30_000;

function tell(what) {
  console.log(JSON.stringify(what));
}

/** An error as the page gets it. */
function shown({ message, loc, frame, id }) {
  return { message, loc, frame, id };
}

async function builds() {
  const lib = { entry: "main.js", formats: ["es"], fileName: "main" };
  const warnings = [];
  const onwarn = (warning) => warnings.push(shown(warning));
  try {
    await build({ logLevel: "silent", build: { lib, rollupOptions: { onwarn } } });
    tell({ exports: { ...(await import("./dist/main.js")) }, warnings });
  } catch (error) {
    tell({ error: shown(error) });
  }
}

async function serves() {
  const server = await createServer({
    logLevel: "silent",
    server: { port: 0, watch: { usePolling: true, interval: 50 } },
  });
  await server.listen();
  const { port } = server.httpServer.address();
  let heard = [];
  const { hot } = server.environments.client;
  const send = hot.send.bind(hot);
  hot.send = (...payload) => {
    heard.push(payload[0]);
    send(...payload);
  };

  /** What a page that imports a module gets. */
  async function got(path) {
    heard = [];
    const answer = await fetch(`http://localhost:${port}${path}`, { headers: { accept: "*/*" } });
    const text = await answer.text();
    const error = heard.find((each) => each.type === "error");
    return { status: answer.status, text, ...(error && { error: shown(error.err) }) };
  }

  async function loaded() {
    await got("/accepting.js");
    return got("/materials/plastic.burnish?import");
  }

  tell(await loaded());
  for await (const line of readline.createInterface({ input: process.stdin })) {
    const { file, text } = JSON.parse(line);
    heard = [];
    await writeFile(file, text);
    const end = Date.now() + LIMIT;
    const isTold = () => heard.some((each) => ["update", "full-reload"].includes(each.type));
    while (!isTold() && Date.now() < end) {
      await new Promise((resume) => setTimeout(resume, 20));
    }
    const told = heard.map(({ type, updates }) => ({
      type,
      updates: updates?.map((each) => [each.path, each.acceptedPath]),
    }));
    tell({ told, ...(await loaded()) });
  }
  await server.close();
}

await { build: builds, serve: serves }[process.argv[2]]();
